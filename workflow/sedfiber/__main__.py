"""``python -m sedfiber`` is the command ``sedfiber``."""

import sys

from sedfiber.commands.cli import main

sys.exit(main())
