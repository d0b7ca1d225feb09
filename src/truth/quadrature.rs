//! Adaptive Gauss–Kronrod integration of a vector-valued function of one variable.

/// Abscissae of the 15-point Kronrod rule on [−1, 1], positive half and zero; the odd ones belong to the 7-point Gauss
/// rule too (Piessens et al. 1983, QUADPACK, routine QK15).
const ABSCISSAE: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];

/// Weights of the 15-point Kronrod rule at [`ABSCISSAE`].
const KRONROD_WEIGHTS: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];

/// Weights of the 7-point Gauss rule at the odd entries of [`ABSCISSAE`].
const GAUSS_WEIGHTS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// What accuracy an integral must reach, component by component.
pub(super) struct Goal<'a> {
    /// Error allowed relative to the component's integral.
    pub relative: f64,
    /// Error allowed in absolute terms where that is more; one entry for each component that is checked.
    ///
    /// Components beyond its length are integrated along but do not steer the refinement and report no error.
    pub floor: &'a [f64],
    /// Whether the last components of the integrand, as many as are checked, are errors of the checked ones.
    ///
    /// Their integral bounds what refinement can achieve: beyond it, panels would only resolve noise.
    pub noisy: bool,
    /// Number of panels at which refinement gives up.
    pub limit: usize,
}

/// An integral over one panel, or over all of them, with the estimate of its absolute error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral<const N: usize> {
    pub value: [f64; N],
    pub error: [f64; N],
    /// Whether the goal was reached; only meaningful for the whole.
    pub converged: bool,
}

/// A stretch of the integration variable and the integral over it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<const N: usize> {
    from: f64,
    to: f64,
    integral: Integral<N>,
}

/// Integrates `function` over the `stretches` (pairs of ends), each at first one panel, halving the worst panel until
/// the goal is met for every checked component.
///
/// `panels` is working memory, so that nested integrals need not allocate. The sum of panels is taken afresh after
/// each step, because a running sum would drift when panels of a high peak are replaced.
pub(super) fn integrate<const N: usize>(
    stretches: impl Iterator<Item = (f64, f64)>,
    goal: &Goal,
    panels: &mut Vec<Panel<N>>,
    mut function: impl FnMut(f64) -> [f64; N],
) -> Integral<N> {
    let checked = goal.floor.len().min(N);
    panels.clear();
    panels.extend(stretches.map(|(from, to)| measure(from, to, checked, &mut function)));
    loop {
        let mut total = Integral { value: [0.0; N], error: [0.0; N], converged: true };
        for panel in panels.iter() {
            for component in 0..N {
                total.value[component] += panel.integral.value[component];
                total.error[component] += panel.integral.error[component];
            }
        }
        // What a unit of error in each component is worth; zero for those that have reached the goal.
        let mut urgency = [0.0; N];
        for (component, &floor) in goal.floor.iter().enumerate().take(checked) {
            let noise = if goal.noisy { total.value[N - checked + component] } else { 0.0 };
            let allowed = (goal.relative * total.value[component].abs()).max(floor).max(noise);
            if total.error[component] > allowed {
                urgency[component] = 1.0 / allowed.max(f64::MIN_POSITIVE);
                total.converged = false;
            }
        }
        if total.converged || panels.len() >= goal.limit {
            return total;
        }
        let worst = panels
            .iter()
            .enumerate()
            .filter(|(_, panel)| panel.can_be_halved())
            .map(|(index, panel)| (index, panel.urgency(&urgency)))
            .fold((usize::MAX, 0.0), |best, next| if next.1 > best.1 { next } else { best });
        if worst.0 == usize::MAX {
            return total;
        }
        let Panel { from, to, .. } = panels[worst.0];
        let middle = 0.5 * (from + to);
        panels[worst.0] = measure(from, middle, checked, &mut function);
        panels.push(measure(middle, to, checked, &mut function));
    }
}

impl<const N: usize> Panel<N> {
    /// Mean of a component of the integrand.
    pub(super) fn mean(&self, component: usize) -> f64 {
        self.integral.value[component] / (self.to - self.from)
    }

    /// Whether the abscissae of both halves would still be distinct numbers.
    fn can_be_halved(&self) -> bool {
        self.to - self.from > 1e3 * f64::EPSILON * self.from.abs().max(self.to.abs())
    }

    /// Largest share of the panel's error in what is allowed.
    fn urgency(&self, weights: &[f64; N]) -> f64 {
        self.integral.error.iter().zip(weights).map(|(error, weight)| error * weight).fold(0.0, f64::max)
    }
}

/// One 15-point panel with QUADPACK's error estimate for the first `checked` components.
fn measure<const N: usize>(
    from: f64,
    to: f64,
    checked: usize,
    function: &mut impl FnMut(f64) -> [f64; N],
) -> Panel<N> {
    let center = 0.5 * (from + to);
    let half_width = 0.5 * (to - from);
    let mut samples = [[0.0; N]; 15];
    samples[7] = function(center);
    for index in 0..7 {
        let offset = half_width * ABSCISSAE[index];
        samples[index] = function(center - offset);
        samples[14 - index] = function(center + offset);
    }
    let mut integral = Integral { value: [0.0; N], error: [0.0; N], converged: true };
    for component in 0..N {
        let samples = samples.map(|sample| sample[component]);
        integral.value[component] = half_width * kronrod(samples);
        if component < checked {
            integral.error[component] = half_width * estimate(samples);
        }
    }
    Panel { from, to, integral }
}

/// Integral over [−1, 1] from samples in ascending order.
fn kronrod(samples: [f64; 15]) -> f64 {
    let pairs: f64 =
        (0..7).map(|index| KRONROD_WEIGHTS[index] * (samples[index] + samples[14 - index])).sum();
    pairs + KRONROD_WEIGHTS[7] * samples[7]
}

/// The same by the Gauss rule within the Kronrod rule.
fn gauss(samples: [f64; 15]) -> f64 {
    let pairs: f64 =
        (0..3).map(|index| GAUSS_WEIGHTS[index] * (samples[2 * index + 1] + samples[13 - 2 * index])).sum();
    pairs + GAUSS_WEIGHTS[3] * samples[7]
}

/// Error estimate of [`kronrod`], as in QUADPACK.
fn estimate(samples: [f64; 15]) -> f64 {
    let value = kronrod(samples);
    let variation = kronrod(samples.map(|sample| (sample - 0.5 * value).abs()));
    // The Kronrod rule is far more accurate than its distance from the Gauss rule. QUADPACK's empirical power 3/2
    // accounts for that, and hands back the whole variation while the panel is not resolved.
    let distance = (value - gauss(samples)).abs();
    let estimate = if variation > 0.0 {
        let ratio = 200.0 * distance / variation;
        variation * (ratio * ratio.sqrt()).min(1.0)
    } else {
        distance
    };
    estimate.max(ROUNDING * kronrod(samples.map(f64::abs)))
}

/// Relative rounding error of a sum of 15 samples, generously.
const ROUNDING: f64 = 20.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;

    /// The Kronrod rule integrates polynomials up to degree 23 exactly, the Gauss rule up to degree 13.
    #[test]
    fn rule_is_exact_for_polynomials() {
        for degree in 0..24 {
            let exact = (1.0 - (-1.0f64).powi(degree + 1)) / f64::from(degree + 1);
            let panel = measure(-1.0, 1.0, 1, &mut |x: f64| [x.powi(degree)]);
            assert!((panel.integral.value[0] - exact).abs() < 1e-15, "degree {degree}");
            if degree < 14 {
                assert!(panel.integral.error[0] < 2e-14, "degree {degree}: {}", panel.integral.error[0]);
            }
        }
    }

    #[test]
    fn peak_and_root_reach_their_goal() {
        let goal = Goal { relative: 1e-10, floor: &[0.0, 0.0], noisy: false, limit: 1000 };
        let peak = |x: f64| [1e-3 / (x * x + 1e-6), x.sqrt()];
        let integral = integrate([(0.0, 1.0)].into_iter(), &goal, &mut Vec::new(), peak);
        assert!(integral.converged);
        for (component, exact) in [1e3f64.atan(), 2.0 / 3.0].into_iter().enumerate() {
            let deviation = (integral.value[component] - exact).abs();
            assert!(deviation <= integral.error[component], "{component}: {deviation:e}");
            assert!(integral.error[component] <= 1e-10 * exact);
        }
    }
}
