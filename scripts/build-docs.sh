#!/usr/bin/env bash
# Builds the manual into target/docs/html, checks its prose and links, and tests its search:
#
#   scripts/build-docs.sh [--no-rust]
#
# Needs cargo and python3 with venv; the packages for the site are kept in target/docs/env. With go or vale installed, vale
# checks the prose; with chromium installed, the search of the site is tested. --no-rust leaves out the documentation of the
# crates.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

# An absolute path, for programs that run in other directories.
target=${CARGO_TARGET_DIR:-target}
mkdir -p -- "$target/docs"
target=$(cd -- "$target" && pwd)
export CARGO_TARGET_DIR=$target
work=$target/docs

# Prose.
vale=$(command -v vale || true)
if [[ -z $vale ]] && command -v go >/dev/null; then
    vale=$work/bin/vale
    [[ -x $vale ]] || GOBIN=$work/bin go install github.com/vale-cli/vale/v3/cmd/vale@v3.20.0
fi
if [[ -n $vale ]]; then
    git ls-files -z '*.md' ':!tests/sweep/mistakes' | xargs -0 "$vale" --output=line
    rm -rf -- "$work/prose"
    git ls-files -z 'crates/*.rs' 'crates/*.py' 'examples/*.rs' 'examples/*.py' | xargs -0 python3 scripts/prose.py "$work/prose"
    (cd -- "$work/prose" && "$vale" --config "$OLDPWD/.vale.ini" --output=line .)
else
    echo "The prose is not checked: install go or vale."
fi

# The environment.
requirements=docs/requirements.txt
if ! cmp -s "$requirements" "$work/made-from"; then
    rm -f -- "$work/made-from"
    python3 -m venv --clear "$work/env"
    "$work/env/bin/python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
    cp -- "$requirements" "$work/made-from"
fi
export PATH="$work/env/bin:$PATH"

# The command and the package whose help and docstrings become the reference.
wheel=$(./scripts/build-dev-wheel.sh)
python -m pip install --quiet --disable-pip-version-check --no-index --no-deps --force-reinstall "$wheel"

rust=()
if [[ ${1-} != --no-rust ]]; then
    RUSTDOCFLAGS="-D warnings" cargo doc --quiet --workspace --no-deps --locked
    rust=(--rust "$target/doc")
fi
PYTHONDONTWRITEBYTECODE=1 python docs/site/build.py "$target/debug/flap" "$work" "${rust[@]}"
MANUAL=$work/html python -m pytest --quiet -p no:cacheprovider -c tests/python/pytest.ini --rootdir . tests/manual
echo "The manual is in $work/html: open index.html."
