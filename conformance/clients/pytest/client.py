"""Runs the tests of this folder, which start their own buses."""

import os
import sys

import pytest

if len(sys.argv) > 1:
    sys.exit(pytest.main([os.path.dirname(__file__), "-q", "-p", "no:cacheprovider"]))
