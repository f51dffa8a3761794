"""``python -m laneweave`` is the command ``laneweave``."""

import sys

from ._command import main

sys.exit(main())
