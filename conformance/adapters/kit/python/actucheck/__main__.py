"""`python -m actucheck` is the program `actucheck` of this environment."""

import subprocess
import sys

from actucheck import program

try:
    sys.exit(subprocess.run([program(), *sys.argv[1:]]).returncode)
except FileNotFoundError as error:
    sys.exit(str(error))
except KeyboardInterrupt:
    sys.exit(130)  # the program had the Ctrl-C too, and has said what it had to say
