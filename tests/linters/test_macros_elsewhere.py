# SPDX-License-Identifier: Apache-2.0
"""Macros with code in headers that cppcheck is not given are named where a change uses them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.seen_otherwise import notifications
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace

GIVE = "#define GIVE(v) do { int kept = v; return kept; } while (false)\n"
USE = "int & pick(int v)\n{\n  GIVE(v);\n}\n"
SOURCE = '#include "give.hpp"\n'


def space(root: Path, files: dict[str, str]) -> Workspace:
    made = workspace(root, files)
    packages = tuple(Package(name=name, path=name) for name in ("arm", "other"))
    return replace(
        made,
        packages=packages,
        files=tuple(replace(file, package=file.path.partition("/")[0]) for file in made.files),
        names=frozenset(files),
    )


def said(place: Path, base: dict[str, str], head: dict[str, str]) -> list[tuple[str | None, str]]:
    found = notifications(space(place / "head", base | head), space(place / "base", base))
    return [(note.path, note.message) for note in found]


@pytest.mark.parametrize(
    ("header", "text", "name"),
    [
        ("arm/inc/give.hpp", GIVE, "give.hpp"),
        ("other/include/other/give.hpp", GIVE, "other/give.hpp"),
        ("other/include/other/give.hpp", "#define GIVE(v) \\\n  throw v\n", "other/give.hpp"),
        ("other/include/other/give.hpp", "#define GIVE(v) int kept = v; use(kept)\n", "other/give.hpp"),
    ],
)
def test_named(tmp_path: Path, header: str, text: str, name: str) -> None:
    base = {header: text, "arm/src/a.cpp": "int a;\n"}
    ((path, message),) = said(tmp_path, base, {"arm/src/a.cpp": f'#include "{name}"\n{USE}'})
    assert path == "arm/src/a.cpp" and f"given the macro GIVE of {header} in another way" in message


PLAIN = "int & pick()\n{\n  return GIVE;\n}\n"
OTHER = '#include "other/give.hpp"\n'


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("#define GIVE local\n", PLAIN),
        ("#define GIVE (local)\n", PLAIN),
        ("#define GIVE (0, *local)\n", PLAIN),
        ("#define GIVE nullptr\n", PLAIN),
        ("#define GIVE &\n", "int GIVE pick();\n"),
        ("#define GIVE(v) (v)\n", "int & a = GIVE(b);\n"),
        ("#define GIVE(v) kept + v\n", "int a = GIVE(b);\n"),
        ("#define static\n", "static int a;\n"),
        ("#define static inline\n", "static int a;\n"),
        ("#undef GIVE\n", PLAIN),
        ("#define KEEP\n", "#ifndef KEEP\n#define KEEP static\n#endif\n"),
    ],
)
def test_a_word_for_a_word(tmp_path: Path, text: str, code: str) -> None:
    base = {"other/include/other/give.hpp": text, "arm/src/a.cpp": "int a;\n"}
    assert [path for path, _ in said(tmp_path, base, {"arm/src/a.cpp": OTHER + code})] == ["arm/src/a.cpp"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("#define GIVE 3\n", PLAIN),
        ("#define GIVE (1.5f * 2)\n", PLAIN),
        ('#define GIVE "local"\n', PLAIN),
        ("#define GIVE 'a'\n", PLAIN),
        ("#define GIVE\n", PLAIN),
        ("#define GIVE MOST\n", PLAIN),
        ("#define GIVE double\n", PLAIN),
        ("#define GIVE uint8_t\n", PLAIN),
        ("#define GIVE true\n", PLAIN),
        ("#define GIVE std::string\n", PLAIN),
        ('#define GIVE rclcpp::get_logger("a")\n', PLAIN),
        ('#define GIVE __attribute__((visibility("default")))\n', "GIVE int a;\n"),
        ("#define GIVE(v) ((v) * M_PI / 180.0)\n", "double a = GIVE(b);\n"),
        ("#define GIVE(v) static_cast<float>(v)\n", "float a = GIVE(b);\n"),
        ("#define GIVE local\n", "// GIVE\nint a;\n"),
        ("#define GIVEN local\n", PLAIN),
    ],
)
def test_no_word_for_a_word(tmp_path: Path, text: str, code: str) -> None:
    base = {"other/include/other/give.hpp": text, "arm/src/a.cpp": "int a;\n"}
    assert said(tmp_path, base, {"arm/src/a.cpp": OTHER + code}) == []


OWN = "static int read(const int * p)\n{\n  return *p;\n}\nint give(int a)\n{\n  return read(&a);\n}\n"


@pytest.mark.parametrize(
    "text",
    [
        "#define read(p) read(0)\n",
        "#define read(...) read(nullptr)\n",
        "#define read(p) take(p)\n",
        "#define read(p) other::take(p)\n",
    ],
)
def test_a_macro_that_is_called_as_a_function(tmp_path: Path, text: str) -> None:
    base = {"other/include/other/give.hpp": text, "arm/src/a.cpp": "int a;\n"}
    ((path, message),) = said(tmp_path, base, {"arm/src/a.cpp": OTHER + OWN})
    assert path == "arm/src/a.cpp" and "the macro read of other/include/other/give.hpp" in message


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("#define read(p) read(p)\n", "int a = read(b);\n"),
        ("#define read(a, ...) read(a, __VA_ARGS__)\n", "int a = read(b, c);\n"),
        (
            "#define read(p) other_read(p, 1)\n",
            "int give(int a)\n{\n  if (read(&a)) {\n    return 1;\n  }\n  return 0;\n}\n",
        ),
        ("#define CHECK(p) check(p)\n", "void give(int a)\n{\n  CHECK(a);\n}\n"),
    ],
)
def test_a_macro_that_is_called_in_place_of_a_function(tmp_path: Path, text: str, code: str) -> None:
    base = {"other/include/other/give.hpp": text, "arm/src/a.cpp": "int a;\n"}
    assert said(tmp_path, base, {"arm/src/a.cpp": OTHER + code}) == []


#: What the change brings, by path; a.cpp, which stays as it is, uses GIVE.
ALONE = {
    "a header": {"other/include/other/give.hpp": "#define GIVE local\n"},
    "a header that a header begins to include": {"arm/include/arm/more.hpp": '#include "other/odd.hpp"\n'},
    "a template": {"arm/cfg/made.hpp.in": "#define GIVE local\n"},
    "a header before each source": {"arm/CMakeLists.txt": "target_precompile_headers(a PRIVATE include/arm/pre.hpp)\n"},
    "a flag": {"arm/CMakeLists.txt": "add_compile_options(-include ${HERE}/include/arm/pre.hpp)\n"},
}


@pytest.mark.parametrize("name", ALONE)
def test_a_file_that_stays_as_it_is(tmp_path: Path, name: str) -> None:
    base = {
        "other/include/other/give.hpp": "#define GIVE kept\n",
        "other/include/other/odd.hpp": "#define GIVE local\n",
        "arm/include/arm/more.hpp": "int more();\n",
        "arm/include/arm/pre.hpp": "#define GIVE local\n",
        "arm/cfg/made.hpp.in": "#define GIVE 1\n",
        "arm/CMakeLists.txt": "configure_file(cfg/made.hpp.in made.hpp)\n",
        "arm/src/a.cpp": '#include "other/give.hpp"\n#include "arm/more.hpp"\n#include "made.hpp"\n' + PLAIN,
        "arm/src/b.cpp": '#include "arm/more.hpp"\nint b;\n',
    }
    assert [path for path, _ in said(tmp_path, base, ALONE[name])] == ["arm/src/a.cpp"]


@pytest.mark.parametrize(
    ("template", "command", "is_named"),
    [
        ("#define GIVE local\n", "configure_file(cfg/made.txt ${BIN}/arm/made.hpp)\n", True),
        ("#cmakedefine GIVE @WORD@\n", "set(WORD local)\nconfigure_file(cfg/made.txt made.hpp)\n", True),
        ("#cmakedefine GIVE @WORD@\n", "set(WORD 3)\nconfigure_file(cfg/made.txt made.hpp)\n", False),
        ('#define GIVE "@WORD@"\n', "configure_file(cfg/made.txt made.hpp)\n", False),
        ("#define GIVE local\n", "configure_file(cfg/made.txt other.hpp)\n", False),
    ],
)
def test_what_a_build_makes_of_a_template(tmp_path: Path, template: str, command: str, is_named: bool) -> None:
    base = {"arm/cfg/made.txt": template, "arm/CMakeLists.txt": command, "arm/src/a.cpp": "int a;\n"}
    found = said(tmp_path, base, {"arm/src/a.cpp": f'#include "arm/made.hpp"\n{PLAIN}'})
    assert [path for path, _ in found] == (["arm/src/a.cpp"] if is_named else [])


def test_named_through_another_header(tmp_path: Path) -> None:
    files = {"arm/include/arm/more.hpp": '#include "other/give.hpp"\n', "other/include/other/give.hpp": GIVE}
    (note,) = said(tmp_path, {"arm/src/a.cpp": ""}, files | {"arm/src/a.cpp": f'#include "arm/more.hpp"\n{USE}'})
    assert "GIVE" in note[1]


@pytest.mark.parametrize(
    ("header", "text", "source"),
    [
        ("arm/include/give.hpp", GIVE, SOURCE + USE),
        ("arm/src/give.hpp", GIVE, SOURCE + USE),
        ("arm/inc/give.hpp", GIVE, SOURCE + "int a;\n"),
        ("arm/inc/give.hpp", GIVE, USE),
        ("arm/inc/give.hpp", GIVE, "// " + SOURCE + USE),
        ("arm/inc/give.hpp", GIVE, "#if 0\n" + SOURCE + "#endif\n" + USE),
        ("arm/inc/give.hpp", "#define GIVE(v) use(v)\n", SOURCE + USE),
        ("arm/inc/give.hpp", "#define GIVE 3\n#define GIVE_IT\nint f() { return 1; }\n", SOURCE + USE),
        ("other/include/other/give.hpp", GIVE, SOURCE.replace("give", "arm/give") + USE),
    ],
)
def test_quiet(tmp_path: Path, header: str, text: str, source: str) -> None:
    assert said(tmp_path, {header: text, "arm/src/a.cpp": "int a;\n"}, {"arm/src/a.cpp": source}) == []


def test_what_the_base_used_is_no_news(tmp_path: Path) -> None:
    base = {"arm/inc/give.hpp": GIVE, "arm/src/a.cpp": SOURCE + USE}
    assert said(tmp_path, base, {"arm/src/a.cpp": SOURCE + USE + "int more;\n"}) == []
