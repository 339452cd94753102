# SPDX-License-Identifier: Apache-2.0
"""The exact tier: what libclang tells of calls where headers are installed, and what it had better not tell."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from haros_ci.extract.cpp import exact
from haros_ci.extract.cpp.exact import ExactArgument as Argument
from haros_ci.extract.cpp.exact import ExactCall, ExactFile
from haros_ci.model.workspace import Problem

needs_clang = pytest.mark.skipif(importlib.util.find_spec("clang") is None, reason="libclang is not installed")

STRING = """#pragma once
#include <stddef.h>
namespace std {
template <class T> class allocator {};
inline namespace __cxx11 {
template <class C, class A = allocator<C>> class basic_string {
public:
  basic_string(const C *, const A & = A());
  basic_string(size_t count, C c);
  basic_string(const basic_string &);
};
template <class C, class A> basic_string<C, A> operator+(const basic_string<C, A> &, const C *);
}
using string = basic_string<char>;
template <class T, class A = allocator<T>> class vector {};
}
"""
MIDDLEWARE = """#pragma once
#include <mw_string.h>
namespace msgs {
template <class A> struct Text_ {};
typedef Text_<std::allocator<void>> Text;
}
namespace mw {
struct Publisher { Publisher(); bool publish(); };
class Handle {
public:
  template <class M> Publisher advertise(const std::string & topic, int queue, bool latch = false);
  template <class M> void subscribe(const std::string &, int, void (*callback)(const M &));
  void set(const std::string &, bool);
  void set(const std::string &, int);
  void set(const std::string &, double);
  void set(const std::string &, const std::string &);
  template <class T> void any(const T &);
};
struct Sub { Sub(Handle &, const std::string & topic, int queue = 1); };
inline Handle & handle() { static Handle h; return h; }
}
#define ADVERTISE(topic) nh.advertise<msgs::Text>(topic, QUEUE)
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    (tmp_path / "ws").mkdir()
    (tmp_path / "include").mkdir()
    (tmp_path / "include" / "mw_string.h").write_text(STRING)
    (tmp_path / "include" / "mw.h").write_text(MIDDLEWARE)
    return tmp_path


def worker(request: str | bytes) -> subprocess.CompletedProcess[bytes]:
    data = request.encode() if isinstance(request, str) else request
    command = [sys.executable, "-I", "-m", "haros_ci.extract.cpp.exact_worker"]
    return subprocess.run(command, input=data, capture_output=True, timeout=300, check=False)


def ask(tree: Path, source: str | bytes, flags: Sequence[str] = (), name: str = "a.cpp") -> str:
    """The answer to where every call of *source* may begin."""
    data = source.encode() if isinstance(source, str) else source
    (tree / "ws" / name).write_bytes(data)
    lines = data.decode("utf-8-sig", "replace").split("\n")
    calls = tuple((i, c) for i, line in enumerate(lines, 1) for c in range(1, min(len(line), 200) + 1))
    (request,) = exact.requests(str(tree / "ws"), [ExactFile(name, tuple(flags), calls)], [str(tree / "include")])
    done = worker(request)
    assert done.returncode == 0, done.stderr
    return done.stdout.decode()


def told(tree: Path, statements: str, before: str = "", **options: Any) -> dict[tuple[int, int], tuple[ExactCall, ...]]:
    """Line and column -> calls; *statements* begin on line 1, with ``mw::Handle nh``."""
    head = f"#include <mw.h>\n{before}\nvoid f(mw::Handle nh) {{\n"
    shift = head.count("\n")
    answer = ask(tree, f"{head}{statements}\n}}\n", **options)
    return {(line - shift, column): calls for (_, line, column), calls in exact.parse(answer).items() if line > shift}


def setting(tree: Path, expression: str, before: str = "") -> Argument:
    """What is told of the second argument of ``nh.set("k", expression)``."""
    (call,) = told(tree, f'nh.set("k", {expression});', before)[1, 1]
    assert call.callee == "mw::Handle::set"
    return call.arguments[1]


def anything(tree: Path, expression: str, before: str = "") -> Argument:
    """What is told of the argument of ``nh.any(expression)``."""
    (call,) = told(tree, f"nh.any({expression});", before)[1, 1]
    return call.arguments[0]


# What is told.


@needs_clang
def test_a_call_with_its_callee_types_values_and_templates(tree: Path) -> None:
    found = told(tree, 'auto p = nh.advertise<msgs::Text>("chatter", 2 * K);', "constexpr int K = 5;")
    expected = ExactCall(
        "mw::Handle::advertise",
        "mw::Publisher",
        (Argument("std::string", "chatter", "char*"), Argument("int", 10, "int")),
        ("msgs::Text",),
    )
    assert found[1, 10] == (expected,)


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before", "expected"),
    [
        ("1", "", Argument("int", 1, "int")),
        ("true", "", Argument("bool", True, "bool")),
        ("1.5", "", Argument("double", 1.5, "double")),
        ("2.5f", "", Argument("double", 2.5, "float")),
        ("A", "enum E { A = 4 };", Argument("int", 4, "E")),
        ("LIMIT + 1", "#define LIMIT 41", Argument("int", 42, "int")),
        ("K", "static const int K = 3;", Argument("int", 3, "int")),
        ("g", "int g = 3;", Argument("int", None, "int")),
        ("f(1)", "constexpr double f(double x) { return x * 2; }", Argument("double", 2.0, "double")),
        ("o.x()", "struct Q { const double & x() const; }; Q o;", Argument("double", None, "double")),
        ('std::string("v")', "", Argument("std::string", "v", "std::string")),
    ],
)
def test_an_overload_and_its_argument(tree: Path, expression: str, before: str, expected: Argument) -> None:
    assert setting(tree, expression, before) == expected


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before", "value"),
    [
        ("S", 'static const char * const S = "a";', "a"),
        ("S", 'constexpr char S[] = "a";', "a"),
        ("S", 'const std::string S = "a";', "a"),
        ("S", 'const std::string S("a");', "a"),
        ("S", 'const std::string R = "a"; const std::string S = R;', "a"),
        ("C::S", 'struct C { static const std::string S; }; const std::string C::S = "a";', "a"),
        ('S + "/b"', 'const std::string S = "a";', "a/b"),
        ('A "/b"', '#define A "a"', "a/b"),
        (r'"\x41\n\"é"', "", 'A\n"é'),
        ("__FILE__", "", "a.cpp"),
    ],
)
def test_a_constant_text(tree: Path, expression: str, before: str, value: str) -> None:
    assert anything(tree, expression, before).value == value


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before"),
    [
        ("S", 'const char * S = "a";'),
        ("S", 'char S[] = "a";'),
        ("S", 'std::string S = "a";'),
        ("S", "extern const std::string S;"),
        ("S", "const std::string S(3, 'a');"),
        ("S", 'bool b(); const std::string S = b() ? "a" : "b";'),
        ("o.S", 'struct C { const std::string S = "a"; }; extern C o;'),
        (r'"a\0b"', ""),
        (r'"\xff"', ""),
        ("(int *)0", ""),
    ],
)
def test_no_constant_text(tree: Path, expression: str, before: str) -> None:
    assert [call.arguments[0].value for call in told(tree, f"nh.any({expression});", before)[1, 1]] == [None]


@needs_clang
@pytest.mark.parametrize("expression", ["__TIME__", "__DATE__", "__TIMESTAMP__"])
def test_the_time_of_day_is_not_told(tree: Path, expression: str) -> None:
    for calls in told(tree, f"nh.any({expression});").values():
        assert all(a.value is None for call in calls for a in call.arguments)


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before", "type_"),
    [
        ("v", "const std::vector<std::string> v;", "std::vector<std::string>"),
        ("v", "std::vector<msgs::Text *> * v;", "std::vector<msgs::Text>"),
        ("v", "template <class T, int N> struct V {}; V<unsigned long, -3> v;", "V<unsigned long, -3>"),
        ("v", "namespace { struct S {}; } S v;", "S"),
        ("v", "namespace n { enum class E { a }; } auto v = n::E::a;", "n::E"),
        ("v", "auto v = mw::handle();", "mw::Handle"),
        ("[] {}", "", None),
        ("&g", "void g(int);", None),
    ],
)
def test_a_type_is_spelled_as_projects_write_it(tree: Path, expression: str, before: str, type_: str | None) -> None:
    assert anything(tree, expression, before).written == type_


@needs_clang
def test_templates_are_deduced(tree: Path) -> None:
    (call,) = told(tree, 'nh.subscribe("t", 1, callback);', "void callback(const msgs::Text &);")[1, 1]
    assert call.templates == ("msgs::Text",)
    assert [a.written for a in call.arguments] == ["char*", "int", None]


@needs_clang
def test_calls_that_begin_at_one_place(tree: Path) -> None:
    calls = told(tree, 'nh.advertise<msgs::Text>("a", 1).publish();')[1, 1]
    assert [c.callee for c in calls] == ["mw::Publisher::publish", "mw::Handle::advertise"]
    assert exact.pick(calls, "advertise") == calls[1]
    assert exact.pick(calls, "advertise", 3) is None
    assert exact.pick(calls, "subscribe") is None


@needs_clang
def test_a_macro_makes_its_call_where_it_is_used(tree: Path) -> None:
    before = "#define QUEUE 7\n#define KEEP(x) do { x; } while (0)"
    found = told(tree, ' ADVERTISE("a");\nKEEP(nh.set("k", 1));', before)
    (made,) = found[1, 2]
    assert (made.callee, made.is_macro, made.templates) == ("mw::Handle::advertise", True, ("msgs::Text",))
    assert [a.value for a in made.arguments] == ["a", 7]
    (kept,) = found[2, 6]
    assert (kept.callee, kept.is_macro) == ("mw::Handle::set", False)


@needs_clang
def test_constructions(tree: Path) -> None:
    before = 'struct N { N(mw::Handle & h) : sub(h, "field") {} mw::Sub sub; };\ntypedef mw::Sub Alias;'
    source = 'mw::Sub s(nh, "local", 2);\nauto p = new mw::Sub(nh, "new");\ng(Alias(nh, "alias"));'
    found = told(tree, source, f"void g(mw::Sub);\n{before}")
    assert found[1, 9][0].arguments[1:] == (Argument("std::string", "local", "char*"), Argument("int", 2, "int"))
    assert [(c.kind, c.callee, c.type, c.arguments[1].value) for c in found[2, 10]] == [
        ("new", "mw::Sub", "mw::Sub", "new")
    ]
    alias = exact.pick(found[3, 3], "Alias")
    assert alias is not None and (alias.kind, alias.arguments[1].value) == ("construct", "alias")
    place = exact.parse(ask(tree, f"#include <mw.h>\n{before}\n"))["a.cpp", 2, 32]
    assert [(c.kind, c.callee, c.arguments[1].value) for c in place] == [("construct", "mw::Sub", "field")]


@needs_clang
def test_columns_are_code_points_and_a_mark_is_none(tree: Path) -> None:
    assert list(told(tree, '/* é𝄞 */ nh.set("k", 1);')) == [(1, 10)]
    answer = ask(tree, b"\xef\xbb\xbfint g(int); int x = g(2);\r\nint y = g(3);\r\n")
    assert list(exact.parse(answer)) == [("a.cpp", 1, 21), ("a.cpp", 2, 9)]


@needs_clang
def test_flags_reach_the_compiler(tree: Path) -> None:
    (tree / "ws" / "own").mkdir()
    (tree / "ws" / "own" / "own.h").write_text("inline int own(const char *);\n")
    flags = [f"-I{tree / 'ws' / 'own'}", '-DTOPIC="x"', "-std=c++11"]
    answer = exact.parse(ask(tree, "#include <own.h>\nint x = own(TOPIC);\n", flags))
    assert answer["a.cpp", 2, 9][0] == ExactCall("own", "int", (Argument("char*", "x", "char*"),))


@needs_clang
def test_a_compilers_headers_need_not_be_installed(tree: Path) -> None:
    source = "#include <stddef.h>\n#include <stdarg.h>\n#include <limits.h>\n#include <float.h>\n#include <stdbool.h>\n"
    answer = exact.parse(ask(tree, f"{source}int g(size_t, int);\nint x = g(INT_MAX, CHAR_BIT);\n"))
    assert [a.value for a in answer["a.cpp", 7, 9][0].arguments] == [2147483647, 8]


@needs_clang
def test_headers_lie_where_packages_and_compilers_put_them(tree: Path) -> None:
    system = tree / "system"
    for path, value in (("c++/9/lib.h", 9), ("c++/12/lib.h", 12), ("features.h", 0), ("c++/12/two.h", 1), ("two.h", 2)):
        (system / path).parent.mkdir(parents=True, exist_ok=True)
        (system / path).write_text(f"#pragma once\nenum {{ {Path(path).stem}_{value} = {value} }};\n")
    (tree / "include" / "pkg" / "pkg").mkdir(parents=True)
    (tree / "include" / "pkg" / "pkg" / "nested.h").write_text("enum { nested = 7 };\n")
    (tree / "ws" / "a.cpp").write_text(
        "#include <lib.h>\n#include <pkg/nested.h>\n#include <two.h>\nint g(int, int, int);\n"
        "int x = g(lib_12, nested, two_1);\n"
    )
    headers = [str(system), str(tree / "include")]
    (request,) = exact.requests(str(tree / "ws"), [ExactFile("a.cpp", (), ((5, 9),))], headers)
    ((_, (call,)),) = exact.parse(worker(request).stdout.decode()).items()
    assert [a.value for a in call.arguments] == [12, 7, 1]


# What clang says wrongly, or not at all, because it does not know everything.


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before"),
    [
        ("v", "typedef Unknown T; T v;"),
        ("v", "using T = Unknown; const T & v;"),
        ("v.front()", "template <class T> struct L { T & front(); }; typedef Unknown U; L<U> v;"),
        ("g()", "typedef Unknown T; T g();"),
        ("g()", "typedef Unknown T; auto g() { T t; return t; }"),
        ("v.x", "typedef Unknown T; struct V { T x; }; V v;"),
        ("w", "typedef Unknown T; T v; auto w = v;"),
        ("w", "typedef Unknown T; const T v = 3; const auto w = v;"),
    ],
)
def test_an_unknown_type_is_not_int(tree: Path, expression: str, before: str) -> None:
    assert [c.arguments[0].type for c in told(tree, f"nh.any({expression});", before).get((1, 1), ())] in ([None], [])
    for calls in told(tree, f'nh.set("k", {expression});', before).values():
        assert all(a.type != "int" and a.written != "int" and a.value != 3 for c in calls for a in c.arguments)


@needs_clang
@pytest.mark.parametrize(
    ("expression", "before"),
    [("v", "Unknown v;"), ("g()", "Unknown g();"), ("g(1)", ""), ("v.x", "struct V { Unknown x; }; V v;")],
)
def test_an_unknown_type_is_unknown(tree: Path, expression: str, before: str) -> None:
    calls = told(tree, f'nh.set("k", {expression});', before).get((1, 1), ())
    assert all(c.callee is None and c.arguments[1] == Argument(None) for c in calls)


@needs_clang
def test_a_macro_that_the_build_may_define_is_unknown(tree: Path) -> None:
    fallback = '#ifndef TOPIC\n# define TOPIC "fallback"\n#endif\n#if !defined(SIZE)\n#define SIZE 3\n\n#endif\n'
    (tree / "ws" / "fallback.h").write_text(f"#ifndef GUARD_H\n#define GUARD_H 1\n{fallback}#endif\n")
    for before in (fallback, f'#include "{tree}/ws/fallback.h"\nconst char * const NAME = TOPIC;\n'):
        source = f"#include <mw.h>\n{before}int g(const char *, int);\n"
        line = source.count("\n") + 1
        here = ("a.cpp", line, 9)
        unknown = exact.parse(ask(tree, f"{source}int x = g(TOPIC, SIZE);\n"))
        assert [a for c in unknown.get(here, ()) for a in c.arguments if a.value is not None] == []
        known = exact.parse(ask(tree, f"{source}int x = g(TOPIC, SIZE);\n", ['-DTOPIC="x"', "-USIZE"]))
        assert [a.value for a in known[here][0].arguments] == ["x", 3]


@needs_clang
def test_an_overload_that_clang_lost_makes_the_choice_doubtful(tree: Path) -> None:
    before = "struct P { void put(Unknown); void put(double); }; P p;"
    (call,) = told(tree, "p.put(3);", before)[1, 1]
    assert call.arguments == (Argument(None, 3, "int"),)


@needs_clang
def test_a_base_that_clang_lost_may_hold_the_callee(tree: Path) -> None:
    before = "int make(int);\nnamespace n { int other(int); }\nstruct A : Unknown { int a; void m() {\n"
    before += "make(1); n::other(2); } };"
    answer = exact.parse(ask(tree, f"{before}\nstruct B : A {{ void m() {{ make(3); }} }};\nint x = make(4);\n"))
    assert [(p[1:], c[0].callee) for p, c in answer.items()] == [
        ((4, 1), None),
        ((4, 10), "n::other"),
        ((5, 27), None),
        ((6, 9), "make"),
    ]


@needs_clang
def test_what_depends_on_a_template_parameter_is_unknown(tree: Path) -> None:
    before = 'template <class T> void t(mw::Handle nh, T x) {\nnh.any(x); nh.advertise<T>("a", 1); x.go("b"); }'
    answer = exact.parse(ask(tree, f"#include <mw.h>\n{before}\n"))
    assert ("a.cpp", 3, 1) not in answer
    assert answer["a.cpp", 3, 12][0].callee is None
    assert answer["a.cpp", 3, 12][0].templates == ()
    assert answer["a.cpp", 3, 37][0].arguments == (Argument(None, "b", "char*"),)


@needs_clang
def test_other_files_and_other_places_are_not_told(tree: Path) -> None:
    (tree / "ws" / "b.h").write_text("\n\nint g(int); int y = g(1);\n")
    (tree / "ws" / "a.cpp").write_text('#include "b.h"\n\nint x = g(1); int z = g(2);\n')
    root, headers = str(tree / "ws"), [str(tree / "include")]
    (request,) = exact.requests(root, [ExactFile("a.cpp", (), ((3, 9), (3, 21)))], headers)
    assert list(exact.parse(worker(request).stdout.decode())) == [("a.cpp", 3, 9)]


# Hostile and senseless requests.


def test_no_headers_no_request_and_an_empty_answer(tree: Path) -> None:
    (tree / "ws" / "a.cpp").write_text("int x = g(1);\n")
    asked = ExactFile("a.cpp", (), ((1, 9),))
    assert exact.requests(str(tree / "ws"), [asked], []) == ()
    assert exact.requests(str(tree / "ws"), [ExactFile("a.cpp", (), ())], ["/usr/include"]) == ()
    files = [{"path": "a.cpp", "calls": [[1, 9]]}]
    done = worker(json.dumps({"root": str(tree / "ws"), "files": files, "headers": []}))
    assert (done.returncode, json.loads(done.stdout)) == (0, {"files": {}, "failed": {}})


@pytest.mark.parametrize(
    "request_",
    [
        b"",
        b"\xff\xfe",
        b"[]",
        b"{}",
        b"null",
        b"[" * 100_000,
        b'{"root": "relative", "files": [], "headers": []}',
        b'{"root": "/nowhere/at/all", "files": [], "headers": []}',
        b'{"root": "/", "files": {}, "headers": []}',
        b'{"root": 1, "files": [], "headers": []}',
    ],
)
def test_what_is_no_request_is_an_exit_code(request_: bytes) -> None:
    done = worker(request_)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"not a request")


@needs_clang
def test_paths_stay_inside_the_root(tree: Path) -> None:
    (tree / "secret.cpp").write_text("int g(int); int x = g(1);\n")
    (tree / "ws" / "link.cpp").symlink_to(tree / "secret.cpp")
    (tree / "ws" / "directory.cpp").mkdir()
    os.mkfifo(tree / "ws" / "pipe.cpp")
    names = ["../secret.cpp", str(tree / "secret.cpp"), "link.cpp", "missing.cpp", "directory.cpp", "pipe.cpp", "a\0b"]
    files = [{"path": name, "flags": [], "calls": [[1, 21]]} for name in names]
    odd: list[Any] = [None, 3, {"path": 4}, {"flags": []}]
    done = worker(json.dumps({"root": str(tree / "ws"), "files": files + odd, "headers": [str(tree / "include")]}))
    reason = "not a readable file inside the workspace"
    assert json.loads(done.stdout) == {"files": {}, "failed": dict.fromkeys(names, reason)}
    assert exact.failures(done.stdout.decode()) == tuple(Problem(name, reason) for name in sorted(names))


@needs_clang
def test_what_an_include_brings_from_outside_is_not_told(tree: Path) -> None:
    (tree / "secret.h").write_text('const char * const SECRET = "s";\n')
    answer = ask(tree, '#include "../secret.h"\nint g(const char *);\nint x = g(SECRET);\n')
    assert exact.parse(answer) == {}
    assert [p.message for p in exact.failures(answer)] == [
        "includes a file from outside of the workspace and the installed headers"
    ]


@needs_clang
def test_flags_that_are_not_harmless_are_left_out(tree: Path) -> None:
    outside = tree / "outside"
    outside.mkdir()
    (outside / "o.h").write_text("#define OUTSIDE 1\n")
    (tree / "ws" / "evil.so").write_text("")
    flags = [
        f"-I{outside}", "-isystem", str(outside), "-include", str(outside / "o.h"), "-Xclang", "-load", "-Xclang",
        str(tree / "ws" / "evil.so"), f"-fplugin={tree / 'ws' / 'evil.so'}", "-o", str(tree / "ws" / "out"),
        "-fsyntax-only", "-MD", "-I", "@response", "-DX(", "-D", "-std=", "-Irelative", "-I",
    ]  # fmt: skip
    source = "#if __has_include(<o.h>) || defined OUTSIDE\n#error\n#else\nint g(int); int x = g(1);\n#endif\n"
    assert list(exact.parse(ask(tree, source, flags))) == [("a.cpp", 4, 21)]
    assert sorted(p.name for p in (tree / "ws").iterdir()) == ["a.cpp", "evil.so"]


@needs_clang
@pytest.mark.parametrize(
    "source",
    [
        "int x = " + "(" * 10_000 + "1" + ")" * 10_000 + ";\n",
        "int g(int); int x = g(" + "1+" * 5_000 + "1);\n",
        "void f() " + "{" * 10_000 + "\n",
        "\0\x01\x02 not C++ at all \xff {{{ <<<\n",
        '#include "a.cpp"\nint g(int); int x = g(1);\n',
        "template <int N> struct F { static const int v = F<N + 1>::v; }; int g(int); int x = g(F<0>::v);\n",
        "struct S;\nint x = S::y(" * 50,
        "",
    ],
)
def test_hostile_source_is_answered_or_ends_the_process(tree: Path, source: str) -> None:
    (tree / "ws" / "a.cpp").write_text(source, encoding="utf-8")
    calls = tuple((1, column) for column in range(1, 40))
    (request,) = exact.requests(str(tree / "ws"), [ExactFile("a.cpp", (), calls)], [str(tree / "include")])
    done = worker(request)
    if done.returncode == 0:
        assert set(json.loads(done.stdout)) == {"files", "failed"}
    else:
        assert exact.parse(done.stdout.decode()) == {}


# The request and the answer as text.


def test_requests_are_sorted_and_batched() -> None:
    files = [ExactFile(name, ("-DX",), ((2, 1), (1, 1), (1, 1))) for name in ("c", "a", "b")]
    texts = exact.requests("/ws", files, ["/h"], batch=2)
    assert [[f["path"] for f in json.loads(t)["files"]] for t in texts] == [["a", "b"], ["c"]]
    entry = {"path": "c", "flags": ["-DX"], "calls": [[1, 1], [2, 1]]}
    assert json.loads(texts[1]) == {"root": "/ws", "files": [entry], "headers": ["/h"]}
    assert exact.requests("/ws", files, ["/h"]) == exact.requests("/ws", reversed(files), ["/h"])


def answer(**changes: Any) -> str:
    argument = {"type": "int", "written": None, "value": 1, **changes.pop("argument", {})}
    call = {"kind": "call", "callee": "f", "type": None, "arguments": [argument], "templates": ["T", None]}
    return json.dumps({"files": {"a.cpp": {changes.pop("place", "1:2"): [{**call, "macro": False, **changes}]}}})


def test_an_answer_is_read() -> None:
    expected = ExactCall("f", None, (Argument("int", 1),), ("T", None))
    assert exact.parse(answer()) == {("a.cpp", 1, 2): (expected,)}
    assert exact.parse(answer(callee=None, kind="new")) != {}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "null",
        "[]",
        "{",
        "[" * 100_000,
        '{"files": []}',
        '{"files": {"a": []}}',
        '{"files": {"a": {"1:1": {}}}}',
        '{"files": {"a": {"1:1": [null]}}}',
        answer(place="0:1"),
        answer(place="1"),
        answer(place="1:-2"),
        answer(callee=3),
        answer(type=[]),
        answer(kind="other"),
        answer(macro=1),
        answer(arguments=None),
        answer(arguments=[None]),
        answer(templates=[1]),
        answer(templates={}),
        answer(argument={"type": 1}),
        answer(argument={"value": [1]}),
        answer(argument={"value": float("nan")}),
    ],
)
def test_wrong_shapes_are_dropped(text: str) -> None:
    assert exact.parse(text) == {}
    assert exact.failures(text) == ()


def test_pick_takes_only_what_is_certain() -> None:
    one, two = ExactCall("a::f", "int"), ExactCall("a::f", "bool")
    made = ExactCall("b::C", "b::C", kind="construct")
    assert exact.pick((one,), "f") == one
    assert exact.pick((one, one), "f") == one
    assert exact.pick((one, two), "f") is None
    assert exact.pick((one,), "g") is None
    assert exact.pick((made,), "Alias") == made
    assert exact.pick((made, one), "Alias") is None
    assert exact.pick((), "f") is None


def test_default_headers_exist_and_do_not_load_libclang() -> None:
    assert all(os.path.isdir(path) for path in exact.default_headers())
    code = "import sys; from haros_ci.extract.cpp import exact; exact.default_headers(); print('clang' in sys.modules)"
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
