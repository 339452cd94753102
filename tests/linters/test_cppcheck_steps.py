# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the places which lead to them refute, and those that stand."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted
from haros_ci.linters.cppcheck_steps import is_never_so

HEAD = '#include <cstdio>\nint main(int argc, char ** argv)\n{\n  FILE * file = fopen(argv[1], "r");\n'
OTHER = HEAD.replace("int main", "int load")


@pytest.mark.parametrize("rule", ["resourceLeak", "memleak"])
@pytest.mark.parametrize(
    "text",
    [
        HEAD + "  if (argc > 3) {\n    return -1;",
        HEAD + "  if (argc > 3)\n    return -1;",
        HEAD + "  for (int i = 0; i < argc; i++) {\n    if (argv[i]) {\n      return EXIT_FAILURE;",
        HEAD + "  auto all = [&](int i) { return i; };\n  if (all(argc)) {\n    return 1;",
        HEAD + "  use(file);\n}",
        "int main()\n{\n  int * p = new int;\n  return *p;",
    ],
)
def test_the_process_ends(rule: str, text: str) -> None:
    assert is_refuted(rule, "Resource leak: file", text.count("\n") + 1, text + "\n  }\n}\n" * (not text.endswith("}")))


@pytest.mark.parametrize("rule", ["resourceLeak", "memleak"])
@pytest.mark.parametrize(
    "text",
    [
        OTHER + "  if (argc > 3) {\n    return -1;",
        OTHER + "  use(file);\n}",
        HEAD + "  while (read(file)) {\n    int * p = new int;\n  }",
        HEAD + "  auto load = [&](int i) {\n    FILE * file = open(i);\n    return i;",
        HEAD + "  auto load = [argc] {\n    if (argc) {\n      return 1;",
        HEAD + "  auto load = [&](int i) { auto * p = new int; return i; };",
        HEAD + "  file = fopen(argv[2]); // return",
        "int Node::main()\n{\n  int * p = new int;\n  return *p;",
        "int domain()\n{\n  int * p = new int;\n  return *p;",
        "struct Node {\n  int main() {\n    int * p = new int;\n    return *p;",
        "",
    ],
)
def test_the_process_goes_on(rule: str, text: str) -> None:
    assert not is_refuted(rule, "Resource leak: file", text.count("\n") + 1, text + "\n  }\n}\n")


def zero(text: str, said: str = "Division by zero", calls: int = 0) -> bool:
    line = next(number for number, item in enumerate(text.split("\n"), 1) if "/" in item or "%" in item)
    steps = [
        ("a.c", line, said),
        *([("a.c", calls, "Calling function 'div', 1st argument 'n' value is 0")] * (calls > 0)),
    ]
    return is_never_so("zerodiv", "Division by zero.", steps, {"a.c": text}.__getitem__)


@pytest.mark.parametrize(
    "text",
    [
        "void fault() {\n  int x = 1/0;\n}",
        "void fault() {\n  int x = a % 0;\n}",
        "void fault() {\n  x /= (0);\n}",
        "void fault() {\n  volatile int x = a / b;\n}",
        "#define NOTHING 0\nint x = a / NOTHING;",
        "const int kNothing = 0;\nint x = a / kNothing;",
        "static constexpr int kNothing{0};\nint x = a % kNothing;",
    ],
)
def test_a_division_on_purpose(text: str) -> None:
    assert zero(text)


def test_a_function_whose_result_is_thrown_away() -> None:
    assert zero("int div(int n) {\n  return 5 / n;\n}\nvoid go() {\n  volatile int x = div(0);\n}\n", calls=5)
    assert not zero("int div(int n) {\n  return 5 / n;\n}\nvoid go() {\n  int x = div(0);\n}\n", calls=5)


@pytest.mark.parametrize(
    "text",
    [
        "int x = a / count;",
        "int count = 0;\nint x = a / count;",
        "int x = a / 10;",
        "int x = a / b; // 1/0",
        "const int kCount = 5;\nint x = a / kCount;",
        "#define COUNT 0.5\nint x = a / COUNT;",
        "volatile int count;\nint x = a / n;",
        "int x = a / n->count;",
        "int x = a / sizes[0];",
    ],
)
def test_a_division_that_nobody_means(text: str) -> None:
    assert not zero(text)


SETS = "template <class T>\nvoid Grid<T>::resize(int n) {\n  cells = new T[n];\n}\n"
MAKES = "template <class T>\nGrid<T>::Grid(int n) {\n  cells = NULL;\n  %s\n  cells[0] = 1;\n}\n"


def null(text: str, name: str = "cells") -> bool:
    lines = text.split("\n")
    first = next(number for number, item in enumerate(lines, 1) if f"{name} = NULL;" in item)
    steps = [
        ("a.cpp", first + 2, "Null pointer dereference"),
        ("a.cpp", first, f"Assignment '{name}=NULL', assigned value is 0"),
    ]
    return is_never_so("nullPointer", f"Null pointer dereference: {name}", steps, {"a.cpp": text}.__getitem__)


@pytest.mark.parametrize("call", ["resize(n);", "this->resize(n);", "if (n) { resize(n); }"])
def test_a_member_that_a_method_sets(call: str) -> None:
    assert null(MAKES % call + SETS)
    assert null(SETS + MAKES % call)


@pytest.mark.parametrize(
    "text",
    [
        MAKES % "other.resize(n);" + SETS,
        MAKES % "other->resize(n);" + SETS,
        MAKES % "// resize(n);" + SETS,
        MAKES % "clear(n);" + SETS,
        MAKES % "resize(n);",
        MAKES % "resize(n);" + SETS.replace("Grid<T>", "Other<T>"),
        MAKES % "resize(n);" + SETS.replace("new T[n]", "NULL"),
        MAKES % "resize(n);" + SETS.replace("cells = ", "other.cells = "),
        MAKES % "resize(n);" + SETS.replace("cells = ", "cells == "),
        (MAKES % "resize(n);" + SETS).replace("Grid<T>::", ""),
    ],
)
def test_a_member_that_stays_null(text: str) -> None:
    assert not null(text)


def twice(text: str, rule: str = "oppositeInnerCondition") -> bool:
    numbers = [number for number, item in enumerate(text.split("\n"), 1) if "if (" in item or "while (" in item]
    said = (
        ("opposite inner condition: done", "outer condition: !done")
        if rule == "oppositeInnerCondition"
        else ("Testing identical condition '!done'", "If condition '!done' is true, the function will return/exit")
    )
    steps = [("a.cpp", numbers[1], said[0]), ("a.cpp", numbers[0], said[1])]
    return is_never_so(rule, "Identical condition '!done', second.", steps, {"a.cpp": text}.__getitem__)


WAITS = "void Node::wait()\n{\n  while (!done) {\n    if (done) break;\n    spin();\n  }\n}\n"


@pytest.mark.parametrize(
    "text",
    [
        WAITS + "void Node::heard()\n{\n  done = true;\n}\n",
        WAITS + "void Node::heard()\n{\n  this->done = true;\n}\n",
        WAITS.replace("\n{\n", "\n{\n  bool done = false;\n  auto heard = [&, this](int i) { done = true; };\n"),
        WAITS.replace(
            "\n{\n", "\n{\n  bool done = false;\n  auto heard = [&]() {\n    if (x) { done = true; }\n  };\n"
        ),
        "void f() {\n  if (!done) return;\n  // done = ask(); todo\n  if (!done) return;\n}\n",
        "void f() {\n  if (!done) return;\n  /* done = ask();\n  */\n  if (!done) return;\n}\n",
    ],
)
def test_a_condition_that_somebody_else_changes(text: str) -> None:
    assert twice(text)
    assert twice(text, "identicalConditionAfterEarlyExit")


@pytest.mark.parametrize(
    "text",
    [
        WAITS,
        WAITS + "void Node::heard()\n{\n  other.done = true;\n}\n",
        WAITS + "void Node::heard()\n{\n  // done = true;\n}\n",
        WAITS.replace("while", "if") + "void Node::heard()\n{\n  done = true;\n}\n",
        WAITS.replace("\n{\n", "\n{\n  bool done = false;\n") + "void other()\n{\n  bool done = true;\n}\n",
        WAITS.replace("\n{\n", "\n{\n  bool done = false;\n  auto heard = [&]() { other = true; };\n"),
        WAITS.replace("\n{\n", "\n{\n  bool done = false;\n  auto heard = [](bool done) { done = true; };\n"),
        "void f() {\n  if (!done) return;\n  // done\n  if (!done) return;\n}\n",
        "void f() {\n  // done = ask();\n  if (!done) return;\n  if (!done) return;\n}\n",
        "void f() {\n  if (!done) return;\n  if (!done) return;\n}\n",
    ],
)
def test_a_condition_that_stays(text: str) -> None:
    assert not twice(text)
    assert not twice(text, "identicalConditionAfterEarlyExit")


def test_conditions_in_two_files() -> None:
    steps = [("a.h", 2, "opposite inner condition: done"), ("b.h", 1, "outer condition: !done")]
    assert not is_never_so("oppositeInnerCondition", "Opposite", steps, lambda path: "")


CONNECT = "connect(this, SIGNAL(changed()), this, SLOT(refresh()));"


@pytest.mark.parametrize("line", [CONNECT, "disconnect(a, SIGNAL(go(int, int)), this, SLOT(refresh(int)));"])
def test_a_slot_that_is_named_is_not_called(line: str) -> None:
    steps = [
        ("a.h", 1, "update is a pure virtual function"),
        ("a.h", 2, "Calling refresh"),
        ("a.h", 3, "Calling update"),
    ]
    text = f"virtual void update() = 0;\n{line}\nvoid refresh() {{ update(); }}\n"
    assert is_never_so("pureVirtualCall", "Call of pure virtual function 'update'", steps, {"a.h": text}.__getitem__)


@pytest.mark.parametrize(
    "line",
    ["refresh();", f"{CONNECT} refresh();", "connect(this, SLOT(other())); this->refresh();", "SLOT(refresh);", ""],
)
def test_a_slot_that_is_called(line: str) -> None:
    steps = [
        ("a.h", 1, "update is a pure virtual function"),
        ("a.h", 2, "Calling refresh"),
        ("a.h", 3, "Calling update"),
    ]
    text = f"virtual void update() = 0;\n{line}\nvoid refresh() {{ update(); }}\n"
    assert not is_never_so(
        "pureVirtualCall", "Call of pure virtual function 'update'", steps, {"a.h": text}.__getitem__
    )
