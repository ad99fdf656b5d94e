#!/usr/bin/env bash
# Checks the files that a maintainer edits for a release: the version, the date and the address of the repository are the same in
# all files, and no page says that flap has no release.
#
#   scripts/check-release.sh VERSION [ADDRESS]
#
# Given ADDRESS, the address in Cargo.toml must be equal to it.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ $# -eq 1 || $# -eq 2 ]] || { echo "usage: scripts/check-release.sh VERSION [ADDRESS], such as 0.1.0" >&2; exit 2; }
wrong=0
mistake() {
    printf 'check-release: %s\n' "$1" >&2
    wrong=1
}
workspace() { sed -n "/^\[workspace.package\]/,/^\[/s/^$1 = \"\(.*\)\"\$/\1/p" Cargo.toml; }
citation() { sed -n "s/^$1: *\"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p" CITATION.cff; }
# same FILE FIELD VALUE EXPECTED
same() { [[ $3 == "$4" ]] || mistake "$1 has $2 ${3:-(none)}, not $4"; }

same Cargo.toml version "$(workspace version)" "$1"
same CITATION.cff version "$(citation version)" "$1"
same docs/how-to/questions.md version "$(sed -n 's/^  version = {\(.*\)},$/\1/p' docs/how-to/questions.md)" "$1"
heading=$(sed -n '/^## /{s///p;q;}' CHANGELOG.md)
if [[ $heading =~ ^(.*)\ -\ ([0-9]{4}-[0-9]{2}-[0-9]{2})$ && ${BASH_REMATCH[1]} == "$1" ]]; then
    same CITATION.cff date-released "$(citation date-released)" "${BASH_REMATCH[2]}"
else
    mistake "the first section of CHANGELOG.md is \"$heading\", not \"$1 - YYYY-MM-DD\""
fi

address=$(workspace repository)
if [[ ! $address =~ ^https://[^/]+/[^/]+/[^/]+$ ]]; then
    mistake "repository in Cargo.toml is \"$address\": write the address of the repository, https://HOST/OWNER/NAME without a slash at the end"
else
    same CITATION.cff repository-code "$(citation repository-code)" "$address"
    [[ $# -eq 1 || $address == "$2" ]] || mistake "repository in Cargo.toml is \"$address\", but this repository is $2"
fi

for file in README.md docs/start/install.md; do
    ! grep -q "no release yet" "$file" || mistake "$file says that flap has no release yet: delete this paragraph"
done
[[ $wrong -ne 0 ]] || echo "All files have version $1."
exit "$wrong"
