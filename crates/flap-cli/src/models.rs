//! The models that the commands of this process can use.

use std::sync::OnceLock;

use flap_core::parameter::Preset;
use flap_core::simulate::{self, Simulator};

static MODELS: OnceLock<Vec<&'static dyn Simulator>> = OnceLock::new();

/// Sets the models. Only the first call has an effect.
pub(crate) fn set(models: Vec<&'static dyn Simulator>) {
    MODELS.get_or_init(|| models);
}

/// Returns all models, in the order of `flap models`.
pub(crate) fn all() -> &'static [&'static dyn Simulator] {
    MODELS.get().map_or(simulate::all(), Vec::as_slice)
}

/// Returns the model `name`.
pub(crate) fn by_name(name: &str) -> Option<&'static dyn Simulator> {
    simulate::find(all(), name)
}

/// Returns the preset `name` with its model.
pub(crate) fn preset(name: &str) -> Option<(&'static dyn Simulator, &'static Preset)> {
    simulate::find_preset(all(), name)
}

/// Returns the names of all presets.
pub(crate) fn presets() -> impl Iterator<Item = &'static str> {
    all().iter().flat_map(|model| model.presets()).map(|preset| preset.name)
}
