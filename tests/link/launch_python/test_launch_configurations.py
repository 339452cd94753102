# SPDX-License-Identifier: Apache-2.0
"""What goes through all launch configurations of a context: those that are set, unless there may be others."""

from __future__ import annotations

import pytest
from launch_python_kit import Context, actions, brief, unknowns

SETUP = """
def over(given, all_of_them):
    for key, value in all_of_them.items():
        if key in given and value != '':
            given[key] = value
    return given

def setup(context, *args, **kwargs):
    {}
    return [Node(package='p', executable='e', name={})]
"""
OVER = "over({'name': 'own', 'mode': 'one'}, context.launch_configurations)['name']"


def name_of(expression: str, context: Context, before: str = "pass") -> tuple[object, list[str]]:
    (opaque,) = actions(
        "ld.add_action(OpaqueFunction(function=setup))", SETUP.replace("{}", before, 1).replace("{}", expression)
    )
    assert opaque.function is not None
    phrase = opaque.function(context)[0].get("name") or ()
    return brief(phrase), unknowns(phrase)


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (OVER, "given"),
        ("'_'.join(context.launch_configurations.keys())", "name_mode_empty"),
        ("'_'.join(context.launch_configurations.values())", "given_two_"),
        ("context.launch_configurations.copy()['mode']", "two"),
        ("'_'.join(k for k, v in context.launch_configurations.items() if v)", "name_mode"),
        ("[v for k, v in context.launch_configurations.items() if k == 'mode'][0]", "two"),
    ],
)
def test_those_that_are_set(expression: str, expected: str) -> None:
    assert name_of(expression, Context(name="given", mode="two", empty="")) == (expected, [])


@pytest.mark.parametrize(
    ("context", "expected"),
    [(Context(), "own"), (Context(name=""), "own"), (Context(other="x"), "own"), (Context(name="a"), "a")],
)
def test_what_is_not_given_stays(context: Context, expected: str) -> None:
    assert name_of(OVER, context) == (expected, [])


def test_what_the_function_sets_is_among_them() -> None:
    before = "context.launch_configurations['name'] = 'set'"
    assert name_of(OVER, Context(name="a"), before) == ("set", [])


@pytest.mark.parametrize("before", ["context.launch_configurations.update(elsewhere())", "elsewhere(context)"])
def test_nothing_is_known_where_there_may_be_others(before: str) -> None:
    assert name_of(OVER, Context(name="a"), "from elsewhere import elsewhere; " + before)[1]


def test_a_copy_is_no_way_to_set_one() -> None:
    before = "context.launch_configurations.copy()['name'] = 'set'"
    assert name_of("context.launch_configurations['name']", Context(name="a"), before) == ("a", [])
