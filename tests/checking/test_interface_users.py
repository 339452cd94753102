# SPDX-License-Identifier: Apache-2.0
"""Where code names an interface, and whether only some builds see it."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.checking.interface_users import InterfaceUsers, always_at, location_of
from haros_ci.checking.project import Project
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.model.workspace import Workspace


class Texts(dict[str, str]):
    def text(self, path: str) -> str:
        return self.get(path, "")


def project(files: dict[str, str]) -> Project:
    programs = {path: (read_python if path.endswith(".py") else read_cpp)(text) for path, text in files.items()}
    return Project(Workspace(root=Path("/"), packages=(), files=(), reader=Texts(files)), {}, programs)


HEADER = '"demo/msg/state.hpp"'


@pytest.mark.parametrize(
    ("text", "line", "is_certain"),
    [
        (f"#include {HEADER}\n", 1, True),
        (f"#ifndef A_HPP\n#define A_HPP\n#include {HEADER}\n#endif\n", 3, True),
        (f"#pragma once\n\n#  include {HEADER}  // state\n", 3, True),
        (f"#ifdef X\n#include <a.h>\n#endif\n#include {HEADER}\n", 4, True),
        (f"#ifdef X\n#include {HEADER}\n#endif\n", 2, False),
        (f"#ifndef A_HPP\n#define A_HPP\n#if X\n#include {HEADER}\n#endif\n#endif\n", 4, False),
        (f"#if X\n#else\n#include {HEADER}\n#endif\n", 3, False),
        (f"#ifndef X\n#define Y\n#include {HEADER}\n#endif\n", 3, False),
        (f"#if __has_include({HEADER})\n#include {HEADER}\n#endif\n", 2, False),
    ],
)
def test_includes(text: str, line: int, is_certain: bool) -> None:
    made = project({"a.cpp": text})
    assert location_of(made, "a.cpp", HEADER).line == line
    found = always_at(made, "a.cpp", HEADER)
    assert (found.line if found is not None else None) == (line if is_certain else None)


@pytest.mark.parametrize(
    ("text", "line", "column", "is_certain"),
    [
        ("from demo.msg import State\n", 1, 22, True),
        ("from demo.msg import Other, State as S\n", 1, 29, True),
        ("from demo.msg import (\n    Other,  # no State\n    State,\n)\n", 3, 5, True),
        ("from demo.msg import Other, \\\n    State\n", 2, 5, True),
        ("try:\n    from demo.msg import State\nexcept ImportError:\n    State = None\n", 2, 26, False),
        ("if True:\n  from demo.msg import (Other,\n    State)\n", 3, 5, False),
    ],
)
def test_imports(text: str, line: int, column: int, is_certain: bool) -> None:
    made = project({"a.py": text})
    found = location_of(made, "a.py", "demo.msg.State")
    assert (found.line, found.column) == (line, column)
    assert always_at(made, "a.py", "demo.msg.State") == (found if is_certain else None)


@pytest.mark.parametrize(
    "text",
    [
        "from demo.msg import States\n",
        "from demo.msg import Other\nState = 1\n",
        "from demo.msg import (\n    Other,\n)\nState = 1\n",
        "import demo.msg.State\n",
    ],
)
def test_imports_that_are_none(text: str) -> None:
    assert location_of(project({"a.py": text}), "a.py", "demo.msg.State").line is None


def test_who_names_what() -> None:
    files = {
        "a.cpp": f"#include {HEADER}\n#include <demo/State.h>\n",
        "b.py": "from demo.msg import State\nfrom demo.srv import Reset\n",
        "c.py": "from other.msg import State\n",
    }
    users = InterfaceUsers(project(files))
    assert [(u.location.path, u.location.line, u.how) for u in users.of("msg", "demo/State")] == [
        ("a.cpp", 2, "includes it"),
        ("a.cpp", 1, "includes it"),
        ("b.py", 1, "imports it"),
    ]
    assert [u.location.path for u in users.of("srv", "demo/Reset")] == ["b.py"]
    assert list(users.of("msg", "demo/Other")) == []
