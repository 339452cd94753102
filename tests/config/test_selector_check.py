# SPDX-License-Identifier: Apache-2.0
"""Selectors that name nothing: errors with a near miss, or notes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.config.project import read_project
from haros_ci.config.selector import check_selectors
from haros_ci.config.settings import Policy, Settings
from haros_ci.errors import UserError
from haros_ci.results.rule import Rule

CATALOGUE = {
    "pylint": {"unused-import": Rule("unused-import", "", tags=("cleanup",), deprecated_ids=("unused-module",))},
    "cpplint": {
        "whitespace/tab": Rule(
            "whitespace/tab", "", tags=("formatting",), aliases=("haros_plugin_cpplint:two_space_indent",)
        )
    },
    "metrics": {"mi-below-20": Rule("mi-below-20", "", aliases=("mi_below_20",))},
    "clang-tidy": {},
}
UNSERVED = frozenset({"max_control_nesting_4", "haros_plugin_cppcheck:SixParams", "unak", "close_brace_alignment"})


def check(text: str, name: str = ".haros-ci.yaml", *, command_line: Policy | None = None) -> tuple[str, ...]:
    parsed = read_project(text.encode(), name)
    settings = replace(
        Settings(root=Path("/")), **parsed.values, origins=parsed.origins, command_line=command_line or Policy()
    )
    return check_selectors(settings, CATALOGUE.__getitem__, CATALOGUE, unserved=UNSERVED, open_tools={"clang-tidy"})


@pytest.mark.parametrize(
    "selector",
    [
        "unused-import",
        "pylint:unused-import",
        "pylint:unused-module",
        "unused-module",
        "pylint",
        "pylint:*",
        "cleanup",
        "whitespace/*",
        "cpplint:white*",
        "*",
        "un*",
        "mi_below_20",
        "metrics:mi_below_20",
        "cpplint:two_space_indent",
        "haros_plugin_cpplint:two_space_indent",
        "haros_plugin_pylint",
        "clang-tidy:bugprone-x",
        "clang-tidy:bugprone-*",
        "user:mine",
    ],
)
def test_known(selector: str) -> None:
    query = "rules: {mine: {name: n, description: d, tags: []}}\n"
    for key in (f"select: ['{selector}']", f"ignore: ['{selector}']", f"levels: {{'{selector}': note}}"):
        assert check(query + key) == ()
    assert check(f"{query}per-path: {{a: {{ignore: ['{selector}']}}}}") == ()
    assert check(query, command_line=Policy(select=(selector,))) == ()


@pytest.mark.parametrize(
    ("selector", "message", "help_"),
    [
        ("unused-imprt", "unknown rule or tag 'unused-imprt'", "did you mean 'unused-import'?"),
        ("Unused-Import", "unknown rule or tag 'Unused-Import'", "did you mean 'unused-import'?"),
        (
            "pylint:unused-imports",
            "unknown rule or tag 'pylint:unused-imports'",
            "did you mean 'pylint:unused-import'?",
        ),
        ("formating", "unknown rule or tag 'formating'", "did you mean 'formatting'?"),
        (
            "cpplnt:whitespace/tab",
            "unknown rule or tag 'cpplnt:whitespace/tab'",
            "did you mean 'cpplint:whitespace/tab'?",
        ),
        ("haros_plugin_cpplint:two_space_indents", "unknown rule or tag", "'haros_plugin_cpplint:two_space_indent'?"),
        ("cpplint:blank*", "no rule matches 'cpplint:blank*'", "lists every rule"),
        ("user:nothing", "unknown rule or tag 'user:nothing'", "lists every rule"),
        ("strict", "unknown rule or tag 'strict'", "'strict' is a profile: choose it with profile: strict"),
        ("qqqqqq", "unknown rule or tag 'qqqqqq'", "haros-ci rules lists every rule"),
    ],
)
def test_unknown(selector: str, message: str, help_: str) -> None:
    for text in (f"\nselect: ['{selector}']", f"\nignore: ['{selector}']", f"\nlevels: {{'{selector}': note}}"):
        with pytest.raises(UserError) as caught:
            check(text)
        assert caught.value.message.startswith(f".haros-ci.yaml:2: {message}")
        assert help_ in (caught.value.help or "")
    with pytest.raises(UserError) as caught:
        check("", command_line=Policy(ignore=(selector,)))
    assert caught.value.message.startswith(f"command line: {message}")


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        ("", ()),
        ("profile: strict", ()),
        (
            "ignore: [max_control_nesting_4, 'haros_plugin_cppcheck:SixParams', unak,\n"
            "  'haros_plugin_cpplint:close_brace_alignment']",
            (
                "HAROS names without a rule here, so nothing to turn on or off: haros_plugin_cppcheck:SixParams, "
                "haros_plugin_cpplint:close_brace_alignment, max_control_nesting_4, unak",
            ),
        ),
        (
            "\nignore: ['semgrep:x']",
            (".haros-ci.yaml:2: 'semgrep:x' can only match in an imported log: no tool here has that name",),
        ),
        (
            "analysis: {ignore: {tags: [formatting, formating],\n  rules: ['user:gone']}}",
            (
                ".haros-ci.yaml:1: no rule or tag 'formating' here; did you mean 'formatting'?",
                ".haros-ci.yaml:2: no rule or tag 'user:gone' here",
            ),
        ),
        ("analysis: {ignore: {metrics: [maintainability_index, nested_control]}}", None),
    ],
)
def test_notes(text: str, notes: tuple[str, ...] | None) -> None:
    found = check(text)
    if notes is None:  # a HAROS list may name anything: never an error
        assert all("no rule or tag" in note or "without a rule here" in note for note in found)
    else:
        assert found == notes


def test_an_error_in_a_haros_list_and_in_ours_is_an_error() -> None:
    with pytest.raises(UserError):
        check("ignore: [formating]\nanalysis: {ignore: {tags: [formating]}}")


def test_notes_have_an_end() -> None:
    text = "analysis: {ignore: {rules: [" + ", ".join(f"r{i}" for i in range(500)) + "]}}"
    notes = check(text)
    assert len(notes) == 21
    assert notes[-1] == "and 480 more notes on selectors"


@pytest.mark.parametrize(
    ("text", "help_"),
    [
        ("linters: {pylnt: true}", "did you mean 'pylint'?"),
        ("linters: {zzzzz: false}", "one of: clang-tidy, cpplint, metrics, pylint"),
    ],
)
def test_unknown_tools(text: str, help_: str) -> None:
    with pytest.raises(UserError, match=r"^\.haros-ci\.yaml:1: unknown tool") as caught:
        check(text)
    assert caught.value.help == help_


def test_a_blacklisted_haros_plugin_is_no_unknown_tool() -> None:
    assert check("plugin_blacklist: [radon]") == ()


def test_linters_may_have_other_names_than_tools() -> None:
    settings = replace(Settings(root=Path("/")), origins=(("linter lizard", "f:1"),))
    assert check_selectors(settings, CATALOGUE.__getitem__, CATALOGUE, linters=("lizard", "pylint")) == ()
    with pytest.raises(UserError, match="unknown tool 'lizard'"):
        check_selectors(settings, CATALOGUE.__getitem__, CATALOGUE)
