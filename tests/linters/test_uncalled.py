# SPDX-License-Identifier: Apache-2.0
"""Calls that do not fit, in functions that nothing calls."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.pylint_surroundings import is_refuted_around
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

CALL = "    draw(1)  # HERE\n"
FUNCTION = f"def draw(a, b):\n    return a\n\n\ndef replan2(a):\n{CALL}"
METHOD = f"class State:\n    def show(self):\n    {CALL}"


def refuted(root: Path, text: str, more: dict[str, str], rule: str = "no-value-for-parameter") -> bool:
    line = text[: text.index("HERE")].count("\n") + 1
    made = workspace(root, {"a.py": text, **more}, [])
    result = Result(
        "pylint", rule, Level.ERROR, "No value for argument 'b' in function call", Location("a.py", line, 5)
    )
    return is_refuted_around(result, made)


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (FUNCTION, {}),
        (FUNCTION, {"b.py": FUNCTION, "c.py": "replan()\nreplan20()\n"}),
        (METHOD, {}),
        (METHOD.replace("State", "State(object)"), {}),
        (f"async def replan2(a):\n{CALL}", {}),
        (f"def replan2(a):\n    def inner():\n    {CALL}    return inner\n", {}),
    ],
)
def test_nothing_calls_it(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert refuted(tmp_path, text, more)
    assert refuted(tmp_path, text, more, "too-many-function-args")


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (CALL.lstrip(), {}),
        (FUNCTION + "\n\nreplan2(1)\n", {}),
        (FUNCTION + "\n\n# replan2(1)\n", {}),
        (FUNCTION, {"b.py": "from a import replan2\n"}),
        (FUNCTION, {"b.launch": '<launch><param name="f" value="replan2"/></launch>\n'}),
        (FUNCTION + "\n\ngetattr(module, 're' + name)()\n", {}),
        (FUNCTION.replace("def replan2", "@route\ndef replan2"), {}),
        (FUNCTION.replace("replan2", "main"), {}),
        (FUNCTION.replace("replan2", "test_plan"), {}),
        (FUNCTION.replace("replan2", "on_goal"), {}),
        (FUNCTION.replace("replan2", "goal_callback"), {}),
        (METHOD.replace("State", "State(Base)"), {}),
        (METHOD.replace("State", "State(metaclass=Kind)"), {}),
        (METHOD.replace("class", "@register\nclass"), {}),
        (METHOD.replace("show", "__call__"), {}),
    ],
)
def test_something_may_call_it(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert not refuted(tmp_path, text, more)


@pytest.mark.parametrize("rule", ["undefined-variable", "used-before-assignment", "not-callable"])
def test_other_rules_stand(tmp_path: Path, rule: str) -> None:
    assert not refuted(tmp_path, FUNCTION, {}, rule)
