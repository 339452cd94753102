# SPDX-License-Identifier: Apache-2.0
"""The profile of the checks alone runs no linter, whatever the project file selects beside it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from commandline import haros, write

from haros_ci.config.settings import LinterSettings, PackagePolicy, PathPolicy, Policy, Settings
from haros_ci.linting import contradictions, lint_options
from haros_ci.registry import built_in
from haros_ci.results.rule import Level

SELECTS = Policy(select=("cpplint:runtime/int",))
SELECTS_CHECKS = Policy(select=("global-name", "haros-ci:self-loop"))


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"policy": SELECTS},
        {"per_path": (PathPolicy(globs=("a",), policy=SELECTS),)},
        {"command_line": SELECTS_CHECKS},
    ],
)
def test_no_linter_runs(more: dict[str, object]) -> None:
    settings = Settings(root=Path("/ws"), profile="architecture", **more)  # type: ignore[arg-type]
    assert lint_options(settings, built_in()).disabled == frozenset(built_in().adapters)


@pytest.mark.parametrize(
    ("more", "run"),
    [
        ({"profile": "ros"}, {"cppcheck", "pylint", "cpplint", "lizard"}),
        ({"profile": "all"}, {"cppcheck", "pylint", "cpplint", "lizard", "radon"}),
        ({"profile": "architecture", "command_line": SELECTS}, {"cpplint"}),
        ({"profile": "architecture", "command_line": Policy(select=("global-name", "pylint"))}, {"pylint"}),
        (
            {"profile": "architecture", "per_path": (PathPolicy(globs=("a",), policy=Policy(), profile="strict"),)},
            {"cppcheck", "pylint", "cpplint", "lizard", "radon"},
        ),
    ],
)
def test_linters_run(more: dict[str, object], run: set[str]) -> None:
    assert run.isdisjoint(disabled(**more))


# -- tools of which nothing is shown -------------------------------------------------------------------------------


def disabled(**more: object) -> frozenset[str]:
    return lint_options(Settings(root=Path("/ws"), **more), built_in()).disabled  # type: ignore[arg-type]


def somewhere(**more: object) -> tuple[PathPolicy, ...]:
    return (PathPolicy(globs=("src/**",), policy=Policy(**more)),)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("more", "silent"),
    [
        ({"command_line": Policy(ignore=("cppcheck",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck:*",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck", "pylint"))}, "pylint"),
        ({"command_line": Policy(ignore=("*",))}, "cppcheck"),
        ({"policy": Policy(ignore=("cppcheck",))}, "cppcheck"),
        ({"policy": Policy(levels=(("cppcheck", None),))}, "cppcheck"),
        ({"command_line": Policy(ignore=("metrics",))}, "lizard"),
        ({"command_line": Policy(ignore=("metrics",))}, "radon"),
        ({"command_line": Policy(ignore=("cpplint",)), "profile": "strict"}, "cpplint"),
        ({"command_line": Policy(ignore=("cpplint",)), "per_path": somewhere(select=("cpplint",))}, "cpplint"),
        ({"policy": Policy(ignore=("cppcheck",)), "per_path": somewhere(ignore=("pylint",))}, "cppcheck"),
        ({"policy": Policy(ignore=("cppcheck",)), "per_path": somewhere(select=("pylint",))}, "cppcheck"),
        (
            {"policy": Policy(ignore=("cppcheck",)), "linters": (("cppcheck", LinterSettings(enabled=True)),)},
            "cppcheck",
        ),
        ({"command_line": Policy(select=("flake8:E501",), ignore=("flake8:*", "flake8:E501"))}, "flake8"),
    ],
)
def test_nothing_of_a_tool_is_shown_so_it_does_not_run(more: dict[str, object], silent: str) -> None:
    assert silent in disabled(**more)


@pytest.mark.parametrize(
    ("more", "heard"),
    [
        ({"command_line": Policy(ignore=("pylint",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck:nullPointer",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("nullPointer", "uninitvar"))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck",), select=("cppcheck:nullPointer",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck",), select=("nullPointer",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck",), select=("null*",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck",), select=("cppcheck:ofNoTable",))}, "cppcheck"),
        ({"command_line": Policy(ignore=("cppcheck",), select=("cppcheck:ofNo*",))}, "cppcheck"),
        ({"policy": Policy(ignore=("cppcheck",)), "command_line": Policy(select=("cppcheck",))}, "cppcheck"),
        ({"policy": Policy(ignore=("cppcheck",)), "per_path": somewhere(select=("cppcheck",))}, "cppcheck"),
        ({"policy": Policy(ignore=("cppcheck",)), "per_path": somewhere(select=("nullPointer",))}, "cppcheck"),
        (
            {
                "policy": Policy(ignore=("cppcheck",)),
                "per_package": (PackagePolicy(names=("a",), policy=Policy(select=("cppcheck",))),),
            },
            "cppcheck",
        ),
        ({"per_path": somewhere(ignore=("cppcheck",))}, "cppcheck"),
        ({"policy": Policy(ignore=("*",)), "command_line": Policy(select=("pylint",))}, "pylint"),
        ({"command_line": Policy(ignore=("metrics",), select=("metrics:halstead-bugs-above-2",))}, "lizard"),
        ({"command_line": Policy(select=("flake8:E501",))}, "flake8"),
        ({"linters": (("flake8", LinterSettings(enabled=True)),)}, "flake8"),
        (
            {
                "policy": Policy(levels=(("cppcheck", None),)),
                "per_path": somewhere(levels=(("nullPointer", Level.ERROR),)),
            },
            "cppcheck",
        ),
    ],
)
def test_a_tool_of_which_something_may_be_shown_runs(more: dict[str, object], heard: str) -> None:
    assert heard not in disabled(**more)


def test_a_tool_that_is_ignored_is_neither_run_nor_missed(tmp_path: Path) -> None:
    """The program of that name leaves a mark when it is started; nor does the report name the tool."""
    root = write(tmp_path / "ws", {"p/a.launch": "<launch/>\n", "p/package.xml": "<package/>\n"})
    write(tmp_path, {"bin/xmllint": f"#!/bin/sh\ntouch {tmp_path}/mark\necho 'xmllint version 20914'\n"})
    (tmp_path / "bin" / "xmllint").chmod(0o755)
    path = os.pathsep.join((str(tmp_path / "bin"), os.environ["PATH"]))
    words = ("check", ".", "--isolated", "--no-cache", "--output", "json", "--select", "xmllint")
    done = haros(*words, cwd=root, PATH=path)
    assert (tmp_path / "mark").exists() and '"xmllint"' in done.stdout
    (tmp_path / "mark").unlink()
    done = haros(*words, "--ignore", "xmllint", cwd=root, PATH=path)
    assert not (tmp_path / "mark").exists() and '"xmllint"' not in done.stdout
    assert done.returncode in (0, 1), done.stderr


# -- tools that are asked for --------------------------------------------------------------------------------------


def enabled(**more: object) -> frozenset[str]:
    return lint_options(Settings(root=Path("/ws"), **more), built_in()).enabled  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("selector", "tools"),
    [
        ("ruff", {"ruff"}),
        ("ruff:F401", {"ruff"}),
        ("ruff:*", {"ruff"}),
        ("PLR0913", {"ruff"}),
        ("F401", {"ruff"}),
        ("clang-tidy", {"clang-tidy"}),
        ("bugprone-use-after-move", {"clang-tidy"}),
        ("catkin_lint", {"catkin_lint"}),
        ("missing_depend", {"catkin_lint"}),
        ("black", {"black"}),
        ("W503", {"flake8"}),
        ("B101", {"bandit"}),
        ("pylint", set()),
        ("unused-import", set()),
        ("nullPointer", set()),
        ("metrics", set()),
        ("correctness", set()),
        ("bugprone-*", set()),
        ("*", set()),
        ("undeclared-dependency", set()),
    ],
)
def test_a_selector_asks_for_the_tool_that_has_the_rule(selector: str, tools: set[str]) -> None:
    """A tool that always runs need not be asked for; a tag or glob says nothing of what has to be installed."""
    assert enabled(command_line=Policy(select=(selector,))) == tools
    assert enabled(policy=Policy(select=(selector,))) == tools
    assert enabled(per_path=somewhere(select=(selector,))) == tools
    assert enabled(command_line=Policy(ignore=(selector,))) == set()


@pytest.mark.parametrize(
    ("selector", "said"),
    [("ruff", True), ("ruff:F401", True), ("F401", True), ("pylint:unused-import", False), ("*", False)],
)
def test_a_tool_that_is_asked_for_and_switched_off_is_said(selector: str, said: bool) -> None:
    settings = Settings(
        root=Path("/ws"),
        command_line=Policy(select=(selector,)),
        linters=(("ruff", LinterSettings(enabled=False)), ("pylint", LinterSettings(enabled=True))),
        origins=(("linter ruff", ".haros-ci.yaml:3"),),
    )
    notes = contradictions(settings, built_in())
    assert [note.partition(" is ")[0] for note in notes] == [".haros-ci.yaml:3: ruff"] * said
