# SPDX-License-Identifier: Apache-2.0
"""Turns of a loop that are gone through one by one: what is rehearsed in them, and the bounds that reasons name."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends, names, python

from haros_ci.follow.loops import LONG, TOO_LONG, TOO_MANY, TOO_MANY_ITEMS, TURNS
from haros_ci.model.architecture import Node

#: A function that is given away and does not end: it takes hundreds of steps for a turn of its own.
ENDLESS = "struct W { bool running_ = true; int n_ = 0; void watch() { while (running_ == true) { %s } } };\n" % (
    "n_ = get(n_); " * 150
)
TEXTS = 'std::vector<std::string> t{"a", "b", "c"}; '
LOOP = TEXTS + "for (size_t i = 0; i < t.size(); ++i) { %s ADV(t[i], 1); }"
HEAVY = "int k = 0; " + "k = get(k); " * (LONG + 50)


def why(found: Node) -> list[str]:
    return [unknown.reason for end in ends(found) for unknown in end.unknowns if unknown.field == "name"]


@pytest.mark.parametrize(
    "code",
    ["boost::asio::post(pool, [&]() { w.watch(); });", "run([&w]() { w.watch(); });", ""],
    ids=["posted", "given to a function that is not known", "nothing"],
)
def test_what_is_rehearsed_in_a_loop_takes_nothing_of_its_turns(code: str) -> None:
    found = cpp(LOOP % f"W w; {code}", ENDLESS)
    assert names(found) == ["/a", "/b", "/c"]


def test_steps_of_a_loop_are_bounded() -> None:
    found = cpp(LOOP.replace("t[i]", '"t" + std::to_string(i)') % HEAVY)
    assert "/t0" in names(found) and why(found) == [TOO_LONG]


def test_an_element_at_is_not_known_for_the_same_reason() -> None:
    assert why(cpp(LOOP.replace("t[i]", "t.at(i)") % HEAVY)) == [TOO_LONG]


def test_turns_are_bounded() -> None:
    found = cpp(f'for (int i = 0; i < {TURNS + 9}; ++i) ADV("t" + std::to_string(i), 1);')
    assert len(names(found)) == TURNS + 1 and why(found) == [TOO_MANY]


def test_elements_are_bounded() -> None:
    found = python(f"for t in {[f't{i}' for i in range(TURNS * 4 + 1)]}:\n    PUB(t)")
    assert names(found) == ["/?"] and why(found) == [TOO_MANY_ITEMS]


@pytest.mark.parametrize("test", ["true", "get()"])
def test_what_has_no_bound_names_none(test: str) -> None:
    reasons = why(cpp(f'int k = 0; while ({test}) {{ k++; ADV("t" + std::to_string(k), 1); }}'))
    assert reasons and not any(reason.startswith("the bound of") for reason in reasons)
