# SPDX-License-Identifier: Apache-2.0
"""What every row of the rule tables keeps to, and which rules the profiles hold."""

from __future__ import annotations

import re

import pytest

from haros_ci.config.settings import PROFILES
from haros_ci.linters import metrics
from haros_ci.linters.catalogue import SAME_DEFECT, TOOLS, WEIGHING, rule, rules_of
from haros_ci.linters.catalogue.clang_tidy_texts import TEXTS as TIDY
from haros_ci.linters.catalogue.reasons import TEXTS as REASONS
from haros_ci.linters.catalogue.standards import STANDARDS
from haros_ci.linters.installed import HOW
from haros_ci.linters.linter import When
from haros_ci.registry import LINTERS, check_rules
from haros_ci.results import own
from haros_ci.results.rule import Level


def test_how_to_get_every_tool_that_does_not_come_with_haros_ci() -> None:
    assert {*HOW} == {linter.NAME for linter in LINTERS if linter.WHEN is not When.ALWAYS}


INVENTED = [
    ("cpplint", "whitespace/brand_new"),
    ("cppcheck", "brandNew"),
    ("pylint", "brand-new"),
    ("ruff", "XYZ123"),
    ("ruff", "F501"),
    ("clang-tidy", "bugprone-brand-new"),
    ("clang-tidy", "odd"),
    ("clang-tidy", "clang-analyzer-core.NullDereference"),
    ("catkin_lint", "brand_new"),
    ("metrics", "brand-new"),
    ("cmake-lint", "C0999"),
    ("cmakelint", "whitespace/new"),
    ("flawfinder", "FF1999"),
    ("hadolint", "DL3999"),
    ("hadolint", "SC2086"),
    ("shellcheck", "SC2001"),
    ("shellcheck", "SC1999"),
    ("xmllint", "encoding-error"),
    ("yamllint", "brand-new"),
    ("bandit", "B999"),
    ("black", "brand-new"),
    ("codespell", "brand-new"),
    ("flake8", "Q000"),
    ("flake8", "XYZ123"),
    ("isort", "brand-new"),
    ("mypy", "brand-new"),
    ("vulture", "brand-new"),
    ("elsewhere", "brand-new"),
]


def in_profile(tool: str, profile: str) -> set[str]:
    return {r.id for r in rules_of(tool).values() if profile in r.profiles}


@pytest.mark.parametrize("tool", [*TOOLS, "elsewhere"])
def test_every_rule_says_what_a_log_needs(tool: str) -> None:
    for entry in (*rules_of(tool).values(), *(rule(t, i) for t, i in INVENTED if t == tool)):
        name = entry.id
        assert re.fullmatch(r"[\w./+-]+", name)
        assert entry.summary.endswith(".") and entry.summary[0] != " " and len(entry.summary) <= 1024, name
        assert entry.summary in entry.help and "Suppress" in entry.help and "\n" not in entry.summary, name
        assert entry.help_uri is None or entry.help_uri.startswith("https://"), name
        assert entry.precision in ("very-high", "high", "medium", "low"), name
        assert set(entry.profiles) <= set(PROFILES) - {"all"}, name
        standards = [tag for tag in entry.tags if tag in STANDARDS or tag.startswith("external/")]
        assert 1 <= len(set(entry.tags) - set(standards)) <= 10 and len(standards) <= 10, name
        assert len(set(entry.tags)) == len(entry.tags), name
        assert all(re.fullmatch(r"[a-z0-9+_/-]+", tag) for tag in entry.tags), name
        assert len(set(entry.aliases)) == len(entry.aliases), name
        assert all(1 <= number <= 1400 for number in entry.cwe), name


@pytest.mark.parametrize("tool", TOOLS)
def test_security_is_for_security(tool: str) -> None:
    for entry in rules_of(tool).values():
        assert (entry.security_severity is not None) == ("security" in entry.tags), entry.id
        assert entry.security_severity is None or 0.1 <= float(entry.security_severity) <= 10.0, entry.id


@pytest.mark.parametrize("tool", TOOLS)
def test_profiles_grow(tool: str) -> None:
    assert in_profile(tool, "bugs-only") <= in_profile(tool, "ros") <= in_profile(tool, "strict")


#: Who asks for these sees how files are laid out; that fails no run.
LAYOUT = ("black", "clang-format", "isort")


@pytest.mark.parametrize("tool", sorted({*TOOLS} - {*LAYOUT, *WEIGHING, "metrics"}))
def test_what_ros_shows_can_fail_a_run(tool: str) -> None:
    """Where the tool itself does not say how bad a finding is; and a metric is no news until a change crosses its limit."""
    shown = [r for r in rules_of(tool).values() if "ros" in r.profiles]
    assert [r.id for r in shown if not r.level.reaches(Level.WARNING)] == []


NEVER = [
    # hold only with every import or header at hand
    ("pylint", "import-error"),
    ("pylint", "no-name-in-module"),
    ("pylint", "no-member"),
    ("pylint", "c-extension-no-member"),
    ("pylint", "wrong-import-order"),
    ("mypy", "import-not-found"),
    ("mypy", "import-untyped"),
    ("vulture", "unused-function"),
    ("bandit", "B101"),
    ("flake8", "E501"),
    ("cppcheck", "missingInclude"),
    ("cppcheck", "missingIncludeSystem"),
    ("cppcheck", "unusedFunction"),
    ("cppcheck", "ctuOneDefinitionRuleViolation"),
    ("catkin_lint", "unknown_package"),
    ("catkin_lint", "no_catkin_component"),
    # say that the tool gave up
    ("cppcheck", "syntaxError"),
    ("cppcheck", "unknownMacro"),
    ("pylint", "astroid-error"),
    ("clang-tidy", "clang-diagnostic-error"),
    # of newer versions
    ("cppcheck", "brandNew"),
    ("pylint", "brand-new"),
    ("ruff", "XYZ123"),
    ("flake8", "XYZ123"),
    ("mypy", "brand-new"),
    ("elsewhere", "brand-new"),
    # hold only with the files that a script sources
    ("shellcheck", "SC1091"),
    ("shellcheck", "SC2154"),
    # taste
    ("hadolint", "DL3008"),
    ("cmake-lint", "C0103"),
    ("yamllint", "document-start"),
    ("flawfinder", "FF1013"),
]


@pytest.mark.parametrize(("tool", "identifier"), NEVER)
def test_only_in_all(tool: str, identifier: str) -> None:
    assert rule(tool, identifier).profiles == ()


def test_layout_is_only_for_google() -> None:
    for entry in rules_of("cpplint").values():
        assert "google" in entry.profiles
        if entry.id.startswith("whitespace/") or entry.id in ("readability/braces", "build/header_guard"):
            assert entry.profiles == ("google",)


@pytest.mark.parametrize(
    ("tool", "identifier", "profile"),
    [
        ("cppcheck", "doubleFree", "bugs-only"),
        ("cppcheck", "nullPointer", "bugs-only"),
        ("cppcheck", "variableScope", "strict"),
        ("cppcheck", "uninitMemberVar", "strict"),
        ("pylint", "undefined-variable", "bugs-only"),
        ("pylint", "unused-import", "strict"),
        ("pylint", "missing-function-docstring", "strict"),
        ("cpplint", "runtime/operator", "ros"),
        ("cpplint", "runtime/references", "google"),
        ("metrics", "max-cyclomatic-complexity-15", "ros"),
        ("metrics", "max-function-length-40", "strict"),
        ("ruff", "F601", "bugs-only"),
        ("ruff", "E902", "bugs-only"),
        ("clang-tidy", "clang-analyzer-core.NullDereference", "bugs-only"),
        ("catkin_lint", "missing_find", "ros"),
        ("clang-format", "formatting", "ros"),
        ("flawfinder", "FF1001", "ros"),
        ("hadolint", "DL3023", "bugs-only"),
        ("hadolint", "SC1073", "bugs-only"),
        ("shellcheck", "SC2115", "ros"),
        ("shellcheck", "SC2086", "strict"),
        ("xmllint", "parser-error", "bugs-only"),
        ("yamllint", "key-duplicates", "bugs-only"),
        ("yamllint", "line-length", "strict"),
        ("cmakelint", "linelength", "strict"),
        ("bandit", "B602", "ros"),
        ("black", "would-reformat", "ros"),
        ("codespell", "misspelling", "ros"),
        ("flake8", "F821", "bugs-only"),
        ("flake8", "F401", "ros"),
        ("isort", "unsorted-imports", "ros"),
        ("mypy", "arg-type", "ros"),
        ("mypy", "no-untyped-def", "strict"),
        ("vulture", "unused-import", "ros"),
        ("pylint", "dangerous-default-value", "strict"),
    ],
)
def test_in_profile(tool: str, identifier: str, profile: str) -> None:
    assert profile in rule(tool, identifier).profiles


@pytest.mark.parametrize(
    ("tool", "identifier", "level"),
    [
        ("pylint", "undefined-variable", Level.ERROR),
        ("pylint", "fatal", Level.ERROR),
        ("pylint", "unused-import", Level.WARNING),
        ("pylint", "literal-comparison", Level.NOTE),  # a refactor message, which no table raises
        ("pylint", "possibly-used-before-assignment", Level.WARNING),
        ("pylint", "missing-module-docstring", Level.NOTE),
        ("cppcheck", "doubleFree", Level.ERROR),
        ("cppcheck", "nullPointer", Level.WARNING),
        ("cppcheck", "uninitMemberVar", Level.WARNING),
        ("cppcheck", "unreadVariable", Level.NOTE),
        ("cppcheck", "variableScope", Level.NOTE),
        ("cpplint", "whitespace/tab", Level.NOTE),
        ("metrics", "max-eloc-50", Level.NOTE),
        ("metrics", "mi-below-20", Level.NOTE),
        ("shellcheck", "SC2068", Level.ERROR),
        ("shellcheck", "SC1000", Level.ERROR),
        ("shellcheck", "SC2001", Level.NOTE),
        ("hadolint", "SC2164", Level.WARNING),
        ("hadolint", "DL3009", Level.NOTE),
        ("flawfinder", "FF1048", Level.NOTE),
        ("bandit", "B602", Level.ERROR),
        ("bandit", "B506", Level.WARNING),
        ("bandit", "B101", Level.NOTE),
        ("flake8", "E999", Level.ERROR),
        ("flake8", "F401", Level.WARNING),
        ("flake8", "E501", Level.NOTE),
        ("mypy", "call-arg", Level.ERROR),
        ("mypy", "assignment", Level.WARNING),
    ],
)
def test_levels(tool: str, identifier: str, level: Level) -> None:
    assert rule(tool, identifier).level is level


def test_ids_keep_the_case_that_was_asked_for() -> None:
    upper, lower = rule("catkin_lint", "MISSING_DEPEND"), rule("catkin_lint", "missing_depend")
    assert (upper.id, upper.summary) == ("MISSING_DEPEND", lower.summary)
    assert rule("pylint", "FATAL").profiles == ()


def test_every_metric_has_a_rule() -> None:
    thresholds = {t.rule for t in (*metrics.FUNCTION_THRESHOLDS, *metrics.FILE_THRESHOLDS)} | set(
        metrics.STRUCTURE_RULES
    )
    assert thresholds == set(rules_of("metrics"))
    assert metrics.WORSE_BANDS.keys() | {w for worse in metrics.WORSE_BANDS.values() for w in worse} <= thresholds


def test_unknown_tools_have_no_table() -> None:
    assert rules_of("elsewhere") == {}


def test_the_same_defect_names_known_rules() -> None:
    for rules in SAME_DEFECT:
        assert len(set(rules)) == len(rules) > 1
        for name in rules:
            tool, _, identifier = name.partition(":")
            known = {**own.RULES, **check_rules()} if tool == "haros-ci" else rules_of(tool)
            assert tool in ("ruff", "clang-tidy") or identifier in known, name


@pytest.mark.parametrize(
    ("identifier", "weakness"), [("B602", 78), ("B506", 20), ("B108", 377), ("B608", 89), ("B501", 295), ("B301", 502)]
)
def test_bandit_s_weaknesses(identifier: str, weakness: int) -> None:
    assert rule("bandit", identifier).cwe == (weakness,)


@pytest.mark.parametrize("tool", ["clang-tidy", "cppcheck", "cpplint", "flake8", "pylint"])
def test_what_profiles_turn_on_has_a_text_of_its_own(tool: str) -> None:
    for name in in_profile(tool, "strict"):
        entry = rule(tool, name)
        assert not entry.summary.startswith("Finding of "), name
        assert entry.help.count("\n\n") == 2, f"{name}: what, why and how to mend, how to silence"


def test_reasons_are_for_rules_once_and_fit_a_screen() -> None:
    named = [name for names in REASONS for name in names]
    assert len(named) == len(set(named))
    for text in (*REASONS.values(), *(advice for _, advice in TIDY.values())):
        assert 20 < len(text) < 320 and text[-1] in ".)", text
