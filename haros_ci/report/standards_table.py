# SPDX-License-Identifier: Apache-2.0
"""Which rules of which tools check what coding standards demand, as docs/standards.md has it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from haros_ci.results.rule import Rule

HEAD = """# Coding standards

Written by `haros-ci rules --standards`. Where a tool says which rule of a standard, or which weakness, one of its checks is about, that
check has the tags below. They select and ignore as any tag does:

    haros-ci check --select cert
    haros-ci check --select external/cwe/cwe-476

| tag | names |
|---|---|
| `cert`, `cwe`, `hicpp`, `misra` | every check that has something to do with the standard |
| `external/cert/id/exp34-c` | the checks for one rule of SEI CERT C or C++ |
| `external/cwe/cwe-476` | the checks for one weakness; GitHub code scanning shows these |
| `external/hicpp/id/rule-6-1-1` | the checks for one rule of High Integrity C++ 4.0 |
| `external/misra/id/rule-10-4` | the findings of Cppcheck's MISRA add-on, in imported logs: the add-on itself is not run |

The forms with `external/` are those of CodeQL's queries. In a SARIF log they stand before a rule's other tags, as GitHub shows no more
than ten; CWE numbers are in its taxonomy as well. HAROS's own tags, such as `misra-cpp` and `hicpp`, mean what HAROS says of its rules.

A tag says that the check finds *some* breaches. No set of checks shows that code conforms to a standard.

Where the mappings come from: CWE numbers are each tool's own (`cppcheck --errorlist`, for one; CWE-398, which is a category, is left
out). CERT and High Integrity C++ are the aliases in clang-tidy's modules `cert` and `hicpp` and the rules that its documentation names,
and Statick's `plugin_mapping` files, of which four ids were corrected (`DCP54-CPP` and `DCP59-CPP` are `DCL54-CPP` and `DCL59-CPP`;
`MEM32-C` is no rule any more; `-Wchar-subscripts` is about STR34-C) and the alpha checks of the analyser left out. clang-tidy's checks
run where it is installed and a compile database exists; those of the modules `cert`, `hicpp`, `cppcoreguidelines`, `misc`, `modernize` and
`readability` only under `--trust-config`, with the workspace's own `.clang-tidy`.
"""
TITLES = {"cert": "SEI CERT", "cwe": "Common Weakness Enumeration", "hicpp": "High Integrity C++", "misra": "MISRA"}


def render(rules: Iterable[tuple[str, Rule]]) -> str:
    """Markdown: for each standard a row for each of its rules, with the checks (pairs of tool and rule) for it."""
    found: dict[str, dict[str, list[str]]] = {}
    for tool, rule in rules:
        for tag in rule.tags:
            if tag.startswith("external/"):
                found.setdefault(tag.split("/")[1], {}).setdefault(tag, []).append(f"{tool}:{rule.id}")
    return HEAD + "".join(_section(standard, found[standard]) for standard in sorted(found))


def _section(standard: str, checks: Mapping[str, list[str]]) -> str:
    rows = (
        f"| `{tag}` | {', '.join(f'`{name}`' for name in sorted(checks[tag]))} |\n"
        for tag in sorted(checks, key=_order)
    )
    return f"\n## {TITLES.get(standard, standard)}\n\n| tag | checks |\n|---|---|\n{''.join(rows)}"


def _order(tag: str) -> list[tuple[str, int]]:
    """``rule-7-1-10`` after ``rule-7-1-8``."""
    return [(word, int(number or 0)) for word, number in re.findall(r"(\D+)(\d*)", tag)]
