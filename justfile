# Recipes for work on flap. `just` alone lists them.

default:
    @just --list

# All tests: formatting, lints, documentation, Rust and Python.
test:
    ./scripts/test.sh

# Rust tests alone.
test-rust:
    cargo test --workspace

# The code of the pages: types, lints, formatting and unit tests (needs npm).
[positional-arguments]
test-web *ARGS:
    ./scripts/test-web.sh "$@"

# The wheel and its tests, in a virtual environment below target/.
test-python:
    ./scripts/test-python.sh

# Tests of the harnesses in benches/peers and benches/growth, in the environment that `just test-python` makes.
test-benches:
    cargo build --locked -p flap-cli
    FLAP="${CARGO_TARGET_DIR:-$PWD/target}/debug/flap" "${CARGO_TARGET_DIR:-target}/python/bin/python" -m pytest --quiet \
        -c tests/python/pytest.ini --rootdir . -p no:cacheprovider benches/tests

# Lanes of aarch64 in an emulator, and sweeps of both architectures to the same bytes: see the script for what it needs.
test-aarch64:
    ./scripts/test-aarch64.sh

# The command for Windows, under Wine: see the script for what it needs.
test-windows:
    ./scripts/test-windows.sh

# Wheels and archives of the command, into dist/ (docs/contributing/releasing.md): `just wheels aarch64-unknown-linux-gnu`.
[positional-arguments]
wheels *ARGS:
    ./scripts/build-wheels.sh "$@"

# The workflow files and the scripts, by actionlint and shellcheck.
lint-workflows:
    ./scripts/lint-workflows.sh

# The files in packaging/ and the metadata of packages.
lint-packaging:
    ./scripts/lint-packaging.sh

# The packages for crates.io: their files, and that they compile.
check-packages:
    ./scripts/check-packages.sh

# Formats all code; ruff is in the environment that `just test-python` makes.
format:
    cargo fmt --all
    "${CARGO_TARGET_DIR:-target}/python/bin/ruff" format
    "${CARGO_TARGET_DIR:-target}/python/bin/ruff" check --fix

# Formatting and lints of Rust. `just test-python` checks Python.
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# The manual with the documentation of the crates, into target/docs/html; checks prose and links. `just docs --no-rust` is quicker.
[positional-arguments]
docs *ARGS:
    ./scripts/build-docs.sh "$@"

# The example sweep of the README.
example:
    cargo run --release -- sweep --grid examples/ozaki_large.toml --restart

# Computes the statements of the papers with flap: writes docs/evidence/reproduction.md.
reproduce:
    mkdir -p target
    cargo run --release --locked --example reproduce > target/reproduction.md
    mv target/reproduction.md docs/evidence/reproduction.md

# Benchmarks: elementary functions, right-hand sides, one step, lanes against scalars; sweeps of presets; CSV.
bench:
    cargo bench -p flap-core -p flap-sweep --bench ensemble --bench step --bench sweep

# With `--work settled` and `--work responses` motions settle, as those of a sweep do.
# flap beside other solvers on the same equations, in turn on one core (benches/peers): `just peers --help`.
[positional-arguments]
peers *ARGS:
    python3 benches/peers "$@"

# Times and memory of `flap sweep` for 10^3 to 10^7 points (benches/growth): `just growth --help`.
[positional-arguments]
growth *ARGS:
    python3 benches/growth "$@"

# Run nothing else meanwhile: it takes some forty minutes, most of it for the other solvers and the largest sweeps, whose
# rows take 4 GB below target/ for a while.
# How fast flap is on this machine, beside other solvers too: writes docs/evidence/performance.md.
bench-report:
    mkdir -p target
    just peers --points 256 --rtol 1e-6 --rounds 3 --json "$PWD/target/peers-256-6.json"
    just peers --points 4096 --rtol 1e-6 --only 'flap|rk4_lanes' --json "$PWD/target/peers-4096-6.json"
    just peers --points 256 --rtol 1e-8 --only 'flap|rk4_lanes|ode_solvers' --json "$PWD/target/peers-256-8.json"
    just peers --points 4096 --rtol 1e-8 --rounds 3 --only 'flap|rk4_lanes' --json "$PWD/target/peers-4096-8.json"
    just peers --work settled --points 256 --rtol 1e-6 --json "$PWD/target/peers-settled-256-6.json"
    just peers --work settled --points 4096 --rtol 1e-6 --only 'flap|rk4_lanes' --json "$PWD/target/peers-settled-4096-6.json"
    just peers --work settled --points 256 --rtol 1e-8 --only 'flap|rk4_lanes' --json "$PWD/target/peers-settled-256-8.json"
    just peers --work responses --points 256 --rtol 1e-6 --json "$PWD/target/peers-responses-256-6.json"
    just growth --json "$PWD/target/growth.json" --picture docs/pictures/growth.svg
    cargo bench --locked -p flap-sweep --bench report -- --growth "$PWD/target/growth.json" \
        --peers "$PWD"/target/peers-*-[68].json > target/performance.md
    mv target/performance.md docs/evidence/performance.md

# Instructions of small sweeps against the stored numbers (needs valgrind); `just count-instructions --renew` stores them.
count-instructions *ARGUMENTS:
    cargo build --release --locked -p flap-cli
    python3 benches/instructions/count.py "${CARGO_TARGET_DIR:-target}/release/flap" {{ARGUMENTS}}

# Looks for input that breaks a reader of text: grid, units, expression, outline, record, journal or sidecar. Needs a nightly compiler and
# `cargo install cargo-fuzz`. Findings go to fuzz/artifacts; the corpus stays as it is.
fuzz TARGET SECONDS="600":
    mkdir -p target/fuzz/{{TARGET}}
    cargo +nightly fuzz run --sanitizer none --fuzz-dir fuzz {{TARGET}} target/fuzz/{{TARGET}} fuzz/corpus/{{TARGET}} -- -max_total_time={{SECONDS}} -max_len=4096

# What continuous integration runs.
ci:
    .ci/run
