# SPDX-License-Identifier: Apache-2.0
"""``haros-ci testgen``: property-based tests as files, and, if asked for by ``--run``, what they say of the running nodes."""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.tested import suites
from haros_ci.commands.common import store_for
from haros_ci.commands.monitor import settings_of
from haros_ci.errors import EXIT_TOOL_TROUBLE, UserError
from haros_ci.pipeline import found, selection_of
from haros_ci.registry import registry
from haros_ci.report.escape import log_line, terminal
from haros_ci.scratch import scratch_directory
from haros_ci.test_files.property_tests.processes import Processes
from haros_ci.test_files.suite import Suite
from haros_ci.test_files.written import MARK, written
from haros_ci.writing import put_below

#: Seconds that the tests have to end what they have started, after SIGINT and after SIGTERM.
_GENTLE, _FIRM = 10.0, 5.0


def testgen(flags: Mapping[str, Any]) -> int:
    """Write the tests; with ``run`` run them: 1 if a property is violated, 3 if they could not be run. 2 for wrong usage, else 0."""
    settings = settings_of(flags)
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    workspace = found(settings, selection)
    store = store_for(settings)
    made = suites(
        workspace,
        Architectures(settings, store, known),
        flags["configuration"],
        settings.project_file or "",
        flags["patience"],
    )
    if trouble := store.flush():
        click.echo(f"warning: {trouble}", err=True)
    result = written(made, non_finite=flags["non_finite"])
    for note in result.notes:
        click.echo(f"note: {terminal(note)}", err=True)
    if not result.files:
        raise UserError(
            "there are no properties to test",
            help="state them in the project file under hpl of a configuration or node",
        )
    folder = Path(flags["directory"])
    for name in result.files:
        _is_ours(folder / name)
    put_below(folder, result.files)
    tests = sorted(name for name in result.files if name.startswith("test_"))
    for name in tests:
        click.echo(str(folder / name))
    return _run(folder, tests, made, flags) if flags["run"] else 0


def _is_ours(path: Path) -> None:
    """UserError for a file that testgen has not written: it is somebody's work."""
    if path.is_symlink() or (path.is_file() and MARK not in _head(path)):
        raise UserError(f"{path} is there, and not of haros-ci testgen", help="name another directory")


def _head(path: Path) -> str:
    with path.open(encoding="utf-8", errors="replace") as file:
        return file.read(2_000)


def _run(folder: Path, tests: Sequence[str], made: Sequence[Suite], flags: Mapping[str, Any]) -> int:
    """Run the tests with pytest, having said what they start."""
    if made[0].ros != 1:
        raise UserError("tests of ROS 2 are not run from here", help="run them with launch_test (docs/testgen.md)")
    missing = [name for name in ("hypothesis", "pytest") if importlib.util.find_spec(name) is None]
    if missing:
        raise UserError(f"{' and '.join(missing)} cannot be imported", help="pip install 'haros-ci[testgen]'")
    for line in starts(made):
        click.echo(log_line(line))
    sys.stdout.flush()
    env = dict(os.environ)
    if flags["examples"] is not None:
        env["PROPERTY_TESTS_EXAMPLES"] = str(flags["examples"])
    with scratch_directory() as scratch:
        report = Path(env.setdefault("PROPERTY_TESTS_REPORT", os.path.join(scratch, "report.jsonl")))
        before = report.stat().st_size if report.exists() else 0
        code = _tested(folder, tests, env)
        results = _results(report, before)
    if code == 1 and "error" in results and "failed" not in results:
        return EXIT_TOOL_TROUBLE  # the system did not start: that says nothing of any property
    return code if code in (0, 1) else EXIT_TOOL_TROUBLE


def _results(report: Path, before: int) -> set[str]:
    """How the tests ended, as their report says from the byte *before* on."""
    try:
        lines = report.read_bytes()[before:].splitlines()
    except OSError:
        return set()
    try:
        return {str(json.loads(line)["result"]) for line in lines}
    except (KeyError, TypeError, ValueError, RecursionError):
        return set()  # another program has written into it


def _tested(folder: Path, tests: Sequence[str], env: Mapping[str, str]) -> int:
    """The exit code of pytest."""
    command = [sys.executable, "-m", "pytest", "-o", "addopts=", "-p", "no:cacheprovider", "-rfsxX", "--"]
    processes = Processes(_GENTLE, _FIRM)
    process = processes.start("the tests", [*command, *(str(folder / name) for name in tests)], env, None)
    try:
        return process.wait()
    finally:
        processes.end_all()


def starts(made: Sequence[Suite]) -> list[str]:
    """What running the tests starts, in words."""
    lines = ["The tests start, and end again, on a master of their own (rosmaster, a free port of 127.0.0.1):"]
    for suite in made:
        if suite.properties:
            launches = ", ".join(" ".join((item.package, item.path, *item.arguments)) for item in suite.launches)
            lines.append(f"  of {launches}: {', '.join(suite.started)}")
    return list(dict.fromkeys(lines))
