"""``python -m sedfiber`` is the command ``sedfiber``."""

import sys

from sedfiber.cli import main

sys.exit(main())
