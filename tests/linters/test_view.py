# SPDX-License-Identifier: Apache-2.0
"""What tools get to see in place of the workspace."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from linter_samples import FakeLinter, workspace

from haros_ci.linters.linter import Program, Unit
from haros_ci.linters.view import MOST_BY_LINKS, of_cpp, views
from haros_ci.linters.work import Work
from haros_ci.model.workspace import Workspace


def seen(space: Workspace, place: Path, *needed: str, **names: object) -> dict[str, bytes]:
    """The files in the view of a tool, by path; *names* are those of its adapter."""
    linter = FakeLinter()
    for name, value in names.items():
        setattr(linter, name, value)
    work = Work(linter, Program(("x",), "1"), "", ())
    work.missing = [Unit(space.files[0], dependencies=needed)]
    place.mkdir()
    view = views(space, [work], place)[linter.NAME]
    found = {}
    for path in sorted(view.root.rglob("*")):
        assert not path.is_symlink()
        if path.is_file():
            found[path.relative_to(view.root).as_posix()] = path.read_bytes()
    return found


def test_files_of_its_languages_and_what_a_unit_needs(tmp_path: Path) -> None:
    space = workspace(
        tmp_path / "ws", {"a.py": "x\r\n", "d/e/b.py": b"\xff\n", "c.cpp": "", "rows.inc": "1", "d.yaml": ""}
    )
    assert seen(space, tmp_path / "v") == {"a.py": b"x\r\n", "d/e/b.py": b"\xff\n"}
    assert seen(space, tmp_path / "w", "rows.inc") == {"a.py": b"x\r\n", "d/e/b.py": b"\xff\n", "rows.inc": b"1"}
    assert seen(space, tmp_path / "x", SEES=frozenset({"yaml"})) == {"a.py": b"x\r\n", "d.yaml": b""}


def test_names_where_they_are_asked_for(tmp_path: Path) -> None:
    space = replace(workspace(tmp_path / "ws", {"a.py": "x"}), names=frozenset({"a.py", "meshes/arm.stl"}))
    assert seen(space, tmp_path / "v", SEES_NAMES=True) == {"a.py": b"x", "meshes/arm.stl": b""}


def test_links_are_copies_of_what_they_lead_to_inside(tmp_path: Path) -> None:
    space = workspace(tmp_path / "ws", {"a.py": "x", "d/b.py": "y"})
    space = replace(space, links=(("l.py", "a.py"), ("m", "d"), ("n.py", "gone.py")))
    assert seen(space, tmp_path / "v") == {"a.py": b"x", "d/b.py": b"y", "l.py": b"x", "m/b.py": b"y"}


def test_links_do_not_multiply_the_tree_without_end(tmp_path: Path) -> None:
    space = workspace(tmp_path / "ws", {f"d/{n}.py": "" for n in range(100)})
    space = replace(space, links=tuple((f"l{n:03}", "d") for n in range(200)))
    assert len(seen(space, tmp_path / "v")) == 100 + MOST_BY_LINKS


def test_execute_bits_stay(tmp_path: Path) -> None:
    space = replace(workspace(tmp_path / "ws", {"a.py": "", "b.py": ""}), executables=frozenset({"b.py"}))
    seen(space, tmp_path / "v")
    modes = [os.stat(tmp_path / "v" / "view0" / name).st_mode & 0o777 for name in ("a.py", "b.py")]
    assert modes == [0o600, 0o700]


def test_includes_that_lead_out_are_blanked_for_those_who_follow_them(tmp_path: Path) -> None:
    text = b'#include "b.h"\n#include "/etc/passwd"\n#include "../c/rows.inc"\n// \xe9\n'
    space = workspace(tmp_path / "ws", {"a/a.py": text, "c/rows.inc": "1"})
    assert seen(space, tmp_path / "v", "c/rows.inc")["a/a.py"] == text
    made = seen(space, tmp_path / "w", "c/rows.inc", FOLLOWS_INCLUDES=True)["a/a.py"]
    assert made == b'#include "b.h"\n                      \n#include "../c/rows.inc"\n// \xe9\n'
    assert b"rows.inc" not in seen(space, tmp_path / "x", FOLLOWS_INCLUDES=True)["a/a.py"], "it is not in this view"


def test_a_file_that_is_gone_is_not_there(tmp_path: Path) -> None:
    space = workspace(tmp_path / "ws", {"a.py": "x", "b.py": "y"})
    (tmp_path / "ws" / "b.py").unlink()
    assert seen(space, tmp_path / "v") == {"a.py": b"x"}


def test_trusted_tools_get_the_workspace_itself(tmp_path: Path) -> None:
    linter = FakeLinter()
    linter.TRUSTED = True  # type: ignore[attr-defined]
    space = workspace(tmp_path / "ws", {"a.py": "x"})
    work = Work(linter, Program(("x",), "1"), "", ())
    work.missing = [Unit(space.files[0])]
    assert views(space, [work], tmp_path) == {}


def test_the_exact_tier_has_a_view_of_its_own(tmp_path: Path) -> None:
    space = workspace(tmp_path / "ws", {"a.cpp": '#include "/x"\n', "b.py": ""})
    view = of_cpp(space, tmp_path / "v")
    assert view.root == tmp_path / "v" and os.listdir(view.root) == ["a.cpp"]
    assert (view.root / "a.cpp").read_text() == "             \n"
