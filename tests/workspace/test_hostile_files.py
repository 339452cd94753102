# SPDX-License-Identifier: Apache-2.0
"""Trees that are broken or set as a trap: the rest is analysed, nothing runs, each costs one notice at most."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest
from git_histories import Git, manifest, plant

from haros_ci.model.workspace import Workspace
from haros_ci.workspace.content import examine
from haros_ci.workspace.discover import discover


def outcome(root: Path, **options: int) -> tuple[list[str], list[tuple[str, str]]]:
    """Paths of the files, and where and how the messages begin; good.cpp must always be among the files."""
    plant(root, {"good.cpp": b"int good;\n"})
    workspace = discover(root, (".",), **options)
    files = [file.path for file in workspace.files]
    assert "good.cpp" in files
    files.remove("good.cpp")
    return files, [(problem.path, problem.message) for problem in workspace.problems]


@pytest.fixture(params=["plain", "git"])
def root(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A directory, and the same as a git work tree."""
    root = tmp_path / "ws"
    root.mkdir()
    if request.param == "git":
        Git(root)
    return root


LONG = b"int a; // " + b"x" * 5_000


@pytest.mark.parametrize(
    ("name", "data", "kept", "words"),
    [
        ("a.cpp", b"\x7fELF\0\0\0", False, "binary"),
        ("a.py", b"x = 1\n" * 9_000 + b"\0", False, "binary"),
        ("a.yaml", "a: 1\n".encode("utf-16"), False, "UTF-16"),
        ("a.py", b"\xfe\xff\0a", False, "UTF-16"),
        ("a.cpp", LONG, False, "more than 5000 characters"),
        ("a.py", b"x = 1\n" + LONG, False, "more than 5000 characters"),
        ("a.yaml", b"a" * 20_001, False, "more than 20000 characters"),
        ("a.cpp", b"// Andr\xe9\n", True, "Latin-1"),
        ("a.py", b"ok = 1\n" * 3 + b"# \xff\n", True, "Latin-1"),
        # silently
        ("a.cpp", b"", True, None),
        ("a.cpp", b"\xef\xbb\xbfint a;\r\n", True, None),
        ("a.cpp", b"int a;\rint b;\r" * 1_000, True, None),
        ("a.cpp", b"// " + "é".encode() * 4_990 + b"\n", True, None),
        ("a.cpp", b"x" * 5_000 + b"\n" + b"x" * 5_000 + b"\r\n", True, None),
        ("a.yaml", b"a" * 20_000, True, None),
        ("a.urdf", LONG, True, None),
        ("a.py", "print('🤖')\n".encode(), True, None),
        ("a.py", b"\x0c\x1b[31m\x07\n", True, None),
    ],
)
def test_contents(tmp_path: Path, name: str, data: bytes, kept: bool, words: str | None) -> None:
    plant(tmp_path, {name: data})
    files, problems = outcome(tmp_path)
    assert files == ([name] if kept else [])
    assert [path for path, _ in problems] == ([] if words is None else [name])
    assert words is None or words in problems[0][1]


def test_the_notice_names_the_line() -> None:
    kept, problem = examine("a.cpp", "cpp", b"int a;\n\n" + LONG + b"\n")
    assert not kept and problem is not None and problem.line == 3
    kept, problem = examine("a.cpp", "cpp", b"int a;\n// \xe9\n")
    assert kept and problem is not None and problem.line == 2


def test_a_large_file_is_not_read(root: Path) -> None:
    with (root / "huge.cpp").open("wb") as file:
        file.truncate(200_000_000)
    files, problems = outcome(root)
    assert files == []
    message = "skipped: 200000000 bytes, more than the limit of 2000000; raise it or exclude the file"
    assert problems == [("huge.cpp", message)]


def test_the_limit_can_be_set(root: Path) -> None:
    plant(root, {"a.cpp": b"int a;\n" * 10})
    assert outcome(root, max_file_size=70)[0] == ["a.cpp"]
    assert outcome(root, max_file_size=69)[0] == []


def test_links(root: Path, tmp_path: Path) -> None:
    plant(tmp_path / "outside", {"secret.cpp": b"int secret;\n", "data.bin": b""})
    plant(root, {"arm/a.cpp": b""})
    links = {
        "out.cpp": "../outside/secret.cpp",
        "out_directory": "../outside",
        "absolute": "/",
        "loop": "loop",
        "a/b/up": "../..",
        "again": "arm",
        "arm/alias.cpp": "a.cpp",
        "gone.cpp": "nowhere.cpp",
        "loop.py": "loop.py",
        "data.bin": "../outside/data.bin",
        "src/CMakeLists.txt": "/opt/ros/noetic/share/catkin/cmake/toplevel.cmake",
    }
    for name, target in links.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).symlink_to(target)
    files, problems = outcome(root)
    assert files == ["arm/a.cpp"]
    assert problems == [
        ("absolute", "skipped: a symbolic link that leads out of the workspace"),
        ("gone.cpp", "skipped: a symbolic link that leads nowhere"),
        ("loop.py", "skipped: a symbolic link that leads nowhere"),
        ("out.cpp", "skipped: a symbolic link that leads out of the workspace"),
        ("out_directory", "skipped: a symbolic link that leads out of the workspace"),
    ]
    assert discover(root, ()).links == (("again", "arm"), ("arm/alias.cpp", "arm/a.cpp"))


def test_the_link_that_catkin_makes_costs_nothing(root: Path, tmp_path: Path) -> None:
    plant(tmp_path, {"opt/share/catkin/cmake/toplevel.cmake": b""})
    (root / "src").mkdir()
    (root / "src" / "CMakeLists.txt").symlink_to(tmp_path / "opt/share/catkin/cmake/toplevel.cmake")
    assert outcome(root) == ([], [])


def test_a_directory_that_became_a_link(tmp_path: Path) -> None:
    git = Git(tmp_path / "ws")
    git.commit({"arm/a.cpp": b"", "arm/b.cpp": b""})
    plant(tmp_path / "outside", {"a.cpp": b"int secret;\n", "b.cpp": b"int secret;\n"})
    (git.top / "arm" / "a.cpp").unlink()
    (git.top / "arm" / "b.cpp").unlink()
    (git.top / "arm").rmdir()
    (git.top / "arm").symlink_to("../outside")
    files, problems = outcome(git.top)
    assert files == []
    assert problems == [("arm", "skipped: a symbolic link that leads out of the workspace")]


def test_pipes_and_sockets_are_not_opened(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(root / "a.cpp")
    os.mkfifo(root / "teleop")
    monkeypatch.chdir(root)  # names of sockets are short
    with socket.socket(socket.AF_UNIX) as end:
        end.bind("b.cpp")
        assert outcome(root) == ([], [])


def test_a_pipe_given_by_name(root: Path) -> None:
    os.mkfifo(root / "a.cpp")
    assert discover(root, ("a.cpp",)).files == ()


def test_names(root: Path) -> None:
    """What fits into a line is kept, and escaped by those who print it."""
    names = ["--init-hook=x.py", "-.cpp", "::error::a.py", "a b.cpp", "a\x1b[31m.cpp", "a\u202e.py", "$(x).py", "ä.cpp"]
    names += ["'\".cpp", "a\\n.cpp", "%s.py", "a\tb.cpp"]
    for name in names:
        (root / name).write_bytes(b"")
    files, problems = outcome(root)
    assert files == sorted(names)
    assert problems == []


def test_names_that_do_not_fit_into_a_line(root: Path) -> None:
    for name in (
        b"a\nb.cpp",
        b"c\r.py",
        b"latin-\xe9.cpp",
        b"line\xe2\x80\xa8.cpp",
        b"d\n/x.cpp",
        b"d\n/y.cpp",
        b"e\n.txt",
    ):
        path = os.path.join(os.fsencode(root), name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb"):
            pass
    files, problems = outcome(root)
    assert files == []
    assert len(problems) == 6  # the text file is nobody's business, the directory is named once
    for path, message in problems:
        assert path == "." and message.isprintable()
        message.encode("utf-8")


def test_deep_nesting(root: Path) -> None:
    deep = "/".join(["d"] * 300)
    plant(root, {f"{deep}/deep.cpp": b"", f"{deep}/package.xml": manifest("deep")})
    workspace = discover(root, (".",), exclude=("x/",))
    assert [file.path for file in workspace.files] == [f"{deep}/deep.cpp", f"{deep}/package.xml"]
    assert {file.package for file in workspace.files} == {"deep"}


def test_nesting_beyond_what_the_system_can_name(root: Path) -> None:
    here = os.open(root, os.O_RDONLY)
    try:
        for _ in range(30):
            os.mkdir("x" * 200, dir_fd=here)
            below = os.open("x" * 200, os.O_RDONLY, dir_fd=here)
            os.close(here)
            here = below
    finally:
        os.close(here)
    files, problems = outcome(root)
    assert files == [] and len(problems) <= 1


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser can read everything")
def test_what_must_not_be_read(root: Path) -> None:
    plant(root, {"a.cpp": b"", "locked/b.cpp": b""})
    (root / "a.cpp").chmod(0)
    (root / "locked").chmod(0)
    try:
        files, problems = outcome(root)
    finally:
        (root / "locked").chmod(0o700)
    assert files == []
    assert ("a.cpp", "skipped: it cannot be read (Permission denied)") in problems


def test_scripts_are_known_by_their_first_line(root: Path) -> None:
    plant(root, {"run": b"#!/usr/bin/env python3\n", "run.sh": b"#!/bin/sh\n", "LICENSE": b"python\n"})
    plant(root, {"node.v2": b"#!/usr/bin/python\n", "plain.v2": b"#!/usr/bin/python\n", "x.in": b"#!/usr/bin/python\n"})
    (root / "node.v2").chmod(0o755)
    (root / "run.sh").chmod(0o755)
    assert outcome(root) == (["node.v2", "run", "run.sh"], [])


def test_an_entity_bomb_is_a_fault(root: Path) -> None:
    entities = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(9))
    bomb = f'<!DOCTYPE package [<!ENTITY e0 "x">{entities}]><package><name>&e9;</name></package>'
    plant(root, {"arm/package.xml": bomb.encode(), "leg/package.xml": b"<package" * 10_000})
    plant(root, {"good.cpp": b""})
    workspace = discover(root, (".",))
    assert [fault.path for fault in workspace.faults] == ["arm/package.xml", "leg/package.xml"]
    assert [package.name for package in workspace.packages] == ["arm", "leg"]


def test_any_order_on_disk_gives_the_same(tmp_path: Path) -> None:
    names = [f"d{n % 7}/f{n}.py" for n in range(60)]
    for place, order in (("one", names), ("two", names[::-1])):
        plant(tmp_path / place / "ws", {name: name.encode() for name in order})

    def facts(workspace: Workspace) -> tuple[object, ...]:
        return workspace.files, workspace.packages, workspace.problems

    assert facts(discover(tmp_path / "one" / "ws", (".",))) == facts(discover(tmp_path / "two" / "ws", (".",)))
