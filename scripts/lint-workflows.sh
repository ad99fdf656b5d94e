#!/usr/bin/env bash
# Checks the workflow files with actionlint, and the scripts with shellcheck if it is installed. Needs go, unless actionlint is
# installed.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

if command -v actionlint >/dev/null; then
    actionlint .github/workflows/*.yml
else
    go run github.com/rhysd/actionlint/cmd/actionlint@v1.7.12 .github/workflows/*.yml
fi
if command -v shellcheck >/dev/null; then
    shellcheck scripts/*.sh .ci/run
else
    echo "The scripts are not checked: install shellcheck."
fi
