//! Macros that declare parameter structs and named options, together with their tables.

use super::table::Parameter;

/// Returns the total number of rows of `tables`.
#[doc(hidden)]
pub const fn rows(tables: &[&[Parameter<'_>]]) -> usize {
    let (mut count, mut table) = (0, 0);
    while table < tables.len() {
        count += tables[table].len();
        table += 1;
    }
    count
}

/// Returns the rows of `tables` in one array. `N` is the number of [`rows`], which is at least one. A row without a
/// group gets the group of the previous row.
#[doc(hidden)]
pub const fn joined<'a, const N: usize>(tables: &[&[Parameter<'a>]]) -> [Parameter<'a>; N] {
    let mut all = [tables[0][0]; N];
    let (mut count, mut table) = (0, 0);
    while table < tables.len() {
        let mut row = 0;
        while row < tables[table].len() {
            all[count] = tables[table][row];
            if all[count].group.is_empty() && count > 0 {
                all[count].group = all[count - 1].group;
            }
            count += 1;
            row += 1;
        }
        table += 1;
    }
    all
}

/// Declares a model's parameter struct and its table.
///
/// Each line consists of the documentation, the name and the type of a field, and then the SI unit, the
/// symbol and the [`Kind`](crate::parameter::Kind). The type of a field is one of these types:
///
/// - `f64`
/// - `Option<f64>`, for a number that flap computes from other parameters if the user does not set the number
/// - an enum declared by [`choice!`](crate::choice)
/// - another struct that `parameters!` declares, with `(flatten)` instead of unit, symbol and kind. The macro
///   inserts the rows of this struct into the table
///
/// A name in brackets before a field begins a group of parameters. After the kind of a field, you can set
/// more fields of [`Parameter`](crate::parameter::Parameter), for example `default: 0.0`.
///
/// If each line ends with a value, after the parentheses with unit, symbol and kind, declare a function below
/// the struct, for example `pub fn published() -> Params;`. The function `published` returns the struct with
/// the values.
///
/// The macro adds `TABLE`, `from_values` and `to_values` to the struct. The rows of `TABLE` have the order of the
/// fields.
///
/// ```
/// use flap_core::parameter::Kind::{Choice, Number};
/// use flap_core::parameter::Range::{Positive, Whole};
///
/// flap_core::choice! {
///     /// Materials of a beam.
///     pub enum Material {
///         /// Carbon fibre.
///         Carbon = "carbon",
///         /// Steel.
///         Steel = "steel",
///     }
/// }
///
/// flap_core::parameters! {
///     /// A beam.
///     pub struct Beam {
///         ["shape"]
///         /// Length.
///         length: f64 = ("m", "L", Number(Positive), is_fitted: true),
///         ["substance"]
///         /// Material.
///         material: Material = ("", "", Choice(Material::NAMES)),
///     }
/// }
///
/// flap_core::parameters! {
///     /// Beams in a row.
///     pub struct Row {
///         /// Number of beams.
///         beams: f64 = ("", "n", Number(Whole(1, 9))) 2.0,
///         /// One of them.
///         beam: Beam = (flatten) Beam { length: 0.2, material: Material::Carbon },
///     }
///
///     /// Two beams of carbon fibre.
///     pub fn pair() -> Row;
/// }
///
/// let names: Vec<&str> = Row::TABLE.iter().map(|row| row.name).collect();
/// assert_eq!(names, ["beams", "length", "material"]);
/// assert_eq!(Row::TABLE[2].group, "substance");
/// assert!(Row::TABLE[1].is_fitted && !Row::TABLE[0].is_fitted);
/// let row = Row::from_values(&[3.0, 0.1, 1.0]);
/// assert_eq!(row.beam.material, Material::Steel);
/// assert_eq!(row.to_values(), [3.0, 0.1, 1.0]);
/// assert_eq!(Row::pair().to_values(), [2.0, 0.2, 0.0]);
/// ```
#[macro_export]
macro_rules! parameters {
    ($(#[$meta:meta])* pub struct $Name:ident {
        $($([$group:literal])? $(#[doc = $doc:literal])+ $field:ident: $type:ty = ($($row:tt)+),)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $Name {
            $($(#[doc = $doc])+ pub $field: $type,)*
        }

        impl $Name {
            /// Parameter table, with its rows in the order of the fields.
            pub const TABLE: &'static [$crate::parameter::Parameter<'static>] = {
                const TABLES: &[&[$crate::parameter::Parameter<'static>]] =
                    &[$($crate::parameters!(@table $type, $field, [$($group)?], [$($doc),+], $($row)+),)*];
                &$crate::parameter::joined::<{ $crate::parameter::rows(TABLES) }>(TABLES)
            };

            /// Returns the parameters of a point, given one value for each row of the table.
            pub fn from_values(values: &[f64]) -> $Name {
                $crate::parameter::Slot::take(&mut values.iter().copied())
            }

            /// Returns one value for each row of the table.
            pub fn to_values(&self) -> Vec<f64> {
                let mut values = Vec::new();
                $crate::parameter::Slot::put(self, &mut values);
                values
            }
        }

        impl $crate::parameter::Slot for $Name {
            fn take(values: &mut impl Iterator<Item = f64>) -> $Name {
                $Name { $($field: $crate::parameter::Slot::take(values),)* }
            }

            fn put(&self, values: &mut Vec<f64>) {
                $($crate::parameter::Slot::put(&self.$field, values);)*
            }
        }
    };
    ($(#[$meta:meta])* pub struct $Name:ident {
        $($([$group:literal])? $(#[doc = $doc:literal])+ $field:ident: $type:ty = ($($row:tt)+) $value:expr,)*
    }
    $(#[$preset_meta:meta])* pub fn $preset:ident() -> $Same:ident;) => {
        $crate::parameters! {
            $(#[$meta])* pub struct $Name {
                $($([$group])? $(#[doc = $doc])+ $field: $type = ($($row)+),)*
            }
        }

        impl $Name {
            $(#[$preset_meta])*
            pub fn $preset() -> $Same {
                $Same { $($field: $value,)* }
            }
        }
    };
    (@table $type:ty, $field:ident, [], $docs:tt, flatten) => {
        <$type>::TABLE
    };
    (@table $type:ty, $field:ident, [$($group:literal)?], [$($doc:literal),+],
     $unit:literal, $symbol:literal, $kind:expr $(, $more:ident: $value:expr)*) => {
        &[$crate::parameter::Parameter {
            $(group: $group,)?
            $($more: $value,)*
            ..$crate::parameter::Parameter::new(
                stringify!($field), $unit, $symbol, $kind, concat!($($doc),+).trim_ascii_start(),
            )
        }]
    };
}

/// Declares an enum of named options for a parameter of the kind [`Choice`](crate::parameter::Kind::Choice).
///
/// Each line contains the documentation of an option and the name of the option in grid files. In a point,
/// the value of the parameter is the index of the option. The first option is the default. The macro adds two
/// lists to the enum: `ALL` contains the options, and `NAMES` contains the names of the options.
#[macro_export]
macro_rules! choice {
    ($(#[$meta:meta])* pub enum $Name:ident {
        $(#[$first_meta:meta])* $First:ident = $first:literal,
        $($(#[$option_meta:meta])* $Option:ident = $option:literal,)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum $Name {
            $(#[$first_meta])*
            #[default]
            $First,
            $($(#[$option_meta])* $Option,)*
        }

        impl $Name {
            /// All options, in the order of their values.
            pub const ALL: &'static [$Name] = &[$Name::$First, $($Name::$Option,)*];
            /// Names of the options, in the order of their values.
            pub const NAMES: &'static [&'static str] = &[$first, $($option,)*];
        }

        impl $crate::parameter::Slot for $Name {
            fn take(values: &mut impl Iterator<Item = f64>) -> $Name {
                let value = values.next();
                let option = $Name::ALL.iter().find(|option| Some(f64::from(**option as u8)) == value);
                option.copied().unwrap_or_default()
            }

            fn put(&self, values: &mut Vec<f64>) {
                values.push(f64::from(*self as u8));
            }
        }
    };
}

/// A field of a parameter struct: one value of a design point, or the values of a struct of parameters.
pub trait Slot {
    /// Reads the values of the field from the next entries of `values`, and returns the field. If a value is
    /// missing, the parameter counts as not set.
    fn take(values: &mut impl Iterator<Item = f64>) -> Self;

    /// Appends the values of the field to the values of a point.
    fn put(&self, values: &mut Vec<f64>);
}

impl Slot for f64 {
    fn take(values: &mut impl Iterator<Item = f64>) -> f64 {
        values.next().unwrap_or(f64::NAN)
    }

    fn put(&self, values: &mut Vec<f64>) {
        values.push(*self);
    }
}

impl Slot for Option<f64> {
    fn take(values: &mut impl Iterator<Item = f64>) -> Option<f64> {
        values.next().filter(|value| !value.is_nan())
    }

    fn put(&self, values: &mut Vec<f64>) {
        values.push(self.unwrap_or(f64::NAN));
    }
}
