"""The plugin, asked as its users ask it: a project of a few files, and pytest in it."""

import sys

import pytest

pytest_plugins = ["pytester"]

# An adapter of one op. WRONG is added to each CRC.
ADAPTER = """
import sys
from actucheck.adapter import Rejected, serve, unhex

def crc(request):
    remainder = 0
    for byte in unhex(request["bytes"]):
        remainder ^= byte << 8
        for _ in range(8):
            remainder = (remainder << 1 ^ (0x8005 if remainder & 0x8000 else 0)) & 0xFFFF
    return {"crc": remainder ^ WRONG}

serve({"name": "bitwise", "version": "1"}, ["host"], "dynamixel2", {"crc": crc})
"""


def adapter(pytester, wrong=0):
    """The command of such an adapter."""
    path = pytester.makepyfile(adapter=ADAPTER.replace("WRONG", str(wrong)))
    return f"{sys.executable} {path}"


def run(pytester, *options, wrong=0, args="--select *.one-byte/crc"):
    """Runs pytest with the adapter; returns its result."""
    command = adapter(pytester, wrong)
    return pytester.runpytest_subprocess(f"--actucheck={command}", f"--actucheck-args={args}", *options)


def expecting(pytester, check="*"):
    """The option that names a file in which failures are expected."""
    text = f'expected_failures:\n  - ids: ["{check}"]\n    reason: it adds one\n'
    return f"--actucheck-expect={pytester.makefile('.yaml', expect=text)}"


def test_requirements_are_tests(pytester):
    result = run(pytester, "-v")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["actucheck::dynamixel2.crc.value PASSED*"])


def test_requirements_join_the_tests_of_the_project(pytester):
    pytester.makepyfile("def test_own(): pass")
    run(pytester).assert_outcomes(passed=2)


def test_a_wrong_answer_fails_with_its_sentence_and_its_bytes(pytester):
    result = run(pytester, wrong=1)
    result.assert_outcomes(failed=1)
    # Of no bytes the remainder is 0.
    result.stdout.fnmatch_lines(
        ["The CRC is CRC-16/UMTS*", "* of * checks", "request*", "expected*", "got*", "replay*actucheck replay*"]
    )


def test_an_expected_failure_is_an_xfail(pytester):
    result = run(pytester, expecting(pytester), "-rx", wrong=1)
    result.assert_outcomes(xfailed=1)
    result.stdout.fnmatch_lines(["reason*it adds one"])


def test_an_unexpected_pass_fails(pytester):
    run(pytester, expecting(pytester, "dynamixel2.basic.one-byte/crc")).assert_outcomes(failed=1)


def test_what_the_adapter_lacks_is_skipped(pytester):
    result = run(pytester, "-rs", args="--select *.stuffing.goal-position/encode")
    result.assert_outcomes(skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED*"])


def test_tests_are_picked_by_their_names(pytester):
    result = run(pytester, "-k", "no-such-requirement")
    result.assert_outcomes(deselected=1)


def test_options_may_stand_in_the_configuration(pytester):
    lines = ["[pytest]", f"actucheck = {adapter(pytester)}", "actucheck_args = --select *.one-byte/crc"]
    pytester.makeini("\n".join(lines))
    pytester.runpytest_subprocess().assert_outcomes(passed=1)


def test_without_a_command_nothing_is_added(pytester):
    pytester.makepyfile("def test_own(): pass")
    pytester.runpytest_subprocess().assert_outcomes(passed=1)


def test_a_missing_file_is_told_in_a_sentence(pytester):
    result = run(pytester, "--actucheck-expect=none.yaml")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: actucheck: cannot read none.yaml*"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--actucheck=/no/such/adapter"], "*cannot run `/no/such/adapter`*"),
        (["--actucheck=python 'adapter.py"], "*No closing quotation*"),
        (["--actucheck=true", "--actucheck-args=--no-such-option"], "*--no-such-option*"),
    ],
)
def test_what_cannot_be_run_is_told_in_a_sentence(pytester, options, message):
    result = pytester.runpytest_subprocess(*options)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines([f"ERROR: {message}"])
