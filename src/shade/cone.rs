//! Cones over ellipses: their vector form factors, whole and cut by planes.

use super::quad::{ltc_angle, ltc_angle_excess, ltc_edge_normal};
use super::real::{Real, Vector};
use super::surface::{LTC_NEAREST_PAIR, LTC_SHALLOWEST, LTC_TINY, unit};

/// The cone over an ellipse, in the ellipse's frame and in units that make its lengths about 1.
#[derive(Clone, Copy, Debug)]
pub struct LtcCone<R: Real> {
    /// First semi-axis.
    pub half_x: R::Vec3,
    /// Second semi-axis, conjugate to the first.
    pub half_y: R::Vec3,
    /// The ellipse's centre.
    pub centre: R::Vec3,
    /// Axes of the frame: along the longer semi-axis, along the shorter one, and away along the normal.
    pub frame: [R::Vec3; 3],
    /// The centre in that frame.
    pub place: R::Vec3,
    /// Squares of the semi-axes.
    pub squares: [R; 2],
    /// The positive root of the confocal equation.
    pub depth: R,
    /// The cone's axis in the frame, a unit vector.
    pub axis: R::Vec3,
    /// Length of the vector form factor of the whole cone.
    pub whole: R,
    /// Where the axis meets the ellipse's plane, in the semi-axes given.
    pub pierced: [R; 2],
    /// Reciprocal of its distance.
    pub nearness: R,
    /// Factor on lengths that leads to the unit.
    pub scale: R,
}

/// A plane through the surface point, as it cuts an ellipse: in the semi-axes' coordinates the ellipse is the
/// unit circle.
#[derive(Clone, Copy, Debug)]
pub struct LtcCut<R: Real> {
    /// Normal of the plane, a unit vector towards the side that counts.
    pub normal: R::Vec3,
    /// Height of the centre over the plane.
    pub height: R,
    /// Direction of rise in the circle's plane.
    pub toward: [R; 2],
    /// Rise by one radius.
    pub steepness: R,
    /// Signed distance of the chord from the centre: at least 1 if nothing counts, at most −1 if all does.
    pub offset: R,
    /// Half the length of the chord.
    pub reach: R,
    /// Cross product of the chord's middle and a radius along it, along the normal.
    pub moment: R,
}

/// The axes across a cone, in the ellipse's frame, with the eigenvalues that belong to them.
#[derive(Clone, Copy, Debug)]
pub struct LtcAcross<R: Real> {
    /// The wider one.
    pub first: R::Vec3,
    /// Eigenvalue of the first.
    pub first_value: R,
    /// The narrower one.
    pub second: R::Vec3,
    /// Eigenvalue of the second.
    pub second_value: R,
}

/// 1 − η / sinh η from k = cosh η − 1 ≥ 0.
pub fn ltc_hyperbolic_deficit<R: Real>(k: R) -> R {
    -R::hyperbolic_excess(k)
}

/// Cosine and sine of the angle by which to turn the first of two conjugate semi-axes to the longer axis of
/// their ellipse: half the angle of (`difference`, `product`), half the difference of their squares and their
/// scalar product.
pub fn ltc_half_turn<R: Real>(difference: R, product: R) -> [R; 2] {
    let (zero, one, half) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let square = difference * difference + product * product;
    let round = square < R::new(1e-30);
    let inverse = square.max(R::new(1e-30)).inverse_sqrt();
    let cosine = if round { one } else { difference.abs() * inverse };
    let sine = if round { zero } else { product * inverse };
    let large = half + half * cosine;
    let inverse_root = large.inverse_sqrt();
    let (large, small) = (large * inverse_root, half * sine * inverse_root);
    if difference >= zero { [large, small] } else { [small, large] }
}

/// The plane of the unit vector `normal` as it cuts the ellipse.
pub fn ltc_cut<R: Real>(
    normal: R::Vec3,
    half_x: R::Vec3,
    half_y: R::Vec3,
    size: R,
    centre: R::Vec3,
) -> LtcCut<R> {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let height = normal.dot(centre);
    let slope = [normal.dot(half_x), normal.dot(half_y)];
    let square = slope[0] * slope[0] + slope[1] * slope[1];
    let inverse = square.max(R::new(LTC_TINY)).inverse_sqrt();
    let steepness = size * square * inverse;
    let toward = [slope[0] * inverse, slope[1] * inverse];
    let offset = (-height / steepness.max(R::new(LTC_TINY))).clamp(R::new(-1e9), R::new(1e9));
    let bounded = offset.clamp(-one, one);
    let inside = (one - bounded) * (one + bounded);
    let reach = inside * inside.max(R::new(LTC_TINY)).inverse_sqrt();
    let middle = centre + (half_x * toward[0] + half_y * toward[1]) * (size * bounded);
    let along = (half_x * toward[1] - half_y * toward[0]) * size;
    let moment = normal.dot(middle.cross(along)).max(zero);
    LtcCut { normal, height, toward, steepness, offset, reach, moment }
}

/// One step of Laguerre's iteration towards the largest root of a cubic, all of whose roots are real.
pub fn ltc_cone_step<R: Real>(x: R, quadratic: R, linear: R, constant: R) -> R {
    let (two, three, four, six) = (R::new(2.0), R::new(3.0), R::new(4.0), R::new(6.0));
    let value = ((x + quadratic) * x + linear) * x + constant;
    let slope = (three * x + two * quadratic) * x + linear;
    let bend = six * x + two * quadratic;
    let under = (four * slope * slope - six * value * bend).max(R::new(0.0));
    let root = under * under.max(R::new(LTC_TINY)).inverse_sqrt();
    x - three * value / (slope + root).max(R::new(LTC_TINY))
}

/// The cone over the ellipse with the semi-axes `half_x` and `half_y` times `size` around `centre`. `normal` is the
/// cross product of the two, `volume` its scalar product with the centre, not negative.
pub fn ltc_cone<R: Real>(
    half_x: R::Vec3,
    half_y: R::Vec3,
    size: R,
    centre: R::Vec3,
    normal: R::Vec3,
    volume: R,
) -> LtcCone<R> {
    let (zero, one, half, tiny) = (R::new(0.0), R::new(1.0), R::new(0.5), R::new(LTC_TINY));
    let [cosine, sine] = ltc_half_turn((half_x.dot(half_x) - half_y.dot(half_y)) * half, half_x.dot(half_y));
    let long = half_x * cosine + half_y * sine;
    let long_square = long.dot(long);
    let long_inverse = long_square.max(tiny).inverse_sqrt();
    let normal_square = normal.dot(normal);
    let normal_inverse = normal_square.max(R::new(1e-30)).inverse_sqrt();
    let first = long * long_inverse;
    let third = normal * normal_inverse;
    let second = third.cross(first);
    let aspect = (normal_square * normal_inverse * long_inverse * long_inverse).min(one);
    let long_half = size * long_square * long_inverse;
    let scale = (centre.dot(centre) + long_half * long_half).max(tiny).inverse_sqrt();
    let a = (long_half * scale).min(one);
    let b = a * aspect;
    let centre = centre * scale;
    let place = R::Vec3::new(centre.dot(first), centre.dot(second), volume * normal_inverse * scale);
    let (a2, b2, q) = (a * a, b * b, aspect * aspect);
    let (x2, y2, z2) = (place.x() * place.x(), place.y() * place.y(), place.z() * place.z());

    // The lower bound: the ellipse's plane counts as one pole, right in value and slope at 0.
    let sum = x2 * q + y2;
    let ratio = sum / (x2 * q * q + y2).max(tiny);
    let pole = (b2 * ratio).min(a2);
    let weight = (sum * ratio).min(x2 + y2);
    let middle = half * (weight + z2 - pole);
    let square = middle * middle + z2 * pole;
    let root = square * square.max(tiny).inverse_sqrt();
    let above_middle = z2 * (pole / (root - middle).max(tiny)).min(R::new(1e19));
    let lowest = if middle > zero { middle + root } else { above_middle };
    let highest = x2 + y2 + z2;
    let quadratic = a2 + b2 - highest;
    let linear = b2 * (a2 - x2 - z2) - a2 * (y2 + z2);
    let constant = -z2 * a2 * b2;
    let mut depth = lowest;
    // What is all but a circle needs none in single precision.
    for _ in 0..R::steps(if aspect < R::new(0.9999) { 3 } else { 0 }) {
        depth = ltc_cone_step(depth, quadratic, linear, constant).max(lowest).min(highest);
    }
    let depth = depth.max(R::new(LTC_SHALLOWEST));

    let (x_weight, y_weight) = (one / (a2 + depth), one / (b2 + depth));
    let drawn = |weight: R| (depth * weight).min(one);
    let toward = R::Vec3::new(place.x() * drawn(x_weight), place.y() * drawn(y_weight), place.z());
    let nearness = toward.dot(toward).max(R::new(1e-30)).inverse_sqrt();
    let spread = ((a2 + depth) * (b2 + depth)).inverse_sqrt();
    let (xi, eta) = (-a * place.x() * x_weight, -b * place.y() * y_weight);
    LtcCone {
        half_x: half_x * (size * scale),
        half_y: half_y * (size * scale),
        centre,
        frame: [first, second, third],
        place,
        squares: [a2, b2],
        depth,
        axis: toward * nearness,
        whole: (place.z() * nearness * (a * b * spread)).min(one),
        pierced: [xi * cosine - eta * sine, xi * sine + eta * cosine],
        nearness,
        scale,
    }
}

/// A cut's moment in a cone's units, where it is at most 1 but for rounding.
pub fn ltc_cone_moment<R: Real>(cone: &LtcCone<R>, cut: &LtcCut<R>) -> R {
    (cut.moment * (cone.scale * cone.scale)).min(R::new(2.0))
}

/// Component along a plane's normal of the cone's axis.
pub fn ltc_cone_tilt<R: Real>(cone: &LtcCone<R>, cut: &LtcCut<R>) -> R {
    // The axis of a distant light from the heights over the plane, which keep their digits at the horizon.
    if cone.squares[0] < R::new(0.06) {
        let rise = cone.pierced[0] * cut.toward[0] + cone.pierced[1] * cut.toward[1];
        (cut.height + rise * cut.steepness) * cone.scale * cone.nearness
    } else {
        ltc_cone_inward(cone, cut.normal).dot(cone.axis)
    }
}

/// `v` in the frame of the ellipse.
pub fn ltc_cone_inward<R: Real>(cone: &LtcCone<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(cone.frame[0].dot(v), cone.frame[1].dot(v), cone.frame[2].dot(v))
}

/// `v` from the frame of the ellipse.
pub fn ltc_cone_outward<R: Real>(cone: &LtcCone<R>, v: R::Vec3) -> R::Vec3 {
    cone.frame[0] * v.x() + cone.frame[1] * v.y() + cone.frame[2] * v.z()
}

/// The axes across a cone.
pub fn ltc_cone_across<R: Real>(cone: &LtcCone<R>) -> LtcAcross<R> {
    let (one, half, tiny) = (R::new(1.0), R::new(0.5), R::new(LTC_TINY));
    let [a2, b2] = cone.squares;
    let (x_square, y_square) = (a2 + cone.depth, b2 + cone.depth);
    let inverse = [x_square.inverse_sqrt(), y_square.inverse_sqrt(), cone.depth.inverse_sqrt()];
    let weighted =
        R::Vec3::new(cone.place.x() * inverse[0], cone.place.y() * inverse[1], cone.place.z() * inverse[2]);
    let g = weighted * weighted.dot(weighted).max(R::new(1e-6)).inverse_sqrt();
    let p = -one / (one + g.z());
    let u = [one + g.x() * g.x() * p, g.x() * g.y() * p, -g.x()];
    let v = [g.x() * g.y() * p, one + g.y() * g.y() * p, -g.y()];
    let u_square = a2 * u[0] * u[0] + b2 * u[1] * u[1];
    let v_square = a2 * v[0] * v[0] + b2 * v[1] * v[1];
    let product = a2 * u[0] * v[0] + b2 * u[1] * v[1];
    let scale = one / (u_square + v_square).max(tiny);
    let [cosine, sine] =
        ltc_half_turn((u_square - v_square) * half * scale, (product * scale).clamp(-one, one));
    let w: [R; 3] = core::array::from_fn(|i| u[i] * cosine + v[i] * sine);
    let first_value = a2 * w[0] * w[0] + b2 * w[1] * w[1];
    let second_value = a2 * (b2 / first_value.max(tiny)).min(one) * (g.z() * g.z());
    let first = unit::<R>(R::Vec3::new(
        w[0] * x_square * inverse[0],
        w[1] * y_square * inverse[1],
        w[2] * cone.depth * inverse[2],
    ));
    LtcAcross {
        first,
        first_value,
        second: cone.axis.cross(first),
        second_value: second_value.min(first_value),
    }
}

/// What the integral along an arc needs of its chord.
struct Chord<R: Real> {
    /// Unit normal of the plane through both ends; components along the axes across the cone and its own.
    normal: R::Vec3,
    /// Sine of the angle between the two.
    sine: R,
    /// 1 − cosine of that angle.
    k: R,
    /// (1 − cosine of the arc's parameter) over the product of the two lengths.
    ratio: R,
    /// Whether the arc is more than half the cone.
    large: bool,
}

/// The integral along an arc, less a vector along its chord's normal; components as those of the normal. See the
/// include.
fn ltc_cone_sweep<R: Real>(cone: &LtcCone<R>, across: &LtcAcross<R>, chord: &Chord<R>, rest: R) -> R::Vec3 {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let pi = R::new(core::f64::consts::PI);
    let (n, sine) = (chord.normal, chord.sine);
    let first_k = (chord.ratio * across.first_value - chord.k).max(zero);
    let x = n.x() * (rest + sine * ltc_hyperbolic_deficit(first_k));

    let second_k = (chord.k - chord.ratio * across.second_value).clamp(zero, two);
    let second_excess = ltc_angle_excess(second_k.min(two - second_k));
    let y = if second_k > one {
        let factor_square = (across.first_value - across.second_value).max(zero)
            * (cone.depth + across.second_value)
            / (cone.depth * across.first_value).max(R::new(LTC_TINY));
        let factor_inverse = factor_square.max(R::new(LTC_TINY)).inverse_sqrt();
        let lesser = sine * n.y().abs();
        let angle = (pi * factor_inverse - lesser * (one + second_excess)).max(zero);
        let signed = if n.y() < zero { -angle } else { angle };
        n.y() * (rest + sine) - signed
    } else {
        n.y() * (rest - sine * second_excess)
    };

    let axis_k = (chord.k + chord.ratio * cone.depth).min(two);
    let lesser = (sine * n.z().abs()).min(cone.whole);
    let acute = lesser + lesser * ltc_angle_excess(axis_k.min(two - axis_k));
    let part = if axis_k > one { pi * cone.whole - acute } else { acute };
    let z = if chord.large { two * pi * cone.whole - part } else { part };
    R::Vec3::new(x, y, z)
}

/// A point of the circle's plane.
type Plane<R> = [R; 2];

/// The point of the ellipse's plane at `p`.
fn ltc_cone_point<R: Real>(cone: &LtcCone<R>, p: Plane<R>) -> R::Vec3 {
    cone.centre + cone.half_x * p[0] + cone.half_y * p[1]
}

fn inverse_length<R: Real>(v: R::Vec3) -> R {
    v.dot(v).max(R::new(LTC_TINY)).inverse_sqrt()
}

/// Vector form factor, times 2π, of the part of a cone on the side of a plane that counts, and its component along
/// the plane's normal, which has more digits for a distant light.
pub fn ltc_cone_part<R: Real>(cone: &LtcCone<R>, across: &LtcAcross<R>, cut: &LtcCut<R>) -> (R::Vec3, R) {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let middle = ltc_cone_point(cone, [cut.toward[0] * cut.offset, cut.toward[1] * cut.offset]);
    let along = (cone.half_x * cut.toward[1] - cone.half_y * cut.toward[0]) * cut.reach;
    let (start, end) = (middle + along, middle - along);
    let (start_inverse, end_inverse) = (inverse_length::<R>(start), inverse_length::<R>(end));
    let both = (start_inverse * end_inverse).min(R::new(LTC_NEAREST_PAIR));
    let (start, end) = (start * start_inverse, end * end_inverse);
    let sine = (two * cut.reach * ltc_cone_moment(cone, cut) * both).min(one);
    let side = start - end;
    let rough = R::new(0.5) * side.dot(side);
    let k = if rough > one { rough } else { sine * sine / (two - rough) };
    let excess = sine * ltc_angle_excess(k.min((two - k).max(zero)));
    let rest = if k > one { R::new(core::f64::consts::PI) - two * sine - excess } else { excess };
    let normal = ltc_cone_inward(cone, cut.normal);
    let tilt = ltc_cone_tilt(cone, cut);
    let n = R::Vec3::new(normal.dot(across.first), normal.dot(across.second), tilt);
    let chord = Chord { normal: n, sine, k, ratio: two * cut.reach * cut.reach * both, large: tilt >= zero };
    let part = ltc_cone_sweep(cone, across, &chord, rest);
    let part = R::Vec3::new(part.x(), part.y(), part.z() + tilt * (rest + sine));
    let sum = across.first * part.x() + across.second * part.y() + cone.axis * part.z();
    (ltc_cone_outward(cone, sum), n.dot(part))
}

/// How two planes cut a cone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Together {
    /// As the first does alone.
    First,
    /// As the second does alone.
    Second,
    /// They leave nothing.
    Nothing,
    /// Each cuts off a part of its own.
    Apart,
    /// Their chords cross.
    Crossing,
}

/// How two planes cut a cone together; see the include.
pub fn ltc_cut_together<R: Real>(a: &LtcCut<R>, b: &LtcCut<R>) -> Together {
    let zero: R = R::new(0.0);
    let apart = [b.toward[0] - a.toward[0], b.toward[1] - a.toward[1]];
    let along = [b.toward[0] + a.toward[0], b.toward[1] + a.toward[1]];
    let (difference, sum) = (b.offset - a.offset, b.offset + a.offset);
    let reaches = (b.reach - a.reach) * (b.reach - a.reach);
    if difference * difference + reaches >= apart[0] * apart[0] + apart[1] * apart[1] {
        return if difference < zero { Together::First } else { Together::Second };
    }
    if sum * sum + reaches >= along[0] * along[0] + along[1] * along[1] {
        return if sum < zero { Together::Apart } else { Together::Nothing };
    }
    Together::Crossing
}

/// Vector form factor, times 2π, of the part of a cone on the sides of two planes that count, where the chords
/// of the two cross.
pub fn ltc_cone_between<R: Real>(
    cone: &LtcCone<R>,
    across: &LtcAcross<R>,
    a: &LtcCut<R>,
    b: &LtcCut<R>,
) -> R::Vec3 {
    let (zero, one, half) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let apart = [b.toward[0] - a.toward[0], b.toward[1] - a.toward[1]];
    let sine = a.toward[0] * apart[1] - a.toward[1] * apart[0];
    let turned = sine > zero;
    let bounded = sine.abs().max(R::new(1e-20));
    // Where the chord of the first meets that of the second.
    let rest = a.offset - b.offset - a.offset * (half * (apart[0] * apart[0] + apart[1] * apart[1]));
    let meet = (rest / if turned { bounded } else { -bounded }).clamp(-a.reach, a.reach);
    let meeting = ltc_cut_point(a, meet);
    let a_end = ltc_cut_point(a, if turned { -a.reach } else { a.reach });
    let b_end = ltc_cut_point(b, if turned { b.reach } else { -b.reach });
    let chords = if turned {
        ltc_cone_chord(cone, a, a_end, meeting) + ltc_cone_chord(cone, b, meeting, b_end)
    } else {
        ltc_cone_chord(cone, a, meeting, a_end) + ltc_cone_chord(cone, b, b_end, meeting)
    };
    let (from, to) = if turned { (b_end, a_end) } else { (a_end, b_end) };
    let arc = ltc_cone_arc(cone, across, from, to, a.offset + b.offset < -one);
    chords + ltc_cone_outward(cone, across.first * arc.x() + across.second * arc.y() + cone.axis * arc.z())
}

/// The point of a plane's chord at `s` from its middle, in the circle's plane.
fn ltc_cut_point<R: Real>(cut: &LtcCut<R>, s: R) -> Plane<R> {
    [cut.toward[0] * cut.offset + cut.toward[1] * s, cut.toward[1] * cut.offset - cut.toward[0] * s]
}

/// The integral along a stretch of the chord of a plane.
fn ltc_cone_chord<R: Real>(cone: &LtcCone<R>, cut: &LtcCut<R>, from: Plane<R>, to: Plane<R>) -> R::Vec3 {
    let (start, end) = (ltc_cone_point(cone, from), ltc_cone_point(cone, to));
    let (start_inverse, end_inverse) = (inverse_length::<R>(start), inverse_length::<R>(end));
    let step = [to[0] - from[0], to[1] - from[1]];
    let square = step[0] * step[0] + step[1] * step[1];
    let length = square * square.max(R::new(LTC_TINY)).inverse_sqrt();
    let both = (start_inverse * end_inverse).min(R::new(LTC_NEAREST_PAIR));
    let sine = length * ltc_cone_moment(cone, cut) * both;
    cut.normal * ltc_angle::<R>(start * start_inverse, end * end_inverse, sine)
}

/// The integral along an arc, in the frame of the cone's axes. `nearly_full` tells an arc of all but the whole
/// circle from one of all but nothing.
fn ltc_cone_arc<R: Real>(
    cone: &LtcCone<R>,
    across: &LtcAcross<R>,
    from: Plane<R>,
    to: Plane<R>,
    nearly_full: bool,
) -> R::Vec3 {
    let half: R = R::new(0.5);
    let (start, end) = (ltc_cone_point(cone, from), ltc_cone_point(cone, to));
    let (start_inverse, end_inverse) = (inverse_length::<R>(start), inverse_length::<R>(end));
    let both = (start_inverse * end_inverse).min(R::new(LTC_NEAREST_PAIR));
    let step = [from[0] - to[0], from[1] - to[1]];
    let square = step[0] * step[0] + step[1] * step[1];
    let side = cone.half_x * step[0] + cone.half_y * step[1];
    let product = ltc_cone_inward(cone, ltc_edge_normal::<R>(end, start, side));
    let product_square = product.dot(product);
    let product_inverse = product_square.max(R::new(LTC_TINY)).inverse_sqrt();
    let normal = R::Vec3::new(product.dot(across.first), product.dot(across.second), product.dot(cone.axis))
        * product_inverse;
    let chord = start * start_inverse - end * end_inverse;
    let sine = (product_square * product_inverse * both).min(R::new(1.0));
    let chord = Chord {
        normal,
        sine,
        k: half * chord.dot(chord),
        ratio: half * square * both,
        large: if square < R::new(1e-9) { nearly_full } else { normal.z() >= R::new(0.0) },
    };
    ltc_cone_sweep(cone, across, &chord, -sine)
}
