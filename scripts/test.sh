#!/usr/bin/env bash
# All tests of flap, or the named stages of them:
#
#   scripts/test.sh [format|lint|docs|rust|pages|python]...
#
# Needs cargo (by rustup) and python3 with venv. The code of the browser's pages is checked where npm is installed.
set -euo pipefail
cd "$(dirname "$0")/.."

[[ $# -gt 0 ]] || set -- format lint docs rust pages python
for stage in "$@"; do
    printf '\n== %s\n' "$stage"
    case $stage in
        format) cargo fmt --all --check ;;
        lint) cargo clippy --workspace --all-targets --locked -- -D warnings ;;
        docs) ./scripts/build-docs.sh ;;
        rust) cargo test --workspace --locked ;;
        pages) if command -v npm >/dev/null; then ./scripts/test-web.sh; else echo "skipped: npm is not installed"; fi ;;
        python) ./scripts/test-python.sh ;;
        *)
            printf 'test: there is no stage %s: choose format, lint, docs, rust, pages or python\n' "$stage" >&2
            exit 2
            ;;
    esac
done
