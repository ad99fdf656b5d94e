//! The wings of a vehicle by name.

use crate::simulate::Simulator;

/// The largest number of wings.
pub const MOST_WINGS: usize = 16;

/// The first part of the names of left-right differences.
pub const DIFFERENCE: &str = "difference";

/// A wing of a vehicle: its name and its side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mount {
    /// Name, the first part of the names of its parameters and columns.
    pub name: String,
    /// True if it is the mirror image, behind the plane of x and z, of a wing at its place.
    pub mirrored: bool,
}

/// The reason why a vehicle cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VehicleError {
    /// It has no wings.
    #[error("a vehicle has one wing or more")]
    NoWings,
    /// It has too many wings.
    #[error("a vehicle has at most {MOST_WINGS} wings, not {0}")]
    ManyWings(usize),
    /// A wing's name cannot begin the names of parameters.
    #[error(
        "`{0}` is no name of a wing: names have lower-case letters, digits and `_`, begin with a letter, and are not \
         `difference`"
    )]
    Name(String),
    /// Two wings have one name.
    #[error("two wings are called `{0}`")]
    SameName(String),
    /// Parameters of two wings, or of a wing and the model, would have one name.
    #[error(
        "a wing cannot be called `{wing}`: its parameter would be called `{parameter}`, which is another one"
    )]
    Clash {
        /// Name of the wing.
        wing: String,
        /// Name of the parameter.
        parameter: String,
    },
    /// The model does not know the force and the moment of its wing.
    #[error("the model {0} has no forces and moments for vehicles")]
    NoLoads(&'static str),
}

/// Refuses wings that do not make a vehicle.
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
    if model.has_loads() { Ok(()) } else { Err(VehicleError::NoLoads(model.name())) }
}
