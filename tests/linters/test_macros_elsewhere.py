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
