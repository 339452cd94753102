# SPDX-License-Identifier: Apache-2.0
"""Files that a change puts in the place of others: named, where the base did not have it so."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from haros_ci.workspace.discover import discover
from haros_ci.workspace.shadowing import shadowed

MANIFEST = "<package format='3'><name>{}</name><version>1.0.0</version></package>\n"
USE = '#include "arm/give.hpp"\nint main() { return give(); }\n'
GIVE = "inline int give() { return 1; }\n"
LISTS = "project(arm)\nadd_executable(driver src/driver.cpp)\n"
FIRST = "target_include_directories(driver PUBLIC {})\n"
HEADER = {"arm/package.xml": MANIFEST.format("arm"), "arm/src/driver.cpp": USE, "arm/include/arm/give.hpp": GIVE}
OTHER = {"more/package.xml": MANIFEST.format("more")}
PYTHON = {"tool/package.xml": MANIFEST.format("tool"), "tool/tool/names.py": "A = 1\n", "tool/tool/__init__.py": ""}
INSTALL = "install(PROGRAMS {} DESTINATION lib/arm)\n"
DEPENDS = HEADER | {
    "arm/package.xml": MANIFEST.format("arm").replace("</version>", "</version><depend>rclcpp</depend>")
}
TARGET = "install(TARGETS driver DESTINATION lib/arm)\n"


def brought(place: Path, base: dict[str, str], head: dict[str, str]) -> list[tuple[str, str]]:
    spaces = []
    for side, files in (("base", base), ("head", base | head)):
        for name, text in files.items():
            path = place / side / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        subprocess.run(["git", "init", "-q", place / side], check=True)
        spaces.append(discover(place / side, ()))
    return [(problem.path, problem.message) for problem in shadowed(spaces[1], spaces[0])]


@pytest.mark.parametrize(
    ("base", "head", "path", "words"),
    [
        (
            HEADER,
            {"arm/first/arm/give.hpp": GIVE},
            "arm/first/arm/give.hpp",
            "may mean this file or arm/include/arm/give.hpp",
        ),
        (
            HEADER | OTHER,
            {"more/include/arm/give.hpp": GIVE},
            "more/include/arm/give.hpp",
            "may mean this file or arm/",
        ),
        (
            HEADER | {"arm/first/arm/give.hpp": GIVE, "arm/CMakeLists.txt": LISTS + FIRST.format("include first")},
            {"arm/CMakeLists.txt": LISTS + FIRST.format("first include")},
            "arm/first/arm/give.hpp",
            "may mean this file or arm/include/arm/give.hpp",
        ),
        (PYTHON, {"tool/tool/names/__init__.py": ""}, "tool/tool/names/__init__.py", "in place of tool/tool/names.py"),
        (DEPENDS, {"arm/rclcpp/rclcpp.hpp": GIVE}, "arm/rclcpp/rclcpp.hpp", "linters take this for rclcpp/rclcpp.hpp"),
        (
            DEPENDS,
            {"arm/src/rclcpp/node.hpp": GIVE},
            "arm/src/rclcpp/node.hpp",
            "linters take this for rclcpp/node.hpp",
        ),
        (
            DEPENDS,
            {"arm/include/rclcpp/node.hpp": GIVE},
            "arm/include/rclcpp/node.hpp",
            "linters take this for rclcpp/node.hpp",
        ),
        (HEADER, {"arm/src/stdlib.h": GIVE}, "arm/src/stdlib.h", "linters take this for stdlib.h"),
        (PYTHON, {"tool/json.py": "A = 1\n"}, "tool/json.py", "the module json of Python's own"),
        (PYTHON, {"json/__init__.py": ""}, "json/__init__.py", "the module json of Python's own"),
        (PYTHON, {"queue.py": ""}, "queue.py", "the module queue of Python's own"),
        (
            PYTHON,
            {"tool/tool/names.cpython-312-x86_64-linux-gnu.so": ""},
            "tool/tool/names.cpython-312-x86_64-linux-gnu.so",
            "in place of",
        ),
        (
            HEADER,
            {"arm/CMakeLists.txt": LISTS + INSTALL.format("a/go b/go")},
            "arm/CMakeLists.txt",
            "a/go and b/go are installed as lib/arm/go",
        ),
        (
            HEADER,
            {"arm/CMakeLists.txt": LISTS + TARGET + INSTALL.format("b/driver")},
            "arm/CMakeLists.txt",
            "driver and b/driver are",
        ),
        (
            HEADER,
            {"arm/CMakeLists.txt": f"if(A)\n{INSTALL.format('a/go')}endif()\n" + INSTALL.format("go")},
            "arm/CMakeLists.txt",
            "a/go and go",
        ),
    ],
)
def test_named(tmp_path: Path, base: dict[str, str], head: dict[str, str], path: str, words: str) -> None:
    ((place, message),) = brought(tmp_path, base, head)
    assert place == path and words in message


TWICE = HEADER | {"arm/first/arm/give.hpp": GIVE}


@pytest.mark.parametrize(
    ("base", "head"),
    [
        (HEADER, {"arm/include/arm/other.hpp": GIVE}),
        (HEADER, {"arm/src/give.hpp": GIVE}),
        (HEADER, {"arm/first/arm/give.txt": GIVE}),
        (HEADER | OTHER, {"more/include/more/give.hpp": GIVE, "more/src/a.cpp": '#include "more/give.hpp"\n'}),
        (HEADER | OTHER, {"more/src/give.hpp": GIVE, "more/src/a.cpp": '#include "give.hpp"\n'}),
        (
            HEADER,
            {
                "arm/src/one/own.hpp": GIVE,
                "arm/src/one/a.cpp": '#include "own.hpp"\n',
                "arm/src/two/own.hpp": GIVE,
                "arm/src/two/a.cpp": '#include "own.hpp"\n',
            },
        ),
        (TWICE, {"arm/src/driver.cpp": USE + "int other();\n"}),
        (TWICE, {"arm/first/arm/give.hpp": GIVE + "int other();\n"}),
        (
            TWICE | {"arm/CMakeLists.txt": LISTS + FIRST.format("first")},
            {"arm/CMakeLists.txt": LISTS + FIRST.format("first") + "# more\n"},
        ),
        (PYTHON, {"tool/tool/others/__init__.py": ""}),
        (DEPENDS, {"arm/src/node.hpp": GIVE, "arm/include/arm/rclcpp/node.hpp": GIVE, "arm/src/arm/other.hpp": GIVE}),
        (DEPENDS, {"arm/rclcpp.hpp": GIVE, "arm/src/rclcpp.cpp": GIVE, "arm/include/arm/stdlib.h": GIVE}),
        (DEPENDS | {"arm/src/rclcpp/node.hpp": GIVE}, {"arm/src/rclcpp/node.hpp": GIVE + "int b;\n"}),
        (PYTHON, {"tool/tool/json.py": ""}),
        (PYTHON, {"tool/tool/json/__init__.py": ""}),
        (PYTHON, {"tool/test/__init__.py": "", "tool/setup.py": ""}),
        (PYTHON | {"tool/json.py": ""}, {"tool/json.py": "A = 1\n"}),
        (PYTHON, {"tool/tool/names/data.txt": ""}),
        (PYTHON | {"tool/tool/names/__init__.py": ""}, {"tool/tool/names/__init__.py": "A = 2\n"}),
        (PYTHON, {"tool/lib/libnames.so": ""}),
        (HEADER, {"arm/CMakeLists.txt": LISTS + INSTALL.format("a/go b/stop")}),
        (HEADER, {"arm/CMakeLists.txt": LISTS + INSTALL.format("a/go") + INSTALL.format("a/go")}),
        (
            HEADER,
            {"arm/CMakeLists.txt": LISTS + INSTALL.format("a/go") + "install(PROGRAMS b/go DESTINATION lib/more)\n"},
        ),
        (
            HEADER | {"arm/CMakeLists.txt": INSTALL.format("a/go b/go")},
            {"arm/CMakeLists.txt": INSTALL.format("a/go b/go") + LISTS},
        ),
    ],
)
def test_quiet(tmp_path: Path, base: dict[str, str], head: dict[str, str]) -> None:
    assert brought(tmp_path, base, head) == []


LINKED = {"arm/package.xml": MANIFEST.format("arm"), "arm/one.hpp": GIVE, "arm/two.hpp": USE, "arm/a/b.hpp": GIVE}


def turned(
    place: Path, before: dict[str, str], after: dict[str, str], gone: tuple[str, ...] = ()
) -> list[tuple[str, str]]:
    """What is said of links, each a path with its target, that are others after a change."""
    spaces = []
    for side, links in (("base", before), ("head", after)):
        for name, text in LINKED.items():
            path = place / side / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if side == "base" or name not in gone:
                path.write_text(text)
        for name, target in links.items():
            (place / side / name).symlink_to(target)
        subprocess.run(["git", "init", "-q", place / side], check=True)
        spaces.append(discover(place / side, ()))
    return [(problem.path, problem.message) for problem in shadowed(spaces[1], spaces[0])]


def test_a_link_that_leads_to_another_file(tmp_path: Path) -> None:
    ((path, message),) = turned(tmp_path, {"arm/part.hpp": "one.hpp"}, {"arm/part.hpp": "two.hpp"})
    assert path == "arm/part.hpp" and "leads to arm/two.hpp, no longer to arm/one.hpp" in message


def test_a_link_that_leads_to_another_directory(tmp_path: Path) -> None:
    ((path, _),) = turned(tmp_path, {"arm/part": "a"}, {"arm/part": "."})
    assert path == "arm/part"


def test_a_link_in_place_of_a_file(tmp_path: Path) -> None:
    ((path, message),) = turned(tmp_path, {}, {"arm/one.hpp": "two.hpp"}, gone=("arm/one.hpp",))
    assert path == "arm/one.hpp" and "and was a file" in message


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ({"arm/part.hpp": "one.hpp"}, {"arm/part.hpp": "one.hpp"}),
        ({"arm/part.hpp": "one.hpp"}, {"arm/part.hpp": "a/b.hpp"}),
        ({}, {"arm/part.hpp": "two.hpp"}),
        ({"arm/part.hpp": "two.hpp"}, {}),
        ({}, {"arm/part": "a"}),
    ],
)
def test_links_that_are_quiet(tmp_path: Path, before: dict[str, str], after: dict[str, str]) -> None:
    assert turned(tmp_path, before, after) == []


def test_headers_of_one_name_without_number(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("haros_ci.workspace.shadowing._MOST_LOOKS", 1)
    ((path, message),) = brought(tmp_path, HEADER, {f"arm/first{i}/arm/give.hpp": GIVE for i in range(3)})
    assert path == "arm/first0/arm/give.hpp" and "so many headers are called give.hpp" in message


def test_what_stands_behind_the_last_note_is_named_in_one(tmp_path: Path) -> None:
    names = [f"give{number:02}.hpp" for number in range(24)]
    use = "".join(f'#include "arm/{name}"\n' for name in names)
    base = {"arm/package.xml": MANIFEST.format("arm"), "arm/src/driver.cpp": use}
    base |= {f"arm/include/arm/{name}": GIVE for name in names}
    found = brought(tmp_path, base, {f"arm/first/arm/{name}": GIVE for name in names})
    assert len(found) == 21 and "arm/first/arm/give23.hpp" in found[1][1]
    assert found[1][0] == found[0][0] and found[1][1].startswith("there are 4 more than the next 20 of this kind")
