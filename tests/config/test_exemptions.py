# SPDX-License-Identifier: Apache-2.0
"""Exceptions: what they fit and what not, what is said of mistakes, and which are for nothing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.config.describe import describe
from haros_ci.config.exemptions import exempt, idle_entries
from haros_ci.config.load import load
from haros_ci.config.project import read_project
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Exemption, Policy, Settings
from haros_ci.errors import UserError
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result, Run, Suppression, Tool
from haros_ci.results.rule import Level, Rule

NAME = ".haros-ci.yaml"
RULES = {"pylint": {"no-member": Rule("no-member", "", tags=("members",), aliases=("E1101",))}}
FOUND = Result("pylint", "no-member", Level.ERROR, "Module 'cv2' has no 'imread' member", Location("src/arm/a.py", 3))
HOMES = {"src/arm/a.py": "arm_driver"}


def read(text: str) -> tuple[Exemption, ...]:
    exemptions = read_project(f"exceptions:\n{text}\n".encode(), NAME).values["exemptions"]
    assert isinstance(exemptions, tuple)
    return exemptions


def settings(text: str) -> Settings:
    return Settings(root=Path("/"), exemptions=read(text))


def suppressed(text: str, result: Result = FOUND) -> tuple[Suppression, ...]:
    chosen = settings(text)
    matches = Selection(chosen, lambda tool: RULES.get(tool, {})).matches
    (run,) = exempt([Run(Tool(result.tool), results=(result,))], chosen, matches, HOMES.get)
    (after,) = run.results
    assert replace(after, suppressions=()) == replace(result, suppressions=())
    return after.suppressions


@pytest.mark.parametrize(
    "text",
    [
        "- {files: [src/arm]}",
        "- {files: ['*.cpp', '**/a.py']}",
        "- {packages: [arm_driver]}",
        "- {packages: [other, 'arm_*']}",
        "- {rules: [pylint]}",
        "- {rules: ['pylint:no-member']}",
        "- {rules: [members]}",
        "- {rules: [E1101]}",
        "- {rules: ['no-*']}",
        "- {rules: [cpplint, '*']}",
        "- {message: has no}",
        "- {message: \"^Module 'cv2' has no '.+' member$\"}",
        "- {message: '(?i)MODULE'}",
        "- {files: ['*.py'], packages: [arm_driver], rules: [pylint], message: cv2, reason: its own}",
    ],
)
def test_fits(text: str) -> None:
    (one,) = suppressed(text)
    assert one.kind == "external" and one.justification and one.source == ".haros-ci.yaml:2"


@pytest.mark.parametrize(
    "text",
    [
        "- {files: [src/leg]}",
        "- {files: [arm.py]}",
        "- {packages: [arm]}",
        "- {packages: ['Arm_*']}",
        "- {rules: [cpplint]}",
        "- {rules: [no-membe]}",
        "- {message: '^has no'}",
        "- {message: module}",
        "- {message: 'member.'}",
        "- {files: [src/arm], rules: [cpplint]}",
        "- {files: [src/leg], rules: [pylint]}",
        "- {packages: [arm_driver], message: numpy}",
        "- {packages: [leg_driver], message: cv2}",
    ],
)
def test_does_not_fit(text: str) -> None:
    assert suppressed(text) == ()


def test_reasons() -> None:
    first, second = suppressed('- {rules: [pylint], reason: "  it\'s\\n so "}\n- {files: [src]}')
    assert first.justification == "it's so"
    assert second.justification == "accepted by the exception at .haros-ci.yaml:3"


def test_what_is_suppressed_in_the_source_stays_so() -> None:
    comment = Suppression("inSource", "see there", Location("src/arm/a.py", 3))
    assert suppressed("- {rules: [pylint]}", replace(FOUND, suppressions=(comment,)))[0] == comment


def test_a_merged_finding_goes_by_any_of_its_rules() -> None:
    merged = replace(FOUND, tool="ruff", rule="X1", also=("pylint:no-member",))
    assert len(suppressed("- {rules: ['pylint:no-member']}", merged)) == 1


def test_outside_of_packages() -> None:
    assert suppressed("- {packages: ['*']}", replace(FOUND, location=Location("tools/x.py", 1))) == ()


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("  a", 2, "'exceptions' must be a list, not a text"),
        ("- a", 2, "an entry of 'exceptions' must be a map, not a text"),
        ("- {}", 2, "an exception needs one of files, packages, rules, message"),
        ("- {reason: because}", 2, "an exception needs one of"),
        ("- {files: [a]}\n- {file: [a]}", 3, "unknown key 'file'"),
        ("- {files: a}", 2, "'files' must be a list, not a text"),
        ("- {files: []}", 2, "'files' of an exception is empty, so it fits nothing"),
        ("- {files: [../a]}", 2, "stay inside it"),
        ("- {rules: [1]}", 2, "an entry of 'rules' must be text"),
        ("- {rules: []}", 2, "'rules' of an exception is empty"),
        ("- files: [a]\n  message: '('", 3, "'message' is no pattern that can be used: missing \\)"),
        ("- {message: '(a+)\\1'}", 2, "invalid escape sequence"),
        ("- {message: '(?=a)'}", 2, "invalid perl operator"),
        ("- {message: " + "a" * 501 + "}", 2, "more than 500 characters"),
        ("- {message: ['a']}", 2, "'message' must be text, not a list"),
        ("- {message: ' '}", 2, "'message' is empty"),
        ("- {files: [a], reason: " + "a" * 501 + "}", 2, "a reason of more than 500 characters"),
        ("- {files: [a]}\n" * 201, 2, "'exceptions' has more than 200 entries"),
    ],
)
def test_mistakes(text: str, line: int, message: str) -> None:
    with pytest.raises(UserError, match=rf"^\.haros-ci\.yaml:{line}: .*{message}") as raised:
        read(text)
    assert raised.value.help


def test_none() -> None:
    assert read_project(b"exceptions:\n", NAME).values["exemptions"] == ()
    assert read_project(b"exceptions: []\n", NAME).values["exemptions"] == ()


def test_a_bomb_is_matched_in_no_time() -> None:
    bomb = "- {message: '^(?:(?:a+)+(?:a|aa)*)+[!]$'}"
    assert suppressed(bomb, replace(FOUND, message="a" * 100_000)) == ()
    assert len(suppressed(bomb, replace(FOUND, message="a" * 1_000 + "!"))) == 1


# -- what is for nothing -------------------------------------------------------------------------------------------

TWO = "- {rules: [pylint]}\n- {rules: [cpplint]}\n"
UNUSED = (".haros-ci.yaml:3: this exception fits no finding of this run; remove it",)


def notes(
    text: str, *, targets: frozenset[str] | None = None, successful: bool = True, **changes: object
) -> tuple[str, ...]:
    chosen = replace(settings(text), **changes)  # type: ignore[arg-type]
    matches = Selection(chosen, lambda tool: RULES.get(tool, {})).matches
    runs = exempt([Run(Tool("pylint"), results=(FOUND,), successful=successful)], chosen, matches, HOMES.get)
    package = Package("arm_driver", "src/arm")
    return idle_entries(runs, Workspace(Path("/"), (package,), (), None, targets), chosen)  # type: ignore[arg-type]


def test_an_unused_one_is_noted() -> None:
    assert notes(TWO) == UNUSED
    assert notes("- {rules: [pylint]}") == ()
    assert notes("  [{files: [a]}, {rules: [pylint]}]") == (
        ".haros-ci.yaml:2: this exception fits no finding of this run; remove it",
    ), "two on a line are two"


@pytest.mark.parametrize(
    "changes",
    [
        {"targets": frozenset({"src/arm/a.py"})},
        {"successful": False},
        {"paths": ("src/arm",)},
        {"command_line": Policy(ignore=("cpplint",))},
        {"origins": (("profile", "command line"),)},
    ],
)
def test_not_where_only_a_part_was_analysed(changes: dict[str, object]) -> None:
    assert notes(TWO, **changes) == ()  # type: ignore[arg-type]


def test_settings_show_them(tmp_path: Path) -> None:
    (tmp_path / NAME).write_text(
        "exceptions:\n  - {rules: [pylint], message: 'a b', reason: c}\nper-package: {arm: strict, leg: {ignore: [x]}}\n"
    )
    shown = describe(load(tmp_path))
    assert '  - {"rules": ["pylint"], "message": "a b", "reason": "c"}  # .haros-ci.yaml:2\n' in shown
    assert 'per-package:\n  "arm":\n    profile: strict\n  "leg":\n    ignore: ["x"]\n' in shown
