# SPDX-License-Identifier: Apache-2.0
"""Negative indices that the code before them rules out."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_indices import is_multiple, is_searched

UNSET = "Assignment 'best=-1', assigned value is -1"


def found(text: str, said: str = UNSET) -> bool:
    line = next(number for number, line in enumerate(text.split("\n"), 1) if "best" in line)
    return is_searched([("a.cpp", 1, "Array index -1 is out of bounds"), ("a.cpp", line, said)], {"a.cpp": text}.get)  # type: ignore[arg-type]


def search(start: str, condition: str, then: str = "{ least = cost(i); best = i; }") -> str:
    return (
        f"int best = -1;\n{start}\nfor (int i = 0; i < n; i++) {{\n  if ({condition}) {then}\n}}\nuse(edges[best]);\n"
    )


@pytest.mark.parametrize(
    "text",
    [
        search("double least = std::numeric_limits<double>::max();", "cost(i) < least"),
        search("double least = numeric_limits<double>::infinity();", "least > cost(i)"),
        search("double least(DBL_MAX);", "cost[i] < least"),
        search("float least = 1e10;", "cost(i) <= least"),
        search("double least{99999.0};", "cost(i) < least"),
        search("double least = -std::numeric_limits<double>::max();", "cost(i) > least"),
        search("double least = std::numeric_limits<double>::lowest();", "cost(i) > least"),
        search("int least = INT_MIN;", "least < cost(i)"),
        "double least = DBL_MAX;\nint best = -1;\nfor (auto& one : all)\n{\n  double now = one.cost();\n  if (now < least)\n  {\n    least = now;\n"
        "    best = i;\n  }\n}\nuse(all[best]);\n",
        search("double least = DBL_MAX;", "least > cost(i)", "{\n    best = i;\n    least = cost(i);\n  }"),
    ],
)
def test_a_search_that_finds_something(text: str) -> None:
    assert found(text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (search("double least = -1;", "cost(i) > least"), UNSET),
        (search("double least = 0;", "cost(i) > least"), UNSET),
        (search("double least = 5.0;", "cost(i) < least"), UNSET),
        (search("double least = std::numeric_limits<double>::min();", "cost(i) > least"), UNSET),
        (search("double least = DBL_MIN;", "cost(i) > least"), UNSET),
        (search("double least = DBL_MAX;", "cost(i) > least"), UNSET),  # the wrong way round: never found
        (search("double least = DBL_MAX;", "cost(i) < limit"), UNSET),
        (search("double least = DBL_MAX;", "cost(i) < least", "{ least = cost(i); other = i; }"), UNSET),
        (search("double least = DBL_MAX;", "cost(i) < least", "{ best = i; }"), UNSET),
        (search("double least = DBL_MAX;", "cost(i) < least && ok(i)"), UNSET),
        (search("double least = DBL_MAX;", "ok(i) && cost(i) < least"), UNSET),
        (search("double least = DBL_MAX;", "cost(i) < least"), "Assuming condition is false"),
        (search("double least = DBL_MAX;", "cost(i) < least"), "Assignment 'best=-2', assigned value is -2"),
        ("int best = -1;\ndouble least = DBL_MAX;\nif (cost(0) < least) { least = cost(0); best = 0; }\n", UNSET),
        ("int best = -1;\nuse(edges[best]);\n", UNSET),
        ("int best = find(edges);\nuse(edges[best]);\n", UNSET),
    ],
)
def test_a_search_that_may_find_nothing(text: str, said: str) -> None:
    assert not found(text, said)


def of(condition: str, before: str = "int full = size / 34;") -> tuple[int, str]:
    text = f"if ({condition}) {{\n  {before}\n  use(data[(full - 1) * 34]);\n}}\n"
    return text[: text.index("use(")].count("\n") + 1, text


@pytest.mark.parametrize(
    "condition",
    ["size > 0 && size % 34 == 0", "size % 34 == 0 && size > 0", "size >= 1 && (size % 34 == 0)", "size != 0 && size % 34 == 0 && on", "size > 0 && ((size % 34)==0)"],
)  # fmt: skip
def test_a_positive_multiple(condition: str) -> None:
    assert is_multiple(*of(condition))


@pytest.mark.parametrize(
    ("condition", "before"),
    [
        ("size > 0", "int full = size / 34;"),
        ("size % 34 == 0", "int full = size / 34;"),
        ("size > 0 && other % 34 == 0", "int full = size / 34;"),
        ("size > 0 && size % 34 != 0", "int full = size / 34;"),
        ("size > 0 && size % 34 == 0", "int full = size / 68;"),
        ("size > 0 && size % 34 == 0", "int full = other / 34;"),
        ("size > 0 && size % 34 == 0", "}\n{\n  int full = size / 34;"),
        ("size >= 0 && size % 34 == 0", "int full = size / 34;"),
        ("size > 0 // && size % 34 == 0", "int full = size / 34;"),
    ],
)
def test_no_positive_multiple(condition: str, before: str) -> None:
    assert not is_multiple(*of(condition, before))
