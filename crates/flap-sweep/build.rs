//! Tells the crate the hash of its sources.

fn main() -> std::io::Result<()> {
    flap_sources::print()
}
