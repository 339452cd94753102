# SPDX-License-Identifier: Apache-2.0
"""C++: what the list of a constructor gives members under ``#if`` has that condition."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp_files, ends, follow, node

CODE = (
    CPP_HEAD
    + """
class A {{ public: A(ros::NodeHandle& h) : a(h.advertise<std_msgs::String>("a", 1)),
{}
  c(h.advertise<std_msgs::String>("c", 1)) {{}}
 ros::Publisher a, b, c; }};
int main(int argc, char** argv) {{ ros::init(argc, argv, "n"); ros::NodeHandle nh; A x(nh); }}
"""
)
INIT = '  b(h.advertise<std_msgs::String>("b", 1)),'


def made(inits: str, cmake: str = "") -> list[tuple[str, list[str], bool]]:
    files = cpp_files(CODE.format(inits))
    files["p/CMakeLists.txt"] += cmake
    return [(e.name, [c.condition for c in e.conditions], e.is_ruled_out) for e in ends(node(follow(files)))]


FIRST, LAST = ("/a", [], False), ("/c", [], False)


@pytest.mark.parametrize("condition", ["#ifdef S", "#if defined(S)", "#ifndef S", "#if S > 2"])
def test_the_condition_is_there(condition: str) -> None:
    found = made(f"{condition}\n{INIT}\n#endif")
    assert found == [FIRST, ("/b", [condition], False), LAST]


def test_an_option_of_the_build_leaves_it_open() -> None:
    option = 'option(S "x" OFF)\nif(S)\n target_compile_definitions(n PUBLIC S)\nendif()\n'
    assert made(f"#ifdef S\n{INIT}\n#endif", option)[1] == ("/b", ["#ifdef S"], False)


def test_what_the_build_leaves_out_is_ruled_out() -> None:
    assert made(f"#ifndef S\n{INIT}\n#endif", "target_compile_definitions(n PUBLIC S)\n")[1] == (
        "/b",
        ["#ifndef S"],
        True,
    )


@pytest.mark.parametrize("inits", [INIT, f"// #ifdef S\n{INIT}"])
def test_without_a_conditional_there_is_none(inits: str) -> None:
    assert made(inits) == [FIRST, ("/b", [], False), LAST]
