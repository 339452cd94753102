# SPDX-License-Identifier: Apache-2.0
"""The exact second tier through the real command: it fills what the first leaves unknown, and changes nothing else."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from commandline import haros, write

from haros_ci.analysis import exactness
from haros_ci.analysis.architecture import architecture
from haros_ci.analysis.exactness import ask, doubtful
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

HEADERS = {
    "ros/ros.h": """#pragma once
#include <lib/number.h>
namespace std { typedef const char* string; }
namespace ros {
void init(int& argc, char** argv, const char* name);
struct NodeHandle {
  void setParam(const char* name, double value);
  void setParam(const char* name, bool value);
  template <class T> void param(const char* name, T& value, const T& otherwise);
};
}
""",
    "lib/number.h": "#pragma once\nnamespace lib { struct Reading { double value() const; bool valid() const; }; Reading read(); }\n",
}
WORKSPACE = {
    "p/package.xml": '<package format="2"><name>p</name><version>1.0.0</version></package>',
    "p/CMakeLists.txt": "project(p)\nfind_package(catkin REQUIRED)\nadd_executable(n src/n.cpp)\n",
    "p/src/n.cpp": """#include <ros/ros.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  nh.setParam("known", true);
  nh.setParam("real", lib::read().value());
  nh.setParam("flag", lib::read().valid());
}
""",
}


def model(place: Path, *flags: str) -> dict[str, Any]:
    done = haros("model", ".", "--format=json", "--no-cache", *flags, cwd=place)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def setters(document: dict[str, Any]) -> dict[str, tuple[str | None, str]]:
    node = document["configurations"][0]["nodes"][0]
    return {end["name"]: (end["type"], end["source"]) for end in node["setters"]}


def test_nothing_is_asked_where_nothing_is_unknown() -> None:
    assert doubtful(Architecture()) == {}


def test_blanks_are_filled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("clang.cindex")
    write(tmp_path / "ws", WORKSPACE)
    write(tmp_path / "include", HEADERS)
    before = setters(model(tmp_path / "ws"))
    assert before == {"/known": ("bool", "source"), "/real": (None, "source"), "/flag": (None, "source")}

    monkeypatch.setattr(exactness, "default_headers", lambda: (str(tmp_path / "include"),))
    workspace = discover(tmp_path / "ws", (".",))
    found = architecture(workspace, Settings(root=tmp_path / "ws"), MemoryCache(), exact=True)
    ends = {end.name: (end.type, end.source) for end in found.configurations[0].nodes[0].endpoints}
    assert ends == {"/known": ("bool", "source"), "/real": ("double", "exact-tier"), "/flag": ("bool", "exact-tier")}


def test_what_was_known_without_it_is_of_the_source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The names of these come from the command line: libclang is asked, and what it knows of the calls was known."""
    pytest.importorskip("clang.cindex")
    code = (
        "#include <ros/ros.h>\nint main(int argc, char** argv) {\n"
        '  ros::init(argc, argv, "n");\n  ros::NodeHandle nh;\n  double rate;\n'
        "  nh.setParam(argv[1], true);\n  nh.param(argv[2], rate, 5.0);\n"
        '  nh.setParam("real", lib::read().value());\n}\n'
    )
    write(tmp_path / "ws", {**WORKSPACE, "p/src/n.cpp": code})
    write(tmp_path / "include", HEADERS)
    monkeypatch.setattr(exactness, "default_headers", lambda: (str(tmp_path / "include"),))
    workspace = discover(tmp_path / "ws", (".",))
    found = architecture(workspace, Settings(root=tmp_path / "ws"), MemoryCache(), exact=True)
    ends = [(end.kind, end.name, end.type, end.source) for end in found.configurations[0].nodes[0].endpoints]
    assert sorted(ends) == [
        ("getters", "/?", "double", "source"),
        ("setters", "/?", "bool", "source"),
        ("setters", "/real", "double", "exact-tier"),
    ]


def test_without_libclang_it_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci.analysis import exactness

    write(tmp_path, WORKSPACE)
    (tmp_path / "python").write_text("#!/bin/sh\nexit 3\n")
    (tmp_path / "python").chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    monkeypatch.setattr(exactness, "default_headers", lambda: (str(tmp_path),))
    told, problems = ask(discover(tmp_path, (".",)), Settings(root=tmp_path), {"p/src/n.cpp": [(6, 3)]})
    assert not told
    assert "pip install 'haros-ci[exact]'" in problems[0].message
