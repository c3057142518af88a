"""Virtual servos for a test."""

import os
import signal
import subprocess

import pytest


@pytest.fixture
def servos():
    """The port of two virtual JA40s, with the IDs 1 and 2."""
    command = [os.environ.get("ACTUCHECK", "actucheck"), "bus", "ja40@1", "ja40@2"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as bus:
        yield bus.stdout.readline().split()[1]
        bus.send_signal(signal.SIGINT)
