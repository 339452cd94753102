# SPDX-License-Identifier: Apache-2.0
"""Which cases are one test in processes of pytest-xdist: those that get nothing of their own; and none fails or is skipped unseen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, strategies
from together import are_chosen, together

Collect = Callable[[Callable[..., None]], list[pytest.Function]]
NUMBERS = pytest.mark.parametrize("number", [1, 2, 3])


@pytest.fixture
def collected(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Collect:
    """What is made of a function that stands in this module."""
    module: Any = request.node.getparent(pytest.Module)

    def collect(function: Callable[..., None]) -> list[pytest.Function]:
        monkeypatch.setattr(module.obj, function.__name__, function, raising=False)
        return together(list(module._genfunctions(function.__name__, function)))

    return collect


@pytest.fixture(scope="module")
def shared() -> list[int]:
    return [1, 2, 3]


@pytest.fixture(params=["a", "b"], scope="module")
def letter(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def of_temporary(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("shared")


@NUMBERS
def numbers(number: int) -> None:
    assert number < 2


@NUMBERS
def with_shared(number: int, shared: list[int]) -> None:
    assert number in shared


@pytest.mark.parametrize(("one", "two"), [(1, "a"), (2, "b")], ids=["x", "y"])
@NUMBERS
def stacked(one: int, two: str, number: int) -> None:
    assert two != "b"


@pytest.mark.parametrize("one, two", [(1, 2), (3, 4)])
def named_in_a_text(one: int, two: int) -> None:
    pytest.fail("never") if one == 3 else None


@NUMBERS
def skips(number: int) -> None:
    if number == 2:
        pytest.skip("not here")


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (numbers, ["2 of 3 fail", "2: AssertionError: assert 2 < 2", "3: AssertionError: assert 3 < 2"]),
        (stacked, ["3 of 6 fail", *(f"{n}-y: AssertionError: assert 'b' != 'b'" for n in (1, 2, 3))]),
        (named_in_a_text, ["1 of 2 fail", "3-4: Failed: never"]),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_they_are_one_test_that_names_what_fails(
    function: Callable[..., None], said: list[str], collected: Collect
) -> None:
    [item] = collected(function)
    assert item.name == function.__name__
    with pytest.raises(AssertionError) as caught:
        item.obj()
    assert [line for line in str(caught.value).splitlines() if line in said] == said


def test_what_they_share_is_given_once(collected: Collect) -> None:
    [item] = collected(with_shared)
    assert item.fixturenames == ["shared"]
    item.obj(shared=[1, 2, 3])
    with pytest.raises(AssertionError, match="1 of 3 fail\n3: "):
        item.obj(shared=[1, 2])


def test_a_fixture_may_ask_for_what_it_is_made_for(collected: Collect) -> None:
    @NUMBERS
    def test_a(number: int, of_temporary: Path) -> None: ...

    @NUMBERS
    def test_b(number: int, request: pytest.FixtureRequest) -> None: ...

    assert [len(collected(function)) for function in (test_a, test_b)] == [1, 3]


def test_a_case_that_is_skipped_is_said_and_the_others_are_run(collected: Collect) -> None:
    [item] = collected(skips)
    with pytest.raises(pytest.skip.Exception, match="1 of 3; 2: not here"):
        item.obj()


# -- what stays as it is -------------------------------------------------------------------------------------------


def test_alone(collected: Collect) -> None:
    def test_none() -> None: ...

    @pytest.mark.parametrize("number", [1])
    def test_one(number: int) -> None: ...

    assert [[item.name for item in collected(function)] for function in (test_none, test_one)] == [
        ["test_none"],
        ["test_one[1]"],
    ]


def test_a_directory_for_each(collected: Collect) -> None:
    @NUMBERS
    def test_a(number: int, tmp_path: Path) -> None: ...

    assert len(collected(test_a)) == 3


def test_a_fixture_of_the_function_for_each(collected: Collect) -> None:
    @NUMBERS
    def test_a(number: int, collected: Collect) -> None: ...

    assert len(collected(test_a)) == 3


def test_a_fixture_with_values(collected: Collect) -> None:
    @NUMBERS
    def test_a(number: int, letter: str) -> None: ...

    assert len(collected(test_a)) == 6


def test_values_for_a_fixture(collected: Collect) -> None:
    @pytest.mark.parametrize("shared", [1, 2], indirect=True)
    def test_a(shared: int) -> None: ...

    assert len(collected(test_a)) == 2


def test_marks(collected: Collect) -> None:
    @NUMBERS
    @pytest.mark.xfail(reason="known")
    def test_a(number: int) -> None: ...

    @pytest.mark.parametrize("number", [1, pytest.param(2, marks=pytest.mark.skip(reason="no"))])
    def test_b(number: int) -> None: ...

    assert [len(collected(function)) for function in (test_a, test_b)] == [3, 2]


def test_random_examples(collected: Collect) -> None:
    @NUMBERS
    @given(other=strategies.integers())
    def test_a(other: int, number: int) -> None: ...

    assert len(collected(test_a)) == 3


@pytest.mark.parametrize(
    ("keyword", "arguments", "chosen"),
    [
        ("", [], False),
        ("", ["tests/test_a.py", "tests/test_a.py::test_b"], False),
        ("word", [], True),
        ("", ["tests/test_a.py::test_b[1-2]"], True),
    ],
)
def test_names_of_cases(keyword: str, arguments: list[str], chosen: bool) -> None:
    config: Any = SimpleNamespace(option=SimpleNamespace(keyword=keyword), args=arguments)
    assert are_chosen(config) is chosen
