"""Measures CPU time and memory of `flap sweep` for different numbers of points: `python3 benches/growth --help`."""

from scaling.command import main

if __name__ == "__main__":
    main()
