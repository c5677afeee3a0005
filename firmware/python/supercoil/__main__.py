"""python -m supercoil"""

import sys

from supercoil.shell import main

sys.exit(main())
