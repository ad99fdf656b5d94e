#!/usr/bin/env bash
# Compares a version with those in Cargo.toml, CITATION.cff and CHANGELOG.md: `scripts/check-version.sh 0.1.0`.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ $# -eq 1 ]] || { echo "usage: scripts/check-version.sh VERSION" >&2; exit 2; }
wrong=0
differs() {
    printf 'check-version: %s has version %s, not %s\n' "$1" "${2:-(none)}" "$3" >&2
    wrong=1
}
cargo=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
citation=$(sed -n 's/^version: *"\{0,1\}\([^"]*\)"\{0,1\}$/\1/p' CITATION.cff)
[[ $cargo == "$1" ]] || differs Cargo.toml "$cargo" "$1"
[[ $citation == "$1" ]] || differs CITATION.cff "$citation" "$1"
# The heading of a release is its version, with or without a date; "(unreleased)" is neither.
grep -Eq "^## ${1//./\\.}( - [0-9]{4}-[0-9]{2}-[0-9]{2})?$" CHANGELOG.md || differs CHANGELOG.md "$(sed -n 's/^## //p' CHANGELOG.md | head -n 1)" "$1"
exit "$wrong"
