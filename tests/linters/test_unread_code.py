# SPDX-License-Identifier: Apache-2.0
"""Code of C++ at which cppcheck does not look is named: lambdas outside of functions, values of coroutines, and blocks that are values."""

from __future__ import annotations

import pytest

from haros_ci.linters.seen_otherwise import seen_otherwise

LAMBDA = "[] { int * p = nullptr; return *p; }"
FIRES = {
    f"int f(F g = {LAMBDA})\n{{\n  return g();\n}}\n": "a lambda outside of functions",
    f"struct A\n{{\n  F g = {LAMBDA};\n}};\n": "a lambda outside of functions",
    f"struct A\n{{\n  F g{{{LAMBDA}}};\n}};\n": "a lambda outside of functions",
    f"class A : public B\n{{\npublic:\n  A(int x, F g = {LAMBDA}) : x_(x) {{}}\n}};\n": "a lambda outside of functions",
    f"namespace a\n{{\nconst int n = {LAMBDA}();\n}}\n": "a lambda outside of functions",
    f"template <int N = {LAMBDA}()>\nint f();\n": "a lambda outside of functions",
    "const F g = [](A * a) { return a->b; };\n": "a lambda outside of functions",
    "const F g = [](int a) { return 3 / a; };\n": "a lambda outside of functions",
    "Task f(int * p)\n{\n  co_return *p;\n}\n": "what a coroutine returns",
    "Task f(A * p)\n{\n  co_yield p->x;\n}\n": "what a coroutine returns",
    "int f(int * p)\n{\n  return ({ int y = *p; y; });\n}\n": "a block of statements that is a value",
    "#ifdef __OPTIMIZE__\nint f() {return 1;}\n#endif\n": "a condition on what flags of a compiler define, and code under it,",
    "#if !defined(__NO_INLINE__)\nint f() {return 1;}\n#endif\n": "a condition on what flags of a compiler define, and code under it,",
    "#ifdef __FLT_RADIX__\nint f() {return 1;}\n#endif\n": "a condition on a name of the compiler's own, and code under it,",
    "#if defined(__INT32_TYPE__) && __ATOMIC_RELAXED == 0\nint f() {return 1;}\n#endif\n": "a condition on a name of the compiler's own, and code under it,",
    "#ifdef __GNUC_STDC_INLINE__\n#else\nint f() {return 1;}\n#endif\n": "a condition on a name of the compiler's own, and code under it,",
    "#if 0\n// \r\\\n#endif\nint f();\n": "a line that ends in a carriage return alone",
}
QUIET = [
    f"int f()\n{{\n  auto g = {LAMBDA};\n  return g();\n}}\n",
    f"class A\n{{\n  A() const noexcept {{{LAMBDA}();}}\n  void f() const {{{LAMBDA}();}}\n}};\n",
    f"template <class T>\nint f()\n{{\n  call({LAMBDA});\n}}\n",
    f'namespace a\n{{\nA::A() : Node("a")\n{{\n  s_ = create_subscription<M>("t", 10, {LAMBDA});\n}}\n}}\n',
    f"int f() try {{{LAMBDA}();}} catch (...) {{}}\n",
    "F g = [](A a) { return call(a); };\n",
    "struct A\n{\n  F g = [this] { this->say(); };\n  F h = [] {};\n};\n",
    "int v[3] = {1, 2, 3};\nint w = v[1];\n[[nodiscard]] int f(int a[3] = nullptr);\n",
    f"// F g = {LAMBDA};\n#if 0\nF g = {LAMBDA};\n#endif\n",
    f"#define MAKE(x) wrap({LAMBDA})\n",
    "Task f()\n{\n  co_return 1;\n}\nTask g()\n{\n  co_await h();\n  co_return;\n}\n",
    "TEST(A, b)\n{\n  EXPECT_THROW({ call(); }, std::exception);\n  f({{1, 2}, {3, 4}});\n}\n",
    "#ifdef __OPTIMIZE__\n#define FAST\n#endif\n",
    "#ifdef __INT64_MAX__\nint f() {return 1;}\n#endif\n",
    "#ifdef __ARM_NEON\nint f() {return 1;}\n#endif\n#ifdef __AVX2__\nint g() {return 1;}\n#endif\n",
    "#ifdef __FLT_RADIX__\n#define RADIX __FLT_RADIX__\n#endif\n",
    "double e = __DBL_EPSILON__;\n",
    "#ifdef _OPENMP\nint f() {return 1;}\n#endif\n",
    "int f();\r\nint g();\r\n",
    "struct A\n{\n  enum B {C, D};\n  int x{3};\n};\nint f(A a) {return a.x;}\n",
    'extern "C" {\nint f() {' + f"auto g = {LAMBDA}; return g();" + "}\n}\n",
]


@pytest.mark.parametrize("text", FIRES)
def test_named(text: str) -> None:
    assert FIRES[text] in list(seen_otherwise(text))


@pytest.mark.parametrize("text", QUIET)
def test_quiet(text: str) -> None:
    assert list(seen_otherwise(text)) == []


@pytest.mark.parametrize(
    "part", ["= [] ", "= [] {", "f(F g = [](int a) { return 3 / a; }", "({", "struct {", "= [](", "a{[", "co_return x"]
)
def test_many_take_linear_time(part: str) -> None:
    assert len(list(seen_otherwise(part * 20_000))) <= 3
