# SPDX-License-Identifier: Apache-2.0
"""Files of tests and of other projects that code begins to use are named; what tests use is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.used_aside import notifications
from haros_ci.model.workspace import Workspace

CODE = "int give() { return 1; }\n"
BASE = {
    "arm/src/a.cpp": "int a;\n",
    "arm/include/vendor/part.hpp": CODE,
    "arm/test/part.cpp": CODE,
    "tool/test/part.py": "A = 1\n",
}
DRIVER = "add_executable({} src/a.cpp {})\n"


def space(root: Path, files: dict[str, str]) -> Workspace:
    made = workspace(root, files)
    language = {"cpp": "cpp", "hpp": "cpp", "py": "python", "txt": "cmake"}
    return replace(
        made,
        files=tuple(
            replace(file, language=language[file.path.rpartition(".")[2]], third_party="/vendor/" in file.path)
            for file in made.files
        ),
    )


def said(place: Path, head: dict[str, str], base: dict[str, str] = BASE) -> list[tuple[str | None, str]]:
    found = notifications(space(place / "head", base | head), space(place / "base", base))
    return [(note.path, note.message) for note in found]


@pytest.mark.parametrize(
    ("path", "text", "used"),
    [
        ("arm/src/a.cpp", '#include "vendor/part.hpp"\n', "arm/include/vendor/part.hpp"),
        ("arm/src/b.cpp", "#include <vendor/part.hpp>\n", "arm/include/vendor/part.hpp"),
        ("arm/src/a.cpp", '#include "../test/part.cpp"\n', "arm/test/part.cpp"),
        ("arm/CMakeLists.txt", DRIVER.format("driver", "test/part.cpp"), "arm/test/part.cpp"),
        ("tool/tool/a.py", "from test.part import A\n", "tool/test/part.py"),
        ("tool/tool/a.py", "from test import other, part\n", "tool/test/part.py"),
        ("tool/tool/a.py", "import test.part\n", "tool/test/part.py"),
    ],
)
def test_named(tmp_path: Path, path: str, text: str, used: str) -> None:
    ((place, message),) = said(tmp_path, {path: text})
    assert place == path and f"it uses {used}, a file of tests" in message


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("arm/src/a.cpp", '// #include "vendor/part.hpp"\n'),
        ("arm/src/a.cpp", '#include "vendor/other.hpp"\n'),
        ("arm/src/a.cpp", '#include "arm/part.hpp"\n'),
        ("arm/test/b.cpp", '#include "part.cpp"\n'),
        ("arm/test/CMakeLists.txt", DRIVER.format("b", "part.cpp")),
        ("arm/CMakeLists.txt", DRIVER.format("test_part", "test/part.cpp")),
        ("arm/CMakeLists.txt", "ament_add_gtest(part test/part.cpp)\n"),
        ("arm/CMakeLists.txt", "# " + DRIVER.format("driver", "test/part.cpp")),
        ("tool/tool/a.py", "'''\nfrom test.part import A\n'''\n"),
        ("tool/tool/a.py", "from tool.part import A\n"),
        ("tool/tool/a.py", "import part_of\n"),
    ],
)
def test_quiet(tmp_path: Path, path: str, text: str) -> None:
    assert said(tmp_path, {path: text}) == []


def test_what_the_base_used_is_no_news(tmp_path: Path) -> None:
    use = '#include "vendor/part.hpp"\n'
    assert said(tmp_path, {"arm/src/a.cpp": f"{use}int more;\n"}, BASE | {"arm/src/a.cpp": use}) == []
    assert notifications(space(tmp_path, BASE), None) == ()


def test_an_own_file_of_the_name_is_meant(tmp_path: Path) -> None:
    assert said(tmp_path, {"arm/src/a.cpp": '#include "part.hpp"\n', "arm/src/part.hpp": CODE}) == []
