# SPDX-License-Identifier: Apache-2.0
"""Flow facts: ways through a body, uses of a variable, what values carry of a message."""

from __future__ import annotations

from typing import Any

import pytest

from haros_ci import syntax
from haros_ci.code.body import body_of, last_part, nodes
from haros_ci.code.codebase import Codebase, Routine, codebase
from haros_ci.code.paths import undone_ways
from haros_ci.code.taint import carried, followed
from haros_ci.code.transforms import is_caught
from haros_ci.code.uses import uses
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.index.index import Source


def cpp(text: str) -> tuple[Codebase, Routine]:
    code = codebase([Source("a.cpp", None, read_cpp(text))], lambda path: text)
    return code, code.routines("a.cpp")[0]


def python(text: str) -> tuple[Codebase, Routine]:
    code = codebase([Source("a.py", None, read_python(text), "a")], lambda path: text)
    return code, next(each for each in code.routines("a.py") if each.function.kind == "function")


def does(expression: syntax.Expression) -> bool:
    return any(isinstance(node, syntax.Call) and last_part(node.callee) == "done" for node in nodes(expression))


def undone(body: str) -> bool:
    _, routine = cpp(f"void f(int a) {{ {body} }}")
    return bool(undone_ways(routine.function.body or (), does, (1, 1)))


@pytest.mark.parametrize(
    "body",
    [
        "",
        "if (a) done();",
        "if (a) return; done();",
        "if (a) { done(); } else if (a > 2) { x(); }",
        "for (int i = 0; i < a; ++i) { done(); }",
        "while (true) { if (a) break; done(); }",
        "switch (a) { case 1: done(); break; default: x(); }",
        "switch (a) { case 1: return; default: done(); }",
        "try { x(); done(); } catch (const E &) { y(); }",
        "while (rclcpp::ok()) { if (a) return; } done();",
        "for (;;) { if (a) return; }",
        "if (!rclcpp::ok()) { return; } x();",
        "if (rclcpp::ok()) { x(); }",
        "while (a) { if (b()) { done(); return; } x(); }",
        "if (!valid(a)) { log(); return; } done();",
        "bool ok = true; if (a) { done(); ok = false; } if (ok) { x(); return; } done();",
        "bool ok = true; for (;;) { if (a) { done(); ok = false; break; } if (b) { ok = false; break; } } if (!ok) return; done();",
        "bool ok = true; if (a) { done(); ok = x(); return; } if (!ok) { return; } done();",
        "bool ok = true; if (a) { ok = false; } if (!ok) { return; } done();",
    ],
)
def test_a_way_leaves_it_undone(body: str) -> None:
    assert undone(body)


@pytest.mark.parametrize(
    "body",
    [
        "done();",
        "if (a) { done(); return; } done();",
        "if (a) { done(); } else { done(); }",
        "if (a) throw E(); done();",
        "if (!rclcpp::ok()) return; done();",
        "while (rclcpp::ok()) { x(); }",
        "while (true) { if (a) { done(); return; } }",
        "while (true) { if (a) { done(); break; } }",
        "for (int i = 0; i < a; ++i) { x(); } done();",
        "switch (a) { case 1: done(); break; default: done(); }",
        "switch (a) { case 1: x(); default: done(); }",
        "try { x(); done(); } catch (const E &) { done(); }",
        "try { x(); } catch (const E &) { y(); } done();",
        "auto r = done();",
        "if (done()) return;",
        "return done();",
        "#if X\nx();\n#endif\n",
        "do { done(); } while (a);",
        "if (rclcpp::ok()) { done(); }",
        "if (!goal.is_active) { return; } done();",
        "if (!server.isActive()) { return; } done();",
        "if (a && !rclcpp::ok()) { return; } done();",
        "bool on = true; while (on) { if (a) { done(); on = false; } }",
        "bool ok = false; for (int i = 0; i < 3; ++i) { if (a) { done(); ok = true; break; } } if (!ok) { done(); }",
        "bool ok = true; if (a) { done(); ok = false; } if (!ok) { return; } done();",
        "bool ok = true; if (a) { done(); ok = false; } if (ok == false) { return; } done();",
        "bool ok = true; if (a) { done(); ok = false; } if (ok) { done(); }",
        "bool ended = false; for (int i = 0; i < 3; ++i) { if (a) { done(); ended = true; break; } } if (ended) return; done();",
        "int state = 0; if (a) { done(); state = 2; } if (state == 2) { return; } done();",
    ],
)
def test_every_way_does_it(body: str) -> None:
    assert not undone(body)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("if (a) { done(); }", False),
        ("if (!a) { return; } done();", False),
        ("if (a != nullptr) { done(); }", False),
        ("if (a == nullptr) { return; } else { done(); }", False),
        ("if (a) { if (b) { done(); } }", True),
        ("if (b) { done(); }", True),
        ("if (a) { x(); }", True),
    ],
)
def test_a_pointer_that_is_given_is_not_null(body: str, expected: bool) -> None:
    _, routine = cpp(f"void f(int * a) {{ {body} }}")
    assert bool(undone_ways(routine.function.body or (), does, (1, 1), frozenset("a"))) is expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("ok = True\n if a:\n  done()\n  ok = False\n  break\n x()\n if ok:\n  done()", False),
        ("ok = True\n for i in a:\n  if i:\n   done()\n   ok = False\n   break\n if not ok:\n  return\n done()", False),
        ("kind = None\n if a:\n  done()\n  kind = 'x'\n if kind is not None:\n  return\n done()", False),
        ("ok = True\n if a:\n  ok = False\n if ok:\n  done()", True),
    ],
)
def test_a_flag_of_python_says_that_it_was_done(body: str, expected: bool) -> None:
    _, routine = python(f"def f(a):\n {body}\n")
    assert bool(undone_ways(routine.function.body or (), does, (1, 1))) is expected


def test_uses_of_a_variable() -> None:
    code, routine = cpp(
        "void f() { M m; m.header.stamp = now(); m.data[i].x = 1; use(m.size); fill(m); pub.publish(std::move(m));\n"
        "m.data.push_back(m.y); auto & r = m; g([&]() { m.z = 1; }); return m; }"
    )
    found = [
        (".".join(use.path), use.role, last_part(use.call.callee) if use.call else "")
        for use in uses(code, routine, "m")
    ]
    assert found == [
        ("header.stamp", "set", ""),
        ("data..x", "set", ""),
        ("size", "argument", "use"),
        ("", "argument", "fill"),
        ("", "argument", "publish"),
        ("data", "receiver", "push_back"),
        ("y", "argument", "push_back"),
        ("", "address", ""),
        ("", "returned", ""),
        ("", "captured", ""),
    ]
    assert uses(code, routine, "n") == ()


CARRIES = {
    "a member": "m.data",
    "joined": "'ls ' + m.data",
    "formatted": "f'ls {m.data}'",
    "by percent": "'ls %s' % m.data",
    "by a method": "m.data.strip()",
    "by a function": "str(m.data)",
    "an argument of format": "'{}'.format(m.data)",
    "one of two": "m.data if x else ''",
    "in a list": "['ls', m.data]",
}
CLEAN = {
    "a number": "int(m.data)",
    "its length": "len(m.data)",
    "quoted": "'ls ' + shlex.quote(m.data)",
    "compared": "m.data == 'x'",
    "looked up": "TABLE[m.data]",
    "looked up by get": "TABLE.get(m.data)",
    "another variable": "n.data",
    "a constant": "'ls'",
}


def value(text: str) -> Any:
    _, routine = python(f"def f(m):\n  return {text}\n")
    return body_of(routine.function).returns[0][0]


@pytest.mark.parametrize("case", CARRIES)
def test_a_value_carries_content(case: str) -> None:
    assert carried(value(CARRIES[case]), {"m": frozenset([()])})


@pytest.mark.parametrize("case", CLEAN)
def test_a_value_carries_none(case: str) -> None:
    assert not carried(value(CLEAN[case]), {"m": frozenset([()])})


def test_content_is_followed_one_call_deep() -> None:
    text = "def f(m):\n  a = m.data\n  g(a, 1)\n\ndef g(x, y):\n  sink(x)\n  h(x)\n\ndef h(z):\n  sink(z)\n"
    code, routine = python(text)
    found = [
        (where.title, len(way))
        for where, call, marks, way in followed(code, routine, {"m": frozenset([()])})
        if call.name == "sink" and any(carried(each, marks) for each in call.args)
    ]
    assert found == [("g", 1)]
    assert list(followed(code, routine, {})) == []


@pytest.mark.parametrize(
    ("handlers", "expected"),
    [
        ("catch (const tf2::TransformException & e) {}", True),
        ("catch (...) {}", True),
        ("catch (const std::exception & e) {}", True),
        ("catch (const OwnError & e) {}", True),
        ("catch (const std::out_of_range & e) {}", False),
    ],
)
def test_what_catches_a_lookup(handlers: str, expected: bool) -> None:
    code, routine = cpp(f"void f() {{ try {{ look(); }} {handlers} }}")
    assert is_caught(code.body(routine).calls[0].around) is expected
    code, routine = cpp("void f() { try { x(); } catch (...) { look(); } }")
    assert not is_caught(code.body(routine).calls[1].around)


def test_a_body_is_facts_in_the_order_of_the_text() -> None:
    code, routine = cpp("void f() { a(b(1)); int x = c(); if (d()) { e(); } static int s = 0; x = new T(2); }")
    body = code.body(routine)
    assert [call.name for call in body.calls] == ["a", "b", "c", "d", "e"]
    assert [call.is_bare for call in body.calls] == [True, False, False, False, True]
    assert [place.kind for place in body.calls[4].around] == ["then"]
    assert body.variables["s"][0].is_static and not body.variables["x"][0].is_static
    assert [kind.name for kind, _, _, _ in body.news] == ["T"]


def test_arguments_by_position_or_keyword() -> None:
    code, routine = python("def f():\n  g(1, b=2)\n  g(*c)\n")
    first, second = code.body(routine).calls
    assert first.argument(0, "a") == syntax.Number(1) and first.argument(1, "b") == syntax.Number(2)
    assert first.argument(2, "c") is None and second.argument(0, "a") is None
