//! Passes the hash of the crate's sources to the compiler as an environment variable.

fn main() -> std::io::Result<()> {
    flap_sources::print()
}
