//! Names and sides of the wings of a vehicle.

use crate::simulate::Simulator;

/// Largest number of wings of a vehicle.
pub const MOST_WINGS: usize = 16;

/// First part of the name of each parameter that describes a difference between left and right wings.
pub const DIFFERENCE: &str = "difference";

/// A wing of a vehicle: name and side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mount {
    /// Name of the wing. The names of all parameters and columns of the wing begin with this name.
    pub name: String,
    /// True if the wing is the mirror image, in the x-z plane, of a wing at the given position.
    pub mirrored: bool,
}

/// Reason why a vehicle with the given wings is impossible.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VehicleError {
    /// The vehicle has no wings.
    #[error("a vehicle needs at least one wing")]
    NoWings,
    /// The vehicle has too many wings.
    #[error("{0} wings are too many: a vehicle has at most {MOST_WINGS}")]
    ManyWings(usize),
    /// The name of a wing is not allowed, because the name cannot be the first part of the names of
    /// parameters.
    #[error(
        "`{0}` is not allowed as the name of a wing: use lower-case letters, digits and `_`, begin with a letter, and \
         do not use `difference`"
    )]
    Name(String),
    /// Two wings have the same name.
    #[error("two wings are called `{0}`")]
    SameName(String),
    /// Two parameters have the same name: a parameter of one wing, and a parameter of a second wing or of the
    /// model.
    #[error("a wing cannot be called `{wing}`: another parameter already has the name `{parameter}`")]
    Clash {
        /// Name of the wing.
        wing: String,
        /// Name of the parameter.
        parameter: String,
    },
    /// The model does not compute the force and the moment of the air on its wing.
    #[error("the model {0} does not compute the forces and moments that vehicles need")]
    NoLoads(&'static str),
}

/// Checks the number and the names of the wings, and that the model computes the loads of its wing.
pub(super) fn check(model: &'static dyn Simulator, mounts: &[Mount]) -> Result<(), VehicleError> {
    if mounts.is_empty() {
        return Err(VehicleError::NoWings);
    }
    if mounts.len() > MOST_WINGS {
        return Err(VehicleError::ManyWings(mounts.len()));
    }
    for (i, mount) in mounts.iter().enumerate() {
        let mut letters = mount.name.bytes();
        let begins = letters.next().is_some_and(|first| first.is_ascii_lowercase());
        let goes_on =
            letters.all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == b'_');
        if !begins || !goes_on || mount.name == DIFFERENCE {
            return Err(VehicleError::Name(mount.name.clone()));
        }
        if mounts[..i].iter().any(|other| other.name == mount.name) {
            return Err(VehicleError::SameName(mount.name.clone()));
        }
    }
    if model.description().loads { Ok(()) } else { Err(VehicleError::NoLoads(model.name())) }
}
