# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from git_histories import Git, manifest, plant

from haros_ci.errors import UserError
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.discover import discover


def found(root: Path, *paths: str, exclude: tuple[str, ...] = ()) -> list[str]:
    return [file.path for file in discover(root, paths or (".",), exclude=exclude).files]


def messages(workspace: Workspace) -> list[tuple[str, str]]:
    return [(problem.path, problem.message) for problem in workspace.problems]


PACKAGE = {
    "package.xml": manifest("arm"),
    "CMakeLists.txt": b"project(arm)\n",
    "src/arm.cpp": b"int main() {}\n",
    "scripts/teleop": b"#!/usr/bin/env python3\nprint()\n",
    "README.md": b"# arm\n",
}
PACKAGE_FILES = ["CMakeLists.txt", "README.md", "package.xml", "scripts/teleop", "src/arm.cpp"]


def test_a_single_package(tmp_path: Path) -> None:
    workspace = discover(plant(tmp_path, PACKAGE), (".",))
    assert [file.path for file in workspace.files] == PACKAGE_FILES
    assert [(package.name, package.path) for package in workspace.packages] == [("arm", ".")]
    assert {file.package for file in workspace.files} == {"arm"}
    source = workspace.files[4]
    assert (source.language, source.size) == ("cpp", 14)
    assert source.digest == hashlib.sha256(b"int main() {}\n").hexdigest()
    assert workspace.targets is None and workspace.problems == () and workspace.faults == ()
    assert workspace.reports_on("src/arm.cpp")


def test_a_package_inside_a_package_is_part_of_it(tmp_path: Path) -> None:
    plant(tmp_path, {"a/package.xml": manifest("outer"), "a/x.py": b"", "a/b/c/x.py": b"", "x.py": b""})
    plant(tmp_path, {"a/b/package.xml": manifest("inner")})
    for scope in ((".",), ("a/b",), ("a/b/c/x.py",)):  # whichever part is asked for
        workspace = discover(tmp_path, scope)
        owners = {file.path: file.package for file in workspace.files}
        assert [(package.name, package.path) for package in workspace.packages] == [("outer", "a")]
        assert owners["a/b/c/x.py"] == owners["a/b/package.xml"] == "outer"
        assert owners.get("a/x.py", "outer") == "outer" and owners.get("x.py") is None


def test_a_manifest_below_a_package_has_no_faults_of_its_own(tmp_path: Path) -> None:
    plant(
        tmp_path, {"a/package.xml": manifest("arm"), "a/lib/b/package.xml": b"<pack", "a/c/package.xml": manifest("c")}
    )
    plant(tmp_path, {"d/package.xml": manifest("c"), "e/package.xml": b"<pack", "e/f/package.xml": manifest("f")})
    workspace = discover(tmp_path, (".",))
    assert [package.path for package in workspace.packages] == ["a", "d", "e"]  # catkin takes a manifest by its name
    assert [fault.path for fault in workspace.faults] == ["e/package.xml"] and messages(workspace) == []


def test_a_broken_manifest_is_a_fault_and_its_directory_still_a_package(tmp_path: Path) -> None:
    plant(tmp_path, {"src/arm/package.xml": b"<package>\n<name>arm</name>", "src/arm/arm.cpp": b"", "leg/leg.cpp": b""})
    workspace = discover(tmp_path, (".",))
    assert [(fault.path, fault.line) for fault in workspace.faults] == [("src/arm/package.xml", 2)]
    assert [(package.name, package.path) for package in workspace.packages] == [("arm", "src/arm")]
    assert {file.path: file.package for file in workspace.files}["src/arm/arm.cpp"] == "arm"


def test_a_broken_manifest_at_the_root_takes_the_roots_name(tmp_path: Path) -> None:
    root = plant(tmp_path / "my_robot", {"package.xml": b"<pack"})
    assert [package.name for package in discover(root, (".",)).packages] == ["my_robot"]


def test_two_packages_of_one_name(tmp_path: Path) -> None:
    plant(
        tmp_path, {"a/package.xml": manifest("arm"), "b/package.xml": manifest("arm"), "c/package.xml": manifest("c")}
    )
    workspace = discover(tmp_path, (".",))
    assert [package.path for package in workspace.packages] == ["a", "b", "c"]
    ((path, message),) = messages(workspace)
    assert path == "b"
    assert message.startswith(
        "the package name 'arm' is also that of a, which the model has (not b); to choose, put a COLCON_IGNORE"
    )


def test_a_directory_is_the_subtree(tmp_path: Path) -> None:
    plant(tmp_path, {"arm/package.xml": manifest("arm"), "arm/src/a.cpp": b"", "leg/l.cpp": b"", "l.cpp": b""})
    workspace = discover(tmp_path, ("arm/src",))
    assert [file.path for file in workspace.files] == ["arm/src/a.cpp"]
    assert workspace.files[0].package == "arm"
    assert [package.path for package in workspace.packages] == ["arm"]
    assert workspace.targets is None
    assert found(tmp_path, "leg", "./arm/", "arm/src") == ["arm/package.xml", "arm/src/a.cpp", "leg/l.cpp"]


def test_files_are_targets_in_the_whole_tree(tmp_path: Path) -> None:
    plant(tmp_path, {"arm/a.cpp": b"", "arm/a.h": b"", "leg/l.cpp": b"", "notes.txt": b""})
    workspace = discover(tmp_path, ("arm/a.cpp", "notes.txt"))
    assert [file.path for file in workspace.files] == ["arm/a.cpp", "arm/a.h", "leg/l.cpp"]
    assert workspace.targets == {"arm/a.cpp"}
    assert not workspace.reports_on("arm/a.h")


def test_with_a_directory_and_a_file_both_are_reported_on(tmp_path: Path) -> None:
    plant(tmp_path, {"arm/a.cpp": b"", "arm/a.h": b"", "leg/l.cpp": b"", "leg/m.cpp": b""})
    workspace = discover(tmp_path, ("arm", "leg/l.cpp"))
    assert [file.path for file in workspace.files] == ["arm/a.cpp", "arm/a.h", "leg/l.cpp"]
    assert workspace.targets == {"arm/a.cpp", "arm/a.h", "leg/l.cpp"}


def test_excludes_hold_for_given_files(tmp_path: Path) -> None:
    plant(tmp_path, {"arm/a.cpp": b"", "vendor/v.cpp": b""})
    workspace = discover(tmp_path, ("arm/a.cpp", "vendor/v.cpp"), exclude=("vendor/",))
    assert workspace.targets == {"arm/a.cpp"}
    assert [file.path for file in workspace.files] == ["arm/a.cpp"]
    assert found(tmp_path, "vendor", exclude=("vendor/",)) == ["vendor/v.cpp"]


@pytest.mark.parametrize("path", ["missing", "a.cpp/x", "a\0b", "loop", "dangling"])
def test_a_path_that_is_not_there(tmp_path: Path, path: str) -> None:
    plant(tmp_path, {"a.cpp": b""})
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "dangling").symlink_to("nowhere")
    with pytest.raises(UserError, match="no such file"):
        discover(tmp_path, (path,))


@pytest.mark.parametrize("path", ["..", "../other", "/etc", "out", "a/../../other"])
def test_a_path_that_leads_out(tmp_path: Path, path: str) -> None:
    root = plant(tmp_path / "ws", {"a/a.cpp": b""})
    plant(tmp_path / "other", {"o.cpp": b""})
    (root / "out").symlink_to(tmp_path / "other")
    with pytest.raises(UserError, match="leads out"):
        discover(root, (path,))


def test_an_argument_that_is_a_link_inside_is_resolved(tmp_path: Path) -> None:
    plant(tmp_path, {"arm/a.cpp": b"", "leg/l.cpp": b""})
    (tmp_path / "current").symlink_to("arm")
    (tmp_path / "l.cpp").symlink_to("leg/l.cpp")
    assert found(tmp_path, "current") == ["arm/a.cpp"]
    assert discover(tmp_path, ("l.cpp",)).targets == {"leg/l.cpp"}


def test_a_root_behind_a_link(tmp_path: Path) -> None:
    plant(tmp_path / "ws", {"a.cpp": b""})
    (tmp_path / "link").symlink_to("ws")
    assert found(tmp_path / "link") == ["a.cpp"]


# -- what is left out ---------------------------------------------------------------------------------------------

SOURCE = {"src/arm/package.xml": manifest("arm"), "src/arm/a.cpp": b""}
SOURCE_FILES = ["src/arm/a.cpp", "src/arm/package.xml"]


@pytest.mark.parametrize(
    "extra",
    [
        {"src/leg/COLCON_IGNORE": b"", "src/leg/l.cpp": b""},
        {"src/leg/AMENT_IGNORE": b"", "src/leg/deep/l.cpp": b""},
        {"src/leg/CATKIN_IGNORE": b"", "src/leg/l.cpp": b""},
        {"build/COLCON_IGNORE": b"", "build/arm/x.py": b"", "install/.colcon_install_layout": b"", "install/x.py": b""},
        {"install/setup.bash": b"", "install/local_setup.bash": b"", "install/arm/x.py": b"", "log/x.yaml": b""},
        {"devel/.catkin": b"", "devel/lib/x.py": b"", "build/x.cmake": b"", "logs/x.yaml": b""},
        {".catkin_workspace": b"", "build/x.cmake": b"", "devel/x.py": b""},
        {"build/CMakeCache.txt": b"", "build/x.cmake": b""},
        {"src/arm/build/CMakeCache.txt": b"", "src/arm/build/x.cmake": b""},
        {"venv/pyvenv.cfg": b"", "venv/lib/x.py": b""},
        {".venv/x.py": b"", ".git_old/x.py": b"", ".tox/x.py": b"", ".vscode/x.yaml": b"", ".github/w.yml": b""},
        {"node_modules/x.yaml": b"", "src/arm/__pycache__/x.py": b"", "arm.egg-info/x.py": b""},
    ],
)
@pytest.mark.parametrize("in_git", [False, True])
def test_left_out(tmp_path: Path, extra: dict[str, bytes], in_git: bool) -> None:
    root = plant(tmp_path / "ws", {**SOURCE, **extra})
    if in_git:
        Git(root)
    assert found(root) == SOURCE_FILES


@pytest.mark.parametrize(
    "extra",
    [
        {"src/arm/log/l.cpp": b""},
        {"src/arm/build/b.py": b""},
        {"src/arm/build_tools/b.py": b""},
        {"src/arm/src/x.cpp": b"", "src/arm/log/l.cpp": b"", "src/arm/install/i.cpp": b""},
        {"build/b.py": b"", "log/l.py": b""},  # nothing says that colcon made them
        {"tools/setup.bash": b"", "tools/t.py": b""},
        {"src/arm/CMakeCache.txt": b"", "src/arm/CMakeLists.txt": b"project(arm)\n"},  # built inside the source
        {
            "devel/package.xml": manifest("devel"),
            "devel/setup.bash": b"",
            "devel/local_setup.bash": b"",
            "devel/d.cpp": b"",
        },
        {"install/COLCON_IGNORE.md": b"", "install/i.py": b""},
        {"src/venv/v.py": b""},
        {"src/arm/.hidden.py": b""},
    ],
)
@pytest.mark.parametrize("in_git", [False, True])
def test_not_left_out(tmp_path: Path, extra: dict[str, bytes], in_git: bool) -> None:
    root = plant(tmp_path / "ws", {**SOURCE, **extra})
    if in_git:
        Git(root)
    sources = {
        name for name in extra if name.endswith((".cpp", ".py", ".md", ".bash", "CMakeLists.txt", "package.xml"))
    }
    assert set(found(root)) == {*SOURCE_FILES, *sources}


@pytest.mark.parametrize("given", ["src/leg", "build", ".github"])
def test_a_given_directory_is_entered_whatever_it_is(tmp_path: Path, given: str) -> None:
    plant(tmp_path, {**SOURCE, "src/leg/COLCON_IGNORE": b"", "build/CMakeCache.txt": b""})
    plant(tmp_path, {f"{given}/x.py": b"", f"{given}/.venv/x.py": b""})
    assert found(tmp_path, given) == [f"{given}/x.py"]


def test_an_ignore_marker_at_the_root_does_not_empty_the_run(tmp_path: Path) -> None:
    assert found(plant(tmp_path, {**SOURCE, "COLCON_IGNORE": b""})) == SOURCE_FILES


# -- git ----------------------------------------------------------------------------------------------------------


def test_what_git_ignores_is_left_out(git: Git) -> None:
    git.commit({**PACKAGE, ".gitignore": b"*.gen.cpp\n/out/\n!keep.gen.cpp\n", "src/.gitignore": b"/local.cpp\n"})
    plant(git.top, {"a.gen.cpp": b"", "keep.gen.cpp": b"", "out/o.cpp": b"", "src/local.cpp": b"", "new.cpp": b""})
    plant(git.top, {"sub/local.cpp": b""})
    (git.top / "src" / "arm.cpp").unlink()  # tracked, but deleted
    assert found(git.top) == [
        "CMakeLists.txt",
        "README.md",
        "keep.gen.cpp",
        "new.cpp",
        "package.xml",
        "scripts/teleop",
        "sub/local.cpp",
    ]


def test_a_subdirectory_of_a_repository_as_root(git: Git) -> None:
    git.commit({".gitignore": b"gen/\n", "ws/src/a.cpp": b"", "ws/gen/g.cpp": b"", "b.cpp": b""})
    assert found(git.top / "ws") == ["src/a.cpp"]
    assert found(git.top / "ws", "src") == ["src/a.cpp"]


def test_repositories_in_a_workspace_are_listed_on_their_own(tmp_path: Path, new_git: Callable[[str], Git]) -> None:
    new_git("ws/src/arm").commit({".gitignore": b"gen.cpp\n", "a.cpp": b"", "gen.cpp": b""})
    new_git("ws/src/leg").commit({"l.cpp": b"", "gen.cpp": b""})
    plant(tmp_path / "ws", {"src/own/o.cpp": b"", "build/.built_by": b"", "build/b.cmake": b""})
    everything = ["src/arm/a.cpp", "src/leg/gen.cpp", "src/leg/l.cpp", "src/own/o.cpp"]
    assert found(tmp_path / "ws") == everything
    assert found(tmp_path / "ws", "src/arm", "src/leg") == everything[:3]


def test_a_repository_nested_in_a_repository(git: Git, new_git: Callable[[str], Git]) -> None:
    git.commit({"a.cpp": b""})
    new_git("ws/src/arm").commit({".gitignore": b"gen.cpp\n", "gen.cpp": b"", "arm.cpp": b""})
    new_git("ws/src/empty")
    plant(git.top, {"src/empty/e.cpp": b""})
    assert found(git.top) == ["a.cpp", "src/arm/arm.cpp", "src/empty/e.cpp"]


def test_sources_that_the_workspaces_own_repository_ignores(git: Git, new_git: Callable[[str], Git]) -> None:
    git.commit({".gitignore": b"/src/\n/build/\n", "robot.repos": b"", "tools/t.py": b""})
    new_git("ws/src/arm").commit({".gitignore": b"gen.cpp\n", "gen.cpp": b"", "arm.cpp": b""})
    plant(git.top, {"build/b.cmake": b""})
    assert found(git.top) == ["src/arm/arm.cpp", "tools/t.py"]


def test_a_given_directory_or_file_that_git_ignores(git: Git) -> None:
    git.commit({".gitignore": b"gen/\n", "a.cpp": b""})
    plant(git.top, {"gen/g.cpp": b""})
    assert found(git.top, "gen") == ["gen/g.cpp"]
    assert discover(git.top, ("gen/g.cpp",)).targets == {"gen/g.cpp"}


def test_submodules(git: Git, new_git: Callable[[str], Git]) -> None:
    new_git("other").commit({"o.cpp": b"", ".gitignore": b"gen.cpp\n"})
    git.commit({"a.cpp": b""})
    git("submodule", "add", "-q", "../other", "lib.cpp")
    git.commit()
    plant(git.top, {"lib.cpp/gen.cpp": b""})
    assert found(git.top) == ["a.cpp", "lib.cpp/o.cpp"]
    git("submodule", "deinit", "-f", "--all")
    workspace = discover(git.top, (".",))
    assert [file.path for file in workspace.files] == ["a.cpp"]
    ((path, message),) = messages(workspace)
    assert path == "lib.cpp" and message.startswith(
        "a submodule that is not checked out: nothing in it is analysed; run git submodule update"
    )
    assert discover(git.top, (".",), exclude=("lib.cpp",)).problems == ()
    assert discover(git.top, ("a.cpp",)).problems == ()
    shutil.rmtree(git.top / "lib.cpp")  # as in a copy that leaves out empty directories
    assert messages(discover(git.top, (".",))) == [(path, message)]


def test_submodules_in_one_problem_and_those_that_nobody_can_have(git: Git, new_git: Callable[[str], Git]) -> None:
    new_git("other").commit({"o.cpp": b""})
    git.commit({"a.cpp": b""})
    for name in ("one", "two"):
        git("submodule", "add", "-q", "../other", name)
    Git(git.top / "lost").commit({"l.cpp": b""})
    git("add", "lost")
    git.commit()
    assert discover(git.top, (".",)).problems == ()
    git("submodule", "deinit", "-f", "--all")
    shutil.rmtree(git.top / "lost")
    (git.top / "lost").mkdir()  # as a clone has it
    (lost, there) = messages(discover(git.top, (".",)))
    assert lost[0] == "lost" and "that .gitmodules does not name: no clone gets the files" in lost[1]
    assert there[0] == "one" and there[1].startswith(
        "a submodule that is not checked out, and so is two: nothing in them is analysed"
    )
    plant(git.top, {"one/a.cpp": b"", "two/README": b"", "lost/l.cpp": b""})
    assert discover(git.top, (".",)).problems == ()


def test_files_of_macos_are_no_sources(tmp_path: Path) -> None:
    fork = b"\x00\x05\x16\x07\x00\x02\x00\x00Mac OS X        "
    plant(
        tmp_path,
        {"__MACOSX/launch/._a.launch.py": fork, "src/._b.cpp": fork, "src/b.cpp": b"int b;\n", "._package.xml": fork},
    )
    workspace = discover(tmp_path, (".",))
    assert [file.path for file in workspace.files] == ["src/b.cpp"] and workspace.problems == ()
    plant(tmp_path, {"src/c.cpp": fork, "src/._d.cpp": b"int d;\n", "src/._e.cpp": b"int\0e;\n"})
    workspace = discover(tmp_path, (".",))
    assert [file.path for file in workspace.files] == ["src/._d.cpp", "src/b.cpp"]
    assert [path for path, _ in messages(workspace)] == ["src/._e.cpp", "src/c.cpp"]


def test_a_linked_work_tree(git: Git, tmp_path: Path) -> None:
    git.commit({".gitignore": b"gen.cpp\n", "a.cpp": b""})
    git("worktree", "add", "-q", "../linked")
    plant(tmp_path / "linked", {"gen.cpp": b"", "b.cpp": b""})
    assert found(tmp_path / "linked") == ["a.cpp", "b.cpp"]


def test_without_git_everything_is_listed(git: Git, monkeypatch: pytest.MonkeyPatch) -> None:
    git.commit({".gitignore": b"gen.cpp\n", "a.cpp": b"", "gen.cpp": b""})
    monkeypatch.setenv("PATH", "/nonexistent")
    workspace = discover(git.top, (".",))
    assert [file.path for file in workspace.files] == ["a.cpp", "gen.cpp"]
    assert messages(workspace) == [
        (".", "git is not installed: all files are listed, .gitignore is not honoured"),
    ]


def test_a_broken_repository_is_listed_without_git(tmp_path: Path) -> None:
    plant(tmp_path / "ws", {"a.cpp": b"", "lib/.git": b"gitdir: /nowhere\n", "lib/l.cpp": b""})
    workspace = discover(tmp_path / "ws", (".",))
    assert [file.path for file in workspace.files] == ["a.cpp", "lib/l.cpp"]
    assert [path for path, _ in messages(workspace)] == ["lib"]


def test_an_unmerged_file_is_listed_once(git: Git) -> None:
    git.commit({"a.cpp": b"int a;\n"})
    git("checkout", "-q", "-b", "side")
    git.commit({"a.cpp": b"int b;\n"})
    git("checkout", "-q", "main")
    git.commit({"a.cpp": b"int c;\n"})
    with pytest.raises(Exception, match="merge"):
        git("merge", "side")
    assert found(git.top) == ["a.cpp"]


# -- texts --------------------------------------------------------------------------------------------------------


def test_texts(git: Git) -> None:
    git.commit({"a.cpp": b"\xef\xbb\xbfint a;\r\n", "CPPLINT.cfg": b"linelength=100\n", "l.py": b"# \xe9\n"})
    workspace = discover(git.top, (".",))
    assert workspace.text("a.cpp") == "int a;\r\n"
    assert workspace.text("l.py") == "# é\n"
    assert workspace.text("CPPLINT.cfg") == "linelength=100\n"  # not analysed, but a tool's settings
    (git.top / "a.cpp").unlink()
    assert workspace.text("a.cpp") == "int a;\r\n"  # read once


@pytest.mark.parametrize("path", ["../secret", "link", "dir/secret", "/etc/passwd", ".git/config", "missing.cpp", ""])
def test_texts_that_are_refused(git: Git, tmp_path: Path, path: str) -> None:
    plant(tmp_path, {"secret": b"secret", "out/secret": b"secret"})
    (git.top / "link").symlink_to("../secret")
    (git.top / "dir").symlink_to("../out")
    git.commit({"a.cpp": b""})
    assert discover(git.top, (".",)).text(path) == ""


def test_settings_of_tools_above_a_given_directory_hold(tmp_path: Path) -> None:
    for path in (".clang-format", "p/.shellcheckrc", "p/any.toml", "p/q/a.cpp", "p/b.cpp", "r/.clang-format"):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(f"# {path}\n")
    (tmp_path / "setup.cfg").symlink_to("p/any.toml")
    (tmp_path / "linked").symlink_to("r")
    (tmp_path / "big.toml").write_text("#" * 5000)
    found = discover(tmp_path, ("p/q",), max_file_size=4000)
    assert found.setting(".clang-format") == "# .clang-format\n" and found.setting("p/.shellcheckrc")
    assert found.setting("p/any.toml") == "# p/any.toml\n"  # what settings refer to may have any name
    assert found.setting("p/q/a.cpp") == found.text("p/q/a.cpp") == "# p/q/a.cpp\n"
    nothing = (
        "setup.cfg",
        "linked/.clang-format",
        "big.toml",
        "p/q/ruff.toml",
        "../x",
        "r/../.clang-format",
        "p",
        "a\0b",
    )
    assert [path for path in nothing if found.setting(path)] == []
    assert [file.path for file in found.files] == ["p/q/a.cpp"]
    assert found.text("p/b.cpp") == found.text("r/.clang-format") == "" and found.names == {"p/q/a.cpp"}
    assert discover(tmp_path, (".",)).setting("p/any.toml") == "# p/any.toml\n"


ROSBUILD = {"manifest.xml": b"<package><depend package='roscpp'/></package>\n", "CMakeLists.txt": b"rosbuild_init()\n"}


@pytest.mark.parametrize(("count", "words"), [(1, "1 package"), (3, "3 packages")])
def test_packages_of_rosbuild_are_named_once(tmp_path: Path, count: int, words: str) -> None:
    plant(tmp_path, {f"p{number}/{name}": data for number in range(count) for name, data in ROSBUILD.items()})
    message = f"{words} of rosbuild (manifest.xml, no package.xml): their nodes are not in the model"
    assert messages(discover(tmp_path, (".",))) == [("p0/manifest.xml", message)]


@pytest.mark.parametrize(
    "files",
    [
        {**ROSBUILD, "package.xml": manifest("arm")},  # built with both
        {"manifest.xml": ROSBUILD["manifest.xml"]},
        {"CMakeLists.txt": b"project(arm)\n"},
        {**ROSBUILD, "manifest.xml": b"<manifest><application/></manifest>\n"},
        {**ROSBUILD, "manifest.xml": b""},
        {f"sub/{name}": data for name, data in ROSBUILD.items()} | {"package.xml": manifest("arm")},
        {"manifest.xml/CMakeLists.txt": b""},
    ],
)
def test_what_is_no_package_of_rosbuild_is_not_named(tmp_path: Path, files: dict[str, bytes]) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == []


SKETCH = "this Arduino sketch{} ROS: what such nodes publish and subscribe to is not in the model"


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({"a/b.ino": b"#include <ros.h>\nros::NodeHandle nh;\n"}, " uses"),
        ({"a/b.pde": b'  #  include "ros.h"\n'}, " uses"),
        ({"a/b.ino": b"#include <micro_ros_arduino.h>\n", "c/d.ino": b"#include <rcl/rcl.h>\n"}, " and 1 more use"),
        ({"a/b.ino": b"#include <ros2arduino.h>\n"}, " uses"),
    ],
)
def test_sketches_that_talk_to_ros_are_named_once(tmp_path: Path, files: dict[str, bytes], words: str) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == [(min(files), SKETCH.format(words))]


@pytest.mark.parametrize(
    "files",
    [
        {"a/b.ino": b"#include <Servo.h>\nvoid loop() {}\n"},
        {"a/b.ino": b""},
        {"a/b.ino.txt": b"#include <ros.h>\n"},
        {"ros_lib/examples/Blink/Blink.pde": b"#include <ros.h>\n"},
        {"a/ros.h": b"#include <rosserial.h>\n"},
    ],
)
def test_other_sketches_are_not_named(tmp_path: Path, files: dict[str, bytes]) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == []


TOOL = b"import rospy\nif __name__ == '__main__':\n    rospy.init_node('n')\n"
LOOSE = "{} in no package: what nodes publish and subscribe to there is not in the model"


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({"tools/a.py": TOOL}, "a Python program of ROS that lies"),
        (
            {"a.py": TOOL.replace(b"import rospy", b"from rclpy.node import Node"), "b/c.py": TOOL},
            "this and 1 more Python program of ROS lie",
        ),
    ],
)
def test_programs_in_no_package_are_named_once(tmp_path: Path, files: dict[str, bytes], words: str) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == [(min(files), LOOSE.format(words))]


@pytest.mark.parametrize(
    "files",
    [
        {"tools/a.py": TOOL.replace(b"rospy", b"os")},
        {"tools/a.py": b"import rospy\n"},
        {"test/a.py": TOOL},
        {"tools/test_a.py": TOOL},
        {"launch/a.launch.py": TOOL},
        {"arm/a.py": TOOL, "arm/package.xml": manifest("arm")},
        {"tools/a.md": TOOL},
    ],
)
def test_other_python_is_not_named(tmp_path: Path, files: dict[str, bytes]) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == []


NODE = b"#include <rclcpp/rclcpp.hpp>\nint main(int argc, char ** argv)\n{\n  rclcpp::init(argc, argv);\n}\n"
OLD_NODE = b'#include "ros/ros.h"\nint\nmain(int argc, char** argv) { ros::init(argc, argv, "a"); }\n'
COMPILED = "{} in no package: what nodes publish and subscribe to there is not in the model"


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({"node.cpp": NODE}, "a C++ program of ROS that lies"),
        ({"tools/a.cpp": OLD_NODE}, "a C++ program of ROS that lies"),
        ({"tools/a.cpp": OLD_NODE, "b.cc": NODE}, "this and 1 more C++ program of ROS lie"),
        ({"tools/a.cpp": OLD_NODE, "b.cc": NODE, "c.cpp": NODE}, "this and 2 more C++ programs of ROS lie"),
        (
            {"tools/a.cpp": NODE, "arm/a.cpp": NODE, "arm/package.xml": manifest("arm")},
            "a C++ program of ROS that lies",
        ),
    ],
)
def test_cpp_programs_in_no_package_are_named_once(tmp_path: Path, files: dict[str, bytes], words: str) -> None:
    path = min(path for path in files if not path.startswith("arm/"))
    assert messages(discover(plant(tmp_path, files), (".",))) == [(path, COMPILED.format(words))]


@pytest.mark.parametrize(
    "files",
    [
        {"a.cpp": b"#include <rclcpp/rclcpp.hpp>\nint main() {}\n"},
        {"a.cpp": NODE.replace(b"main", b"helper")},
        {"a.cpp": b"int main() { cv::init(1); }\n"},
        {"a.cpp": b"int domain(int a) { ros::init(a); }\n"},
        {"a.hpp": b"#include <rclcpp/rclcpp.hpp>\nclass A : public rclcpp::Node {};\n"},
        {"test/a.cpp": NODE},
        {"tools/test_a.cpp": NODE},
        {"arm/a.cpp": NODE, "arm/package.xml": manifest("arm")},
        {"tools/a.md": NODE},
        {"tools/a.cpp": b"// rclcpp::init(argc, argv)\nint domain();\n"},
    ],
)
def test_other_cpp_is_not_named(tmp_path: Path, files: dict[str, bytes]) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == []


def test_cpp_of_rosbuild_is_named_with_its_package(tmp_path: Path) -> None:
    files = {"arm/manifest.xml": b"<package></package>", "arm/CMakeLists.txt": b"", "arm/src/a.cpp": OLD_NODE}
    found = messages(discover(plant(tmp_path, files), (".",)))
    assert not [words for _, words in found if "C++" in words]


PYTHON_LAUNCH = (
    b"from launch import LaunchDescription\ndef generate_launch_description():\n    return LaunchDescription([])\n"
)
XML_LAUNCH = b"<launch>\n</launch>\n"
STRAY = "{} in no package: what is started there is no configuration of the model"


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({"launch.py": PYTHON_LAUNCH}, "a launch file that lies"),
        ({"start.py": PYTHON_LAUNCH}, "a launch file that lies"),
        ({"a/top.launch": XML_LAUNCH, "b_launch.py": PYTHON_LAUNCH}, "this and 1 more launch file lie"),
        (
            {"a.launch.xml": XML_LAUNCH, "b.launch.yaml": b"launch:\n- node: {pkg: p}\n", "c.launch.py": PYTHON_LAUNCH},
            "this and 2 more launch files lie",
        ),
    ],
)
def test_launch_files_in_no_package_are_named_once(tmp_path: Path, files: dict[str, bytes], words: str) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == [(min(files), STRAY.format(words))]


@pytest.mark.parametrize(
    "files",
    [
        {"launch.py": b"import os\nos.system('make')\n"},
        {"launch.py": b"# def generate_launch_description\n"},
        {"start.py": PYTHON_LAUNCH.replace(b"def g", b"    def g")},
        {"test/a.launch.py": PYTHON_LAUNCH},
        {"a.launch": b"[program]\nname=x\n"},
        {"a.xml": XML_LAUNCH},
        {"a.launch.yaml": b"services: []\n"},
        {"arm/launch.py": PYTHON_LAUNCH, "arm/package.xml": manifest("arm")},
        {"arm/launch/a.launch": XML_LAUNCH, "arm/package.xml": manifest("arm")},
        {"a.launch.py.in": PYTHON_LAUNCH},
    ],
)
def test_other_launch_files_are_not_named(tmp_path: Path, files: dict[str, bytes]) -> None:
    assert messages(discover(plant(tmp_path, files), (".",))) == []


def test_a_package_of_rosbuild_that_is_left_out_is_not_named(tmp_path: Path) -> None:
    plant(tmp_path, {f"old/{name}": data for name, data in ROSBUILD.items()})
    assert messages(discover(tmp_path, (".",), exclude=("old",))) == []


@pytest.mark.parametrize(
    ("skipped", "gone", "named"),
    [
        (("b/c.py", "b/d.py"), ("b/c.py", "b/d.py"), "b/c.py"),
        (("b/c.py",), ("b/c.py",), "b/c.py"),
        (("b/c.py",), (), ""),
        ((), ("b/c.py",), ""),
        ((), (), ""),
    ],
)
def test_what_a_sparse_checkout_leaves_out_is_named(
    git: Git, skipped: tuple[str, ...], gone: tuple[str, ...], named: str
) -> None:
    git.commit({"a.py": b"", "b/c.py": b"", "b/d.py": b""})
    for path in skipped:
        git("update-index", "--skip-worktree", path)
    for path in gone:
        (git.top / path).unlink()
    found = [problem for problem in discover(git.top, (".",)).problems if "sparse" in problem.message]
    assert [problem.path for problem in found] == ([named] if named else [])
    if named:
        assert found[0].message.startswith(f"{len(gone)} tracked file")


def test_a_pipe_is_named_where_it_is_asked_for_or_tracked(git: Git) -> None:
    git.commit({"a.py": b"", "b.py": b""})
    (git.top / "a.py").unlink()
    os.mkfifo(git.top / "a.py")
    os.mkfifo(git.top / "c.py")
    found = {problem.path: problem.message for problem in discover(git.top, (".",)).problems}
    assert "it is a pipe" in found["a.py"] and "c.py" not in found
    (asked,) = (problem for problem in discover(git.top, ("c.py",)).problems if problem.path == "c.py")
    assert asked.message.startswith("skipped: it cannot be read (it is a pipe")
