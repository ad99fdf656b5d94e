//! Columns and their meanings.

use flap_core::simulate;
use flap_sweep::table::labels::split_unit;

#[test]
fn names_of_measures_end_in_their_units() {
    let mut with_unit = 0;
    for model in simulate::all() {
        for column in model.columns() {
            let (_, unit) = split_unit(&column.name);
            assert_eq!(unit, column.unit, "{}", column.name);
            with_unit += usize::from(!unit.is_empty());
        }
    }
    assert!(with_unit > 60, "{with_unit}");
}
