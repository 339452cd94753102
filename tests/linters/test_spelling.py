# SPDX-License-Identifier: Apache-2.0
"""Words that can be rules of a tool whose tables are not complete, and words that cannot."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from haros_ci.config.selector import check_selectors, slip_finder
from haros_ci.config.settings import Policy, Settings
from haros_ci.errors import UserError
from haros_ci.linters.catalogue import UNSERVED
from haros_ci.linters.catalogue.spelling import doubt
from haros_ci.model.slips import slips
from haros_ci.registry import built_in


@pytest.mark.parametrize(
    ("selector", "says"),
    [
        ("pylint:unused-improt", "did you mean 'pylint:unused-import'?"),
        ("pylint:Unused-Import", "did you mean 'pylint:unused-import'?"),
        ("pylint:unused_import", "did you mean 'pylint:unused-import'?"),
        ("pylint:W0611", "pylint's rules go by their symbols"),
        ("pylint:unused", "'pylint:unused*' names all whose id begins so"),
        ("cppcheck:nullPointr", "did you mean 'cppcheck:nullPointer'?"),
        ("cppcheck:nullpointer", "did you mean 'cppcheck:nullPointer'?"),
        ("mypy:arg_type", "did you mean 'mypy:arg-type'?"),
        ("clang-tidy:bugprone-use-after-mvoe", "did you mean 'clang-tidy:bugprone-use-after-move'?"),
        ("clang-tidy:bugprone", "'clang-tidy:bugprone*' names all whose id begins so"),
        ("clang-tidy:modernize-use", "'clang-tidy:modernize-use*' names all whose id begins so"),
        ("ruff:F", "'ruff:F*' names all whose id begins so"),
        ("ruff:F40", "'ruff:F*'"),
        ("ruff:f401", "did you mean 'ruff:F401'?"),
        ("ruff:FF401", "did you mean 'ruff:F401'?"),
        ("ruff:unused-import", "ruff's rules go by their codes"),
        ("flake8:unused-import", "flake8's rules go by their codes"),
        ("bandit:101", "did you mean 'bandit:B101'?"),
        ("shellcheck:2086", "did you mean 'shellcheck:SC2086'?"),
        ("hadolint:DL30088", "did you mean 'hadolint:DL300"),
        ("catkin_lint:missing_dpend", "did you mean 'catkin_lint:missing_depend'?"),
    ],
)
def test_a_slip_is_an_error(selector: str, says: str) -> None:
    with pytest.raises(UserError) as caught:
        check(selector)
    tool, _, name = selector.partition(":")
    assert caught.value.message == f"command line: {tool} has no rule '{name}'"
    if says == "'ruff:F*'":
        says = "'ruff:F40*' names all"
    assert says in (caught.value.help or "")


@pytest.mark.parametrize(
    "selector",
    [
        "pylint",
        "pylint:",
        "pylint:*",
        "pylint:unused-*",
        "pylint:unused-import",
        "unused-import",
        "ruff:F401",
        "ruff:F4*",
        "ruff:PLR0913",
        "PLR0913",
        "PLR*",
        "ruff:AIR302",
        "clang-tidy:bugprone-*",
        "clang-tidy:modernize-loop-convert",
        "modernize-loop-convert",
        "clang-tidy:hicpp-use-override",
        "clang-tidy:clang-diagnostic-unused-lambda-capture",
        "clang-tidy:clang-analyzer-core.DivideZero",
        "flake8:D103",
        "flake8:ABC123",
        "flawfinder:strcpy",
        "catkin_lint:MISSING_DEPEND",
        "catkin_lint:missing_depend",
        "haros_plugin_pylint:error",
    ],
)
def test_what_a_tool_has_is_no_slip(selector: str) -> None:
    assert not check(selector)


@pytest.mark.parametrize(
    "selector",
    ["pylint:brand-new-message", "cppcheck:quiteAnotherDefect", "ruff:F499", "shellcheck:SC9999", "pylint:zzz*"],
)
def test_what_a_newer_version_may_have_is_said(selector: str) -> None:
    tool = selector.partition(":")[0]
    (note,) = check(selector)
    assert note == (
        f"command line: '{selector}' names no rule of {tool} that haros-ci knows: "
        f"it has no effect unless {tool} reports one of that name"
    )


def test_every_rule_of_every_table_is_beyond_doubt() -> None:
    known = built_in()
    doubtful = [f"{tool}:{rule}" for tool in known.tools for rule in known.rules_of(tool) if doubt(tool, rule)]
    assert not doubtful


@pytest.mark.parametrize(
    ("one", "other", "number"),
    [("import", "improt", 1), ("import", "import", 0), ("abc", "", 3), ("ab", "ba", 1), ("abcd", "acbde", 2)],
)
def test_slips(one: str, other: str, number: int) -> None:
    assert slips(one, other) == number
    assert slips(other, one) == number  # pylint: disable=arguments-out-of-order


def check(selector: str) -> tuple[str, ...]:
    known = built_in()
    return check_selectors(
        Settings(root=Path("/"), command_line=Policy(select=(selector,))),
        known.rules_of,
        known.tools,
        open_tools=known.open_ended,
        doubt=known.doubt,
        identifiers=known.identifiers,
    )


@pytest.mark.parametrize(
    ("selector", "meant"),
    [
        ("pylint:unused-improt", "pylint:unused-import"),
        ("unused-improt", "unused-import"),
        ("pylnt:unused-import", "pylint:unused-import"),
        ("undeclared-dependancy", "undeclared-dependency"),
        ("haros-ci:undeclared-dependancy", "haros-ci:undeclared-dependency"),
        ("cpplint:build/inclde", "cpplint:build/include"),
    ],
)
def test_slips_in_comments(selector: str, meant: str) -> None:
    assert slip()(selector) == f"did you mean '{meant}'?"


@pytest.mark.parametrize(
    "selector",
    [
        *("unused-import", "pylint:unused-import", "pylint", "metrics", "correctness", "*", "unused-*", "user:mine"),
        *("my-own-rule", "semgrep:x", "pylint:brand-new-message", "ruff:F499", "haros_plugin_cppcheck:SixParams"),
        *("max_control_nesting_4", "clang-tidy:clang-diagnostic-x", "flake8:ABC123", "x", "", "mine:unused-improt"),
    ],
)
def test_no_slips_in_comments(selector: str) -> None:
    assert slip()(selector) == ""


def slip() -> Callable[[str], str]:
    known = built_in()
    return slip_finder(
        Settings(root=Path("/")),
        known.rules_of,
        known.tools,
        unserved=UNSERVED,
        open_tools=known.open_ended,
        doubt=known.doubt,
        identifiers=known.identifiers,
    )
