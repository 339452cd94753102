# SPDX-License-Identifier: Apache-2.0
"""Enclosing scopes of C++ and Python lines."""

from __future__ import annotations

import pytest

from haros_ci.results.scope import scopes


def marked(text: str, language: str) -> list[tuple[str, str]]:
    """(expected, found) of every line that says ``@scope`` at its end; ``@`` alone expects none."""
    found = scopes(text, language)
    return [
        (line.rpartition("@")[2], found.at(number)) for number, line in enumerate(text.split("\n"), 1) if "@" in line
    ]


CPP = {
    "free function": "int f(int a)  // @f\n{\n  return a;  // @f\n}  // @f\nint g;  // @",
    "K&R": "static void f(int a) {  // @f\n  a();  // @f\n}\n",
    "return type on its own line": "std::vector<int>  // @f\nf(\n  int a,  // @f\n  int b)\n{\n}\n",
    "namespaces": (
        "namespace a::b {  // @a::b\nnamespace c\n{\n"
        "void f() {}  // @a::b::c::f\nint x;  // @a::b::c\n}\n}\nint y;  // @"
    ),
    "inline namespace": "inline namespace v1 {\nint x;  // @v1\n}",
    "anonymous namespace": "namespace {\nvoid f() {  // @f\n}\n}\nnamespace n { namespace {\nint x;  // @n\n} }",
    "extern C": 'extern "C" {\nvoid f() {\n x();  // @f\n}\n}\nint y;  // @',
    "class": (
        "class A : public B<C>, private D {\n int x;  // @A\n"
        " void f() const override {\n  g();  // @A::f\n }\n};\nint y;  // @"
    ),
    "exported class": "class NAV_PUBLIC A final\n{\n int x;  // @A\n};",
    "attribute macro class": "struct __attribute__((packed)) A {\n int x;  // @A\n};",
    "nested class": "struct A { struct B {\n int x;  // @A::B\n};\n int y;  // @A\n};",
    "anonymous struct": "struct A { union {\n int x;  // @A\n}; };",
    "returns struct": "struct foo * make(int a) {\n x();  // @make\n}",
    "enum": "enum class Colour : int {\n RED,  // @Colour\n};",
    "out of line": "namespace nav {\nvoid Ctl::init(int a) {\n x();  // @nav::Ctl::init\n}\n}",
    "out of line template": "template <class T, int N = (1 > 2)>\nvoid Ctl<T, N>::init() {\n x();  // @Ctl::init\n}",
    "shifted template argument": "std::map<int, std::vector<int>> f(A<(1 >> 2)> a) {\n x();  // @f\n}",
    "constructor": "A::A(int a)\n: x_(a), y_{a}, B<C>{a}, z_{[] { return 1; }()}\n{\n f();  // @A::A\n}\nint y;  // @",
    "constructor in class": "class A {\n A() : x_(1), y_{2} {\n f();  // @A::A\n }\n int z;  // @A\n};",
    "all-capitals constructor": "struct PID { PID(int a) {\n x();  // @PID::PID\n} };",
    "destructor": "A::~A() {\n x();  // @A::~A\n}",
    "function try block": "A::A() try : x_(1) {\n x();  // @A::A\n} catch (...) {\n}\nvoid f() {\n x();  // @f\n}",
    "call operator": "struct A { int operator()(int a) const {\n x();  // @A::operator()\n} };",
    "comparison operators": (
        "bool operator<(A a, A b) {\n x();  // @operator<\n}\n"
        "bool A::operator==(const A & b) {\n x();  // @A::operator==\n}"
    ),
    "shift operator": "std::ostream & operator<<(std::ostream & o, A a) {\n x();  // @operator<<\n}",
    "assignment operator": "A & A::operator=(const A & a) {\n x();  // @A::operator=\n}",
    "conversion operator": "A::operator bool() const {\n x();  // @A::operator bool\n}",
    "lambda argument": "void f() {\n run([](int a) {\n  x();  // @f\n });\n}",
    "lambda variable": "auto l = [](int a) {\n x();  // @\n};\nvoid f() {\n x();  // @f\n}",
    "default argument in braces": "void f(std::map<int, int> m = {}, A a = A{1}) {\n x();  // @f\n}",
    "initializer": "int a[] = {\n 1,  // @\n};\nA b{1};\nvoid f() {\n x();  // @f\n}",
    "trailing return": "auto f(int a) -> decltype(g(a)) {\n x();  // @f\n}",
    "noexcept": "void f() noexcept(noexcept(g())) {\n x();  // @f\n}",
    "thread annotation": "void f() REQUIRES(mutex_) {\n x();  // @f\n}",
    "enable_if": "std::enable_if_t<(N < 3), void> f() {\n x();  // @f\n}",
    "function type argument": "std::function<void(int)> f() {\n x();  // @f\n}",
    "declspec": "__declspec(dllexport) int f(int a) {\n x();  // @f\n}",
    "export macro with argument": "EXPORT(x) int f(int a) {\n x();  // @f\n}",
    "macro line before": "PLUGINLIB_EXPORT_CLASS(a::B, a::C)\n\nnamespace a {\nvoid B::f() {\n x();  // @a::B::f\n}\n}",
    "test macro": (
        "TEST(Walker, turns_left) {\n x();  // @TEST(Walker, turns_left)\n"
        "}\nTEST_F(A, B)\n{\n x();  // @TEST_F(A, B)\n}"
    ),
    "Qt class": (
        "class A : public Q\n{\n Q_OBJECT\npublic Q_SLOTS:\n"
        " void f() {\n  x();  // @A::f\n }\nprivate:\n int y;  // @A\n};"
    ),
    "strings and characters": "void f() {\n g(\"}\\\"}\", '}', '\\'', u8'}', L\"}\");  // @f\n}",
    "raw string": 'void f() {\n g(R"x(} )" )x");  // @f\n}\nint y;  // @',
    "digit separators": "void f() {\n int a = 1'000; int b = 0xFF'FF; g('}');  // @f\n}",
    "comments": "void f() {\n // }\n /* } */ g();  // @f\n}",
    "directives": "#define OPEN {\n#define LONG { \\\n  {\nvoid f() {\n x();  // @f\n}\nint y;  // @",
    "both branches open": "#if A\nvoid f(int a) {\n#else\nvoid f() {\n#endif\n x();  // @f\n}\nint y;  // @",
    "branches in a body": (
        "void f() {\n#ifdef A\n if (a) {\n#elif B\n if (b) {\n#endif\n x();  // @f\n }\n}\nint y;  // @"
    ),
    "dead branch": "#if 0\nvoid f() {\n#endif\nint y;  // @",
    "guarded extern C": (
        '#ifdef __cplusplus\nextern "C" {\n#endif\nvoid f() {\n'
        " x();  // @f\n}\n#ifdef __cplusplus\n}\n#endif\nint y;  // @"
    ),
    "CRLF": "void f() {\r\n x();  // @f\r\n}\r\nint y;  // @",
}

PYTHON = {
    "functions": "def f(a):  # @f\n    return a  # @f\n\nx = 1  # @",
    "class": "class A(B):  # @A\n    x = 1  # @A\n    def f(self):\n        pass  # @A.f\n    y = 2  # @A",
    "nested": "def f():\n    def g():\n        pass  # @f.g\n    return g  # @f",
    "async": "async def f():\n    await g()  # @f",
    "decorated": "@d\ndef f():\n    pass  # @f",
    "blocks are no scopes": "def f():\n    if a:\n        for b in c:\n            d()  # @f",
    "under if": "if A:\n    def f():\n        x()  # @f\nelse:\n    y()  # @",
    "one line": "class A: pass  # @A\nx = 1  # @",
    "comment at column 0": "def f():\n    a()\n# b\n    c()  # @f\n# d  # @\nx = 1",
    "string over lines": 'def f():\n    a = """\ndef g():\nx\n"""\n    b()  # @f',
    "brackets over lines": "def f():\n    a = [\n1,\n]\n    b()  # @f\nc()  # @",
    "backslash": "def f():\n    a = 1 + \\\n2\n    b()  # @f",
    "signature over lines": "def f(\n    a,\n    b,\n):\n    c()  # @f",
    "tabs": "class A:\n\tdef f(self):\n\t\tx()  # @A.f\n\ty = 1  # @A",
    "Python 2": "def f():\n    print 'a'  # @f\n    exec 'b'\nclass A:\n    x = 0777L  # @A",
    "open bracket": "def f():\n    a(\n\ndef g():\n    b()  # @g",
    "quote in a comment": "def f():\n    a()  # don't\n    b()  # @f",
    "quotes": "def f():\n    a('\"', \"#\", '\\'')  # @f\nx = ''''a'''  # @",
}

OTHER = [("", "cpp"), ("", "python"), ("def f():\n    x", "cmake"), ("<a/>", "xml"), ("int f() { }", "interface")]

BROKEN = [
    "}}}}} void f() {", "void f( {", ")))", "R\"(", "/* open", "\"open", "'", "#if\n#else\n#endif\n#endif\n#else",
    "class {{{{", "template <", "operator", "namespace", "::::", "a < b < c {", "\\", "\0\x01", "{" * 3000,
    "namespace a {" * 3000, "void f(" * 3000, "a{}" * 3000, "A():" + "b{}," * 3000, "#if A\n" * 3000, "R\"x(" * 3000,
    "(" * 3000 + "{" * 3000, "struct A { " * 3000 + "void f() {", "def f(:\n  '''", "  def f\n x\ny", "class\ndef\n",
]  # fmt: skip


@pytest.mark.parametrize("name", CPP)
def test_cpp(name: str) -> None:
    lines = marked(CPP[name], "cpp")
    assert [found for _, found in lines] == [expected.strip() for expected, _ in lines]


@pytest.mark.parametrize("name", PYTHON)
def test_python(name: str) -> None:
    lines = [(e, f) for e, f in marked(PYTHON[name], "python") if e != "d"]
    assert [found for _, found in lines] == [expected.strip() for expected, _ in lines]


@pytest.mark.parametrize(("text", "language"), OTHER)
def test_nothing_elsewhere(text: str, language: str) -> None:
    found = scopes(text, language)
    assert [found.at(line) for line in (0, 1, 2, 99)] == [""] * 4


@pytest.mark.parametrize("text", BROKEN, ids=range(len(BROKEN)))
def test_broken_input_is_read(text: str) -> None:
    for language in ("cpp", "python"):
        assert isinstance(scopes(text, language).at(1), str)
        assert len(scopes(text, language).at(1)) <= 400
