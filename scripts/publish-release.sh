#!/usr/bin/env bash
# Makes the release of a tag, with the section of CHANGELOG.md of its version as the text, and uploads the files of dist/ and their
# checksums: `scripts/publish-release.sh v0.1.0`. If the release exists, its files are replaced. Needs the command `gh` and its token
# in GH_TOKEN. `scripts/publish-release.sh v0.1.0 --notes` prints the text alone.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ ${1-} == v* ]] || { echo "usage: scripts/publish-release.sh vVERSION [--notes]" >&2; exit 2; }
version=${1#v}
notes=$(awk -v head="## $version" 'index($0, head) == 1 { inside = 1; next } /^## / { inside = 0 } inside' CHANGELOG.md)
# GitHub resolves the links of a release relative to the page of the release, and not to the files of the repository.
files=$(sed -n '/^\[workspace.package\]/,/^\[/s/^repository = "\(.*\)"$/\1/p' Cargo.toml)/blob/$1
notes=$(sed -E "s|\]\(([^):#]+)([#)])|](${files}/\1\2|g" <<<"$notes")
if [[ ${2-} == --notes ]]; then
    printf '%s\n' "$notes"
    exit
fi
(cd dist && rm -f SHA256SUMS && sha256sum -- * >../SHA256SUMS && mv ../SHA256SUMS .)
if gh release view "$1" >/dev/null 2>&1; then
    gh release upload "$1" --clobber dist/*
else
    gh release create "$1" --title "flap $version" --notes "$notes" dist/*
fi
