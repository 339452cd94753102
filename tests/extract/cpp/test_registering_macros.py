# SPDX-License-Identifier: Apache-2.0
"""Macros of a workspace that register classes by others of pluginlib, rclcpp_components and BehaviorTree.CPP."""

from __future__ import annotations

import pytest

from haros_ci.extract.cpp.read import Macro, read_cpp

PLUGIN = "#define PLUGIN(Type) PLUGINLIB_EXPORT_CLASS(arm::Type, arm::Base)\n"
TREE = "#define NODES(space, Type) \\\n  BT_REGISTER_NODES(factory) \\\n  { \\\n    factory.registerNodeType<space::Type>(#Type); \\\n  }\n"


def registered(text: str, macros: dict[str, Macro] | None = None) -> list[tuple[str, tuple[str, ...], int]]:
    return [(name, words, line) for name, words, line, _ in read_cpp(text, macros).registered]


@pytest.mark.parametrize(
    "use", ["PLUGIN(Drive)", "PLUGIN(Drive);", "namespace x {\nPLUGIN(Drive)\n}", "int a;\nPLUGIN(Drive)\nint b;"]
)
def test_a_macro_that_exports_a_class(use: str) -> None:
    line = use[: use.index("PLUGIN")].count("\n") + 2
    found = [one for one in registered(f"{PLUGIN}{use}\n") if one[0] != "PLUGIN"]
    assert found == [("PLUGINLIB_EXPORT_CLASS", ("arm::Drive", "arm::Base"), line)]


def test_a_macro_of_a_macro() -> None:
    text = f"{PLUGIN}#define BOTH(A, B) PLUGIN(A); PLUGIN(B)\nBOTH(Left, Right)\n"
    found = [words[0] for name, words, _ in registered(text) if name == "PLUGINLIB_EXPORT_CLASS"]
    assert found == ["arm::Left", "arm::Right"]


def test_a_macro_of_a_header() -> None:
    macros = {"COMPONENT": (("Type",), "RCLCPP_COMPONENTS_REGISTER_NODE(arm::Type)")}
    assert ("RCLCPP_COMPONENTS_REGISTER_NODE", ("arm::Drive",), 3) in registered("\n\nCOMPONENT(Drive)\n", macros)


@pytest.mark.parametrize("use", ["NODES(arm, Drive)", "NODES(arm, Drive);", "NODES(arm::trees, Drive)\nclass C {};"])
def test_a_macro_that_registers_nodes_of_trees(use: str) -> None:
    program = read_cpp(f"{TREE}\n{use}\n")
    (function,) = program.functions
    assert (function.name, function.line) == ("BT_REGISTER_NODES", 7) and function.body is not None
    space = "arm::trees" if "trees" in use else "arm"
    assert f"{space}::Drive" in repr(function.body) and "'Drive'" in repr(function.body)


@pytest.mark.parametrize(
    "text",
    [
        f"{PLUGIN}int a;\n",
        f"{PLUGIN}// PLUGIN(Drive)\n",
        "PLUGIN(Drive)\n",
        "#define PLUGIN(Type) EXPORT(Type)\nPLUGIN(Drive)\n",
        "#define PLUGIN(Type) class Type##Factory { PLUGINLIB_EXPORT_CLASS(Type\nPLUGIN(Drive)\n",
        f"{PLUGIN}PLUGIN(Left, Right)\n",
        f"{PLUGIN}PLUGIN()\n",
        f"#undef PLUGIN\n{PLUGIN}void f() {{ other::PLUGIN(1); }}\n",
        "#define LOOP(A) LOOP(A) PLUGINLIB_EXPORT_CLASS(A, A\nLOOP(Drive)\n",
        "#define TEXT(A) \"PLUGINLIB_EXPORT_CLASS(\" #A \")\"\nTEXT(Drive)\n",
    ],
)  # fmt: skip
def test_what_registers_nothing(text: str) -> None:
    assert not [words for name, words, _ in registered(text) if name == "PLUGINLIB_EXPORT_CLASS"]


def test_macros_that_grow_end() -> None:
    text = "#define A0(T) PLUGINLIB_EXPORT_CLASS(T, T);\n" + "".join(
        f"#define A{n}(T) A{n - 1}(T) A{n - 1}(T)\n" for n in range(1, 40)
    )
    read_cpp(f"{text}A39(Drive)\n")
