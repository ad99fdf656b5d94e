//! Grid files and plans: what a grid file means, and what is said about one that means nothing.

mod change;
mod designs;
mod fake;
mod files;
mod formulas;
mod meaning;
mod mistakes;
mod points;
mod sample;
