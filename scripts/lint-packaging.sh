#!/usr/bin/env bash
# Checks the files of packaging/, CITATION.cff and the metadata of the Python package with the tools of
# scripts/packaging-requirements.txt:
#
#   scripts/lint-packaging.sh [WHEEL or source distribution]...
#
# The formula is checked with `brew style` where brew is installed, and its syntax where ruby is installed. apptainer has no lint.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

work=${CARGO_TARGET_DIR:-$PWD/target}/lint-packaging
requirements=scripts/packaging-requirements.txt
if ! cmp -s "$requirements" "$work/made-from"; then
    python3 -m venv --clear "$work/env"
    "$work/env/bin/python" -m pip install --quiet --disable-pip-version-check --only-binary :all: -r "$requirements"
    # cffconvert needs an older jsonschema than the other tools.
    python3 -m venv --clear "$work/cff"
    "$work/cff/bin/python" -m pip install --quiet --disable-pip-version-check cffconvert==2.0.0
    cp -- "$requirements" "$work/made-from"
fi
export PATH="$work/env/bin:$work/cff/bin:$PATH"

hadolint packaging/Dockerfile
cffconvert --validate -i CITATION.cff
validate-pyproject crates/flap-py/pyproject.toml
[[ $# -eq 0 ]] || twine check --strict "$@"

# Recipes with values of the same form as those of a release.
printf 'no sources' >"$work/sdist"
./scripts/fill-recipes.sh "$work/sdist" "$work/recipes"
if grep -n '@[A-Z0-9]*@' "$work"/recipes/*; then
    echo "lint-packaging: scripts/fill-recipes.sh leaves these words" >&2
    exit 1
fi
python - "$work/recipes/recipe.yaml" <<'PYTHON'
import sys

from rattler_build import PlatformConfig, RenderConfig, Stage0Recipe, VariantConfig

# conda-forge's own choices of compilers and Python.
versions = {
    "c_compiler": ["gcc"], "c_stdlib": ["sysroot"], "rust_compiler": ["rust"], "python": ["3.11.*", "3.14.*"]
}
recipe = Stage0Recipe.from_file(sys.argv[1])
for platform in ("linux-64", "osx-arm64", "win-64"):
    rendered = recipe.render(VariantConfig(versions), RenderConfig(platform=PlatformConfig(target_platform=platform)))
    print(f"The recipe of conda renders for {platform}: {len(rendered)} variants.")
    assert len(rendered) == 2
PYTHON
if command -v brew >/dev/null; then
    brew style "$work/recipes/flap.rb"
elif command -v ruby >/dev/null; then
    ruby -c "$work/recipes/flap.rb"
else
    echo "The formula is not checked: install brew or ruby."
fi
