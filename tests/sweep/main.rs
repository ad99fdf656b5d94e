//! Grid files and plans: the plans of valid grid files, and the messages about invalid grid files.

mod change;
mod designs;
mod fake;
mod files;
mod formulas;
mod meaning;
mod mistakes;
mod points;
mod sample;
