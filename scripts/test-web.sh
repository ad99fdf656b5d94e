#!/usr/bin/env bash
# Checks the code of the pages: types (tsc), formatting and lints (biome), and unit tests (node's own test runner):
#
#   scripts/test-web.sh [--fix]
#
# Needs node 18 or later, and npm. The tools are installed into target/web, in the versions of crates/flap-live/web/package-lock.json,
# and only when that file changes. With --fix, biome writes what it can mend. The pages themselves need none of this.
set -euo pipefail

die() {
    printf 'test-web: %s\n' "$1" >&2
    exit 2
}

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
command -v npm >/dev/null || die "npm is not installed: on Debian and Ubuntu, install nodejs and npm"

web=crates/flap-live/web
tools=target/web
if ! cmp -s "$web/package-lock.json" "$tools/made-from"; then
    mkdir -p "$tools"
    cp "$web/package.json" "$web/package-lock.json" "$tools"
    npm ci --prefix "$tools" --no-audit --no-fund --loglevel error
    cp "$web/package-lock.json" "$tools/made-from"
fi

# The chart library in the repository is the published one, of which the types are.
for file in uPlot.iife.min.js uPlot.min.css; do
    cmp "$tools/node_modules/uplot/dist/$file" "$web/uplot/$file"
done
"$tools/node_modules/.bin/tsc" --project "$web"
biome=("$PWD/$tools/node_modules/.bin/biome" check --error-on-warnings)
[[ ${1-} == --fix ]] && biome+=(--write)
(cd "$web" && "${biome[@]}" .)
"${biome[@]}" --config-path "$web" tests/web
node --test tests/web/*.test.js
