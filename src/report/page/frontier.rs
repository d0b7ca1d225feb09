//! What no other choice beats.

/// The Pareto frontier of points (cost, error): those that no other point beats in one and equals or beats in the other,
/// as indices in the order of their cost. Points that are not finite are never on it.
///
/// ```
/// use softbox::report::page::frontier;
///
/// let points = [[1.0, 5.9], [0.8, 2.1], [0.4, 6.0], [1.4, 1.8], [1.5, 2.0]];
/// assert_eq!(frontier(&points), [2, 1, 3]);
/// ```
pub fn frontier(points: &[[f64; 2]]) -> Vec<usize> {
    let finite = |index: &usize| points[*index].iter().all(|value| value.is_finite());
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    order.sort_by(|a, b| {
        let [a, b] = [points[*a], points[*b]];
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        match kept.last().map(|last| points[*last]) {
            Some(last) if points[index][1] >= last[1] && points[index] != last => {}
            _ => kept.push(index),
        }
    }
    kept
}
