# SPDX-License-Identifier: Apache-2.0
"""What is read of the workspace to run the tools: includes, imports, settings, compile databases, macros, Python 2."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest
from linter_samples import FakeLinter, MemoryStore, workspace

from haros_ci.linters import cppcheck_libraries, imports, includes, installed, macro_scan, schedule
from haros_ci.linters.compile_db import flags_by_file
from haros_ci.linters.linter import LintOptions, Unit
from haros_ci.linters.process import search_path
from haros_ci.linters.pylint_config import config_path, inert_options
from haros_ci.linters.python2 import is_newer, is_python2, why_unreadable
from haros_ci.model.package import Package, SourceFile

PYTHON_2 = [
    "raise 'State', 'no state'\n",
    'print "x"\n',
    "    print 'x' % y\n",
    "print x, y\n",
    "try:\n    f()\nexcept ValueError, e:\n    pass\n",
    "try:\n    f()\nexcept (IOError, OSError), e:\n    pass\n",
    'raise ValueError, "no"\n',
    "exec code\n",
    "if a <> b:\n    pass\n",
    "x = `y`\n",
    "os.chmod(p, 0755)\n",
    "x = ur'y'\n",
    "#!/usr/bin/env python2\nx = (\n",
    "x = 'a' + `b.c[0]` + 'd'\n",
    "x = \"a\" + 'b', 1 <> 2\n",
    "os.chmod('x', 0755)\n",
]
NOT_PYTHON_2 = [
    "print('x')\n",
    "print\n",
    "print = 3\n",
    "print(x\n",
    "def f(:\n",
    "x = 1 +\n",
    "except_ = a, b\n",
    "try:\n    f()\nexcept (A, B) as e:\n    pass\n",
    "raise ValueError('a, b')\n",
    "raise 'a, b' +\n",
    "#!/usr/bin/env python3\nx = (\n",
    "x = 0o755 +\n",
    "# say `x` and a <> b\nx = (\n",
    "'''print the docs'''\n(\n",
    "x = 10 + 0.5 +\n",
    "train(lr=0.01, gamma=0.99\nx = 1\n",
    "x = 1.01 + 2.07e01 + 0x01 + 00 +\n",
    "x = 'a' + \"<> `b` 0777 ur'c'\" +\n",
    "print(f'`{x}`', \n  y=0.01 # <>\nz = (\n",
]


@pytest.mark.parametrize("text", PYTHON_2)
def test_python_2_is_recognised(text: str) -> None:
    with pytest.raises(SyntaxError):
        compile(text, "x", "exec")
    assert is_python2(text)


@pytest.mark.parametrize("text", NOT_PYTHON_2)
def test_broken_python_3_is_not_python_2(text: str) -> None:
    assert not is_python2(text)


@pytest.mark.parametrize("line", ["type X = int", "  def f[T](x: T): pass", "async def f[T](): pass", "class A[T]:"])
def test_newer_python_is_recognised(line: str) -> None:
    assert is_newer(line, "invalid syntax") == (sys.version_info < (3, 12))


@pytest.mark.parametrize(
    "line", ["type(x) = 3 +", "def f(x[1]):", "class A(B[T]", "typed x =", "x = type[", "type = 3 +"]
)
def test_what_is_broken_is_not_newer(line: str) -> None:
    assert not is_newer(line, "invalid syntax")


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="this Python reads it")
@pytest.mark.parametrize(
    "text",
    [
        'class A[T]:\n    """Owns the ``B`` of ``c``\n    and `d`\n    """\n',
        "def f[T](a: T) -> T:\n    return a\n",
        "x = 1\ntype Y = int\n",
    ],
)
def test_why_newer_python_is_not_read(text: str) -> None:
    assert not is_python2(text)
    assert why_unreadable(text).startswith("it is for Python 3.12 or later")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("print 'a'\n", "it is Python 2"),
        ('"""\nclass A[T]:\n"""\nprint a\n', "it is Python 2"),
        ("def f(:\n", "it is not valid Python"),
        ('"""\nsay `a`\n"""\ndef f(:\n', "it is not valid Python"),
    ],
)
def test_why_other_python_is_not_read(text: str, why: str) -> None:
    assert why_unreadable(text).startswith(why)


UNTERMINATED = "unterminated string literal (detected at line 1)"


@pytest.mark.parametrize(
    "line",
    [
        "x = f'a {",
        'log(f"{one} and {',
        "log(F'{{x}} {two(",
        "x = rf'{a}{b",
        "f'{",
        'print("a", f"b {c',
        "say(f'it is {  ",
    ],
)
def test_a_line_break_in_the_braces_of_an_f_string_is_newer(line: str) -> None:
    assert is_newer(line, UNTERMINATED) == (sys.version_info < (3, 12))
    assert is_newer(line, "EOL while scanning string literal") == (sys.version_info < (3, 12))
    assert not is_newer(line, "invalid syntax")


@pytest.mark.parametrize(
    "line",
    [
        "x = 'a {",
        "x = f'a",
        "x = f'{a} b",
        "x = f'{{ b",
        "x = f'' + 'a {",
        "x = f'{a}' + 'b {",
        "half'{",
        "x = f'{a}{{b}} c",
        "",
    ],
)
def test_a_text_that_does_not_end_is_not_newer(line: str) -> None:
    assert not is_newer(line, UNTERMINATED)


INERT = [
    ("pylintrc", "[A]\ndisable=a,\n b\nmax-line-length=99\n", {"disable": "a,\nb", "max-line-length": "99"}),
    (".pylintrc", "[A]\nmax_line_length: 99\n", {"max-line-length": "99"}),
    ("setup.cfg", "[pylint.MAIN]\ndisable=a\n[flake8]\nignore=b\n", {"disable": "a"}),
    ("tox.ini", "[tool:pylint]\ngood-names=i\n", {"good-names": "i"}),
    ("pyproject.toml", "[tool.pylint]\nmax-args = 9\n", {"max-args": "9"}),
    (
        "pyproject.toml",
        '[tool.pylint.a]\ndisable = ["a", "b"]\ninit-import = true\n',
        {"disable": "a,b", "init-import": "yes"},
    ),
    ("pylintrc", "[A]\nINIT-HOOK=x\nload-plugins=y\nload_plugins=y\nevaluation=z\nsource-roots=.\n", {}),
    ("pylintrc", "[A]\nextension-pkg-allow-list=a\nextension-pkg-whitelist=a\nunsafe-load-any-extension=yes\n", {}),
    ("pylintrc", "[A]\noutput-format=mod.Class\nmsg-template=x\nspelling-dict=en\nimport-graph=/tmp/x\njobs=99\n", {}),
    ("pyproject.toml", '[tool.pylint.a]\ninit-hook = "x"\nload-plugins = ["y"]\n', {}),
    ("pyproject.toml", "[tool]\npylint = 3\n", {}),
    ("pyproject.toml", "[tool.black]\ndisable = 3\n", {}),
]


@pytest.mark.parametrize(("name", "text", "options"), INERT)
def test_only_inert_options_pass(name: str, text: str, options: dict[str, str]) -> None:
    assert inert_options(name, text) == options


@pytest.mark.parametrize(
    ("name", "text"), [("pylintrc", "disable=x\n"), ("pyproject.toml", "[tool.pylint\n"), ("setup.cfg", "[a\n")]
)
def test_unreadable_settings_are_an_error(name: str, text: str) -> None:
    with pytest.raises(ValueError):
        inert_options(name, text)


def test_the_nearest_settings_win(tmp_path: Path) -> None:
    files = {"pylintrc": "[A]\n", "a/setup.cfg": "[pylint]\n", "a/b/setup.cfg": "[flake8]\n", "c/pylintrc": "\n"}
    space = workspace(tmp_path, files)
    found = [config_path(space, directory) for directory in ("", "a", "a/b", "c", "d/e")]
    assert found == ["pylintrc", "a/setup.cfg", "a/setup.cfg", "pylintrc", "pylintrc"]


def test_includes(tmp_path: Path) -> None:
    files = {
        "p/include/p/a.hpp": '#include "b.hpp"\n# include <vector>\n//#include "no.hpp"\n',
        "p/include/p/b.hpp": '#include "../p/a.hpp"\n',
        "p/src/a.cpp": '  #  include <p/a.hpp>\n#include "local.h"\n#include "q/q.hpp"\n',
        "p/src/local.h": "",
        "q/include/q/q.hpp": "",
        "no.hpp": "",
    }
    space = workspace(tmp_path, files)
    store = MemoryStore()
    written = includes.written(space, space.files, store)
    assert includes.written(space, space.files, store) == written and store.hits == 1
    direct = includes.resolve(written, dict.fromkeys(files, ("p/include",)))
    assert includes.closure("p/src/a.cpp", direct) == {"p/include/p/a.hpp", "p/include/p/b.hpp", "p/src/local.h"}
    assert includes.closure("p/include/p/b.hpp", direct) == {"p/include/p/a.hpp"}


@pytest.mark.parametrize("planted", ["[]", '{"x": 1}', '"text"', "null"])
def test_a_spoiled_list_of_includes_is_read_anew(tmp_path: Path, planted: str) -> None:
    space = workspace(tmp_path, {"a.cpp": '#include "b.hpp"\n'})
    store = MemoryStore()
    expected = includes.written(space, space.files, store)
    store.values = dict.fromkeys(store.values, planted.replace("x", space.files[0].digest))
    assert includes.written(space, space.files, store) == expected == {"a.cpp": ("b.hpp",)}


IMPORTS = [
    ("import b\n", {"p/b.py"}),
    ("from p.b import x\n", {"p/b.py", "p/__init__.py"}),
    ("from . import b\n", {"p/b.py"}),
    ("from p import (\n    x,\n    b,\n)\n", {"p/b.py", "p/__init__.py"}),
    ("if x:\n    import os, b as d\n", {"p/b.py"}),
    ("from .sub.c import y\n", {"p/sub/c.py", "p/b.py"}),
    ("import os\n", set()),
    ("# import b\n", set()),
    ("x = 'import b'\n", set()),
    ("important = b\n", set()),
]


@pytest.mark.parametrize(("text", "needs"), IMPORTS)
def test_imports_within_a_package(tmp_path: Path, text: str, needs: set[str]) -> None:
    files = {"p/a.py": text, "p/b.py": "", "p/__init__.py": "", "p/sub/c.py": "from ..b import z\n", "q/b.py": ""}
    found = imports.closures(workspace(tmp_path, files, [Package("p", "p"), Package("q", "q")]))
    assert set(found["p/a.py"]) == {*needs, "p/__init__.py"} and found["q/b.py"] == ()  # it says what p/a.py is called


ALLOWED = [
    (["-I", "inc", "-Iinc"], ["-I{root}/inc", "-I{root}/inc"]),
    (["-isystem", "inc", "-isystem/usr/include"], ["-isystem", "{root}/inc", "-isystem", "/usr/include"]),
    (["-iquote", "inc"], ["-iquote", "{root}/inc"]),
    (
        ["-DA=1", "-D", "B", "-UC", "-std=c++17", "-Wall", "-x", "c++"],
        ["-DA=1", "-DB", "-UC", "-std=c++17", "-Wall", "-xc++"],
    ),
]
FORBIDDEN = [
    ["-fplugin=evil.so"],
    ["-Xclang", "-load", "-Xclang", "evil.so"],
    ["-Wl,-plugin,evil.so", "-Wa,x", "-Wp,x"],
    ["-include", "/etc/passwd"],
    ["-I/etc", "-I../..", "-Ilink", "-isystem", "/root", "-I", "/nonexistent"],
    ["@response", "-o", "out", "--config=x", "-B.", "-specs=x", "-wrapper", "sh"],
    ["-x", "ir", "-I"],
    ["-DA\n=1"],
]


def database(root: Path, arguments: list[str], **more: object) -> dict[str, tuple[str, ...]]:
    entry = {"directory": ".", "file": "a.cpp", "arguments": ["c++", *arguments, "a.cpp"], **more}
    files = {"a.cpp": "", "inc/h.hpp": "", "build/compile_commands.json": json.dumps([entry, 3, {"file": 7}])}
    if not (root / "link").is_symlink():
        root.mkdir(exist_ok=True)
        (root / "link").symlink_to("/etc")
    return flags_by_file(workspace(root, files), LintOptions())


@pytest.mark.parametrize(("arguments", "flags"), ALLOWED)
def test_harmless_flags_pass(tmp_path: Path, arguments: list[str], flags: list[str]) -> None:
    real = os.path.realpath(tmp_path)
    joined = " ".join(flags).format(root=real).replace("-x c++", "-xc++")
    assert " ".join(database(tmp_path, arguments)["a.cpp"]).replace("-x c++", "-xc++") == joined


@pytest.mark.parametrize("arguments", FORBIDDEN)
def test_other_flags_do_not(tmp_path: Path, arguments: list[str]) -> None:
    assert database(tmp_path, arguments)["a.cpp"] == ()


@pytest.mark.parametrize("file", ["../a.cpp", "/etc/passwd", "b.cpp", ""])
def test_files_outside_are_not_described(tmp_path: Path, file: str) -> None:
    assert database(tmp_path, ["-DA"], file=file) == {}


@pytest.mark.parametrize("text", ["", "{", "3", "{}", "[[]]", "[" * 100_000])
def test_a_broken_database_is_none(tmp_path: Path, text: str) -> None:
    options = LintOptions(compile_database=".")
    assert flags_by_file(workspace(tmp_path, {"a.cpp": "", "compile_commands.json": text}), options) == {}


def test_a_command_line_is_split_not_run(tmp_path: Path) -> None:
    entry = [{"directory": "/", "file": str(tmp_path / "a.cpp"), "command": 'c++ "-DA=x y" $(touch pwned) -c a.cpp'}]
    space = workspace(tmp_path, {"a.cpp": "", "out/compile_commands.json": json.dumps(entry)})
    assert flags_by_file(space, LintOptions(compile_database="out")) == {"a.cpp": ("-DA=x y",)}
    assert not (tmp_path / "pwned").exists()


def test_the_checkout_s_database_serves_a_base_revision(tmp_path: Path) -> None:
    head, base = tmp_path / "head", tmp_path / "base"
    entry = [{"directory": str(head / "build"), "file": "../a.cpp", "command": f"c++ -I{head}/inc -I{head}/new a.cpp"}]
    files = {"a.cpp": "", "inc/h.hpp": ""}
    workspace(head, {**files, "new/h.hpp": "", "build/compile_commands.json": json.dumps(entry)})
    flags = flags_by_file(workspace(base, files), LintOptions(root=head))
    assert flags == {"a.cpp": (f"-I{os.path.realpath(base)}/inc",)}


DECORATIONS = [
    "ROBOT_PUBLIC",
    "NAV2_UTIL__VISIBILITY_EXPORT",
    "ecl_EXPORT x ECL_LOCAL",
    "ROBOT_PUBLIC_TYPE",
    "A_DECL",
    "class ROBOT_PUBLIC Arm : public Part {};",
    "template<typename T> ROBOT_PUBLIC T* f();",
    "ROBOT_PUBLIC ~Arm();",
    "ROBOT_PUBLIC\nvoid f();",
    "extern int * ROBOT_LOCAL f();",
    "#if defined(ROBOT_EXPORT)\n#endif\nROBOT_EXPORT [[nodiscard]] int f();",
    "ROBOT_PUBLIC ::ns::T f();",
]
NO_DECORATIONS = [
    *("PUBLIC", "public", "ROBOT_PUBLICATION", "IS_LOCAL_x", "robot_public", "EXPORT_ROBOT", "Robot_PUBLIC"),
    "if (d == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL) {}",
    "f(DURABILITY_LOCAL);",
    "enum E { A_LOCAL, B_LOCAL };",
    "int a = A_LOCAL + 1;",
    "switch (a) { case A_LOCAL: break; }",
    "return Kind::A_LOCAL\n  ;",
    "BOOST_CLASS_EXPORT(ns::A)\nint a;",
    "// A_LOCAL is the best\n",
    "/*\n * A_LOCAL is the best\n */",
    "#ifdef A_LOCAL\n#endif",
    # used as a value once, it is one everywhere
    "class A_LOCAL B {}; int c = A_LOCAL;",
]


@pytest.mark.parametrize("text", DECORATIONS)
def test_decorations_are_found(text: str) -> None:
    assert macro_scan.decorations(macro_scan.marks(text))


@pytest.mark.parametrize("text", NO_DECORATIONS)
def test_other_names_are_no_decorations(text: str) -> None:
    assert not macro_scan.decorations(macro_scan.marks(text))


REGISTRATIONS = [
    "G2O_USE_OPTIMIZATION_LIBRARY(csparse)\nnamespace g2o {}\n",
    'REGISTER_NODE(\n  ns::A<B, (C)>,\n  "a)b")\n\n// more\n/* and more */\nclass A;\n',
    "REGISTER_A(a)\nREGISTER_A(b);\n",
    "REGISTER_A(a)\n#endif\n",
    "REGISTER_A(a)",
    "REGISTER_A(a)\n[[nodiscard]] int b;\n",
    "class A {\npublic:\nREGISTER_A(a)\nint b;\n};\n",
    "int a;  // of a\nREGISTER_A(a)\n#ifdef B\nint b;\n#endif\n",
    "// more of a\nREGISTER_A(a)\nint b;\n",
    "#include <a.hpp>\nREGISTER_A(a)\nint b;\n",
    "template<typename T>\nREGISTER_A(a)\nint b;\n",
]
NO_REGISTRATIONS = [
    "REGISTER_A(a);\nint b;\n",
    "DEFINE_TEST(a)\n{\n}\n",
    "DEFINE_TEST(a) : b() {}\n",
    "  REGISTER_A(a)\nint b;\n",
    "void f() {\n  LOG_INFO(a);\n}\nLOG_INFO(a)\nint b;\n",
    "STREAM_OUT(a)\n  << b;\n",
    "STREAM_OUT(a)\n  (b);\n",
    "#define REGISTER_A(a)\nint b;\n",
    "// REGISTER_A(a)\nint b;\n",
    "REGISTER(a)\nint b;\n",
    "register_a(a)\nint b;\n",
    "REGISTER_A(a\nint b;\n",
    "REGISTER_A(((((((((a)))))))))\nint b;\n",
    "int c = MAKE_A(1);\nMAKE_A(2)\nint b;\n",
    "int\nMAKE_A(int * p)\nnoexcept\n{\n}\n",
    "int &\nMAKE_A(int * p)\nconst\n{\n}\n",
    "int b =\nMAKE_A(p)\n[0];\n",
    "int b =\nMAKE_A(p)\nand c;\n",
    "int b = c +\nMAKE_A(p)\n}\n",
    "int b = a;\nMAKE_A(p)\n#if 1\n[0] = 1;\n#endif\n",
    "int\nMAKE_A(p)\nint * p;\n{\n}\n",
    "return\nMAKE_A(p)\n}\n",
]


@pytest.mark.parametrize("text", REGISTRATIONS)
def test_registrations_are_found(text: str) -> None:
    assert len(macro_scan.registrations(macro_scan.marks(text))) == 1


@pytest.mark.parametrize("text", NO_REGISTRATIONS)
def test_other_calls_are_no_registrations(text: str) -> None:
    assert not macro_scan.registrations(macro_scan.marks(text))


HEADERS = [
    ("#include <QWidget>", ["qt"]),
    ("#include <QtWidgets/QLabel>", ["qt"]),
    ("#include <qobject.h>", ["qt"]),
    ('#include "ui_panel.h"', ["qt"]),
    ("#include <rviz_common/panel.hpp>", ["qt"]),
    ("#include <rqt_gui_cpp/plugin.h>", ["qt"]),
    ("class A {\n  Q_OBJECT\n};", ["qt"]),
    ("class A {\nprivate slots:\n};", ["qt"]),
    ("#include <boost/bind.hpp>", ["boost"]),
    ("BOOST_FOREACH(int a, b) {}", ["boost"]),
    ("#include <gtest/gtest.h>", ["googletest"]),
    ("#include <rmf_utils/catch.hpp>", ["catch2"]),
    ('TEST_CASE("a") {}\n#include <catcher/a.hpp>', ["catch2"]),
    ("#include <catcher.hpp>\nvoid TEST_CASE(int a);", []),
    ("#include <pybind11/pybind11.h>\n#include <Python.h>", ["python"]),
    ("#include <qwidget.h>\nTEST(A, b) {}", ["googletest", "qt"]),
    ('#include "quaternion.h"\n#include <queue.h>', []),
    ("#include <rclcpp/rclcpp.hpp>\nstruct A { int slots; void emit(); };", []),
    ("#include <quaternion/quaternion.h>\n#include <Qubit/a.h>", []),
    ("#include <queue>\nint foreach, signals, BOOST;", []),
    ("// Q_OBJECTS and QT\nenum { QT_A };", []),
    ("#define QT_NO_KEYWORDS\n#include <QWidget>", ["!qt", "qt"]),
    ("#define QT_NO_KEYWORDS\n", []),
]


@pytest.mark.parametrize(("text", "expected"), HEADERS)
def test_libraries_are_asked_for_by_headers_and_macros(tmp_path: Path, text: str, expected: list[str]) -> None:
    space = workspace(tmp_path, {"a.cpp": text + "\n"})
    store = MemoryStore()
    for _ in range(2):  # the second time from the store
        directives = includes.written(space, space.files, store)
        asked = cppcheck_libraries.by_file(space, space.files, directives, store)
        assert list(cppcheck_libraries.together(asked.values())) == expected


def units(*sizes: int, group: str = "") -> list[Unit]:
    return [Unit(SourceFile(f"{group}{i:03}.py", "python", size, "0"), group) for i, size in enumerate(sizes)]


@pytest.mark.parametrize(
    ("given", "shapes"),
    [
        (units(1_000_000), [1]),
        (units(*[1_000_000] * 8), [4, 4]),
        (units(*[1_000_000] * 9), [5, 4]),
        (units(9_000_000, 1, 1, 1), [1, 3]),
        (units(*[0] * 850), [400, 400, 50]),
        (units(1, 1, group="a") + units(1, group="b"), [2, 1]),
        ([], []),
    ],
)
def test_batches_are_even_and_of_one_group(given: list[Unit], shapes: list[int]) -> None:
    made = schedule.batches(given, cost=1.0, seconds=4.0)
    assert [len(batch) for batch in made] == shapes
    assert schedule.batches(given[::-1], cost=1.0, seconds=4.0) == made
    assert sorted(u.file.path for batch in made for u in batch) == sorted(u.file.path for u in given)


@pytest.mark.parametrize(
    ("of_adapter", "total", "expected"),
    [
        (2.0, 1000.0, 2.0),
        ((10.0, 40.0), 1000.0, 40.0),
        ((10.0, 40.0), 100.0, 25.0),
        ((10.0, 40.0), 5.0, 10.0),
        ((10.0, 40.0), 0.0, 10.0),
    ],
)
def test_long_work_is_done_by_fewer_and_longer_processes(of_adapter: Any, total: float, expected: float) -> None:
    assert schedule.seconds_of(FakeLinter(BATCH_SECONDS=of_adapter), total) == expected


def test_path_has_no_directory_of_the_workspace(tmp_path: Path) -> None:
    (tmp_path / "root/bin").mkdir(parents=True)
    (tmp_path / "link").symlink_to(tmp_path / "root/bin")
    given = f".::bin:{tmp_path}/root/bin:{tmp_path}/link:{tmp_path}/rooted:/usr/bin:/usr/bin"
    assert search_path({"PATH": given}, tmp_path / "root") == [f"{tmp_path}/rooted", "/usr/bin"]


def test_no_program_is_taken_from_the_workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tool = tmp_path / "root" / "some-tool"
    tool.parent.mkdir()
    tool.write_text(f"#!/bin/sh\ntouch {tmp_path}/ran\necho some-tool 1.2\n")
    tool.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tool.parent}:/usr/bin:/bin")
    assert installed.binary("some-tool", LintOptions(root=tool.parent)) is None
    assert not (tmp_path / "ran").exists()
    found = installed.binary("some-tool", LintOptions(root=tmp_path / "elsewhere"))
    assert found is not None and (found.argv, found.version) == ((str(tool),), "1.2")


def test_a_distribution_is_found_by_its_directory() -> None:
    found = installed.distribution("pytest")
    assert found is not None and found.version == pytest.__version__
    assert installed.distribution("no-such-thing") is None
