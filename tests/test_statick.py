# SPDX-License-Identifier: Apache-2.0
"""docs/statick.md: its two set-ups say the same of the same findings, its recipes load, and no tool is left out."""

from __future__ import annotations

import re
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import pytest
import yaml

from haros_ci.config.exemptions import exempt
from haros_ci.config.load import load
from haros_ci.config.project import read_project
from haros_ci.config.selection import Selection
from haros_ci.config.selector import check_selectors
from haros_ci.config.settings import Settings
from haros_ci.model import globs
from haros_ci.model.location import Location
from haros_ci.registry import registry
from haros_ci.results.linear_regex import compiled
from haros_ci.results.result import Result, Run, Tool
from haros_ci.results.rule import Level

PAGE = (Path(__file__).parents[1] / "docs" / "statick.md").read_text(encoding="utf-8")
BLOCKS = dict(re.findall(r"<!-- ((?:statick: )?\S+) -->\n```yaml\n(.*?)```", PAGE, re.DOTALL))
CONFIG, PROFILE, EXCEPTIONS = (
    yaml.safe_load(BLOCKS[f"statick: {name}.yaml"]) for name in ("config", "profile", "exceptions")
)
#: ``src/statick_tool/plugins/tool`` of Statick, March 2025, but for do_nothing.
TOOLS = (
    "bandit black catkin_lint cccc chktex clang-format clang-tidy cmakelint cppcheck cpplint docformatter dockerfile-lint"
    " dockerfilelint eslint flawfinder groovylint hadolint htmllint isort jshint lacheck lizard make markdownlint mypy"
    " perlcritic pycodestyle pydocstyle pyflakes pylint rstcheck rstlint ruff shellcheck spotbugs stylelint uncrustify"
    " val_parser val_validate writegood xmllint yamllint"
).split()


def test_every_tool_has_a_row() -> None:
    table = PAGE[PAGE.index("## Tools") : PAGE.index("## An example")]
    assert len(TOOLS) == 42
    assert [row.split("`")[1] for row in re.findall(r"^\| `\S+`", table, re.MULTILINE)] == TOOLS


ROOT = "/ws"
HOMES = {"arm": "arm_driver", "leg": "leg_driver", "worlds": "demo_worlds", "old": "old_driver"}


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    (tmp_path / ".haros-ci.yaml").write_text(BLOCKS["haros-ci"], encoding="utf-8")
    return load(tmp_path, trust_config=True)


def package(path: str) -> str | None:
    return HOMES.get(path.split("/")[1])


def test_the_file_is_right_by_itself(settings: Settings) -> None:
    assert settings.notes == ()
    known = registry(settings)
    assert (
        check_selectors(settings, known.rules_of, known.tools, linters=known.adapters, open_tools=known.open_ended)
        == ()
    )
    assert [tool.name for tool in settings.tools] == ["perlcritic"]


# -- Statick's side, as its exceptions.py and profile.py have it ----------------------------------------------------------


def level_in_statick(path: str) -> str:
    name = package(path)
    return "" if name in EXCEPTIONS["ignore_packages"] else PROFILE["packages"].get(name, PROFILE["default"])


def runs_in_statick(tool: str, path: str) -> bool:
    level: dict[str, Any] = CONFIG["levels"].get(level_in_statick(path), {"tool": {}})
    inherited = [CONFIG["levels"][name]["tool"] for name in level.get("inherits_from", ())]
    return any(tool in tools for tools in (level["tool"], *inherited))


def excepted_in_statick(tool: str, path: str, message: str) -> bool:
    mine = EXCEPTIONS["packages"].get(package(path), {}).get("exceptions", {})
    for where in (EXCEPTIONS["global"]["exceptions"], mine):
        for entry in where.get("file", ()):
            concerns = entry["tools"] == "all" or tool in entry["tools"]
            if concerns and any(fnmatch(f"{ROOT}/{path}", glob) for glob in entry["globs"]):
                return True
        for entry in where.get("message_regex", ()):
            concerns = entry["tools"] == "all" or tool in entry["tools"]
            placed = "globs" not in entry or any(fnmatch(f"{ROOT}/{path}", glob) for glob in entry["globs"])
            if concerns and placed and re.match(entry["regex"], message):
                return True
    return False


# -- and ours ------------------------------------------------------------------------------------------------------------


def accepted_here(settings: Settings, selection: Selection, result: Result) -> bool:
    if any(globs.matches(glob, result.location.path) for glob in settings.exclude):
        return True
    (run,) = exempt([Run(Tool(result.tool), results=(result,))], settings, selection.matches, package)
    return bool(run.results[0].suppressions)


FINDINGS = [
    ("pylint", "function-redefined", "src/arm/a.py", "function already defined"),
    ("pylint", "function-redefined", "src/leg/a.py", "function already defined"),
    ("pylint", "function-redefined", "src/worlds/a.py", "function already defined"),
    ("pylint", "function-redefined", "src/old/a.py", "function already defined"),
    ("pylint", "function-redefined", "src/leg/third_party/a.py", "function already defined"),
    ("pylint", "no-member", "src/leg/a.py", "Module 'cv2' has no 'imread' member"),
    ("pylint", "no-member", "src/leg/a.py", "Module 'numpy' has no 'float' member"),
    ("cpplint", "build/printf_format", "src/leg/test/a.hpp", "%q in format strings is deprecated.  Use %ll instead."),
    ("cpplint", "build/printf_format", "src/leg/src/a.hpp", "%q in format strings is deprecated.  Use %ll instead."),
    ("cppcheck", "nullPointer", "src/leg/test/a.cpp", "Null pointer dereference: p"),
    ("cppcheck", "nullPointer", "src/arm/src/bridge/a.cpp", "Null pointer dereference: vendor_p"),
    ("cppcheck", "nullPointer", "src/arm/src/a.cpp", "Null pointer dereference: vendor_p"),
    ("cppcheck", "nullPointer", "src/leg/src/bridge/a.cpp", "Null pointer dereference: vendor_p"),
    (
        "catkin_lint",
        "missing_depend",
        "src/leg/package.xml",
        "package exports nodelet plugin but does not exec_depend on 'nodelet'",
    ),
    ("catkin_lint", "missing_depend", "src/leg/package.xml", "package a does not exec_depend on 'nodelet'"),
    ("clang-tidy", "bugprone-infinite-loop", "src/arm/src/a.cpp", "this loop is infinite"),
    ("clang-tidy", "bugprone-infinite-loop", "src/leg/src/a.cpp", "this loop is infinite"),
]


@pytest.mark.parametrize(("tool", "rule", "path", "message"), FINDINGS)
def test_both_show_the_same(settings: Settings, tool: str, rule: str, path: str, message: str) -> None:
    known = registry(settings)
    selection = Selection(settings, known.rules_of, unlisted=known.unlisted, package=package)
    result = Result(tool, rule, Level.WARNING, message, Location(path, 1))
    theirs = runs_in_statick(tool, path) and not excepted_in_statick(tool, path, message)
    ours = selection.wants(tool, rule, path) and not accepted_here(settings, selection, result)
    assert ours == theirs


@pytest.mark.parametrize(
    ("flag", "tool", "rule"),
    [
        ("--suppress=unreadVariable", "cppcheck", "unreadVariable"),
        ("-build/include_order", "cpplint", "build/include_order"),
        ("-legal", "cpplint", "legal/copyright"),
        ("--disable=R", "pylint", "too-many-branches"),
        ("C0200", "pylint", "consider-using-enumerate"),
    ],
)
def test_what_flags_turn_off_is_off(settings: Settings, flag: str, tool: str, rule: str) -> None:
    assert flag in CONFIG["levels"]["team"]["tool"][tool]["flags"]
    known = registry(settings)
    selection = Selection(settings, known.rules_of, unlisted=known.unlisted, package=package)
    assert not selection.wants(tool, rule, "src/leg/a.py")


# -- the recipes ---------------------------------------------------------------------------------------------------------

ROWS = {row.split("`")[1]: row for row in re.findall(r"^\| `\S+` \|.*$", PAGE, re.MULTILINE)}
RECIPES = {
    name: re.findall(r"`((?:exec|stream|output|pattern|fields|levels|exit): .*?)`(?=,| \||;)", row)
    for name, row in ROWS.items()
    if "`exec: [" in row and "…" not in row and name not in ("val_parser", "val_validate")
}


@pytest.mark.parametrize("name", sorted(RECIPES))
def test_a_recipe_loads(name: str) -> None:
    entry = {key: yaml.safe_load(part)[key] for part in RECIPES[name] for key in (part.partition(":")[0],)}
    text = yaml.safe_dump({"linters": {f"my-{name}": {**entry, "files": ["*"]}}})
    (tool,) = read_project(text.encode(), ".haros-ci.yaml", trust_config=True).values["declared"]
    assert list(tool.argv) == entry["exec"]


@pytest.mark.parametrize(
    ("name", "line", "expected"),
    [
        ("docformatter", "./src/a.py", {"path": "./src/a.py", "message": "./src/a.py"}),
        (
            "htmllint",
            "./a.html: line 3, col 5, no tabs",
            {"path": "./a.html", "line": "3", "column": "5", "message": "no tabs"},
        ),
        ("lacheck", '"./a.tex", line 3: double space', {"path": "./a.tex", "line": "3", "message": "double space"}),
        (
            "markdownlint",
            "./a.md:3:1 MD013/line-length Line length",
            {"path": "./a.md", "line": "3", "column": "1", "rule": "MD013", "message": "Line length"},
        ),
        (
            "rstcheck",
            "./a.rst:3: (ERROR/3) Unknown role",
            {"path": "./a.rst", "line": "3", "level": "ERROR", "message": "Unknown role"},
        ),
    ],
)
def test_a_pattern_reads_what_its_tool_writes(name: str, line: str, expected: dict[str, str]) -> None:
    (part,) = (part for part in RECIPES[name] if part.startswith("pattern: "))
    assert compiled(yaml.safe_load(part)["pattern"]).search(line) == expected
