#!/usr/bin/env bash
# Compares a version with those in Cargo.toml, CITATION.cff and CHANGELOG.md, and requires the address of the repository:
#
#   scripts/check-release.sh VERSION [ADDRESS]
#
# Given ADDRESS, the address in Cargo.toml must be equal to it.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ $# -eq 1 || $# -eq 2 ]] || { echo "usage: scripts/check-release.sh VERSION [ADDRESS]" >&2; exit 2; }
wrong=0
mistake() {
    printf 'check-release: %s\n' "$1" >&2
    wrong=1
}
differs() { mistake "$1 has version ${2:-(none)}, not $3"; }
workspace() { sed -n "/^\[workspace.package\]/,/^\[/s/^$1 = \"\(.*\)\"\$/\1/p" Cargo.toml; }

cargo=$(workspace version)
citation=$(sed -n 's/^version: *"\{0,1\}\([^"]*\)"\{0,1\}$/\1/p' CITATION.cff)
[[ $cargo == "$1" ]] || differs Cargo.toml "$cargo" "$1"
[[ $citation == "$1" ]] || differs CITATION.cff "$citation" "$1"
# The heading of a release is its version, with or without a date; "(unreleased)" is neither.
grep -Eq "^## ${1//./\\.}( - [0-9]{4}-[0-9]{2}-[0-9]{2})?$" CHANGELOG.md || differs CHANGELOG.md "$(sed -n 's/^## //p' CHANGELOG.md | head -n 1)" "$1"

address=$(workspace repository)
if [[ ! $address =~ ^https://[^/]+/[^/]+/[^/]+$ ]]; then
    mistake "repository in Cargo.toml is \"$address\": write the address of the repository, https://HOST/OWNER/NAME without a slash at the end"
elif [[ $# -eq 2 && $address != "$2" ]]; then
    mistake "repository in Cargo.toml is \"$address\", but this repository is $2"
fi
exit "$wrong"
