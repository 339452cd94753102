# SPDX-License-Identifier: Apache-2.0
"""``haros-ci explain``, ``rules``, ``--version`` and the table of ``metrics``: what they show, and what they leave out."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from haros_ci import cli
from haros_ci.commands import explain
from haros_ci.commands.rules import fits
from haros_ci.commands.versions import tool_versions
from haros_ci.linters.catalogue.examples import BY_RULE
from haros_ci.linters.own_words import cppcheck_text, own_words, pylint_text
from haros_ci.model.measurement import Measurement
from haros_ci.registry import built_in
from haros_ci.report.measurements import Limit
from haros_ci.report.worst_measurements import table, worst
from haros_ci.results.rule import Rule

RULES: list[tuple[str, Rule]] = list(built_in().documented_rules())
CHECKS = [rule for tool, rule in RULES if tool == "haros-ci" and "## Bad" in rule.help]


@pytest.fixture
def no_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    """No tool is asked; in its place stands a text that is longer than any."""
    monkeypatch.setattr(explain, "_own_words", lambda tool, rule: "Many words of the tool. " * 200)


def said(capfd: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = cli.main([*arguments])
    out, err = capfd.readouterr()
    return code, out, err


# -- explain -----------------------------------------------------------------------------------------------------


def test_every_rule_has_one_screen(no_tools: None) -> None:
    too_long = [f"{tool}:{rule.id}" for tool, rule in RULES if len(explain.short(tool, rule, ["another:rule"])) > 30]
    assert too_long == []


def test_every_check_shows_what_why_bad_good_and_silence() -> None:
    lacking = []
    for rule in CHECKS:
        labels = {line.partition(":")[0] for line in explain.short("haros-ci", rule)}
        if not {"What", "Why", "Bad", "Good", "Silence", "More"} <= labels:
            lacking.append(rule.id)
    assert lacking == []


def test_the_bad_example_has_the_line_and_the_good_one_its_counterpart() -> None:
    lines = explain.short("haros-ci", next(rule for rule in CHECKS if rule.id == "topic-type-mismatch"))
    assert '  sub = node.create_subscription(Int32, "chatter", print, 10)  <-- here' in lines
    good = lines[lines.index("Good: The same type on both ends, both.py:") :]
    assert '  sub = node.create_subscription(String, "chatter", print, 10)' in good
    assert not any("expect:" in line for line in lines)


def test_a_rule_of_a_tool_has_its_words_and_an_example(no_tools: None) -> None:
    rule = next(rule for tool, rule in RULES if (tool, rule.id) == ("pylint", "dangerous-default-value"))
    text = "\n".join(explain.short("pylint", rule))
    assert "What:    Many words of the tool." in text and "\nWhy/fix:" in text
    assert "  def add(item, queue=None):" in text and "pylint: disable=dangerous-default-value" in text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("One sentence.", "One sentence."),
        ("A sentence. " * 60, "A sentence."),
        ("A part; " * 80, "A part."),
        ("word " * 200, "..."),
    ],
)
def test_a_long_paragraph_ends_with_a_sentence(text: str, shown: str) -> None:
    lines = explain._labelled("What", text)
    assert len(lines) <= explain.PARAGRAPH and lines[-1].endswith(shown)


@pytest.mark.parametrize(
    ("rule", "good"),
    [
        ("undeclared-launch-dependency", "Good: It is declared, package.xml:"),
        ("undeclared-dependency", "Good: It is declared, scan_filter/package.xml:"),
        ("header-not-set", "Good: Both are set, src/scan.cpp:"),
        ("frame-leading-slash", "Good: Without a slash, tracker.py:"),
        ("unknown-target", "Good: All are made, CMakeLists.txt:"),
    ],
)
def test_the_good_example_is_the_bad_one_mended(rule: str, good: str) -> None:
    assert good in explain.short("haros-ci", next(check for check in CHECKS if check.id == rule))


def test_no_boilerplate_where_the_tool_has_words(no_tools: None) -> None:
    rule = next(rule for tool, rule in RULES if (tool, rule.id) == ("pylint", "line-too-long"))
    assert "Finding of pylint's check" not in "\n".join(explain.short("pylint", rule))


def test_full_has_everything(capfd: pytest.CaptureFixture[str]) -> None:
    code, short, _ = said(capfd, "explain", "topic-type-mismatch")
    _, full, _ = said(capfd, "explain", "topic-type-mismatch", "--full")
    assert code == 0 and len(short.splitlines()) <= 30 < len(full.splitlines())
    assert "\n## Limits\n" in full and "\nAliases: G06" in full and "\n## " not in short


def test_rules_of_several_tools_are_named(capfd: pytest.CaptureFixture[str]) -> None:
    _, out, _ = said(capfd, "explain", "unused-import")
    assert out.startswith("pylint:unused-import (warning)\n") and "\nAlso: vulture:unused-import\n" in out


@pytest.mark.parametrize("name", ["nosuch", "", "topic"])
def test_an_unknown_rule(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    code, out, err = said(capfd, "explain", name)
    assert (code, out) == (2, "") and "unknown rule" in err


def test_colours() -> None:
    painted = explain.painted("haros-ci:a (error)\nWhat:    b\n")
    assert painted == "\x1b[1mharos-ci:a\x1b[0m (\x1b[31merror\x1b[0m)\n\x1b[1mWhat\x1b[0m:    b\n"


@pytest.mark.parametrize("text", ["plain text", "  indented What: no label", "a (error) in a sentence", "Somewhat: no"])
def test_nothing_to_colour(text: str) -> None:
    assert explain.painted(text) == text


def test_examples_differ_and_are_short() -> None:
    assert all(pair.bad != pair.good for pair in BY_RULE.values())
    assert all(len(code.splitlines()) <= 6 for pair in BY_RULE.values() for code in (pair.bad, pair.good))


# -- the tools' own words ----------------------------------------------------------------------------------------


def test_pylint_text() -> None:
    answer = (
        ":unused-import (W0611): *Unused %s*\n  Used when an imported module or variable is not\n"
        "  used. This message belongs to the variables checker.\n\n"
    )
    assert pylint_text(answer) == "Used when an imported module or variable is not used."


LIST = """<error id="a" severity="error" msg="Short." verbose="Long: &apos;x&apos;\\012y" cwe="1"/>
<error id="b" severity="error" msg="The same." verbose="The same."/>"""


@pytest.mark.parametrize(("rule", "text"), [("a", "Long: 'x'\ny"), ("b", ""), ("c", ""), ("a|b", "")])
def test_cppcheck_text(rule: str, text: str) -> None:
    assert cppcheck_text(LIST, rule) == text


@pytest.mark.parametrize(
    ("tool", "rule"),
    [("pylint", "--rcfile=x"), ("pylint", "a b"), ("cpplint", "runtime/int"), ("no-tool", "a"), ("pylint", "no-such")],
)
def test_no_words(tool: str, rule: str) -> None:
    assert own_words(tool, rule) == ""


# -- rules -------------------------------------------------------------------------------------------------------


RULE = Rule("runtime/printf", "A variable format string.", aliases=("haros_printf",), tags=("google-cpp",))


@pytest.mark.parametrize(
    "pattern", [None, "", "printf", "PRINTF", "cpplint:runtime/*", "*printf", "google-cpp", "format", "haros_p"]
)
def test_fits(pattern: str | None) -> None:
    assert fits(pattern, "cpplint", RULE)


@pytest.mark.parametrize(
    "pattern", ["sprintf", "printf*x", "google", "pylint", "*:printf", "runtime/*f_", "[", "format  string"]
)
def test_does_not_fit(pattern: str) -> None:
    assert not fits(pattern, "cpplint", RULE)


def test_rules_have_a_head_and_columns(capfd: pytest.CaptureFixture[str]) -> None:
    code, out, _ = said(capfd, "rules", "undeclared-", "--tool", "haros-ci")
    lines = out.splitlines()
    assert code == 0 and lines[0].split() == ["on", "level", "rule", "what", "it", "finds"]
    assert all(line[lines[0].index("rule") :].startswith("haros-ci:undeclared-") for line in lines[1:-2])
    assert re.fullmatch(r"\d+ rules, \d+ of them on in the profile ros", lines[-1])


def test_rules_as_json_are_filtered(capfd: pytest.CaptureFixture[str]) -> None:
    _, out, _ = said(capfd, "rules", "--tool", "cpplint", "--profile", "ros", "--enabled", "--json")
    rows: list[dict[str, Any]] = json.loads(out)
    assert rows and all(row["id"].startswith("cpplint:") and row["enabled"] for row in rows)


def test_no_rule_fits(capfd: pytest.CaptureFixture[str]) -> None:
    assert said(capfd, "rules", "nosuch")[:2] == (0, "0 rules, 0 of them on in the profile ros\n")


@pytest.mark.parametrize("arguments", [("--tool", "nosuch"), ("--profile", "nosuch")])
def test_rules_of_nothing_known(arguments: tuple[str, ...], capfd: pytest.CaptureFixture[str]) -> None:
    assert said(capfd, "rules", *arguments)[0] == 2


# -- the worst values --------------------------------------------------------------------------------------------

LIMITS = (
    Limit("max-10", "function", "cyclomatic-complexity", 10),
    Limit("max-15", "function", "cyclomatic-complexity", 15),
    Limit("max-400", "file", "file-length", 400),
    Limit("min-20", "file", "comment-ratio", 0.2, is_lowest=True),
)


def function(name: str, value: float, metric: str = "cyclomatic-complexity") -> Measurement:
    return Measurement("p", "src/a.cpp", 3, "", name, metric, value)


def test_the_worst_comes_first_and_once() -> None:
    values = [function("f", 12), function("g", 40), Measurement("p", "src/a.cpp", 0, "", "", "file-length", 1000)]
    values.append(function("g", 900, "file-length"))  # no limit on this level
    assert [(value.function, limit.rule) for value, limit in worst(values, LIMITS, 10)] == [
        ("g", "max-10"),
        ("", "max-400"),
        ("f", "max-10"),
    ]
    assert len(worst(values, LIMITS, 2)) == 2


@pytest.mark.parametrize(
    "value",
    [
        function("f", 10),
        function("f", 0),
        function("f", 99, "no-such-metric"),
        Measurement("p", "src/a.cpp", 0, "", "", "comment-ratio", 0.0),
        Measurement("p", "src/a.cpp", 0, "", "", "file-length", 400),
    ],
)
def test_what_is_not_among_the_worst(value: Measurement) -> None:
    assert worst([value], LIMITS, 10) == []
    assert table([value], LIMITS, 10) == "Nothing is over a limit.\n\n"


def test_the_table() -> None:
    assert table([function("f", 40)], LIMITS, 10) == (
        "The worst 1, by value divided by limit:\n"
        "  value  limit  metric                 of        what  where\n"
        "  40     10     cyclomatic-complexity  function  f     src/a.cpp:3\n"
        "\n"
    )


# -- versions ----------------------------------------------------------------------------------------------------


def test_versions_name_the_tools_that_decide(capfd: pytest.CaptureFixture[str]) -> None:
    code, out, _ = said(capfd, "--version")
    first, second = out.splitlines()
    assert code == 0 and first.startswith("haros-ci, version ")
    assert second.startswith("with astroid ") and second.count(" Python 3.") == 1
    assert [name for name, _ in tool_versions()] == ["astroid", "cppcheck", "cpplint", "lizard", "pylint", "radon"]
