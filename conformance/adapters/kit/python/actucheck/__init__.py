"""actucheck for Python: the program, what adapters share (`actucheck.adapter`), and a plugin for pytest."""

import os
import shutil
import sysconfig

__all__ = ["program"]


def program():
    """The path of the program `actucheck`: of this environment, or else the first on the path.

    Raises FileNotFoundError if there is none.
    """
    here = sysconfig.get_path("scripts")
    elsewhere = os.environ.get("PATH", os.defpath)
    found = shutil.which("actucheck", path=os.pathsep.join([here, elsewhere]))
    if found is None:
        raise FileNotFoundError("the program actucheck is not there; `pip install actucheck` installs it")
    return found
