# SPDX-License-Identifier: Apache-2.0
"""C and C++ measured by hand and by the worker."""

from __future__ import annotations

from math import log2
from typing import Any

import pytest

from haros_ci.linters.lizard_worker import measure
from haros_ci.linters.metrics_worker import Unmeasurable


def functions(code: str) -> dict[str, dict[str, Any]]:
    return {f["name"]: f for f in measure(code.encode())["functions"]}


def only(code: str) -> dict[str, Any]:
    (function,) = measure(code.encode())["functions"]
    return dict(function)


@pytest.mark.parametrize(
    ("body", "complexity"),
    [
        ("", 1),
        ("if (a) {}", 2),
        ("if (a && b || c) {}", 4),
        ("for (;;) { while (a) {} }", 3),
        ("do {} while (a);", 2),
        ("switch (a) { case 1: break; case 2: break; default: break; }", 3),
        ("return a ? 1 : 2;", 2),
        ("try {} catch (E & e) {} catch (...) {}", 3),
        ("auto f = [](int i) { if (i) {} };", 2),
        ("// if (a) {}\n/* while (a) {} */", 1),
        ('log("if (a) && b");', 1),
        ("#if A\nx();\n#endif", 2),
        ("else_if();", 1),
    ],
)
def test_complexity(body: str, complexity: int) -> None:
    assert only(f"void f() {{ {body}\n}}")["cc"] == complexity


@pytest.mark.parametrize(
    ("signature", "parameters"),
    [
        ("void f()", 0),
        ("void f(void)", 0),
        ("void f(int a)", 1),
        ("void f(int a, int b = 3, const char * c = nullptr)", 3),
        ("void f(std::map<int, std::pair<int, int>> a, int b)", 2),
        ("void f(std::function<void(int, int)> g, int b)", 2),
        ("void f(\n  int a,\n  int b\n)", 2),
        ("TEST_F(Fixture, name)", 0),
    ],
)
def test_parameters(signature: str, parameters: int) -> None:
    assert only(signature + " {}")["parameters"] == parameters


@pytest.mark.parametrize(
    ("code", "names"),
    [
        ("namespace a { class B { void c() {} }; }", ["a::B::c"]),
        ("void a::B::c() const {}", ["a::B::c"]),
        ("a::B::~B() {}", ["a::B::~B"]),
        ("bool operator<<(int a, int b) {}", ["operator<<"]),
        ("struct F { int operator()(int a) { return a; } };", ["F::operator()"]),
        ("template <typename T>\nvoid A<T>::f() {}", ["A<T>::f"]),
        ("TEST_F(Fixture, does_it) { }", ["TEST_F(Fixture, does_it)"]),
        ("RCLCPP_COMPONENTS_REGISTER_NODE(a::B)\nvoid f() {}", ["f"]),
        # quiet: no functions
        ("", []),
        ("void f();", []),
        ("class A { A() = default; A(const A &) = delete; };", []),
        ("int x = f(3);", []),
        ("if (a) { b(); }", []),
        ("while (a) { b(); }", []),
        ("#define M(x) if (x) { }", []),
        ("enum class E { A, B };", []),
        ("PLUGINLIB_EXPORT_CLASS(a::B, c::D)", []),
    ],
)
def test_names(code: str, names: list[str]) -> None:
    assert list(functions(code)) == names


@pytest.mark.parametrize(
    ("code", "line", "column"),
    [
        ("void f() {}", 1, 6),
        ("\n\nvoid\nA::f(\n  int a) {}", 4, 1),
        ("void  A::f() {}", 1, 7),
        ("class A {\n  int g() { return 1; }\n};", 2, 7),
        ("int /* é */ g() {}", 1, 13),
        ("\ufeffint g() {}", 1, 5),
        ("// a\r\nint g() {\r\n}\r\n", 2, 5),
    ],
)
def test_place(code: str, line: int, column: int) -> None:
    function = only(code)
    assert (function["line"], function["column"]) == (line, column)


LENGTHS = """\
// comment
int f(int a)
{
  // a comment

  int b =
    a;
  if (a) {
    /* two
       lines */
    b = 2;  // trailing
  }
#ifdef X
  b = 3;
#else
  b = 4; }
#endif
  return b;
}
"""


def test_lengths() -> None:
    """Of #else nothing is read, or its brace would end the function early."""
    f = only(LENGTHS)
    assert f["nloc"] == 10
    assert f["eloc"] == 7  # without {, }, } and the preprocessor lines
    assert f["cc"] == 3
    metrics = measure(LENGTHS.encode())["file"]
    assert metrics["nloc"] == 13  # with the preprocessor lines of the branch that is read
    assert metrics["comment_ratio"] == pytest.approx(5 / 17)


@pytest.mark.parametrize(
    ("code", "names"),
    [
        ("#if A\nvoid f() {\n#else\nvoid g() {\n#endif\n}\nvoid h() {}", ["f", "h"]),
        ("#if 0\nvoid f() {\n#else\nvoid g() {\n#endif\n}", ["g"]),
        ("#ifdef A\n#if 0\n{ {\n#endif\nvoid f() {}\n#elif B\n{ {\n#endif\nvoid g() {}", ["f", "g"]),
        ("#else\n#endif\nvoid f() {}", ["f"]),
        ("#if 0\nvoid f() {}", []),
    ],
)
def test_branches(code: str, names: list[str]) -> None:
    assert list(functions(code)) == names


def test_halstead() -> None:
    """``int a = b + b;`` has operators int = + ; and operands a b b."""
    assert measure(b"int a = b + b;")["file"]["volume"] == pytest.approx(7 * log2(6))
    assert measure(b"f(b);")["file"]["volume"] == pytest.approx(4 * log2(4))  # f ( b ; with the bracket pair once
    assert measure(b"// nothing\n#include <a>\n")["file"]["volume"] == 0


@pytest.mark.parametrize("code", [b"", b"\n\n", b"// only a comment\n", b"\xef\xbb\xbf"])
def test_no_code(code: bytes) -> None:
    metrics = measure(code)["file"]
    assert (metrics["nloc"], metrics["volume"], metrics["mi"]) == (0, 0, 100)


def test_latin_1() -> None:
    assert measure("// é\nvoid grün() {}\n".encode("latin-1"))["functions"][0]["name"] == "grün"


def test_many_branches() -> None:
    code = "void f(int x)\n{\n" + "  if (x) { x++; }\n" * 10_000 + "}\n"
    assert only(code)["cc"] == 10_001


@pytest.mark.parametrize(
    "code",
    [
        "{" * 20_000,
        "}" * 20_000,
        "void f() {" + "if (a) {" * 5_000,
        "(" * 20_000,
        "<" * 20_000,
        'char * s = "' + "x" * 100_000,
        "#if A\n" * 5_000,
        "template <" * 3_000,
        "/*" * 2_000,
    ],
)
def test_nonsense_is_measured(code: str) -> None:
    assert measure(code.encode())["file"]["nloc"] >= 1


def test_binary_is_not() -> None:
    with pytest.raises(Unmeasurable):
        measure(b"\x7fELF\0\0")
