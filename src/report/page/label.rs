//! Labels that do not overlap.

/// A box on a chart; y runs down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest x.
    pub left: f64,
    /// Smallest y.
    pub top: f64,
    /// Largest x.
    pub right: f64,
    /// Largest y.
    pub bottom: f64,
}

impl Bounds {
    /// Whether two boxes have more than an edge in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    /// Whether `other` lies in this box.
    pub fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }

    /// Length of the part of a line that lies in the box.
    fn covers(&self, [ax, ay, bx, by]: [f64; 4]) -> f64 {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (start, step, low, high) in
            [(ax, bx - ax, self.left, self.right), (ay, by - ay, self.top, self.bottom)]
        {
            if step.abs() < 1e-12 {
                if start < low || start > high {
                    return 0.0;
                }
            } else {
                let [a, b] = [(low - start) / step, (high - start) / step];
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
        }
        (to - from).max(0.0) * (bx - ax).hypot(by - ay)
    }
}

/// A marker that needs a label of a given size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Its middle.
    pub x: f64,
    /// Its middle.
    pub y: f64,
    /// Its radius.
    pub radius: f64,
    /// Width of the label.
    pub width: f64,
    /// Height of the label.
    pub height: f64,
}

impl Anchor {
    fn marker(&self) -> Bounds {
        let Self { x, y, radius, .. } = *self;
        Bounds { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius }
    }
}

/// Where a label went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Its box.
    pub bounds: Bounds,
    /// A line from the marker to a label that is not beside it.
    pub leader: Option<[f64; 4]>,
}

/// Gap between a marker and its label.
const GAP: f64 = 3.0;
/// What a place costs for each unit of a line that a label hides, in units of distance.
const HIDDEN_LINE: f64 = 2.0;

/// Finds a place within `area` for the label of each anchor: near it, off all markers and all other labels, and off `lines`
/// where that is not far. Only if nothing within the area is free does a label overlap another one.
pub fn place(anchors: &[Anchor], area: Bounds, lines: &[[f64; 4]]) -> Vec<Placed> {
    let markers: Vec<Bounds> = anchors.iter().map(Anchor::marker).collect();
    let crowd = |anchor: &Anchor| {
        anchors.iter().filter(|other| (other.x - anchor.x).hypot(other.y - anchor.y) < 60.0).count()
    };
    let mut order: Vec<usize> = (0..anchors.len()).collect();
    // Those with most neighbours choose first.
    order.sort_by_key(|index| std::cmp::Reverse(crowd(&anchors[*index])));
    let mut placed: Vec<Option<Placed>> = vec![None; anchors.len()];
    for index in order {
        let taken: Vec<Placed> = placed.iter().flatten().copied().collect();
        let price = |candidate: &Placed| {
            let bounds = candidate.bounds;
            let clashes = markers.iter().chain(taken.iter().map(|other| &other.bounds));
            let clashes = clashes.filter(|other| bounds.overlaps(other)).count();
            let crossed: f64 = taken
                .iter()
                .flat_map(|other| {
                    let over = other.leader.map_or(0.0, |leader| bounds.covers(leader));
                    let under = candidate.leader.map_or(0.0, |leader| other.bounds.covers(leader));
                    [over, under]
                })
                .sum();
            let own = candidate.leader.map_or(0.0, |leader| {
                let others = markers.iter().enumerate().filter(|(other, _)| *other != index);
                others.map(|(_, marker)| marker.covers(leader)).sum()
            });
            let hidden: f64 = lines.iter().map(|line| bounds.covers(*line)).sum();
            let outside = if area.contains(&bounds) { 0.0 } else { 1e9 };
            let length = candidate.leader.map_or(0.0, |[ax, ay, bx, by]| 8.0 + (bx - ax).hypot(by - ay));
            outside + 1e6 * clashes as f64 + 1e3 * (crossed + own) + HIDDEN_LINE * hidden + length
        };
        let best = candidates(&anchors[index], area)
            .map(|candidate| (price(&candidate), candidate))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        placed[index] = best.map(|(_, candidate)| candidate);
    }
    placed.into_iter().flatten().collect()
}

/// The eight places beside an anchor, rings around it, and a grid over the whole area.
fn candidates(anchor: &Anchor, area: Bounds) -> impl Iterator<Item = Placed> {
    let Anchor { x, y, radius, width, height } = *anchor;
    let at = move |middle: [f64; 2]| {
        let [u, v] = middle;
        Bounds {
            left: u - 0.5 * width,
            right: u + 0.5 * width,
            top: v - 0.5 * height,
            bottom: v + 0.5 * height,
        }
    };
    // In order of preference, which decides between equals.
    let sides = [(1, 0), (1, -1), (1, 1), (-1, 0), (0, -1), (0, 1), (-1, -1), (-1, 1)];
    let beside = sides.into_iter().map(move |(across, down)| {
        let (across, down) = (f64::from(across), f64::from(down));
        let apart = radius + GAP;
        let off = if across != 0.0 && down != 0.0 { 0.7 } else { 1.0 };
        let middle =
            [x + across * (off * apart + 0.5 * width), y + down * (off * apart * 0.8 + 0.5 * height)];
        Placed { bounds: at(middle), leader: None }
    });
    let led = move |middle: [f64; 2]| {
        let bounds = at(middle);
        let near = [x.clamp(bounds.left, bounds.right), y.clamp(bounds.top, bounds.bottom)];
        let [dx, dy] = [near[0] - x, near[1] - y];
        let length = dx.hypot(dy).max(1e-9);
        let start = [x + dx / length * radius, y + dy / length * radius];
        Placed { bounds, leader: Some([start[0], start[1], near[0], near[1]]) }
    };
    let rings = (1..12).flat_map(move |ring| {
        (0..24).map(move |step| {
            let angle = core::f64::consts::TAU * f64::from(step) / 24.0;
            let apart = radius + GAP + 9.0 * f64::from(ring);
            let (sine, cosine) = angle.sin_cos();
            led([x + cosine * (apart + 0.5 * width), y + sine * (apart + 0.5 * height)])
        })
    });
    let columns = (2.0 * (area.right - area.left) / width).floor().max(1.0) as usize;
    let rows = ((area.bottom - area.top) / (0.5 * height)).floor().max(1.0) as usize;
    let grid = (0..columns * rows).map(move |index| {
        let across = 0.5 * width * (index % columns) as f64;
        let down = 0.5 * height * (index / columns) as f64;
        led([area.left + 0.5 * width + across, area.top + 0.5 * height + down])
    });
    beside.chain(rings).chain(grid)
}

/// Moves texts that stand one above the other apart: middles as near as can be to the wanted ones, in their order, `height`
/// apart and within `low`…`high`; closer together only where they do not fit.
pub(super) fn spread(wanted: &[f64], height: f64, low: f64, high: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|a, b| wanted[*a].total_cmp(&wanted[*b]));
    let height = height.min((high - low) / wanted.len().max(1) as f64);
    // Groups of touching texts (sum of wanted places less offsets, count), merged while they overlap: the
    // least-squares solution.
    let mut groups: Vec<(f64, usize)> = Vec::new();
    let start = |(sum, count): (f64, usize)| {
        (sum / count as f64).clamp(low + 0.5 * height, high - (count as f64 - 0.5) * height)
    };
    for index in &order {
        groups.push((wanted[*index], 1));
        while let [.., before, last] = groups[..] {
            if start(before) + before.1 as f64 * height <= start(last) {
                break;
            }
            groups.truncate(groups.len() - 2);
            let shift = before.1 as f64 * height * last.1 as f64;
            groups.push((before.0 + last.0 - shift, before.1 + last.1));
        }
    }
    let mut places = vec![0.0; wanted.len()];
    let mut next = order.into_iter();
    for group in groups {
        for (rank, index) in next.by_ref().take(group.1).enumerate() {
            places[index] = start(group) + rank as f64 * height;
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_texts_are_apart_and_within() {
        let wanted = [10.0, 12.0, 11.0, 50.0, 99.0, 98.0, 97.5];
        let places = spread(&wanted, 8.0, 0.0, 100.0);
        for (a, b) in (0..7).flat_map(|a| (0..a).map(move |b| (a, b))) {
            assert!((places[a] - places[b]).abs() > 7.999, "{places:?}");
            assert_eq!(places[a] < places[b], wanted[a] < wanted[b], "{places:?}");
        }
        assert!(places.iter().all(|place| (3.999..96.001).contains(place)), "{places:?}");
        assert_eq!(places[3], 50.0, "one that has room stays");
    }
}
