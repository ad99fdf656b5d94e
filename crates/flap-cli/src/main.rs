//! The `flap` command.
fn main() {}
