"""python -m supercoil.ros: the same as supercoil-ros."""

import sys

from supercoil.ros.cli import main

if __name__ == "__main__":
    sys.exit(main())
