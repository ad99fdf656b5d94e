//! The models with other types of numbers than lanes: numbers that count operations, and dual numbers.

mod counted;
mod dual;
mod responses;

use flap_core::model::bimorph::{Bimorph, Law};
use flap_core::model::direct_drive::{DirectDrive, FlowDirection};
use flap_core::model::four_bar::FourBar;
use flap_core::simulate::preset;

const BIMORPH: Bimorph = Bimorph::SINE;
const GROWING_BIMORPH: Bimorph = Bimorph { law: Law::Square, ..Bimorph::SINE };
const DIRECT_DRIVE: DirectDrive = DirectDrive::SINE;
const DIRECT_DRIVE_BLADES: DirectDrive = DirectDrive { flow: FlowDirection::Blade, ..DirectDrive::SINE };
const FOUR_BAR: FourBar = FourBar::SINE;

/// The values of a preset.
fn values(name: &str) -> Vec<f64> {
    let (_, preset) = preset(name).unwrap();
    (preset.values)()
}
