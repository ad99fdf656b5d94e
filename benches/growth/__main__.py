"""Measures cost and memory of `flap sweep` over the number of points: `python3 benches/growth --help`."""

from scaling.command import main

if __name__ == "__main__":
    main()
