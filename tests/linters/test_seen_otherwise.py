# SPDX-License-Identifier: Apache-2.0
"""Code that a change brings and cppcheck is given in another way than the compiler is named; what every package has is not."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.seen_otherwise import notifications, seen_otherwise

CODE = "int & pick() {\n  int local = 1;\n  return local;\n}"

SEEN = {
    '#define PART "part.hpp"\n#include PART\n': "'#include PART'",
    "# /* why */ include PART(x)\n": "'#include PART(x)'",
    "#inc\\\nlude PART\n": "'#include PART'",
    f"#ifndef TP_ARGS\n#define TP_ARGS(...) __VA_ARGS__\n#endif\nTP_ARGS({CODE})\n": "TP_ARGS",
    f"TP_ARGS({CODE})\n": "code in the arguments of TP_ARGS",
    f"class A\n{{\n  Q_PROPERTY(\n    int x)\n  Q_PROPERTY({CODE})\n}};\n": "code in the arguments of Q_PROPERTY",
    "#ifndef ARM_PART_EXPORT\n#define ARM_PART_EXPORT int & pick() { int a = 1; return a; }\n#endif\n": "ARM_PART_EXPORT",
    "#if !defined(ARM_PUBLIC)\n#define ARM_PUBLIC int a = *nothing,\n#endif\n": "ARM_PUBLIC",
    f"#ifndef PCL_EXPORTS\n{CODE}\n#endif\n": "PCL_EXPORTS",
    f"#if X && !defined(PCL_EXPORTS)\n\n{CODE}\n#endif\n": "PCL_EXPORTS",
}
SEEN |= {
    f"/* why *\\\n/ {CODE} /* */\n": "end is written over two lines",
    f"/* why *\\ \r\n/ {CODE} /* */\n": "end is written over two lines",
    f"/* why *??/\n/ {CODE} /* */\n": "end is written over two lines",
    f"/* why *\\\n\\\n/ {CODE} /* */\n": "end is written over two lines",
    f"/* why *\\\f\n\\ \n\\\r\n/ {CODE} /* */\n": "end is written over two lines",
    '#inc\\\f\nlude "part.glsl"\n': "form feed",
    "struct _asm { static int & pick() { int a = 1; return a; } };\n": "_asm",
    "int & _asm() { int a = 1; return a; }\n": "_asm",
    "void f() { __asm { nop } }\n": "_asm",
}
SEEN |= {
    '#define GIVE a\n#pragma push_macro("GIVE")\n#undef GIVE\n': "push_macro",
    '_Pragma("pop_macro(\\"GIVE\\")")\n': "pop_macro",
    "#define DO(x) _Pragma(#x)\nDO(pop_macro(GIVE))\n": "the pragma '#x",
    "%:pragma redefine_extname a b\n": "redefine_extname",
    f"#pragma asm\n{CODE}\n#pragma endasm\n": "the pragma 'asm'",
    f"// why??/\n{CODE}\n": "a trigraph",
    f"// why??/ \r\n{CODE}\n": "a trigraph",
    "??=define GIVE a\n": "a trigraph",
    'const char * a = "??/"; static ";\n': "a trigraph",
    "#line 1\nint a = CAT(give_, __LINE__);\n": "the number of a line",
    '# 7 "a.cpp"\nint a = __LINE__;\n': "the number of a line",
    "#ifdef ROS_DEPRECATED\n#define GIVE a\n#else\n#define GIVE b\n#endif\n": "a condition on ROS_DEPRECATED",
    "#ifndef RCLCPP_DISABLE_COPY\n#define GIVE a\n#endif\n": "a condition on RCLCPP_DISABLE_COPY",
    "#if X && defined(Py_RETURN_NONE)\nint a;\n#endif\n": "a condition on Py_RETURN_NONE",
    "#ifndef PCL_EXPORTS\n#define PCL_EXPORTS\n#define GIVE a\n#endif\n": "a condition on PCL_EXPORTS",
    "#ifndef Py_RETURN_NONE\n#define Py_RETURN_NONE return local\n#endif\n": "the macro Py_RETURN_NONE",
    "#ifndef ROS_DEPRECATED\n#define ROS_DEPRECATED not\n#endif\n": "the macro ROS_DEPRECATED",
}
LABEL = 'int * pick(int & a) {}("nothing");\n'
SEEN |= {
    LABEL.format("__asm__"): '"nothing" for the assembler',
    LABEL.format("asm"): "for the assembler",
    LABEL.format("const __asm"): "for the assembler",
    'extern int kept __asm__("other");\n': "for the assembler",
    'int * pick(int & a) __asm__("_" "nothing") __attribute__((used));\n': "for the assembler",
    "#define NAMED(x) __asm__(#x)\nint pick() NAMED(nothing);\n": "for the assembler",
    'int pick() __attribute__((alias("nothing")));\n': "the attribute alias",
    'static int pick() __attribute__((used, __weakref__("nothing")));\n': "the attribute weakref",
    '[[gnu::ifunc("nothing")]] int pick();\n': "the attribute ifunc",
    '[[using gnu : alias("nothing")]] int pick();\n': "the attribute alias",
    "#pragma weak pick = nothing\n": "pick, which is nothing",
    '_Pragma("weak pick=nothing")\n': "pick, which is nothing",
    "#define GIVE(a, ...) __VA_OPT__(static) int a\n": "__VA_OPT__",
    "#define TEXT(include) #include\n": "the parameter include",
    "#define TEXT(a, \\\n  pragma) a #pragma\n": "the parameter pragma",
}
SEEN |= {
    f"#if __GNUC__ != 13\n{CODE}\n#endif\n": "the version of the compiler",
    f"#if __GNUC__ < 13\n{CODE}\n#endif\n": "the version of the compiler",
    f"#if __GNUC__ == 13 && __GNUC_MINOR__ < 3\n#else\n{CODE}\n#endif\n": "the version of the compiler",
    f"#if X\n#elif __GNUC__ > 13\n{CODE}\n#endif\n": "the version of the compiler",
    f"#ifdef X\n#if __GNUC__ <= 12 && !defined(Y)\n{CODE}\n#endif\n#endif\n": "the version of the compiler",
    f"#if !RCLCPP_VERSION_GTE(99, 0, 0)\n{CODE}\n#endif\n": "RCLCPP_VERSION_GTE",
    f"#if ROS_VERSION_MINIMUM(2, 0, 0)\n#else\n{CODE}\n#endif\n": "ROS_VERSION_MINIMUM",
    f"#if PCL_VERSION < PCL_VERSION_CALC(99, 1, 0)\n{CODE}\n#endif\n": "PCL_VERSION_CALC",
}
QUIET = [
    'void f(bool a) {\n  asm("nop");\n  if (a) asm("hlt");\n  else asm("nop");\n  asm volatile("mfence" ::: "memory");\n}\n',
    'void f() {\n  for (;;)\n    __asm__("pause");\n  do asm("nop"); while (false);\n  register int a asm("r0");\n}\n',
    '// int pick() __asm__("nothing");\nconst char * a = "__attribute__((alias(\\"b\\")))";\n#define A\n',
    'po.alias("name");\nint alias(int a);\n[[nodiscard]] int pick();\n__attribute__((weak)) int give();\n#pragma weak give\n',
    "#define LOG(f, ...) printf(f __VA_OPT__(,) __VA_ARGS__)\n",
    "#define INCLUDE_IT(a) #a\n#define GIVE(includes) #includes\n",
    f"#if __GNUC__ >= 7\n{CODE}\n#endif\n",
    f"#if defined(__GNUC__) && __GNUC__ < 5\n{CODE}\n#endif\n",
    "#if __GNUC__ >= 12\n#pragma GCC diagnostic push\n#endif\nint a;\n",
    "#if __GNUC__ >= 14\n#define ARM_QUIET 1\n#else\n#define ARM_QUIET 0\n#endif\n",
    f"#ifdef __GNUC__\nint a;\n#else\n{CODE}\n#endif\n",
    f"#if RCLCPP_VERSION_GTE(28, 0, 0)\nint a;\n#else\n{CODE}\n#endif\n",
    f"#if ROS_VERSION_MINIMUM(1, 14, 0)\nint a;\n#else\n{CODE}\n#endif\n",
    f"#if PCL_VERSION_COMPARE(>=, 1, 12, 0) || VTK_VERSION < VTK_VERSION_CHECK(9, 1, 0)\n{CODE}\n#endif\n",
    '#pragma once\n#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored "-Wall"\n#pragma omp parallel for\n#pragma pack(push, 1)\n',
    "#pragma warning(disable : 4996)\n#  pragma GCC visibility push(default)\n#pragma clang diagnostic pop\n#pragma\n",
    '_Pragma("GCC diagnostic push") __pragma(warning(push))\n',
    "// #pragma push_macro\n/*\n#pragma push_macro\n*/\n",
    "// why??! what??) http://a/??/b\n/* ??/ */\nint a = b ? c : d;\n",
    "#line 7\nint a;\n",
    "int a = __LINE__;\n",
    "#ifndef ROS_DEPRECATED\n// none\n#define ROS_DEPRECATED  \n\n#endif\n",
    "#ifdef ROS_DEPRECATED\n#undef ROS_DEPRECATED\n#endif\n",
    "#ifdef RCLCPP_VERSION_GTE\n#if RCLCPP_VERSION_GTE(28, 0, 0)\nint a;\n#endif\n#endif\n",
    "#ifdef __linux__\n#define GIVE a\n#else\n#define GIVE b\n#endif\n",
    "/* one * \\\n / two */\n/**\n * text \\\n */\n",
    "#define A(x) \\\n  (x * \\\n  /2)\n\f\nint a;\n",
    'void f() { __asm__ volatile("nop"); asm("nop"); __asm("nop"); int my_asm = 1; f._asm_; }\n',
    CODE,
    '#include "part.hpp"\n#include <vector>\n',
    "// #include PART\n",
    "/*\n#include PART\n*/\n",
    "#if 0\n#include PART\n#endif\n",
    'const char * text = R"(\n#include PART\n)";\n',
    '#define PART "part.hpp"\n',
    "RCLCPP_DISABLE_COPY(Node)\nRCLCPP_COMPONENTS_REGISTER_NODE(arm::Node)\n",
    f"TRACEPOINT_EVENT(arm, a, TP_ARGS(const void *, node), TP_FIELDS(ctf_integer_hex(const void *, node, node)))\n{CODE}\n",
    'ROS_DEPRECATED_MSG("use { or ;")\nvoid f();\n',
    "Q_PROPERTY(int x READ x WRITE setX)\n",
    f"ARM_CODE({CODE})\n",
    "#ifndef ARM_EXPORT\n#define ARM_EXPORT\n#endif\n",
    '#ifndef ARM_EXPORT\n#define ARM_EXPORT __attribute__((visibility("default")))\n#endif\n',
    "#ifdef ARM_BUILDING\n#define ARM_PUBLIC __declspec(dllexport)\n#else\n#define ARM_PUBLIC __declspec(dllimport)\n#endif\n",
    "#ifndef ARM_PUBLIC\n#define ARM_PUBLIC [[gnu::visibility]] inline\n#endif\n",
    '#ifndef ARM_EXPORT\n#define ARM_EXPORT extern "C" ARM_API\n#endif\n',
    "#define ARM_EXPORT int a = *nothing,\n",
    "#ifndef LIMIT\n#define LIMIT (1 + 2)\n#endif\n",
    "#ifndef ARM__NODE_HPP_\n#define ARM__NODE_HPP_\nint a;\n#endif\n",
    "#ifdef __linux__\nint a;\n#endif\n",
    "#ifndef Q_MOC_RUN\n#include <a.hpp>\n#endif\n",
    "#ifndef PCL_EXPORTS\n#define PCL_EXPORTS\n#endif\n",
    "EIGEN_MAKE_ALIGNED_OPERATOR_NEW\nint a;\n",
    "TP_ARGS(",
]


def test_hostile_text_takes_linear_time() -> None:
    for text in (
        "asm(",
        "__attribute__((",
        "[[",
        "#pragma weak a",
        "#if __GNUC__ < 12\n",
        "#define A(include",
        "__asm__ ",
    ):
        list(seen_otherwise(f"#define A\n{text * 20_000}"))


@pytest.mark.parametrize("text", SEEN)
def test_it_is_named(text: str) -> None:
    assert any(SEEN[text] in words for words in seen_otherwise(text))


@pytest.mark.parametrize("text", QUIET)
def test_it_is_not_named(text: str) -> None:
    assert list(seen_otherwise(text)) == []


def noted(old: dict[str, str], new: dict[str, str], tmp_path: Path) -> list[str | None]:
    before, after = (workspace(tmp_path / name, files) for name, files in (("old", old), ("new", new)))
    return [note.path for note in notifications(after, before)]


def test_only_what_a_change_brings_is_noted(tmp_path: Path) -> None:
    use, other = "#include PART\n", "#include OTHER\n"
    (tmp_path / "old").mkdir()
    (tmp_path / "new").mkdir()
    old = {"same.cpp": use, "edited.cpp": use, "more.cpp": use, "moved.cpp": use, "plain.cpp": CODE}
    new = {"same.cpp": use, "edited.cpp": f"{use}int a;\n", "more.cpp": use + other, "there.cpp": f"{use}int b;\n"}
    new |= {"plain.cpp": other, "new.cpp": f"{other}int c;\n", "part.py": use}
    assert noted(old, new, tmp_path) == ["more.cpp", "new.cpp", "plain.cpp"]


USED = "ARM_PUBLIC int f();\n"
ASKED = "#ifdef ARM_PUBLIC\n#define GIVE a\n#else\n#define GIVE b\n#endif\n"


@pytest.mark.parametrize(
    ("text", "is_noted"),
    [
        (ASKED, True),
        (ASKED.replace("PUBLIC", "OTHER"), False),
        ("#ifndef ARM_PUBLIC\n#define ARM_PUBLIC\n#endif\n", False),
        ("#ifndef ARM_PUBLIC_HPP_\n#define ARM_PUBLIC_HPP_\nint a;\n#endif\n", False),
        ("int a;\n", False),
    ],
)
def test_conditions_on_what_the_workspace_uses_as_a_decoration(tmp_path: Path, text: str, is_noted: bool) -> None:
    old = {"used.hpp": USED, "a.cpp": "int b;\n"}
    assert noted(old, old | {"a.cpp": text}, tmp_path) == (["a.cpp"] if is_noted else [])


def test_without_a_base_nothing_is_noted(tmp_path: Path) -> None:
    assert notifications(workspace(tmp_path, {"a.cpp": "#include PART\n"}), None) == ()


def test_macros_without_end_take_no_time_in_the_square_of_their_number() -> None:
    assert list(seen_otherwise("TP_ARGS(" * 50_000)) == []
