# SPDX-License-Identifier: Apache-2.0
"""What pylint says of calls into modules of which there are several of one name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.pylint_surroundings import is_refuted_around
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

MAIN = "from plans import Plan\n\nplan = Plan(1, 2)\nplan.update()\n"
HERE = "class Plan:\n    def __init__(self, log, start):\n        pass\n\n    def update(self):\n        pass\n"
OTHER = HERE.replace("start)", "start, k)").replace("update(self)", "update(self, k)")
MISSING = "No value for argument 'k' in constructor call"


def refuted(root: Path, rule: str, message: str, line: int, files: dict[str, str]) -> bool:
    made = replace(workspace(root, files), names=frozenset(files))
    return is_refuted_around(
        Result("pylint", rule, Level.ERROR, message, Location("a/main.py", line, 8 if line == 3 else 1)), made
    )


FIRES = [
    ("no-value-for-parameter", MISSING, 3, {}),
    ("no-value-for-parameter", "No value for argument 'k' in method call", 4, {}),
    ("missing-kwoa", "Missing mandatory keyword argument 'k' in constructor call", 3, {}),
    (
        "no-value-for-parameter",
        MISSING,
        3,
        {"a/main.py": MAIN.replace("from plans import Plan", "import os, plans as p")},
    ),
    (
        "unexpected-keyword-arg",
        "Unexpected keyword argument 'start' in constructor call",
        3,
        {"b/plans.py": OTHER.replace("start", "begin")},
    ),
    ("too-many-function-args", "Too many positional arguments for constructor call", 3, {}),
    ("too-many-function-args", "Too many positional arguments for method call", 4, {}),
]
DOTTED = MAIN.replace("from plans", "from kinds.plans")
FIRES += [
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": DOTTED, "a/kinds/plans.py": HERE, "b/kinds/plans.py": OTHER}),
]
QUIET = [
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": DOTTED, "a/kinds/plans.py": HERE}),
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": DOTTED, "a/kinds/plans.py": OTHER, "b/kinds/plans.py": HERE}),
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": DOTTED, "b/kinds/plans.py": OTHER}),
    ("no-value-for-parameter", MISSING, 3, {"a/plans.py": OTHER}),
    ("no-value-for-parameter", MISSING, 3, {"a/plans.py": OTHER, "b/plans.py": HERE}),
    ("no-value-for-parameter", MISSING, 3, {"b/plans.py": HERE}),
    ("no-value-for-parameter", MISSING, 3, {"b/plans.py": OTHER, "a/main.py": MAIN + "def go(k):\n    pass\n"}),
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": MAIN.replace("from plans", "from b.plans")}),
    ("no-value-for-parameter", MISSING, 3, {"a/main.py": MAIN.replace("plans", "tools")}),
    ("no-value-for-parameter", MISSING, 3, {"a/plans.py": "print 'a'\n"}),
    ("unexpected-keyword-arg", "Unexpected keyword argument 'begin' in constructor call", 3, {}),
    (
        "too-many-function-args",
        "Too many positional arguments for constructor call",
        3,
        {"a/main.py": MAIN + "class Plan:\n    pass\n"},
    ),
    ("too-many-function-args", "Too many positional arguments for constructor call", 1, {}),
    ("no-member", MISSING, 3, {}),
]


@pytest.mark.parametrize(("rule", "message", "line", "files"), FIRES)
def test_the_module_beside_takes_it(rule: str, message: str, line: int, files: dict[str, str], tmp_path: Path) -> None:
    assert refuted(tmp_path, rule, message, line, {"a/main.py": MAIN, "a/plans.py": HERE, "b/plans.py": OTHER, **files})


@pytest.mark.parametrize(("rule", "message", "line", "files"), QUIET)
def test_it_may_be_so(rule: str, message: str, line: int, files: dict[str, str], tmp_path: Path) -> None:
    given = {"a/main.py": MAIN, "a/plans.py": HERE, "b/plans.py": OTHER, **files}
    assert not refuted(tmp_path, rule, message, line, given)
