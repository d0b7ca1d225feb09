//! The frontier and the places of labels, on random points.

use softbox::report::page::{Anchor, Bounds, frontier, place};

use crate::sample::Random;

fn dominates(a: [f64; 2], b: [f64; 2]) -> bool {
    a[0] <= b[0] && a[1] <= b[1] && a != b
}

#[test]
fn frontier_is_what_nothing_dominates() {
    assert_eq!(frontier(&[]), [0; 0]);
    assert_eq!(frontier(&[[2.0, 1.0], [1.0, 2.0], [2.0, 2.0], [1.0, 3.0]]), [1, 0]);
    assert_eq!(frontier(&[[1.0, 1.0], [f64::NAN, 0.0], [0.0, f64::INFINITY]]), [0]);
    let mut random = Random(1);
    for round in 0..2000 {
        // Few different values make equal ones common.
        let mut value = || (random.unit() * if round % 2 == 0 { 6.0 } else { 1e6 }).floor();
        let points: Vec<[f64; 2]> = (0..round % 23).map(|_| [value(), value()]).collect();
        let kept = frontier(&points);
        for (index, point) in points.iter().enumerate() {
            let beaten = points.iter().any(|other| dominates(*other, *point));
            assert_eq!(kept.contains(&index), !beaten, "{point:?} of {points:?}, frontier {kept:?}");
        }
        assert!(kept.is_sorted_by(|a, b| points[*a][0] <= points[*b][0]), "{kept:?} of {points:?}");
    }
}

#[test]
fn labels_do_not_overlap() {
    let area = Bounds { left: 60.0, top: 62.0, right: 546.0, bottom: 380.0 };
    let mut random = Random(2);
    for round in 0..400 {
        let count = 2 + round % 15;
        // Half of the rounds have all points in a corner or a heap.
        let spread = if round % 2 == 0 { [486.0, 318.0] } else { [60.0, 50.0] };
        let start = [(486.0 - spread[0]) * random.unit(), (318.0 - spread[1]) * random.unit()];
        let anchors: Vec<Anchor> = (0..count)
            .map(|_| Anchor {
                x: area.left + start[0] + spread[0] * random.unit(),
                y: area.top + start[1] + spread[1] * random.unit(),
                radius: 7.0,
                width: 28.0 + 120.0 * random.unit(),
                height: 15.0,
            })
            .collect();
        let lines: Vec<[f64; 4]> =
            anchors.windows(2).map(|pair| [pair[0].x, pair[0].y, pair[1].x, pair[1].y]).collect();
        let placed = place(&anchors, area, &lines);
        assert_eq!(placed.len(), count);
        for (index, label) in placed.iter().enumerate() {
            let bounds = label.bounds;
            assert!(area.contains(&bounds), "round {round}: {bounds:?} within {area:?}");
            let size = [bounds.right - bounds.left - anchors[index].width, bounds.bottom - bounds.top - 15.0];
            assert!(size.iter().all(|excess| excess.abs() < 1e-9), "{bounds:?} for {:?}", anchors[index]);
            for other in &placed[..index] {
                assert!(!bounds.overlaps(&other.bounds), "round {round}: {bounds:?} on {:?}", other.bounds);
            }
            for Anchor { x, y, .. } in &anchors {
                let dot = Bounds { left: x - 7.0, top: y - 7.0, right: x + 7.0, bottom: y + 7.0 };
                assert!(!bounds.overlaps(&dot), "round {round}: {bounds:?} on the marker at {x}, {y}");
            }
        }
    }
}
