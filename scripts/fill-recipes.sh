#!/usr/bin/env bash
# Writes the recipes of packaging/conda and packaging/homebrew with the values of a release to a folder:
#
#   scripts/fill-recipes.sh SDIST FOLDER
#
# SDIST is dist/flapwing-VERSION.tar.gz. The version, the address of the repository and the oldest versions of Python and NumPy
# come from Cargo.toml and crates/flap-py/pyproject.toml.
set -euo pipefail
[[ $# -eq 2 && -f $1 ]] || { printf 'usage: scripts/fill-recipes.sh SDIST FOLDER\n' >&2; exit 2; }
hash=$(sha256sum "$1" | cut -d ' ' -f 1)
mkdir -p -- "$2"
out=$(cd -- "$2" && pwd)
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

workspace() { sed -n "/^\[workspace.package\]/,/^\[/s/^$1 = \"\(.*\)\"\$/\1/p" Cargo.toml; }
repository=$(workspace repository)
# As long as Cargo.toml has no address, an example, so that the recipes can be checked.
repository=${repository:-https://example.org/flap}
python=$(sed -n 's/^requires-python = ">=\(.*\)"$/\1/p' crates/flap-py/pyproject.toml)
numpy=$(sed -n 's/^dependencies = \["numpy>=\(.*\)"\]$/\1/p' crates/flap-py/pyproject.toml)
for recipe in packaging/conda/recipe.yaml packaging/homebrew/flap.rb; do
    sed -e '/scripts\/fill-recipes.sh replaces/d' -e "s|@VERSION@|$(workspace version)|g; s|@REPOSITORY@|$repository|g" \
        -e "s|@SHA256@|$hash|g; s|@PYTHON@|$python|g; s|@NUMPY@|$numpy|g" "$recipe" >"$out/$(basename -- "$recipe")"
done
