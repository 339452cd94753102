# SPDX-License-Identifier: Apache-2.0
"""Coding standards as tags: the tables against the tools, selection by them, the generated page, and SARIF."""

from __future__ import annotations

import json
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.config.selection import Selection
from haros_ci.config.selector import check_selectors
from haros_ci.config.settings import Policy, Settings
from haros_ci.errors import UserError
from haros_ci.linters import catalogue, cppcheck
from haros_ci.linters.catalogue import standards
from haros_ci.linters.catalogue.cppcheck import weaknesses
from haros_ci.linters.linter import LintOptions
from haros_ci.registry import built_in
from haros_ci.report import sarif
from haros_ci.report.standards_table import render
from haros_ci.results.result import Report, Run, Tool
from haros_ci.results.rule import Rule

PAGE = Path(__file__).parents[2] / "docs" / "standards.md"
CATEGORY = 398  # CWE-398 is a category; SARIF and GitHub want weaknesses


def test_the_cwe_numbers_are_cppchecks_own() -> None:
    program = cppcheck.locate(LintOptions())
    assert program is not None
    listed = subprocess.run([*program.argv, "--errorlist"], capture_output=True, check=True, timeout=60).stdout
    errors = ElementTree.fromstring(listed).iter("error")
    theirs = {e.attrib["id"]: int(e.attrib["cwe"]) for e in errors if int(e.get("cwe", CATEGORY)) != CATEGORY}
    ours = weaknesses()
    assert len(theirs) > 150
    assert {id: number for id, number in ours.items() if id in theirs} == theirs


@pytest.mark.parametrize("table", [standards.CERT_CLANG_TIDY, standards.CERT_CPPCHECK], ids=["clang-tidy", "cppcheck"])
def test_the_tables_are_well_formed(table: tuple[tuple[str, str], ...]) -> None:
    for rules, checks in table:
        assert all(re.fullmatch(r"[a-z]{3}\d\d-(c|cpp)", rule) for rule in rules.split()), rules
        assert all(re.fullmatch(r"[\w.-]+", check) for check in checks.split()), checks
    assert [rules for rules, _ in table] == sorted(rules for rules, _ in table)


def test_cppchecks_part_names_checks_of_ours() -> None:
    assert set(standards.named("cppcheck")) <= set(catalogue.rules_of("cppcheck"))


@pytest.mark.parametrize(
    ("tool", "rule", "tags"),
    [
        ("cppcheck", "nullPointer", {"cwe", "cert", "external/cwe/cwe-476", "external/cert/id/exp34-c"}),
        ("cppcheck", "zerodiv", {"cwe", "cert", "external/cwe/cwe-369", "external/cert/id/int33-c"}),
        ("cppcheck", "misra-c2012-10.4", {"misra", "external/misra/id/rule-10-4"}),
        ("cppcheck", "premium-misra-c++-2023-6.8.2", {"misra", "external/misra/id/rule-6-8-2"}),
        ("cppcheck", "cert-EXP05-C", {"cert", "external/cert/id/exp05-c"}),
        ("clang-tidy", "cert-err34-c", {"cert", "external/cert/id/err34-c"}),
        ("clang-tidy", "bugprone-unchecked-string-to-number-conversion", {"cert", "external/cert/id/err34-c"}),
        ("clang-tidy", "bugprone-signal-handler", {"cert", "external/cert/id/msc54-cpp", "external/cert/id/sig30-c"}),
        ("clang-tidy", "hicpp-use-auto", {"hicpp", "external/hicpp/id/rule-7-1-8"}),
        ("clang-tidy", "modernize-use-auto", {"hicpp", "external/hicpp/id/rule-7-1-8"}),
        (
            "clang-tidy",
            "misc-static-assert",
            {"cert", "hicpp", "external/cert/id/dcl03-c", "external/hicpp/id/rule-7-1-10"},
        ),
    ],
)
def test_tags(tool: str, rule: str, tags: set[str]) -> None:
    assert tags <= set(catalogue.rule(tool, rule).tags)


@pytest.mark.parametrize(
    ("tool", "rule"),
    [
        ("cppcheck", "duplicateBranch"),  # CWE-398
        ("cppcheck", "brandNew"),
        ("cppcheck", "certainly-not"),
        ("clang-tidy", "bugprone-infinite-loop"),
        ("clang-tidy", "certain-err34-c"),
        ("pylint", "unused-import"),
        ("cpplint", "build/include"),
    ],
)
def test_no_tags(tool: str, rule: str) -> None:
    assert not set(standards.STANDARDS) & set(catalogue.rule(tool, rule).tags)


def selection(*select: str) -> Selection:
    settings = Settings(root=Path("/"), profile="architecture", command_line=Policy(select=select))
    known = built_in()
    check_selectors(settings, known.rules_of, known.tools, open_tools=known.open_ended)
    return Selection(settings, known.rules_of, unlisted=known.unlisted)


@pytest.mark.parametrize(
    ("selector", "on", "off"),
    [
        (
            "cert",
            ["cppcheck:nullPointer", "clang-tidy:cert-err34-c", "clang-tidy:bugprone-signal-handler"],
            ["cppcheck:memleak"],
        ),
        ("cwe", ["cppcheck:nullPointer", "cppcheck:memleak"], ["cppcheck:uninitMemberVar", "pylint:unused-import"]),
        ("hicpp", ["clang-tidy:hicpp-use-auto", "clang-tidy:modernize-use-auto"], ["clang-tidy:cert-err34-c"]),
        (
            "external/cwe/cwe-476",
            ["cppcheck:nullPointer", "cppcheck:ctunullpointer"],
            ["cppcheck:memleak", "cppcheck:zerodiv"],
        ),
        (
            "external/cert/id/exp34-c",
            ["cppcheck:nullPointer", "clang-tidy:clang-analyzer-core.NullDereference"],
            ["cppcheck:zerodiv"],
        ),
    ],
)
def test_selection(selector: str, on: list[str], off: list[str]) -> None:
    chosen = selection(selector)
    for name in (*on, *off):
        tool, _, rule = name.partition(":")
        assert chosen.wants(tool, rule, "a.cpp") == (name in on), name


@pytest.mark.parametrize("selector", ["external/cwe/cwe-9999", "external/cert/id/exp99-c", "external/cwe/cwe-47"])
def test_a_rule_that_no_check_is_for_is_a_mistake(selector: str) -> None:
    with pytest.raises(UserError, match="unknown rule or tag"):
        selection(selector)


def test_the_page_is_the_table() -> None:
    assert PAGE.read_text(encoding="utf-8") == render(built_in().documented_rules())


def test_a_table() -> None:
    rules = [
        ("b", Rule("x", "", tags=("cert", "external/cert/id/exp10-c", "external/cert/id/exp9-c"))),
        ("a", Rule("y", "", tags=("external/cert/id/exp10-c", "style"))),
    ]
    (section,) = render(rules).split("\n## ")[1:]
    assert section == (
        "SEI CERT\n\n| tag | checks |\n|---|---|\n"
        "| `external/cert/id/exp9-c` | `b:x` |\n| `external/cert/id/exp10-c` | `a:y`, `b:x` |\n"
    )


def test_sarif_has_them_first() -> None:
    rule = catalogue.rule("cppcheck", "nullPointer")
    rule = replace(rule, tags=(*(f"t{n}" for n in range(10)), *rule.tags))
    log = json.loads(sarif.render(Report(runs=(Run(Tool("cppcheck"), rules=(rule,)),))))
    (run,) = log["runs"]
    (written,) = run["tool"]["driver"]["rules"]
    assert written["properties"]["tags"][:2] == ["external/cwe/cwe-476", "external/cert/id/exp34-c"]
    assert written["relationships"][0]["target"]["id"] == "CWE-476"
    assert [taxon["id"] for taxon in run["taxonomies"][0]["taxa"]] == ["CWE-476"]
