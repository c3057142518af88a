"""A test for each requirement of the documents: `pytest --actucheck "python adapter.py"`.

The program runs once, while tests are collected. A requirement passes if none of its checks failed. One whose
failures are all expected (`--actucheck-expect FILE`) is an `xfail`, and one that nothing could be asked about is
skipped, with the reason. What the documents leave unspecified is no failure.
"""

import json
import shlex
import subprocess
import tempfile
import warnings
from pathlib import Path

import pytest

from actucheck import program

# Verdicts after which a requirement has failed.
FAILED = ("fail", "flaky", "crash", "timeout", "adapter-fault", "not-run", "unexpected-pass")
# The versions of the report that this reads.
VERSIONS = (6,)

OPTIONS = {
    "actucheck": "the command of an adapter, which actucheck checks",
    "actucheck_as": "what the library is: codec (if nothing is said) or host",
    "actucheck_expect": "a file of failures that are expected",
    "actucheck_args": "more options of the program, such as '--select *.stuffing.*'",
}


class ActucheckWarning(UserWarning):
    """What a document recommends is not done."""


def pytest_addoption(parser):
    group = parser.getgroup("actucheck", "conformance of a library by its adapter")
    for name, text in OPTIONS.items():
        metavar = {"actucheck": "COMMAND", "actucheck_expect": "FILE"}.get(name)
        choices = ("codec", "host") if name == "actucheck_as" else None
        group.addoption(f"--{name.replace('_', '-')}", metavar=metavar, choices=choices, help=text)
        parser.addini(name, text)


@pytest.hookimpl(tryfirst=True)  # so that -k and --deselect find the tests
def pytest_collection_modifyitems(session, config, items):
    command = option(config, "actucheck")
    if command:
        node = Requirements.from_parent(session, name="actucheck", nodeid="actucheck", command=command)
        items.extend(node.collect())


def option(config, name):
    """An option of the command line, or else of the configuration."""
    return config.getoption(name) or config.getini(name)


class Requirements(pytest.Collector):
    """All requirements that checks of an adapter are about."""

    def __init__(self, *, command, **more):
        super().__init__(**more)
        self.command = command

    def collect(self):
        report = self.report()
        details = {}
        for kept in report["not_passed"]:
            details.setdefault(kept["requirement"], []).append(kept)
        return [
            Requirement.from_parent(
                self, name=result["id"], result=result, details=details.get(result["id"], [])
            )
            for result in report["requirements"]
        ]

    def report(self):
        """Runs the program, and reads its report."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "report.json")
            words = [option(self.config, "actucheck_as") or "codec", f"--report=json={path}", "--quiet"]
            expect = option(self.config, "actucheck_expect")
            words += ["--expect", expect] if expect else []
            words += shlex.split(option(self.config, "actucheck_args") or "")
            try:
                command = [program(), *words, "--", *shlex.split(self.command)]
            except (FileNotFoundError, ValueError) as error:
                raise pytest.UsageError(f"actucheck: {error}") from None
            ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
            if not path.exists():
                raise pytest.UsageError(ended.stderr.strip() or f"actucheck ended with {ended.returncode}")
            report = json.loads(path.read_text(encoding="utf-8"))
        if report["version"] not in VERSIONS:
            raise pytest.UsageError(
                f"actucheck {report['actucheck']} writes reports of version {report['version']}, which this "
                "plugin does not know; install both of one version"
            )
        return report


class Requirement(pytest.Item):
    """A requirement, with the counts of its checks and the smallest that did not pass."""

    def __init__(self, *, result, details, **more):
        super().__init__(**more)
        self.result, self.details = result, details
        self.user_properties.append(("statement", self.statement()))

    def runtest(self):
        totals = {verdict: count for verdict, count in self.result["totals"].items() if count}
        if any(verdict in FAILED for verdict in totals):
            raise NotConforming(self.text(FAILED))
        if "expected-failure" in totals:
            pytest.xfail(self.text(["expected-failure"]))
        if set(totals) == {"skip"}:
            pytest.skip(self.first(["skip"], "reason") or "the adapter offers nothing for it")
        if "warn" in totals:
            warnings.warn(ActucheckWarning(self.text(["warn"])), stacklevel=1)

    def statement(self):
        """The sentence, and where it is."""
        statement = self.result["statement"]
        if statement is None:
            return f"{self.name}: a rule of the adapter protocol"
        return f"{statement['text']} ({statement['document']}, {statement['section']})"

    def kept(self, verdicts):
        """The smallest checks with such a verdict."""
        groups = (group for group in self.details if group["verdict"] in verdicts)
        return [check for group in groups for check in group["smallest"]]

    def first(self, verdicts, field):
        return next((check[field] for check in self.kept(verdicts) if check.get(field)), None)

    def text(self, verdicts):
        """The sentence, how many checks did not pass, and the smallest of them."""
        count = sum(self.result["totals"].get(verdict, 0) for verdict in verdicts)
        lines = [self.statement(), f"{count} of {sum(self.result['totals'].values())} checks"]
        for check in self.kept(verdicts)[:1]:
            lines += [
                f"{name:<8}  {value if isinstance(value, str) else json.dumps(value)}"
                for name, value in (
                    ("check", check["id"]),
                    ("request", check.get("request")),
                    ("expected", check.get("expected")),
                    ("got", check.get("actual")),
                    ("because", check.get("detail")),
                    ("reason", check.get("reason")),
                    ("replay", check.get("replay")),
                )
                if value
            ]
        return "\n".join(lines)

    def repr_failure(self, excinfo):
        """What is wrong; the place in this plugin would help nobody."""
        if isinstance(excinfo.value, NotConforming):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self):
        # Not the name alone: pytest would take its dots for modules.
        return self.path, None, f"actucheck {self.name}"


class NotConforming(Exception):
    """A library does not do what a sentence says."""
