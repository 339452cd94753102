# SPDX-License-Identifier: Apache-2.0
"""Lists that C++ puts in another order: std::sort, std::reverse and their kin."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp_files, follow

from haros_ci.model.architecture import Node

LIST = 'std::vector<std::string> v{"b", "c", "a"}; '
OBJECTS = (
    "struct P { virtual void make() = 0; };\n"
    'struct A : P { void make() override { ros::NodeHandle n; pub = n.advertise<std_msgs::String>("x", 1); } ros::Publisher pub; };\n'
    "struct S { P* p; int i; };\n"
)
BY_NUMBER = "[](const S& a, const S& b) { return a.i < b.i; }"


def node(body: str, top: str = "") -> Node:
    main = f'int main(int argc, char** argv) {{ ros::init(argc, argv, "n"); ros::NodeHandle nh; ros::Publisher p; {body} }}'
    ((found,),) = (each.nodes for each in follow(cpp_files(f"{CPP_HEAD}{top}{main}")).configurations)
    return found


def names(body: str, top: str = "") -> list[str]:
    return [end.name for end in node(body, top).endpoints if end.kind == "publishers" and not end.implicit]


def advertise(name: str) -> str:
    return f" p = nh.advertise<std_msgs::String>({name}, 1);"


@pytest.mark.parametrize(
    ("arrange", "first"),
    [
        ("std::sort(v.begin(), v.end());", "/a"),
        ("std::stable_sort(v.begin(), v.end());", "/a"),
        ("std::sort(std::begin(v), std::end(v));", "/a"),
        ("std::ranges::sort(v);", "/a"),
        ("std::reverse(v.begin(), v.end());", "/a"),
        ("std::reverse(v.begin(), v.end()); std::sort(v.begin(), v.end()); std::reverse(v.begin(), v.end());", "/c"),
        ("auto& w = v[0]; std::sort(v.begin(), v.end()); v[0] = w;", "/a"),
    ],
)
def test_known_orders(arrange: str, first: str) -> None:
    assert names(LIST + arrange + advertise("v[0]")) == [first]
    assert names(LIST + arrange + f" for (const auto& s : v) {{{advertise('s')} }}") == ["/a", "/b", "/c"]


@pytest.mark.parametrize(
    "arrange",
    [
        "std::sort(v.begin(), v.end(), std::greater<std::string>());",
        "std::sort(v.begin(), v.end(), [](const std::string& a, const std::string& b) { return a.size() < b.size(); });",
        "std::sort(v.begin() + 1, v.end());",
        "std::sort(v.begin(), v.end() - 1);",
        "std::random_shuffle(v.begin(), v.end());",
        "std::shuffle(v.begin(), v.end(), generator);",
        "std::rotate(v.begin(), v.begin() + 1, v.end());",
        "std::partial_sort(v.begin(), v.begin() + 1, v.end());",
        "std::nth_element(v.begin(), v.begin() + 1, v.end());",
        "std::ranges::sort(v, compare);",
        "std::next_permutation(v.begin(), v.end());",
    ],
)
def test_orders_that_are_not_known_lose_no_element(arrange: str) -> None:
    assert names(LIST + arrange + f" for (const auto& s : v) {{{advertise('s')} }}") == ["/a", "/b", "/c"]
    assert names(LIST + arrange + advertise("v[0]")) == ["/?"]


@pytest.mark.parametrize(
    "change",
    [
        "v.erase(std::unique(v.begin(), v.end()), v.end());",
        "std::fill(v.begin(), v.end(), word());",
        "std::fill(std::begin(v), std::end(v), word());",
        "std::generate(v.begin(), v.end(), word);",
        "std::iota(v.begin(), v.end(), word());",
        "std::transform(v.begin(), v.end(), v.begin(), other);",
        "other::sort(v.begin(), v.end());",
        "std::sort(v.begin(), v.end(), compare); v.push_back(word());",
        "std::sort(v.begin(), v.end(), compare); v.insert(v.begin(), word());",
    ],
)
def test_other_changes_make_elements_unknown(change: str) -> None:
    assert "/?" in names(LIST + change + f" for (const auto& s : v) {{{advertise('s')} }}")


def test_an_unknown_element_stays_one() -> None:
    made = names('std::vector<std::string> v{"b", word()}; std::sort(v.begin(), v.end());' + advertise("v[0]"))
    assert made == ["/?"]


@pytest.mark.parametrize(
    ("fill", "expected"),
    [
        ("v.push_back(S{new A, 1}); v.push_back(S{new A, 2});", []),
        ("if (word()) v.push_back(S{new A, 1});", ["what it is made for is an element of the list on some paths only"]),
    ],
)  # fmt: skip
def test_objects_in_lists_that_are_sorted(fill: str, expected: list[str]) -> None:
    body = f"std::vector<S> v; {fill} std::sort(v.begin(), v.end(), {BY_NUMBER}); for (const auto& s : v) s.p->make();"
    (end,) = (end for end in node(body, OBJECTS).endpoints if end.kind == "publishers" and not end.implicit)
    assert (end.name, [unknown.reason for unknown in end.unknowns]) == ("/x", expected)
