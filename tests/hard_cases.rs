//! The bounds that the documentation states hold for the twin in f32.

mod common;

use softbox::table::Table;

#[test]
fn the_twin_in_single_precision_keeps_every_bound() {
    let table = Table::default();
    let cases = common::families::cases(200);
    let exact: Vec<_> = cases.iter().map(|case| common::twin::<f64>(&table, case)).collect();
    let values: Vec<_> =
        cases.iter().map(|case| common::twin::<f32>(&table, case).map(|v| v as f32)).collect();
    common::check("twin", &cases, &exact, &values, &table);
}
