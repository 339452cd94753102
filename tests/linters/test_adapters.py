# SPDX-License-Identifier: Apache-2.0
"""What each adapter makes of captured output: findings, files given up, and refusals of what the tool never writes."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

import pytest
from linter_samples import workspace

from haros_ci.linters import catkin_lint, clang_tidy, cppcheck, cpplint, pylint, ruff
from haros_ci.linters.linter import Batch, Finding, GaveUp, LintOptions, Output
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.results.rule import Level

PACKAGES = [Package("robot", "robot", ros=1)]


def parse(
    adapter: ModuleType,
    root: Path,
    files: Mapping[str, str | bytes],
    stdout: str = "",
    stderr: str = "",
    code: int = 0,
    group: str = "",
) -> list[Finding | GaveUp]:
    space = workspace(root, files, PACKAGES)
    chosen = tuple(f for f in space.files if f.language in adapter.LANGUAGES and not f.path.endswith(".hpp"))
    batch = Batch(space, chosen, LintOptions(), root, group)
    return list(adapter.parse(Output(stdout.encode(), stderr.encode(), code), batch))


def brief(said: list[Finding | GaveUp]) -> list[tuple[object, ...]]:
    return [
        (s.unit, s.result.rule, str(s.result.location)) if isinstance(s, Finding) else (s.unit, s.message, s.line)
        for s in said
    ]


DONE = "Done processing ./a b.cpp\nTotal errors found: 1\n"
CPPLINT_FIRES = [
    ("./a b.cpp:3:  Do not indent  [whitespace/indent_namespace] [4]", "whitespace/indent_namespace", 3),
    ("./a b.cpp:0:  No copyright message found.  [legal/copyright] [5]", "legal/copyright", None),
    ("./a b.cpp:None:  Header guard  [build/header_guard] [5]", "build/header_guard", None),
    ("./a b.cpp:7:  Found [x] in 'y:3:  z'  [build/c++11] [5]", "build/c++11", 7),
]
CPPLINT_QUIET = [
    "",
    "Skipping input './a b.cpp': Can't open for reading",
    "./other.cpp:3:  Do not indent  [whitespace/indent] [4]",
    "./a b.cpp:3: no two spaces [whitespace/indent] [4]",
    "./a b.cpp:3:  no category",
    "::error file=./a b.cpp,line=3::  x  [whitespace/indent] [4]",
]


@pytest.mark.parametrize(
    ("name", "line", "is_told"),
    [
        ("a b.cpp", "foo(&(int)x);", True),
        ("a b.cpp", "x = &static_cast<A>(y);", True),
        ("a b.cpp", "x = &((A *)p)->b + &(B)c;", True),
        ("a b.cpp", "return &((struct x *)e)->pp->e;", False),
        ("a b.cpp", "p = &((T*)q())[0];", False),
        ("a b.cpp", "p = & ( (T *)q ) -> x;", False),
        ("a b.cpp", "if ((a != (u16)b)&&(c != (u16)d))", False),
        ("a b.cpp", "if (a && (int)b && &((T *)p)->c)", False),
        ("a b.cpp", "if ((a)&&(bool)f(b))", False),
        ("a b.cpp", "if ((a)&&(bool)b) foo(&(int)x);", True),
        ("a b.cpp", "if ((a)&&(bool)b) x = &static_cast<A>(y);", True),
        ("a b.cpp", "x = &((Scalar*)store->values)[i];", False),
        ("a b.cpp", "x = &((Scalar*)store->at(3))[i] + &(B)c;", True),
        ("a b.cpp", "#define OFFSET(T, m) ((size_t)&(((T *)0)->m))", False),
        ("a b.cpp", "#define OFFSET(T, m) ((word)&(((T*)0x10)->m)-0x10)", False),
        ("a b.cpp", "#define OFFSET(T, m) (size_t)(&((T *)(0))->m)", False),
        ("a b.cpp", "#define OFFSET(T, m) ((char *)&(((T *) NULL)->m) - (char *) NULL)", False),
        ("a b.cpp", "n = (size_t)&(((T *)nullptr)->m);", False),
        ("a b.cpp", "n = (size_t)&(((T *)0)->m) + f(&(int)x);", True),
        ("a b.cpp", "foo(&(T)0);", True),
        ("a b.c", "foo(&(int)x);", False),
        ("a b.c", "a = b & (uint32_t) c;", False),
    ],
)
def test_cpplint_on_the_address_of_a_cast(tmp_path: Path, name: str, line: str, is_told: bool) -> None:
    said = parse(
        cpplint,
        tmp_path,
        {name: f"\n{line}\n"},
        f"Done processing ./{name}\n",
        f"./{name}:2:  Are you taking an address of a cast?  [runtime/casting] [4]\n",
    )
    assert bool(said) == is_told


@pytest.mark.parametrize(("line", "rule", "number"), CPPLINT_FIRES)
def test_cpplint_fires(tmp_path: Path, line: str, rule: str, number: int | None) -> None:
    (said,) = parse(cpplint, tmp_path, {"a b.cpp": ""}, DONE, line)
    assert isinstance(said, Finding)
    assert (said.result.rule, said.result.location) == (rule, Location("a b.cpp", number))


@pytest.mark.parametrize("line", CPPLINT_QUIET)
def test_cpplint_stays_quiet(tmp_path: Path, line: str) -> None:
    assert parse(cpplint, tmp_path, {"a b.cpp": ""}, DONE, line) == []


UTF8 = "./a b.cpp:{}:  Line contains invalid UTF-8 (or Unicode replacement character).  [readability/utf8] [5]"


@pytest.mark.parametrize(
    ("data", "is_told"),
    [
        ("int a;\n// 3 \ufffd\n", False),
        ("int a;\nint b;  // 3 \ufffd or 4 \ufffd\n", False),
        ("/* a\n 3 \ufffd\n*/\n", False),
        ('/* a\n 3 \ufffd\n*/\nchar c[] = "\xff";\n', False),
        ('int a;\nchar b[] = "\ufffd";\n', True),
        ('int a;\nchar b[] = "\ufffd";  // \ufffd\n', True),
        (b"int a;\n// 3 \xb0\n", True),
        (b"int a;\n// 3 \xb0 \xef\xbf\xbd\n", True),
        (b'int a;\nchar b[] = "\xb0";\n', True),
        ("int a;", True),
        ("", True),
    ],
)
def test_cpplint_on_letters_that_are_lost(tmp_path: Path, data: str | bytes, is_told: bool) -> None:
    said = parse(cpplint, tmp_path, {"a b.cpp": data}, DONE, UTF8.format(2))
    assert bool(said) == is_told


INCLUDED = "./a b.cpp:{}:  Do not include {} files from other packages.  [build/include] [4]"


@pytest.mark.parametrize(
    ("number", "suffix"), [(1, ".cpp"), (2, ".cpp"), (3, ".ipp"), (4, ".inl"), (4, ".cu"), (3, ".inc"), (5, ".cpp")]
)
def test_cpplint_on_a_part_of_a_header(tmp_path: Path, number: int, suffix: str) -> None:
    text = '#include "part.cpp"\n  # include  "part.cpp"  // beside it\n#include <a/b.ipp>\n#include "a/b.inl"\n#include "p.cpp"\n'
    assert parse(cpplint, tmp_path, {"a b.cpp": text}, DONE, INCLUDED.format(number, suffix)) == []


@pytest.mark.parametrize(("number", "suffix"), [(1, ".cpp"), (2, ".cc"), (3, ".cpp"), (9, ".cpp")])
def test_cpplint_on_a_source_of_another_package(tmp_path: Path, number: int, suffix: str) -> None:
    text = '#include "other/a.cpp"\n#include <other/a.cc>\n#include <a.cpp>\n'
    (said,) = parse(cpplint, tmp_path, {"a b.cpp": text}, DONE, INCLUDED.format(number, suffix))
    assert isinstance(said, Finding) and said.result.rule == "build/include"


@pytest.mark.parametrize("stdout", ["", "Total errors found: 0\n", "Done processing ./b.cpp\n"])
def test_cpplint_must_answer_for_every_file(tmp_path: Path, stdout: str) -> None:
    with pytest.raises(ValueError, match="no answer for a b.cpp"):
        parse(cpplint, tmp_path, {"a b.cpp": ""}, stdout, "Traceback (most recent call last):\n")


def message(**changes: object) -> dict[str, object]:
    plain = {"type": "warning", "symbol": "unused-import", "message": "Unused import os", "obj": "Arm.move", "line": 2}
    return {**plain, "path": "a.py", "column": 4, "endLine": 2, "endColumn": 9, **changes}


def report(*messages: dict[str, object]) -> str:
    return json.dumps({"messages": messages, "statistics": {}})


def test_pylint_counts_columns_from_one_and_knows_the_scope(tmp_path: Path) -> None:
    (said,) = parse(pylint, tmp_path, {"a.py": "\n"}, report(message()), code=4)
    assert isinstance(said, Finding)
    assert said.result.location == Location("a.py", 2, 5, 2, 10)
    assert (said.result.level, said.result.scope) == (Level.WARNING, "Arm.move")


PYLINT = [
    (
        [message(type="fatal", symbol="astroid-error", message="/home/x/a.py: boom")],
        [("a.py", "astroid-error, a fault of pylint", None)],
    ),
    ([message(symbol="syntax-error")], [("a.py", "syntax-error", "a.py:2:5")]),
    # said once, in the file that is imported
    ([message(symbol="syntax-error", message="Parsing failed: 'invalid syntax (b, line 9000)'", line=9000)], []),
    ([message(symbol="syntax-error", message="Cannot import 'b' due to 'invalid syntax (b, line 47)'")], []),
    ([message(symbol="unknown-option-value")], []),
    ([message(path="elsewhere.py")], []),
    ([message(path="./a.py", line=0, column=0, endLine=None)], [("a.py", "unused-import", "a.py:1:1")]),
    ([], []),
]


@pytest.mark.parametrize(("messages", "expected"), PYLINT)
def test_pylint(tmp_path: Path, messages: list[dict[str, object]], expected: list[object]) -> None:
    assert brief(parse(pylint, tmp_path, {"a.py": "\n"}, report(*messages), code=16)) == expected


@pytest.mark.parametrize("before", ["The Zen of Python, by Tim Peters\n\n{not the report}\n", "{\n"])
def test_pylint_after_what_a_module_says_that_it_imports(tmp_path: Path, before: str) -> None:
    text = before + json.dumps(json.loads(report(message())), indent=4)
    (said,) = parse(pylint, tmp_path, {"a.py": "\n"}, text, code=4)
    assert isinstance(said, Finding)


def test_pylint_on_python_2(tmp_path: Path) -> None:
    text = report(message(symbol="syntax-error"), message(), message(path="b.py"))
    said = parse(pylint, tmp_path, {"a.py": "print 'x'\n", "b.py": ""}, text)
    assert brief(said) == [("a.py", "it is Python 2", 2), ("b.py", "unused-import", "b.py:2:5")]


def test_pylint_on_python_that_is_newer_than_its_own(tmp_path: Path) -> None:
    said = parse(pylint, tmp_path, {"a.py": "x = 1\ntype A = int\n"}, report(message(symbol="syntax-error")))
    if sys.version_info < (3, 12):
        version = ".".join(map(str, sys.version_info[:2]))
        why = f"it is for Python 3.12 or later, and haros-ci runs on Python {version}; run it on that of the robot"
        assert brief(said) == [("a.py", why, 2)]
    else:
        assert brief(said) == [("a.py", "syntax-error", "a.py:2:5")]


@pytest.mark.parametrize(
    ("stdout", "code"), [("", 1), ("{", 0), ("{}", 0), ("[]", 0), (report(), 32), ('{"messages": [{}]}', 0)]
)
def test_pylint_refuses(tmp_path: Path, stdout: str, code: int) -> None:
    with pytest.raises((ValueError, KeyError, TypeError)):
        parse(pylint, tmp_path, {"a.py": ""}, stdout, code=code)


def xml(*errors: str) -> str:
    return f'<?xml version="1.0"?><results version="2"><errors>{"".join(errors)}</errors></results>'


def error(id: str = "nullPointer", severity: str = "error", file0: str = "a.cpp", places: str = "a.cpp:3:5") -> str:
    located = ""
    for number, place in enumerate(places.split()):
        path, line, column = place.split(":")
        located += f'<location file="{path}" line="{line}" column="{column}" info="step {number}"/>'
    origin = f' file0="{file0}"' if file0 else ""
    return f'<error id="{id}" severity="{severity}" msg="Said &lt;it&gt;"{origin}>{located}</error>'


GROUP = json.dumps(["c++", ["include", "."], []])
CPPCHECK = [
    (error(), [("a.cpp", "nullPointer", "a.cpp:3:5")]),
    (error(places="h.hpp:1:0 a.cpp:3:5"), [("a.cpp", "nullPointer", "h.hpp:1")]),
    (error(file0="", places="h.hpp:1:2"), [("a.cpp", "nullPointer", "h.hpp:1:2")]),
    (error("syntaxError"), [("a.cpp", "Said <it>", 3)]),
    (error("directiveAsMacroParameter"), [("a.cpp", "Said <it>", 3)]),
    (error("unknownMacro", places="h.hpp:4:1"), [("a.cpp", "Said <it> (h.hpp:4)", None)]),
    (error("syntaxError", file0="", places="h.hpp:4:1"), [("a.cpp", "Said <it> (h.hpp:4)", None)]),
    (error("syntaxError") + error("unknownMacro"), [("a.cpp", "Said <it>", 3)]),
    (error("missingIncludeSystem", "information"), []),
    (error("toomanyconfigs", "style"), []),
    (error("normalCheckLevelMaxBranches", "information"), []),
    (error("checkersReport", "information", places=""), []),
    (error("internalThing", places=""), []),
    ("", []),
]


@pytest.mark.parametrize(("errors", "expected"), CPPCHECK)
def test_cppcheck(tmp_path: Path, errors: str, expected: list[object]) -> None:
    files = {"a.cpp": '#include "h.hpp"\n\n', "b.cpp": "", "h.hpp": "\n"}
    assert brief(parse(cppcheck, tmp_path, files, stderr=xml(errors), group=GROUP)) == expected


@pytest.mark.parametrize(
    ("needs", "given", "expected"),
    [
        ("int *", "unsigned int *", Level.NOTE),
        ("unsigned int *", "signed int *", Level.NOTE),
        ("long *", "unsigned long *", Level.NOTE),
        ("short *", "unsigned short *", Level.NOTE),
        ("int *", "unsigned char *", Level.WARNING),
        ("int *", "signed long *", Level.WARNING),
        ("int *", "double *", Level.WARNING),
        ("unsigned int *", "size_t * {aka unsigned long *}", Level.WARNING),
        ("int *", "int", Level.WARNING),
    ],
)
def test_cppcheck_on_a_number_whose_sign_alone_differs(tmp_path: Path, needs: str, given: str, expected: Level) -> None:
    message = f"%d in format string (no. 1) requires '{needs}' but the argument type is '{given}'."
    stderr = xml(error("invalidScanfArgType_int", "warning").replace("Said &lt;it&gt;", message))
    (said,) = parse(cppcheck, tmp_path, {"a.cpp": ""}, stderr=stderr, group=GROUP)
    assert isinstance(said, Finding) and said.result.level is expected
    stderr = stderr.replace("invalidScanfArgType_int", "invalidPrintfArgType_uint")
    (said,) = parse(cppcheck, tmp_path, {"a.cpp": ""}, stderr=stderr, group=GROUP)
    assert isinstance(said, Finding) and said.result.level is Level.WARNING


def test_cppcheck_explains_with_all_its_locations(tmp_path: Path) -> None:
    (said,) = parse(
        cppcheck, tmp_path, {"a.cpp": ""}, stderr=xml(error(places="a.cpp:3:5 a.cpp:1:2 a.cpp:2:2")), group=GROUP
    )
    assert isinstance(said, Finding)
    assert [(r.message, str(r.location)) for r in said.result.related] == [
        ("step 1", "a.cpp:1:2"),
        ("step 2", "a.cpp:2:2"),
    ]


def test_cppcheck_counts_bytes_and_we_code_points(tmp_path: Path) -> None:
    text = "int a; /* \u00e9\u00e9 */ x\n"
    (said,) = parse(cppcheck, tmp_path, {"a.cpp": text}, stderr=xml(error(places="a.cpp:1:19")), group=GROUP)
    assert isinstance(said, Finding) and said.result.location.column == text.index("x") + 1


BOMB = '<?xml version="1.0"?><!DOCTYPE r [<!ENTITY a "b"><!ENTITY c "&a;&a;">]><results><error id="&c;"/></results>'
NOT_CPPCHECK = [
    "",
    "cppcheck: error: could not find",
    xml()[:-10],
    BOMB,
    xml('<error severity="error"><location/></error>'),
]


@pytest.mark.parametrize("stderr", NOT_CPPCHECK)
def test_cppcheck_refuses(tmp_path: Path, stderr: str) -> None:
    with pytest.raises((ValueError, KeyError)):
        parse(cppcheck, tmp_path, {"a.cpp": ""}, stderr=stderr, group=GROUP)
    with pytest.raises(ValueError, match="exit code"):
        parse(cppcheck, tmp_path, {"a.cpp": ""}, stderr=xml(), code=1, group=GROUP)


def test_cppcheck_text_that_xml_does_not_allow(tmp_path: Path) -> None:
    stderr = xml(error()).replace("Said", "Said \x1b\x00")
    (said,) = parse(cppcheck, tmp_path, {"a.cpp": ""}, stderr=stderr, group=GROUP)
    assert isinstance(said, Finding) and said.result.message == "Said ?? <it>"


def test_ruff(tmp_path: Path) -> None:
    def item(path: Path, code: str | None, row: int = 1) -> dict[str, object]:
        end = {"row": row, "column": 9}
        return {
            "filename": str(path),
            "code": code,
            "message": "m",
            "location": {"row": row, "column": 8},
            "end_location": end,
        }

    items = [
        item(tmp_path / "a.py", "F401"),
        item(tmp_path / "b.py", "F821"),
        item(tmp_path / "b.py", None, 2),
        item(tmp_path / "b.py", "F401", 3),
        item(tmp_path / "c.py", "F821"),
        item(tmp_path / "c.py", None, 2),
        item(tmp_path / "c.py", "F401"),
        item(Path("/etc/passwd"), "F401"),
    ]
    files = {"a.py": "import os\n", "b.py": "\n(\n", "c.py": "\nprint 'x'\n"}
    said = parse(ruff, tmp_path, files, json.dumps(items))
    assert brief(said) == [
        ("c.py", "it is Python 2", 2),
        ("a.py", "F401", "a.py:1:8"),
        ("b.py", "invalid-syntax", "b.py:2:8"),
    ]


TIDY = """{root}/a.cpp:3:5: warning: null dereference [clang-analyzer-core.NullDereference]
   return *p;
{root}/a.cpp:1:2: note: 'p' initialized here
{root}/h.hpp:2:1: warning: throwing [bugprone-exception-escape,cert-err58-cpp]
12 warnings generated.
"""


def test_clang_tidy(tmp_path: Path) -> None:
    said = parse(clang_tidy, tmp_path, {"a.cpp": ""}, TIDY.format(root=tmp_path), code=1)
    assert brief(said) == [
        ("a.cpp", "clang-analyzer-core.NullDereference", "a.cpp:3:5"),
        ("a.cpp", "bugprone-exception-escape", "h.hpp:2:1"),
    ]
    assert isinstance(said[0], Finding)
    assert [str(related.location) for related in said[0].result.related] == ["a.cpp:1:2"]


def test_clang_tidy_gives_up_where_the_compiler_does(tmp_path: Path) -> None:
    line = f"{tmp_path}/a.cpp:1:10: error: 'rclcpp/rclcpp.hpp' file not found [clang-diagnostic-error]\n"
    assert brief(parse(clang_tidy, tmp_path, {"a.cpp": ""}, line, code=1)) == [
        ("a.cpp", "'rclcpp/rclcpp.hpp' file not found", 1)
    ]


CATKIN = {
    "errors": [
        {"id": "PROJECT_NAME", "location": {"file": "CMakeLists.txt", "line": 2, "package": "robot"}, "text": "t"}
    ],
    "warnings": [{"id": "MISSING_DIRECTORY", "location": {"package": "robot"}, "text": "t"}],
    "notices": [{"id": "INDENTATION", "location": {"file": "a.cmake", "line": 1, "package": "other"}, "text": "t"}],
}


def test_catkin_lint(tmp_path: Path) -> None:
    files = {"robot/package.xml": "", "robot/CMakeLists.txt": ""}
    assert brief(parse(catkin_lint, tmp_path, files, json.dumps(CATKIN))) == [
        ("robot/package.xml", "PROJECT_NAME", "robot/CMakeLists.txt:2"),
        ("robot/package.xml", "MISSING_DIRECTORY", "robot/package.xml"),
    ]


def test_catkin_lint_says_once_what_is_missing_and_weighs_it(tmp_path: Path) -> None:
    def item(identifier: str, line: int, text: str) -> dict[str, object]:
        return {
            "id": identifier,
            "location": {"file": "CMakeLists.txt", "line": line, "package": "robot"},
            "text": text,
        }

    lines = [("MISSING_DEPEND", 9, "rostest"), ("MISSING_DEPEND", 4, "rostest"), ("MISSING_DEPEND", 5, "tf")]
    errors = [item(*each) for each in (*lines, ("MISSING_CATKIN_DEPEND", 6, "tf"), ("MISSING_FILE", 7, "'.test'"))]
    files = {"robot/package.xml": "", "robot/CMakeLists.txt": "\n" * 9}
    said = parse(catkin_lint, tmp_path, files, json.dumps({"errors": errors, "warnings": [], "notices": []}))
    found = [s.result for s in said if isinstance(s, Finding)]
    assert [(r.rule, r.location.line, r.level, [n.location.line for n in r.related]) for r in found] == [
        ("MISSING_DEPEND", 4, Level.ERROR, [9]),
        ("MISSING_DEPEND", 5, Level.ERROR, []),
        ("MISSING_CATKIN_DEPEND", 6, Level.WARNING, []),
    ]


@pytest.mark.parametrize(
    ("missing", "rules"),
    [
        ("missing find_package(catkin).", ["MISSING_FIND"]),
        ("missing find_package(Boost).", ["CATKIN_ORDER_VIOLATION", "MISSING_FIND"]),
    ],
)
def test_catkin_lint_says_once_that_catkin_is_not_found(tmp_path: Path, missing: str, rules: list[str]) -> None:
    place = {"file": "CMakeLists.txt", "line": 4, "package": "robot"}
    order = {
        "id": "CATKIN_ORDER_VIOLATION",
        "location": place,
        "text": "catkin_package() is called before find_package(catkin).",
    }
    find = {"id": "MISSING_FIND", "location": {**place, "line": 9}, "text": missing}
    report = {"errors": [order, find], "warnings": [], "notices": []}
    said = parse(catkin_lint, tmp_path, {"robot/package.xml": "", "robot/CMakeLists.txt": "\n" * 9}, json.dumps(report))
    assert [each.result.rule for each in said if isinstance(each, Finding)] == rules


@pytest.mark.parametrize(
    ("line", "is_old"),
    [
        ("except (A, B), e:", True),
        ("except rospy.ROSException, e:", True),
        ("except (A or B):", False),
        ("except A, B:", False),
        ("except (A, B) as e:", False),
    ],
)
def test_ruff_on_what_binds_an_exception_in_python_2(tmp_path: Path, line: str, is_old: bool) -> None:
    said = {
        "code": "B030",
        "filename": str(tmp_path / "a.py"),
        "message": "`except` handlers",
        "location": {"row": 3, "column": 8},
        "end_location": {"row": 3, "column": 12},
    }
    (found,) = parse(ruff, tmp_path, {"a.py": f"try:\n    a()\n{line}\n    pass\n"}, json.dumps([said]))
    assert isinstance(found, GaveUp) == is_old
