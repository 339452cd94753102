# SPDX-License-Identifier: Apache-2.0
"""Statements of C++ that are left out before programs are followed: they make and change nothing; all others stay."""

from __future__ import annotations

import pytest

from haros_ci.analysis.api_rows import api_rows
from haros_ci.coverage.names import names_of
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.index.idle import GETTERS, Idle, idle_in
from haros_ci.syntax import Program
from haros_ci.syntax.source import Source

IDLE = (
    "int more = 1;",
    "const double more{-1.5 * 2};",
    "unsigned int more;",
    'std::string more("x");',
    'const char * more = "x";',
    "auto more = true;",
    "int n = 1;",
    "(void)n;",
    'RCLCPP_INFO(get_logger(), "at %d of %zu", n, s.size());',
    'RCLCPP_WARN_STREAM(this->get_logger(), "at " << n << std::to_string(2));',
    'RCLCPP_ERROR_THROTTLE(rclcpp::get_logger("x"), *get_clock(), 1000, "at");',
    'ROS_INFO_NAMED("x", "%s", s.c_str());',
    'RCLCPP_DEBUG(logger_, n > 3 ? "a" : "b");',
    'std::cout << "at " << n << std::endl;',
    'if (n > 3 && s.empty()) { RCLCPP_INFO(logger_, "at"); }',
    'if (n > 3) { ROS_INFO("at"); } else { ROS_WARN("off"); }',
)
#: What makes, changes or may do something, is used, or is no statement of its own.
OTHER = (
    "int more = 1; n = more;",
    "int more = 1; auto call = [&]() { return more; };",
    "int held = 1; USING;",
    "int more = next();",
    "int more = n;",
    "static int more = 1;",
    "int more[3];",
    "int & more = n;",
    "std::vector<int> more;",
    "Thing more;",
    "n = 1;",
    "++n;",
    "next();",
    "get_logger();",
    's += "x";',
    'RCLCPP_INFO(get_logger(), "%d", next());',
    'RCLCPP_INFO(get_logger(), "%d", n++);',
    'RCLCPP_INFO(get_logger(), "%d", n = 2);',
    'RCLCPP_INFO(get_logger(), "%d", table["x"]);',
    'RCLCPP_INFO(get_logger(), "%d", get_parameter("x").as_int());',
    'RCLCPP_INFO_FUNCTION(get_logger(), next, "at");',
    "ROS_ASSERT(n > 3);",
    'MY_INFO("at");',
    'log("at");',
    'file << "at";',
    'if (next()) { ROS_INFO("at"); }',
    "if (n > 3) { next(); }",
    'while (n > 3) { ROS_INFO("at"); }',
    "return;",
)
FUNCTION = (
    "#define USING held\nint n; std::string s; Log logger_; std::map<std::string, int> table;\nvoid go() {{\n{}\n}}\n"
)


def program_of(text: str) -> Program:
    return read_cpp(text)


def left(text: str, idle: Idle | None = None) -> int:
    """The statements that are left of a body, those inside others and lambdas aside."""
    program = program_of(FUNCTION.format(text))
    known = idle or idle_in([Source("a.cpp", "p", program)])
    function = next(one for one in known.program(program).functions if one.name == "go")
    return len(function.body or ())


def written(text: str) -> int:
    function = next(one for one in program_of(FUNCTION.format(text)).functions if one.name == "go")
    return len(function.body or ())


@pytest.mark.parametrize("text", IDLE)
def test_idle(text: str) -> None:
    assert (written(text), left(text)) == (1, 0)


@pytest.mark.parametrize("text", OTHER)
def test_not_idle(text: str) -> None:
    assert left(text) == written(text) > 0


@pytest.mark.parametrize(
    "around",
    ("if (n > 3) {{ {} next(); }}", "for (;;) {{ {} next(); }}", "try {{ {} next(); }} catch (int e) {{ next(); }}",
     "switch (n) {{ case 1: {} next(); break; }}", "for (auto a : s) {{ {} next(); }}", "{{ {} next(); }}", "while (n) {{ if (n) {{ {} next(); }} }}"),
)  # fmt: skip
def test_inside(around: str) -> None:
    """What is left of a block is the block without them."""
    idle = Idle(frozenset())
    text = around.replace("{}", 'ROS_INFO("at"); int more = 1;')
    bare = around.replace("{}", "")
    with_them, without = (idle.program(program_of(FUNCTION.format(one.format()))) for one in (text, bare))
    assert [str(f.body).count("Do(") for f in with_them.functions] == [
        str(f.body).count("Do(") for f in without.functions
    ]
    assert "more" not in str([f.body for f in with_them.functions])


def test_own() -> None:
    """What a workspace defines itself under these names is followed."""
    own = program_of(
        '#define ROS_INFO(x) next(x)\nstd::string Thing::get_name() { next(); return "x"; }\nint other();\n'
    )
    idle = idle_in([Source("a.cpp", "p", own)])
    assert idle.own == {"ROS_INFO", "get_name"}
    assert left('ROS_INFO("at");', idle) == 1
    assert left('ROS_WARN("%s", thing.get_name());', idle) == 1
    assert left('ROS_WARN("at");', idle) == 0


def test_apart_from_apis() -> None:
    """Nothing that is looked for in texts as a call of an API is a getter or logs: a text has the same calls without them."""
    for rows in api_rows(None, "", [], ()).values():
        names = names_of(tuple(rows))
        assert not GETTERS & (names.methods | names.classes.keys())
        assert not any(name.startswith(("RCLCPP_", "ROS_")) for name in names.methods)


def test_same_object() -> None:
    """A program without them is the same object; Python stays as it is."""
    program = program_of(FUNCTION.format("next();"))
    assert idle_in([]).program(program) is program
    python = Program("python")
    assert idle_in([]).program(python) is python


def test_too_deep() -> None:
    """A program that is nested too deeply to be gone through stays as it is."""
    deep = program_of(FUNCTION.format("{" * 150 + 'ROS_INFO("at");' + "}" * 150))
    assert idle_in([]).program(deep).language == "cpp"
