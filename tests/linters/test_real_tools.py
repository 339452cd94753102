# SPDX-License-Identifier: Apache-2.0
"""Each default tool once, as installed, on a few lines; and what only the real tools can show."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters import catkin_lint, clang_tidy, cppcheck, cpplint, lizard, pylint, radon, ruff
from haros_ci.linters.linter import Linter, LintOptions, When
from haros_ci.linters.run import lint
from haros_ci.model.package import Package
from haros_ci.registry import LINTERS
from haros_ci.results.result import Run

PACKAGE = Package("robot", "src/robot", ros=1)
HEADER = """#pragma once
class Arm {
 public:
  Arm();
  int joints;
};
"""
SOURCE = """#include "robot/arm.hpp"

Arm::Arm() {}

int deref(bool on) {
  int* p = 0;
  if (on) { return 1; }
  return *p;
}
"""
MANIFEST = (
    "<package><name>robot</name><version>1.0.0</version><description>Arm.</description>"
    '<maintainer email="a@example.org">A</maintainer><license>BSD</license>'
    "<buildtool_depend>catkin</buildtool_depend></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.5)\nproject(other)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
FILES = {
    "src/robot/package.xml": "<package><name>robot</name></package>\n",
    "src/robot/include/robot/arm.hpp": HEADER,
    "src/robot/src/arm.cpp": SOURCE,
    "src/robot/scripts/go.py": '"""Go."""\nimport os\n\n\ndef go(speed=[]):\n    """Go."""\n    return speed\n',
}


def run(root: Path, linter: Linter, files: dict[str, str], **more: object) -> Run:
    options = more.pop("options", LintOptions())
    assert isinstance(options, LintOptions)
    space = workspace(root, files, [PACKAGE], **more)  # type: ignore[arg-type]
    (only,) = lint(space, [linter], options, MemoryStore(), everything)
    assert only.successful, only.notifications
    return only


def found(run: Run) -> set[tuple[str, str, int | None]]:
    return {(r.rule, r.location.path.rpartition("/")[2], r.location.line) for r in run.results}


@pytest.mark.parametrize(
    ("linter", "expected"),
    [
        (cpplint, {("legal/copyright", "arm.cpp", None), ("legal/copyright", "arm.hpp", None)}),
        (pylint, {("unused-import", "go.py", 2), ("dangerous-default-value", "go.py", 5)}),
        (cppcheck, {("nullPointer", "arm.cpp", 8), ("uninitMemberVar", "arm.cpp", 3)}),
        (lizard, {("min-comment-ratio-20", "arm.cpp", 1)}),
        (radon, {("max-comment-ratio-30", "go.py", 1)}),
    ],
)
def test_every_default_tool_finds_its_defects(tmp_path: Path, linter: Linter, expected: set[object]) -> None:
    done = run(tmp_path, linter, FILES)
    assert linter.WHEN is When.ALWAYS and done.tool.version[0].isdigit()
    assert expected <= found(done)


@pytest.mark.parametrize(
    "linter", [linter for linter in LINTERS if linter.WHEN is When.ALWAYS], ids=lambda linter: linter.NAME
)
def test_every_default_tool_is_quiet_on_nothing(tmp_path: Path, linter: Linter) -> None:
    assert run(tmp_path, linter, {"empty.xml": ""}).results == ()


def test_jobs_and_place_change_nothing(tmp_path: Path) -> None:
    done = []
    for jobs, place in ((1, "one"), (3, "two words/ü")):
        space = workspace(tmp_path / place, FILES, [PACKAGE])
        done.append(lint(space, LINTERS[:5], LintOptions(jobs=jobs), MemoryStore(), everything))
    assert done[0] == done[1]
    assert str(tmp_path) not in repr(done[0])


@pytest.mark.parametrize("linter", [cpplint, cppcheck, lizard])
def test_odd_names_are_analysed(tmp_path: Path, linter: Linter) -> None:
    names = ["-D.cpp", "--help.hpp", "two words.cpp", "100%.cpp", "::error::.cpp", "ü.cpp", "q\"'.cpp", "a,b.cpp"]
    defects = "void f(int a, int b, int c, int d, int e, int g, int h) { int* p = 0; *p = a; }\n"
    assert {r.location.path for r in run(tmp_path, linter, dict.fromkeys(names, defects)).results} == set(names)


CPPLINT_SETTINGS = [
    ({"CPPLINT.cfg": "filter=-legal/copyright\n"}, set()),
    ({"src/CPPLINT.cfg": "filter=-legal/copyright\n"}, {"b.cpp"}),
    ({"src/CPPLINT.cfg": "exclude_files=.*\\.cpp\n"}, {"b.cpp"}),
    ({"other/CPPLINT.cfg": "filter=-legal/copyright\n"}, {"a.cpp", "b.cpp"}),
    ({"../CPPLINT.cfg": "filter=-legal/copyright\n"}, {"a.cpp", "b.cpp"}),
    ({}, {"a.cpp", "b.cpp"}),
]


@pytest.mark.parametrize(("settings", "reported"), CPPLINT_SETTINGS)
def test_cpplint_honours_settings_inside_the_workspace(
    tmp_path: Path, settings: dict[str, str], reported: set[str]
) -> None:
    files = {"src/a.cpp": "int a;\n", "lib/b.cpp": "int b;\n", **settings}
    done = run(tmp_path / "root", cpplint, files)
    assert {name for rule, name, _ in found(done) if rule == "legal/copyright"} == reported
    assert {"src/a.cpp", "lib/b.cpp"} <= done.analysed


STD = """#include <vector>
std::string a = std::max<int>(1, 2) + swap(b) + ns::string;
std::unordered_map<std::vector<int>, std::less<>> c;  // printf("%d")
void f() { printf("x"); memcpy(a, b, 3); x->sort(1); std::sort(a, b); cout << "string" << endl; }
auto wide = "@";
""".replace("@", "\u65e5" * 45)


def test_the_worker_says_what_cpplint_says(tmp_path: Path) -> None:
    done = run(tmp_path, cpplint, {"a.cpp": STD})
    options = ["--verbose=0", "--filter=+build/include_alpha", "--linelength=100"]
    command = [sys.executable, "-I", "-X", "utf8", "-m", "cpplint", *options, "a.cpp"]
    plain = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False).stderr.decode()
    expected = re.findall(r"^a\.cpp:(\d+):  (.*)  \[(.*)\] \[\d\]$", plain, re.MULTILINE)
    said = [(str(r.location.line or 0), r.message, r.rule) for r in done.results]
    assert sorted(said) == sorted(set(expected)) and len(said) > 10


def test_a_line_length_of_one_directory_does_not_leak(tmp_path: Path) -> None:
    long = f"int a = {'1' * 130};  // Copyright\n"
    files = {"a/CPPLINT.cfg": "linelength=200\n", "a/a.cpp": long, "b/b.cpp": long}
    assert {name for rule, name, _ in found(run(tmp_path, cpplint, files)) if rule == "whitespace/line_length"} == {
        "b.cpp"
    }


def test_cpplint_checks_every_suffix(tmp_path: Path) -> None:
    names = [f"b.{suffix}" for suffix in "c cc cpp cxx c++ h hh hpp hxx h++ ipp tpp txx inl cu cuh".split()]
    space = workspace(tmp_path, {"a.cpp": "int a;\n"})
    for name in names:
        (tmp_path / name).write_text("int a;\n")
    space = replace(space, files=tuple(replace(space.files[0], path=name) for name in names))
    (done,) = lint(space, [cpplint], LintOptions(), MemoryStore(), everything)
    assert {result.location.path for result in done.results if result.rule == "legal/copyright"} == set(names)


def test_header_guards_begin_as_ros_includes(tmp_path: Path) -> None:
    guarded = "#ifndef ROBOT_ARM_HPP_\n#define ROBOT_ARM_HPP_\n#endif  // ROBOT_ARM_HPP_\n"
    done = run(tmp_path, cpplint, {"src/robot/include/robot/arm.hpp": guarded})
    assert "build/header_guard" not in {result.rule for result in done.results}


MACROS = [
    "#include <rclcpp/rclcpp.hpp>\nRCLCPP_COMPONENTS_REGISTER_NODE(ns::Node)\n",
    "PLUGINLIB_EXPORT_CLASS(ns::A, ns::B)\n",
    "class ROBOT_PUBLIC A { RCLCPP_SMART_PTR_DEFINITIONS(A) ROBOT_LOCAL void f(); };\n",
    "#if RCLCPP_VERSION_GTE(1, 2, 3)\nint a;\n#else\nint b;\n#endif\n",
    "#if ROS_VERSION_MINIMUM(1, 14, 0)\nint a;\n#endif\n",
    "#if PCL_VERSION < PCL_VERSION_CALC(1, 10, 0)\nint a(\n#else\nint b;\n#endif\n",
    "#if QT_VERSION >= QT_VERSION_CHECK(5, 0, 0)\nint a;\n#else\nint b(\n#endif\n",
    "class W : public QWidget { Q_OBJECT\npublic Q_SLOTS:\n void f(); signals: void g(); };\n",
    "TEST(A, b) { EXPECT_TRUE(true); }\n",
    "void f(V v) { BOOST_FOREACH(int a, v) { g(a); } }\n",
    "BT_REGISTER_NODES(factory) { factory.add(); }\n",
    "BT_JSON_CONVERTER(ns::Point, msg) { add(msg.x); }\n",
    '#define ALL \\\n CXT_MACRO_MEMBER(port, int, 8890) \\\n CXT_MACRO_MEMBER( /* a file */ \\\n path, \\\n std::string, "a.yaml") \\\n /* end */\n'
    "struct C {\n#undef CXT_MACRO_MEMBER\n#define CXT_MACRO_MEMBER(n, t, d) CXT_MACRO_DEFINE_MEMBER(n, t, d)\n CXT_MACRO_DEFINE_MEMBERS(ALL)\n};\n"
    "void f(rclcpp::Node & node, C & c) {\n#undef CXT_MACRO_MEMBER\n#define CXT_MACRO_MEMBER(n, t, d) CXT_MACRO_LOAD_PARAMETER(node, c, n, t, d)\n"
    " CXT_MACRO_INIT_PARAMETERS(ALL, g)\n#undef CXT_MACRO_MEMBER\n#define CXT_MACRO_MEMBER(n, t, d) CXT_MACRO_PARAMETER_CHANGED(c, n, t)\n"
    " CXT_MACRO_REGISTER_PARAMETERS_CHANGED(node, ALL, g)\n CXT_MACRO_SET_PARAMETER(node, c, port, 0);\n}\n",
    "struct P { PCL_ADD_POINT4D; EIGEN_MAKE_ALIGNED_OPERATOR_NEW };\n",
    # a value whose name ends as that of a decoration does
    "bool f(int d) { if (d == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL) { return true; } return false; }\n",
    "int f(int d) { switch (d) { case A_LOCAL: return 1; default: return B_EXPORT; } }\n",
    # a macro with arguments whose name ends so, with and without a semicolon
    '#include "k/K.h"\nBOOST_CLASS_EXPORT(k::A);\nBOOST_CLASS_EXPORT(k::B<k::C>);\nBOOST_CLASS_EXPORT(k::D)\nnamespace k\n{ int a; }\n',
    "BOOST_CLASS_EXPORT_KEY(k::A)\nBOOST_CLASS_VERSION(k::A, 1)\nBOOST_SERIALIZATION_ASSUME_ABSTRACT(k::B)\nint a;\n",
    "BOOST_FUSION_ADAPT_STRUCT(ns::P, (double, x)(double, y))\nint a;\n",
    "BOOST_AUTO_TEST_SUITE(s)\nBOOST_AUTO_TEST_CASE(c) { BOOST_CHECK(true); }\nBOOST_AUTO_TEST_SUITE_END()\n",
    "BOOST_FIXTURE_TEST_CASE(c, F) { BOOST_CHECK_CLOSE(a, 1.0, 2); }\n",
    "BOOST_PYTHON_MODULE(m) { def(a); }\n",
    "G2O_USE_OPTIMIZATION_LIBRARY(csparse)\nG2O_USE_OPTIMIZATION_LIBRARY(cholmod)\nnamespace g2o {\nint a;\n}\n",
    "REGISTER_THING(\n  ns::Thing,\n  ns::Base)\n\n// more\nclass A {};\n",
    "CLASS_LOADER_REGISTER_CLASS(ns::A, ns::B)\nCLASS_LOADER_REGISTER_CLASS_INTERNAL(A, B, 1)\nint a;\n",
    "PLUGINLIB_EXPORT_CLASS(ns::A, ns::B)\nPLUGINLIB_DECLARE_CLASS(p, A, ns::A, ns::B)\nint a;\n",
    "class W : public rviz_common::Panel {\nQ_OBJECT\nQ_PROPERTY(int a READ a)\npublic Q_SLOTS:\nvoid f();\nQ_SIGNALS:\nvoid g();\n};\n",
    "#include <QObject>\nvoid f(L l) { foreach (const int& a, l) { emit changed(a); } }\n",
    "#define QT_NO_KEYWORDS\n#include <QObject>\nclass W : QObject { Q_OBJECT\npublic Q_SLOTS:\n void f(); Q_SIGNALS: void g(); int slots; };\n",
    "TYPED_TEST_SUITE(A, B);\nTYPED_TEST(A, b) { EXPECT_TRUE(true); }\nINSTANTIATE_TEST_SUITE_P(x, A, Values(1));\n",
    "INSTANTIATE_TEST_CASE_P(x, A, Values(1), );\nTEST_P(A, b) { ASSERT_TRUE(x) << 1; EXPECT_THAT(a, Eq(1)); }\n",
    "#include <gtest/gtest.h>\nTEST_F(A, b) { EXPECT_THROW({ a(); b(); }, E) << 1; if (c) ASSERT_EQ(a, b) << 2; else EXPECT_NO_THROW(a()); }\n",
    '#include <gtest/gtest.h>\nTEST(A, b) { ASSERT_THROW(a(), std::out_of_range); EXPECT_DEATH({ b(); }, "x"); FAIL() << 1; SUCCEED(); }\n',
    "#include <ours/check.h>\nvoid f() { ASSERT_EQ(a, b, c); ASSERT_TRUE(a, b); EXPECT_THROW(a); }\n",
    "#include <gtest/gtest.h>\nnamespace a\n{\nTEST(A, b)\n{\n  f();\n}\n\nTEST_F(A, c)\n{\n  g();\n}\nTYPED_TEST(D, e)\n{\n}\n}\n",
    '#include <gmock/gmock.h>\nMATCHER_P(IsBig, least, "is big")\n{\n  return arg > least;\n}\nMATCHER(IsOdd, "") { return arg % 2; }\n'
    "class M : B { MOCK_METHOD(int, f, (int a), (override)); MOCK_CONST_METHOD1(g, int(int)); };\n",
    "#define QT_NO_KEYWORDS\n#include <QObject>\n#if QT_VERSION >= QT_VERSION_CHECK(5, 0, 0)\nint slots;\n#endif\nvoid A::f() { Q_D(A); d->x(); }\n",
    'SCENARIO_METHOD(Fixture, "a", "[b]")\n{\n  GIVEN("c") { WHEN("d") { THEN("e") { REQUIRE(a == b); } } }\n}\nSCENARIO("f") { int a; }\n',
    '#include <catch2/catch.hpp>\nTEST_CASE("a") { SECTION("b") { CHECK(a); } }\nTEST_CASE_METHOD(F, "b", "[c]") { CHECK(d); }\n',
    "struct A : B { void f() override { PYBIND11_OVERRIDE(void, B, f, ); } int g() { PYBIND11_OVERLOAD_PURE(int, B, g, a); } };\n",
    "class M { MOCK_METHOD(int, f, (int a), (override)); MOCK_METHOD1(g, int(int)); MOCK_CONST_METHOD0(h, int()); };\n",
    "class F { FRIEND_TEST(A, b);\nFRIEND_TEST(A, c); int a; };\n",
    "template<typename T>\nROBOT_PUBLIC T * f();\nextern ROBOT_EXPORT int * a;\ntemplate class ROBOT_EXPORT A<int>;\n",
    "struct T { int slots[4]; int signals; };\nint f(T table, bool emit) { table.slots[1] = 4; return emit ? table.signals : table.slots[1]; }\n",
]


def test_cppcheck_knows_the_macros_of_ros(tmp_path: Path) -> None:
    done = run(tmp_path, cppcheck, {f"a{number}.cpp": text for number, text in enumerate(MACROS)})
    assert done.notifications == () and len(done.analysed) == len(MACROS)


PLAIN_WORDS = (
    "struct Table { int slots[6]; int signals; };\nvoid fill(Table& table) { table.slots[6] = 4; table.signals = 1; }\n"
)


@pytest.mark.parametrize(
    ("files", "is_read"),
    [
        ({"a.cpp": PLAIN_WORDS}, True),
        ({"a.cpp": PLAIN_WORDS, "b.cpp": "#include <QWidget>\nclass W : QWidget { Q_OBJECT };\n"}, True),
        ({"a.cpp": '#include "a.hpp"\n' + PLAIN_WORDS, "a.hpp": "#include <boost/foreach.hpp>\n"}, True),
        ({"a.cpp": "#define QT_NO_KEYWORDS\n#include <QWidget>\n" + PLAIN_WORDS}, True),
        (
            {"a.cpp": "#include <QWidget>\n" + PLAIN_WORDS, "CMakeLists.txt": "add_definitions(-DQT_NO_KEYWORDS)\n"},
            True,
        ),
        ({"a.cpp": "#include <QWidget>\n" + PLAIN_WORDS}, False),
        ({"a.cpp": '#include "a.hpp"\n' + PLAIN_WORDS, "a.hpp": "#include <QtCore/QObject>\n"}, False),
    ],
)
def test_words_of_qt_are_plain_names_without_qt(tmp_path: Path, files: dict[str, str], is_read: bool) -> None:
    done = run(tmp_path, cppcheck, files)
    assert any(rule == "arrayIndexOutOfBounds" for rule, _, _ in found(done)) is is_read


def test_a_function_returns_by_python_s_macros(tmp_path: Path) -> None:
    text = "#include <Python.h>\nstatic PyObject* f(int* a) {\n  *a = 1;\n  Py_RETURN_NONE;\n}\n"
    assert "missingReturn" not in {rule for rule, _, _ in found(run(tmp_path, cppcheck, {"a.cpp": text}))}
    bare = text.replace("  Py_RETURN_NONE;\n", "")
    assert "missingReturn" in {rule for rule, _, _ in found(run(tmp_path, cppcheck, {"a.cpp": bare}))}


@pytest.mark.parametrize("text", ["  SOME_MACRO_OF_OURS(a)\nint f() { return 1; }\n", "int f( {\n"])
def test_cppcheck_names_what_it_gave_up(tmp_path: Path, text: str) -> None:
    done = run(tmp_path, cppcheck, {"a.cpp": text, "b.cpp": "int f() { int* p = 0; return *p; }\n"})
    assert [note.path for note in done.notifications] == ["a.cpp"]
    assert ("nullPointer", "b.cpp", 1) in found(done)


def test_cppcheck_quotes_nothing_from_outside(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("TOP_SECRET_WORD(x) more {\n")
    done = run(tmp_path / "root", cppcheck, {"a.cpp": f'#include "{tmp_path}/secret"\n#include "../secret"\nint a;\n'})
    assert done.notifications == () and done.analysed == {"a.cpp"}, "it is not opened, and the rest is analysed"
    assert "SECRET" not in repr(done) and str(tmp_path) not in repr(done)


def test_a_finding_in_a_header_belongs_to_every_includer(tmp_path: Path) -> None:
    files = {
        "src/robot/include/robot/f.hpp": "inline int f() { int* p = 0; return *p; }\n",
        "src/robot/src/a.cpp": '#include "robot/f.hpp"\nint a() { return f(); }\n',
        "src/robot/src/b.cpp": "#include <robot/f.hpp>\nint b() { return f(); }\n",
    }
    store = MemoryStore()
    (cold,) = lint(workspace(tmp_path, files, [PACKAGE]), [cppcheck], LintOptions(), store, everything)
    assert [r.location.path for r in cold.results if r.rule == "nullPointer"] == ["src/robot/include/robot/f.hpp"]
    assert cold.analysed == set(files)
    for gone in ("src/robot/src/a.cpp", "src/robot/src/b.cpp"):
        fewer = {path: text for path, text in files.items() if path != gone}
        (warm,) = lint(workspace(tmp_path, fewer, [PACKAGE]), [cppcheck], LintOptions(), store, everything)
        assert "nullPointer" in {r.rule for r in warm.results}
    changed = {**files, "src/robot/include/robot/f.hpp": "inline int f() { return 1; }\n"}
    (fixed,) = lint(workspace(tmp_path, changed, [PACKAGE]), [cppcheck], LintOptions(), store, everything)
    assert "nullPointer" not in {r.rule for r in fixed.results}


def test_a_header_target_is_seen_through_its_includers(tmp_path: Path) -> None:
    files = {
        "src/robot/include/robot/f.hpp": "inline int f() { int* p = 0; return *p; }\n",
        "src/robot/src/a.cpp": '#include "robot/f.hpp"\nint a() { int* q = 0; return *q; }\n',
    }
    done = run(tmp_path, cppcheck, files, targets=["src/robot/include/robot/f.hpp"])
    assert {name for _, name, _ in found(done)} == {"f.hpp"} == {path.rpartition("/")[2] for path in done.analysed}


def test_headers_in_a_circle_are_analysed_once(tmp_path: Path) -> None:
    files = {
        "a.hpp": '#pragma once\n#include "b.hpp"\n',
        "b.hpp": '#pragma once\n#include "a.hpp"\nint f() { int* p = 0; return *p; }\n',
    }
    done = run(tmp_path, cppcheck, files)
    assert done.analysed == {"a.hpp", "b.hpp"} and ("nullPointer", "b.hpp", 3) in found(done)


def test_cppcheck_uses_definitions_of_the_compile_database(tmp_path: Path) -> None:
    source = "#ifdef BROKEN\nint f() { int* p = 0; return *p; }\n#endif\n"
    files = {
        "a.cpp": source,
        "build/compile_commands.json": json.dumps([{"file": "a.cpp", "command": "c++ -DBROKEN a.cpp"}]),
    }
    assert ("nullPointer", "a.cpp", 2) in found(run(tmp_path, cppcheck, files))


@pytest.mark.parametrize(
    ("linter", "files", "expected"),
    [
        (ruff, FILES, ("F401", "go.py", 2)),
        (
            clang_tidy,
            {
                **FILES,
                "build/compile_commands.json": json.dumps(
                    [{"file": "src/robot/src/arm.cpp", "arguments": ["c++", "-Isrc/robot/include"]}]
                ),
            },
            ("clang-analyzer-core.NullDereference", "arm.cpp", 8),
        ),
        (
            catkin_lint,
            {"src/robot/package.xml": MANIFEST, "src/robot/CMakeLists.txt": CMAKE},
            ("PROJECT_NAME", "CMakeLists.txt", 2),
        ),
    ],
)
def test_tools_that_are_used_where_installed(
    tmp_path: Path, linter: Linter, files: dict[str, str], expected: tuple[str, str, int]
) -> None:
    if linter.locate(LintOptions()) is None:
        pytest.skip(f"{linter.NAME} is not installed")
    assert expected in found(run(tmp_path, linter, files))


def test_a_bad_manifest_costs_catkin_lint_only_itself(tmp_path: Path) -> None:
    if catkin_lint.locate(LintOptions()) is None:
        pytest.skip("catkin_lint is not installed")
    files = {"p/package.xml": MANIFEST, "p/CMakeLists.txt": CMAKE, "q/package.xml": "<a/>", "q/CMakeLists.txt": ""}
    packages = [Package("robot", "p", ros=1), Package("q", "q", ros=1)]
    space = workspace(tmp_path, files, packages)
    (done,) = lint(space, [catkin_lint], LintOptions(), MemoryStore(), everything)
    assert done.successful and [note.path for note in done.notifications] == ["q/package.xml"]
    assert ("PROJECT_NAME", "CMakeLists.txt", 2) in found(done)


def test_python_2_is_one_notification(tmp_path: Path) -> None:
    done = run(tmp_path, pylint, {"a.py": 'import os\nprint "x"\n', "b.py": "def f(:\n"})
    assert [(note.path, note.line) for note in done.notifications] == [("a.py", 2)]
    assert ("syntax-error", "b.py", 1) in found(done)
    assert "a.py" not in {name for _, name, _ in found(done)}


@pytest.mark.parametrize(
    ("settings", "reported"),
    [
        ({"pylintrc": "[MESSAGES CONTROL]\ndisable=unused-import,\n  missing-module-docstring\n"}, False),
        ({"setup.cfg": "[pylint.'MESSAGES CONTROL']\ndisable=W0611\n"}, False),
        ({"pyproject.toml": '[tool.pylint."messages control"]\ndisable = ["unused-import"]\n'}, False),
        ({"scripts/.pylintrc": "[MAIN]\ndisable=all\n"}, False),
        ({"pyproject.toml": "[tool.black]\nline-length = 10\n"}, True),
        ({"pylintrc": "disable=unused-import\n"}, True),
        ({"../pylintrc": "[MAIN]\ndisable=all\n"}, True),
    ],
)
def test_inert_pylint_settings_are_honoured(tmp_path: Path, settings: dict[str, str], reported: bool) -> None:
    done = run(tmp_path / "root", pylint, {"scripts/go.py": "import os\n", **settings})
    assert (("unused-import", "go.py", 1) in found(done)) == reported
