#!/usr/bin/env bash
# Writes the source distribution of the Python package to dist/flapwing-VERSION.tar.gz, and checks that it has all sources.
#
# Needs maturin of scripts/release-requirements.txt, which scripts/build-wheels.sh also uses.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check "$(grep '^maturin==' scripts/release-requirements.txt)"
rm -f dist/flapwing-*.tar.gz
"$folder/env/bin/maturin" sdist --manifest-path crates/flap-py/Cargo.toml --out dist
tar -xzf dist/flapwing-*.tar.gz -C "$folder"
cd -- "$folder"/flapwing-*
for file in PKG-INFO README.md LICENSE-APACHE LICENSE-MIT Cargo.lock pyproject.toml python/flapwing/py.typed \
    crates/flap-{cli,core,experiments,live,py,sources,sweep}/Cargo.toml crates/flap-live/web/live/page.js; do
    [[ -f $file ]] || { printf 'build-sdist: the source distribution lacks %s\n' "$file" >&2; exit 1; }
done
# All crates are here, and the lock file is theirs.
cargo metadata --locked --format-version 1 >/dev/null
find . -type f | wc -l | xargs printf 'dist/flapwing-….tar.gz has %s files.\n'
