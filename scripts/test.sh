#!/usr/bin/env bash
# All tests of flap: formatting, lints, documentation, Rust, Python. Needs cargo (by rustup) and python3 with venv.
set -euo pipefail
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$1"; }

step "Formatting"
cargo fmt --all --check

step "Lints"
cargo clippy --workspace --all-targets --locked -- -D warnings

step "Documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

step "Rust tests"
cargo test --workspace --locked

step "Python tests"
./scripts/test-python.sh
