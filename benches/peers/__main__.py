"""Runs flap and other solvers side by side: see README.md."""

from harness.command import main

if __name__ == "__main__":
    main()
