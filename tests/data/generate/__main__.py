"""Recomputes the reference data in tests/data with SciPy: `python3 tests/data/generate --help`."""

import sys

from reference.command import main

if __name__ == "__main__":
    sys.exit(main())
