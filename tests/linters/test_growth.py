# SPDX-License-Identifier: Apache-2.0
"""Little text that becomes much for a tool: the file is named, the tool is not asked about it, and the others are analysed."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from pathlib import Path

import pytest
from linter_samples import FakeLinter, MemoryStore, everything, workspace

from haros_ci.linters import cppcheck, growth, macro_growth, pylint
from haros_ci.linters.linter import LintOptions, Unit
from haros_ci.linters.run import lint
from haros_ci.model.workspace import Workspace


def doubled(count: int) -> str:
    return "#define A0 1\n" + "".join(f"#define A{n} A{n - 1} A{n - 1}\n" for n in range(1, count))


def with_arguments(count: int) -> str:
    return "#define A0(i) i\n" + "".join(f"#define A{n}(i) A{n - 1}(i) A{n - 1}(i)\n" for n in range(1, count))


def nested(name: str, depth: int) -> str:
    return f"int a = {f'{name}(' * depth}1{')' * depth};\n"


TWICE = "#define D(x) x x\n"
EXPANDING = {
    "doubled": doubled(40),
    "doubled, last first": "\n".join(reversed(doubled(40).splitlines())),
    "with arguments": with_arguments(40),
    "spliced": doubled(40).replace(" A", " \\\n A"),
    "other spelling": doubled(40).replace("#define", "%:define"),
    "comments between": doubled(40).replace("#define", "# /* a */ define"),
    "under conditions": f"#if 0\n{doubled(40)}#endif\n",
    "each of all others": "".join(f"#define A{n} {' '.join(f'A{m}' for m in range(12))}\n" for n in range(12)),
    "arguments in arguments": TWICE + nested("D", 30),
    "by another name": f"{TWICE}#define E D\n{nested('E', 30)}",
    "any arguments": f"#define D(...) __VA_ARGS__ __VA_ARGS__\n{nested('D', 30)}",
    "named ones": f"#define D(rest...) rest rest\n{nested('D', 30)}",
    "in a definition": f"{TWICE}#define Q(x) {'D(' * 30}x{')' * 30}\n",
    "defined once more with another parameter": TWICE + "#if 0\n#define D(y) y\n#endif\n" + nested("D", 30),
    "defined once more without parameters": TWICE + "#if 0\n#define D E\n#endif\n" + nested("D", 30),
    "a tail defined once more": TWICE + "#define E D\n#if 0\n#define E 1\n#endif\n" + nested("E", 30),
    "the second of two parameters": f"#define D(x, y) y y\n{nested('D', 30).replace('D(', 'D(1, ')}",
    "many large ones": doubled(18) + "#define P(x) A17 x\n" + "int a = P(1);\n" * 40,
}


@pytest.mark.parametrize("name", EXPANDING)
def test_macros_that_expand_to_too_much(tmp_path: Path, name: str) -> None:
    assert declined_by_cppcheck(tmp_path, {"a.cpp": EXPANDING[name]}) == {"a.cpp": growth.LARGE_EXPANSION}


QUIET = {
    "nothing": "",
    "numbers": "".join(f"#define A{n} {n}\n" for n in range(3_000)),
    "a chain": "#define A0 1\n" + "".join(f"#define A{n} (A{n - 1} + 1)\n" for n in range(1, 200)),
    "a chain, last first": "".join(f"#define A{n} (A{n - 1} + 1)\n" for n in range(200, 0, -1)),
    "itself": "#define A A A\n" * 40,
    "two of each other": "#define A B\n#define B A\n",
    "a circle": "#define A(x) B(x) + 1\n#define B(x) C(x) + 1\n#define C(x) A(x) + 1\nint a = A(1);\n",
    "a circle of two uses": "#define A(x) B(x) B(x)\n#define B(x) A(x)\nint a = A(1);\n",
    "a circle and a long way": "#define A(x) B(x) B0\n#define B(x) A(x)\nint a = A(1);\n#define B99 1\n"
    + "".join(f"#define B{n} B{n + 1} + 1\n" for n in range(99)),
    "few doublings": doubled(12),
    "the larger of two": "#define MAX(a, b) ((a) > (b) ? (a) : (b))\nint x = MAX(1, MAX(2, MAX(3, MAX(4, 5))));\n",
    "many uses": "#define CHECK(a) if (!(a)) { fail(#a, __FILE__, __LINE__); }\n" + "CHECK(x);\n" * 5_000,
    "words in a text": '#define A "A A A A A A"\n' * 40,
    "a list": "#define LIST(X) " + " ".join(f"X({n})" for n in range(500)) + "\nLIST(F)\n",
    "names alone": "#define D(x) x x\nint D; int a = D;\n" * 50,
    "no end": "#define D(x) x x\n" + "D(" * 5,
    "in a comment": "// " + " ".join(doubled(40).splitlines()),
    "defined elsewhere": "".join(f"A{n} A{n - 1}\n" for n in range(1, 40)),
}


@pytest.mark.parametrize("name", QUIET)
def test_macros_as_they_are_written(tmp_path: Path, name: str) -> None:
    assert declined_by_cppcheck(tmp_path, {"a.cpp": QUIET[name]}) == {}


def test_macros_of_a_header_hold_where_it_is_included(tmp_path: Path) -> None:
    files = {"include/a.hpp": doubled(40), "src/a.cpp": '#include "a.hpp"\n', "src/b.cpp": "int b;\n"}
    assert declined_by_cppcheck(tmp_path, files) == {"src/a.cpp": growth.LARGE_EXPANSION}


def test_a_circle_of_macros_in_files_that_never_meet_is_none(tmp_path: Path) -> None:
    files = {
        "include/a.hpp": "#define A(x) B(x) B(x) B(x)\n",
        "include/b.hpp": "#define B(x) C(x) C(x) C(x)\n",
        "include/c.hpp": "#define C(x) D(x) D(x) D(x)\n" + doubled(17).replace("A", "D"),
        **{f"src/{name}.cpp": f'#include "{name}.hpp"\nint a = {name.upper()}(1);\n' for name in "abc"},
    }
    assert declined_by_cppcheck(tmp_path, files) == {}


MANY = f"#define P(x) {'x ' * 100}\n"
CALLS = "int a = Q(Q(Q(1)));\n"


@pytest.mark.parametrize(
    ("own", "other"),
    [
        # in the other file F drops what it is given
        (f"{MANY}#define Q(x) F(P(x))\n{CALLS}", "#define F(x) 0\n"),
        # or calls of F are nested deeper than is read
        (f"{MANY}#define Q(x) {'F(' * 70}P(x){')' * 70}\n{CALLS}", "#define F(x) x\n"),
        # or E stands for much else
        (
            f"{MANY}#define E P\n#define Q(x) E(x)\n{CALLS}",
            "".join(f"#define T{n}(x) x\n#define E T{n}\n" for n in range(70)),
        ),
        # or what is called is a name without arguments
        (f"{MANY}#define Q(x) P(x)\n{CALLS}", "#define P 1\n"),
    ],
)
def test_macros_of_a_file_that_is_not_included_hide_nothing(tmp_path: Path, own: str, other: str) -> None:
    files = {"src/a.cpp": own, "src/b.cpp": other}
    assert declined_by_cppcheck(tmp_path / "alone", {"src/a.cpp": own}) == {"src/a.cpp": growth.LARGE_EXPANSION}
    assert "src/a.cpp" in declined_by_cppcheck(tmp_path / "both", files)


@pytest.mark.parametrize(("text", "tables"), [("#define MAX(a, b) ((a) > (b) ? (a) : (b))\n", 1), (doubled(40), 31)])
def test_many_files_that_include_one_are_looked_at_together(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, tables: int
) -> None:
    made: list[int] = []
    init = macro_growth.Expansions.__init__

    def counting(
        self: macro_growth.Expansions, defined: Collection[macro_growth.Macro], *, bound: bool = False
    ) -> None:
        made.append(len(defined))
        init(self, defined, bound=bound)

    monkeypatch.setattr(macro_growth.Expansions, "__init__", counting)
    own = {f"src/{n}.cpp": f'#include "a.hpp"\n#define N{n} {n}\nint a = MAX(1, N{n});\n' for n in range(30)}
    declined = declined_by_cppcheck(tmp_path, {"include/a.hpp": text, **own})
    assert (len(declined), len(made)) == (30 if tables > 1 else 0, tables)


def test_macros_in_two_files_together(tmp_path: Path) -> None:
    lines = doubled(40).splitlines(keepends=True)
    files = {"include/a.hpp": "".join(lines[::2]), "src/a.cpp": '#include "a.hpp"\n' + "".join(lines[1::2])}
    assert declined_by_cppcheck(tmp_path, files) == {"src/a.cpp": growth.LARGE_EXPANSION}


CLASSES = {
    "doubled": "struct C0 {}; struct D0 {};\n"
    + "".join(f"struct C{n} : C{n - 1}, D{n - 1} {{}}; struct D{n} : C{n - 1} {{}};\n" for n in range(1, 40)),
    "unknown at the top": "".join(
        f"class C{n} final : public a::C{n - 1}, private virtual D{n - 1} {{}};\nclass D{n} : C{n - 1} {{}};\n"
        for n in range(1, 40)
    ),
    "of templates": "".join(
        f"template <class T> struct C{n} : C{n - 1}<T>, D{n - 1}<std::map<T, T>> {{}};\ntemplate <class T> struct D{n} : C{n - 1}<T> {{}};\n"
        for n in range(1, 40)
    ),
}


@pytest.mark.parametrize("name", CLASSES)
def test_classes_with_many_ways_up(tmp_path: Path, name: str) -> None:
    assert declined_by_cppcheck(tmp_path, {"a.cpp": CLASSES[name]}) == {"a.cpp": growth.MANY_WAYS}


@pytest.mark.parametrize(
    "text",
    [
        "struct C0 {};\n" + "".join(f"struct C{n} : C{n - 1} {{}};\n" for n in range(1, 500)),
        "".join(f"struct C{n} : A, B, D {{}};\n" for n in range(500)),
        "".join(f"class Node{n} : public rclcpp::Node, public Named {{}};\n" for n in range(500)),
        "class Node : public a::Node, public b::Node {};\n" * 100,
        "struct A { A() : a(1), b(2) {} };\n" * 100,
        "enum class E : int { A, B };\n" * 100,
    ],
)
def test_classes_as_they_are_written(tmp_path: Path, text: str) -> None:
    assert declined_by_cppcheck(tmp_path, {"a.cpp": text}) == {}


def python_classes(first: int, last: int) -> str:
    return "".join(
        f"class C{n}(C{n - 1}, D{n - 1}): pass\nclass D{n}(C{n - 1}, D{n - 1}): pass\n" for n in range(first, last)
    )


def chain(height: int) -> str:
    return "class C0: pass\n" + "".join(f"class C{n}(C{n - 1}): pass\n" for n in range(1, height))


HIGH = {
    "one above another": chain(16),
    "made by calls": "class C0: pass\n" + "".join(f'C{n} = type("C", (C{n - 1},), {{}})\n' for n in range(1, 16)),
    "by other names": "".join(f"class C{n}(D{n - 1}): pass\nD{n} = C{n}\n" for n in range(16)),
    "of one name": "class C: pass\n" + "class C(C): pass\n" * 15,
    "in classes": "".join(f"class A{n}:\n    class C(A{n - 1}.C): pass\n" for n in range(1, 17)),
    "in two lines": chain(16).replace("(", "\\\n("),
    "of two names": "class A(B): pass\nclass B(A): pass\n" * 8,
    "of types": chain(16).replace("):", "[int]):"),
    "very many": chain(5000),
}


@pytest.mark.parametrize("name", HIGH)
def test_python_classes_one_above_another(tmp_path: Path, name: str) -> None:
    assert declined_by_pylint(tmp_path, {"a.py": HIGH[name]}) == {"a.py": growth.HIGH}


def test_python_classes_one_above_another_in_several_files(tmp_path: Path) -> None:
    lines = chain(12).splitlines(keepends=True)
    files = {f"m{n}.py": (f"from m{n - 1} import *\n" if n else "") + line for n, line in enumerate(lines)}
    assert declined_by_pylint(tmp_path, files) == {"m10.py": growth.HIGH, "m11.py": growth.HIGH}


PYTHON = {
    "doubled": python_classes(1, 40),
    "made by calls": "".join(
        f'C{n} = type("C", (C{n - 1}, D{n - 1}), {{}})\nD{n} = type("D", (C{n - 1}, D{n - 1}), {{}})\n'
        for n in range(1, 40)
    ),
    "by other names": "".join(
        f"class C{n}(E{n - 1}, D{n - 1}): pass\nclass D{n}(C{n - 1}, E{n - 1}): pass\nE{n} = C{n}\n"
        for n in range(1, 40)
    ),
    "several bases": "".join(f"class C{n}({', '.join(f'C{m}' for m in range(n))}): pass\n" for n in range(1, 20)),
    "of types": python_classes(1, 40).replace(", D", "[int], m.D"),
}


@pytest.mark.parametrize("name", PYTHON)
def test_python_classes_with_many_ways_up(tmp_path: Path, name: str) -> None:
    assert declined_by_pylint(tmp_path, {"a.py": PYTHON[name]}) == {"a.py": growth.MANY_WAYS}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "class A(\n",
        chain(10),
        *(chain(m) + chain(m).replace("C", "D") for m in (7, 10)),
        "".join(f"class C{n}(C{n % 3}): pass\n" for n in range(3, 500)),
        "".join(f"class C{n}(Base): pass\nclass D{n}(C{n}): pass\n" for n in range(500)),
        "class Node(base.Foo): pass\nclass Foo(other.Node): pass\n" * 4,
        "class Node(rclpy.node.Node): pass\n" * 10,
        "".join(f"x{n} = x{n - 1}.y\n" for n in range(500)) + "x = msg.x\n" * 50,
        "".join(f"class A{n}:\n    class C(object): pass\n" for n in range(500)),
        "".join(f"class C{n}(Node, Mixin): pass\n" for n in range(500)),
        "".join(f"class Node{n}(rclpy.node.Node, Named, metaclass=M): pass\n" for n in range(500)),
        "class Node(a.Node, b.Node): pass\n" * 10,
        python_classes(1, 8),
        "".join(f"a{n} = a{n - 1} + b{n - 1}\nb{n} = type(a{n - 1})\n" for n in range(1, 100)),
    ],
)
def test_python_classes_as_they_are_written(tmp_path: Path, text: str) -> None:
    assert declined_by_pylint(tmp_path, {"a.py": text}) == {}


def test_classes_of_modules_that_are_imported(tmp_path: Path) -> None:
    files = {"m.py": python_classes(1, 8), "a.py": f"from m import *\n{python_classes(8, 20)}", "b.py": "import m\n"}
    assert declined_by_pylint(tmp_path, files) == {"a.py": growth.MANY_WAYS}


def declined_by_cppcheck(root: Path, files: dict[str, str]) -> dict[str, str]:
    space = workspace(root, files)
    return cppcheck.declined(space, list(cppcheck.plan(space, LintOptions(), MemoryStore())))


def declined_by_pylint(root: Path, files: dict[str, str]) -> dict[str, str]:
    space = workspace(root, files)
    return pylint.declined(space, list(pylint.plan(space, LintOptions(), MemoryStore())))


class Declining(FakeLinter):
    def declined(self, workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
        return {unit.file.path: "too much" for unit in units if "much" in workspace.text(unit.file.path)}


def test_a_tool_is_not_asked_about_a_file_that_its_adapter_declines(tmp_path: Path) -> None:
    space, store = workspace(tmp_path, {"a.py": "# say W\n", "b.py": "# much\n# hang\n"}), MemoryStore()
    for _ in range(2):  # the second time from the store
        linter = Declining()
        (done,) = lint(space, [linter], LintOptions(), store, everything)
        assert [result.location.path for result in done.results] == ["a.py"]
        (note,) = done.notifications
        assert (note.path, note.message) == ("b.py", "fake could not analyse this file: too much")
    assert linter.asked == []


def test_a_tool_is_not_started_for_declined_files_alone(tmp_path: Path) -> None:
    linter = Declining()
    (done,) = lint(workspace(tmp_path, {"b.py": "# much\n"}), [linter], LintOptions(), MemoryStore(), everything)
    assert linter.asked == [] and len(done.notifications) == 1


BACKSLASH = {
    "a source": ({"a\\b.cpp": "int a;\n", "c.cpp": "int c;\n"}, {"a\\b.cpp"}),
    "a directory": ({"a\\b/d.cpp": "int a;\n", "c.cpp": "int c;\n"}, {"a\\b/d.cpp"}),
    "a header": ({"a\\b.hpp": "int a;\n", "c.cpp": '#include "a\\b.hpp"\n'}, {"c.cpp"}),
    "none": ({"b.hpp": "// a\\b\nint a;\n", "c.cpp": '#include "b.hpp"\nconst char *d = "e\\\\f";\n'}, set()),
}


@pytest.mark.parametrize("name", BACKSLASH)
def test_a_backslash_in_a_path_that_cppcheck_takes_for_a_slash(name: str, tmp_path: Path) -> None:
    files, expected = BACKSLASH[name]
    root = workspace(tmp_path, files)
    options = LintOptions()
    units = list(cppcheck.plan(root, options, MemoryStore()))
    found = cppcheck.declined(root, units)
    assert found.keys() == expected and all("backslash in the path" in reason for reason in found.values())
