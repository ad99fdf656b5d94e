#!/usr/bin/env bash
# Packages the crates as `cargo publish` does, compares the files in each package with the files that it needs, and checks that
# the packages compile together without the repository:
#
#   scripts/check-packages.sh [--list]
#
# --list leaves out the compilation, which takes some minutes. The packages are in target/packages.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

die() {
    printf 'check-packages: %s\n' "$1" >&2
    exit 1
}

target=${CARGO_TARGET_DIR:-$PWD/target}
mkdir -p -- "$target/packages"
target=$(cd -- "$target" && pwd)
crates=(flap-sources flap-core flap-experiments flap-sweep flap-live flap-cli)
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)

# Tests, benches and examples are outside of the crates, so cargo leaves them out and warns.
told=$(cargo package --locked --no-verify --allow-dirty --target-dir "$target/packages" "${crates[@]/#/--package=}" 2>&1) ||
    die "cargo package fails: $told"
grep -v -e "^warning: ignoring \(test\|benchmark\|example\) " -e "manifest has no documentation" -e "^ *|$" -e "= note: see" <<<"$told" || true
sources=$target/packages/sources
rm -rf -- "$sources"
mkdir -- "$sources"
for crate in "${crates[@]}"; do
    tar -xzf "$target/packages/package/$crate-$version.crate" -C "$sources"
    needed=(Cargo.toml README.md LICENSE-APACHE LICENSE-MIT src)
    [[ ! -f crates/$crate/build.rs ]] || needed+=(build.rs)
    [[ $crate != flap-live ]] || needed+=(web/live.html web/results.html web/live/page.js web/results/page.js web/uplot/LICENSE)
    for file in "${needed[@]}"; do
        [[ -e $sources/$crate-$version/$file ]] || die "the package of $crate lacks $file"
    done
    others=$(cd -- "$sources/$crate-$version" && find . -type f ! -path './src/*.rs' ! -path './src/*.c' ! -path './web/*.js' \
        ! -path './web/*.css' ! -path './web/*.html' ! -path ./web/uplot/LICENSE ! -name 'LICENSE-*' ! -name README.md ! -name 'Cargo.*' \
        ! -path ./build.rs ! -path ./.cargo_vcs_info.json)
    [[ -z $others ]] || die "the package of $crate has files that it does not need: $others"
done
[[ ${1-} != --list ]] || exit 0

# In a workspace of their own. Versions of other crates are those of the lock file in the package of flap-cli.
cp -- "$sources/flap-cli-$version/Cargo.lock" "$sources"
{
    printf '[workspace]\nresolver = "3"\nmembers = ["flap-cli-%s"]\n[patch.crates-io]\n' "$version"
    for crate in "${crates[@]}"; do printf '%s = { path = "%s-%s" }\n' "$crate" "$crate" "$version"; done
} >"$sources/Cargo.toml"
(cd -- "$sources" && cargo check --quiet --target-dir "$target/packages/check")
echo "The packages of ${#crates[@]} crates are complete and compile."
