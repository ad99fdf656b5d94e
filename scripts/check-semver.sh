#!/usr/bin/env bash
# Compares the public items of the crates with the last version on crates.io (cargo-semver-checks), and fails if the version number
# does not announce a break. The first version has nothing to compare with.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

if ! told=$(cd / && cargo info --quiet --registry crates-io flap-cli 2>&1); then
    [[ $told == *"could not find"* ]] || { printf 'check-semver: cargo does not reach crates.io: %s\n' "$told" >&2; exit 1; }
    echo "crates.io has no version of flap-cli: there is nothing to compare with."
    exit 0
fi
command -v cargo-semver-checks >/dev/null || cargo install --locked cargo-semver-checks@0.51.0
cargo semver-checks --package flap-core --package flap-experiments --package flap-sweep --package flap-live --package flap-cli
