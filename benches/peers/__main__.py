"""Runs flap and other solvers on the same points, and compares the results: see README.md."""

from harness.command import main

if __name__ == "__main__":
    main()
