"""Measures how the cost and the memory of `flap sweep` grow with the number of points: `python3 benches/growth --help`."""

from scaling.command import main

if __name__ == "__main__":
    main()
