# SPDX-License-Identifier: Apache-2.0
"""Changes that add, move or remove what keeps directories from being analysed: the base revision decides."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from hostile_kit import CHEAP_FINDING, CONTROL, Outcome, Trap, assert_harmless

QUICK = ("--ignore=pylint,cpplint,metrics,ruff,unassignedVariable", "--select=nullPointer,file-not-analysed")
DEFECT = "int f(int x) { int *unset = 0; return *unset + x; }\n"
ARM = "src/arm/deep/arm.cpp"


@dataclass(frozen=True)
class Case:
    """What the base holds beside ``ARM`` and what the head does, to which *path* is still analysed; *says* stands in a message."""

    name: str
    head: Callable[[Trap], object]
    says: str = (
        "does not count, as the base revision does not have it; 1 file (src/arm/deep/arm.cpp) below it is analysed"
    )
    base: Callable[[Trap], object] = lambda t: None
    path: str = ARM


def added(*names: str, path: str = ARM) -> Case:
    says = f"does not count, as the base revision does not have it; 1 file ({path}) below it is analysed"
    return Case(", ".join(names), lambda t: [t.write(name, "") for name in names], says, path=path)


def moved(trap: Trap, source: str, target: str) -> None:
    (trap.root / target).parent.mkdir(parents=True, exist_ok=True)
    (trap.root / source).rename(trap.root / target)


def linked(trap: Trap, name: str, target: str) -> None:
    (trap.root / name).unlink(missing_ok=True)
    (trap.root / name).symlink_to(target)


def ignored(trap: Trap) -> None:
    trap.write(".gitignore", "*.cpp\n*\n")
    trap.git("add", "-f", ".gitignore")


CASES = [
    added("src/arm/COLCON_IGNORE"),
    added("src/arm/CATKIN_IGNORE"),
    added("src/arm/AMENT_IGNORE"),
    added("src/arm/.catkin"),
    added("src/arm/.colcon_install_layout"),
    added("src/arm/.built_by"),
    added("src/arm/pyvenv.cfg"),
    added("src/arm/deep/CMakeCache.txt"),
    added("src/arm/setup.bash", "src/arm/local_setup.bash"),
    added("src/COLCON_IGNORE", "src/arm/COLCON_IGNORE"),
    added("src/arm/deep/COLCON_IGNORE", "src/arm/CMakeCache.txt"),
    Case(
        "a workspace of catkin",
        lambda t: t.write(".catkin_workspace", ""),
        ".catkin_workspace does not count",
        lambda t: t.write("build/b.cpp", DEFECT),
        "build/b.cpp",
    ),
    Case(
        "an output beside it",
        lambda t: t.write("install/.colcon_install_layout", ""),
        base=lambda t: t.write("log/b.cpp", DEFECT),
        path="log/b.cpp",
        says="",
    ),
    Case(
        "sources beside it",
        lambda t: moved(t, "src", "code") or t.write("src/x.cpp", ""),
        base=lambda t: (
            [moved(t, "src", "other"), t.write(".catkin_workspace", ""), t.write("build/b.cpp", DEFECT)]
            and t.write("src", "")
        ),
        path="build/b.cpp",
        says="build: it stays",
    ),
    Case(
        "a marker that is a link",
        lambda t: linked(t, "src/arm/COLCON_IGNORE", "deep/arm.cpp"),
    ),
    Case(
        "a marker that is a link to nowhere",
        lambda t: linked(t, "src/arm/COLCON_IGNORE", "nowhere"),
    ),
    Case(
        "a marker that has moved",
        lambda t: moved(t, "src/leg/COLCON_IGNORE", "src/arm/COLCON_IGNORE"),
        base=lambda t: t.write("src/leg/COLCON_IGNORE", ""),
    ),
    Case(
        "a marker of another kind",
        lambda t: moved(t, "src/arm/readme", "src/arm/COLCON_IGNORE"),
        base=lambda t: t.write("src/arm/readme", ""),
    ),
    Case(
        "no package any more",
        lambda t: (t.root / "src/arm/package.xml").unlink(),
        "it stays a directory of sources, though src/arm/package.xml is gone; 1 file (src/arm/deep/arm.cpp)",
        base=lambda t: [
            t.write("src/arm/package.xml", "<package/>"),
            t.write("src/arm/setup.bash", ""),
            t.write("src/arm/local_setup.bash", ""),
        ],
    ),
    Case(
        "no CMakeLists.txt any more",
        lambda t: (t.root / "src/arm/CMakeLists.txt").unlink(),
        "though src/arm/CMakeLists.txt is gone",
        base=lambda t: [t.write("src/arm/CMakeLists.txt", ""), t.write("src/arm/CMakeCache.txt", "")],
    ),
    Case(
        "a CMakeLists.txt with another name",
        lambda t: moved(t, "src/arm/CMakeLists.txt", "src/arm/cmakelists.txt"),
        "though src/arm/CMakeLists.txt is gone",
        base=lambda t: [t.write("src/arm/CMakeLists.txt", ""), t.write("src/arm/CMakeCache.txt", "")],
    ),
    Case(
        "a new directory with a marker",
        lambda t: [t.write("src/new/new.cpp", DEFECT), t.write("src/new/COLCON_IGNORE", "")],
        "src/new/COLCON_IGNORE does not count",
        path="src/new/new.cpp",
    ),
    Case("what git ignores is tracked", ignored, ""),
    Case("what git ignores there is tracked", lambda t: t.write("src/arm/.gitignore", "*\n!.gitignore\n"), ""),
    Case(
        "attributes",
        lambda t: t.write(
            ".gitattributes", "* -text export-ignore linguist-generated linguist-vendored -diff binary\n"
        ),
        "",
    ),
    Case(
        "a submodule that is none",
        lambda t: t.write(".gitmodules", '[submodule "arm"]\n\tpath = src/arm\n\turl = ./x\n\tignore = all\n'),
        ".gitmodules: 1 changed file names other repositories",
    ),
]


def pull_request(trap: Trap, base: Callable[[Trap], object], head: Callable[[Trap], object]) -> None:
    (trap.root / CONTROL).unlink()
    trap.write(CHEAP_FINDING[0], DEFECT)
    trap.write(ARM, DEFECT)
    base(trap)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    head(trap)
    trap.commit()


def states(outcome: Outcome) -> dict[tuple[str, str], str]:
    return {(r["path"], r["rule"]): r["state"] for r in outcome.report["results"] if r["state"] != "absent"}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_change_hides_nothing(case: Case, trap: Trap) -> None:
    """The file is analysed, and it is said which marker does not count, with the files below it."""
    pull_request(trap, case.base, case.head)
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert (case.path, "nullPointer") in states(outcome), outcome.notes()
    messages = [f"{path}: {message}" for path, message in outcome.notes()]
    assert not case.says or [m for m in messages if case.says in m], messages
    assert case.says or case.name == "an output beside it" or messages == [], messages
    assert_harmless(trap, outcome)


# -- what stays as it was -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Quiet:
    """Where *path* is left out as ever, and nothing is said."""

    name: str
    base: Callable[[Trap], object]
    head: Callable[[Trap], object] = lambda t: t.write("readme", "")
    after: Callable[[Trap], object] = lambda t: None
    arguments: tuple[str, ...] = ("--baseline-rev=main",)
    path: str = ARM


def built(trap: Trap) -> None:
    """What building leaves, not committed."""
    for name in ("build/COLCON_IGNORE", "install/.colcon_install_layout", "log/COLCON_IGNORE"):
        trap.write(name, "")
    for name in ("build/x.cpp", "install/x.cpp", "log/x.cpp"):
        trap.write(name, DEFECT)


QUIET = [
    Quiet("a marker of the base", lambda t: t.write("src/arm/COLCON_IGNORE", "")),
    Quiet("a marker of the base, at a directory above", lambda t: t.write("src/COLCON_IGNORE", "")),
    Quiet(
        "another marker beside it",
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
        lambda t: t.write("src/arm/.catkin", ""),
    ),
    Quiet(
        "a marker below it",
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
        lambda t: t.write("src/arm/deep/.catkin", ""),
    ),
    Quiet(
        "a marker of the base that is a link now",
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
        lambda t: linked(t, "src/arm/COLCON_IGNORE", "nowhere"),
    ),
    Quiet(
        "a marker of the base with text",
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
        lambda t: t.write("src/arm/COLCON_IGNORE", "x"),
    ),
    Quiet("a marker that nobody commits", lambda t: None, after=lambda t: t.write("src/arm/COLCON_IGNORE", "")),
    Quiet("a marker that git ignores", lambda t: None, after=lambda t: t.write("src/arm/CMakeCache.txt", "")),
    Quiet("no base revision", lambda t: None, lambda t: t.write("src/arm/COLCON_IGNORE", ""), arguments=()),
    Quiet("built here", lambda t: None, after=built, path="build/x.cpp"),
    Quiet(
        "built here, beside it",
        lambda t: t.write(".catkin_workspace", ""),
        after=lambda t: t.write("devel/x.cpp", DEFECT),
        path="devel/x.cpp",
    ),
    Quiet(
        "left out by the base's project file",
        lambda t: t.write(".haros-ci.yaml", "exclude: [src/arm]\n"),
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
    ),
    Quiet(
        "left out by the command line",
        lambda t: None,
        lambda t: t.write("src/arm/COLCON_IGNORE", ""),
        arguments=("--baseline-rev=main", "--exclude=src/arm"),
    ),
]


@pytest.mark.parametrize("case", QUIET, ids=lambda case: case.name)
def test_what_was_left_out_stays_so(case: Quiet, trap: Trap) -> None:
    pull_request(trap, case.base, case.head)
    case.after(trap)
    outcome = trap.run(*case.arguments, *QUICK, "--fail-on=never")
    assert outcome.code == 0, outcome.stderr
    assert (case.path, "nullPointer") not in states(outcome)
    assert outcome.notes() == []


def test_a_marker_that_goes_away_lets_the_files_in(trap: Trap) -> None:
    pull_request(
        trap, lambda t: t.write("src/arm/COLCON_IGNORE", ""), lambda t: (t.root / "src/arm/COLCON_IGNORE").unlink()
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert states(outcome)[ARM, "nullPointer"] == "new" and outcome.notes() == []


def test_a_given_directory_is_entered_and_nothing_is_said(trap: Trap) -> None:
    pull_request(trap, lambda t: None, lambda t: t.write("src/arm/COLCON_IGNORE", ""))
    done = trap.start("check", "src/arm", "--baseline-rev=main", *QUICK)
    assert "does not count" not in done.stdout.decode() and done.returncode == 0, done.stdout


# -- packages around packages --------------------------------------------------------------------------------------

MANIFEST = """<package format="3"><name>{}</name><version>1.0.0</version><description>x</description>
<maintainer email="a@b.de">a</maintainer><license>MIT</license><exec_depend>{}</exec_depend></package>
"""


def packages(trap: Trap, *names: str) -> None:
    for name in names:
        trap.write(f"src/{name}/package.xml", MANIFEST.format(name, "roscp"))


def of_packages(outcome: Outcome) -> list[Any]:
    return [result for result in outcome.report["results"] if result["rule"] == "file-not-analysed"]


@pytest.mark.parametrize(
    ("around", "says"),
    [
        ("package.xml", "makes a package around 2 packages of the base revision (src/arm, src/leg)"),
        ("src/package.xml", "makes a package around 2 packages of the base revision (src/arm, src/leg)"),
    ],
)
def test_a_package_around_packages_is_named(around: str, says: str, trap: Trap) -> None:
    """It takes their manifests out of the analysis, as colcon and catkin do not look below a package."""
    pull_request(trap, lambda t: packages(t, "arm", "leg"), lambda t: t.write(around, MANIFEST.format("all", "rospy")))
    outcome = trap.run("--baseline-rev=main", *QUICK)
    (result,) = of_packages(outcome)
    assert (result["path"], outcome.code) == (around, 1) and says in result["message"], outcome.report


def test_a_manifest_that_moves_up_is_named(trap: Trap) -> None:
    pull_request(
        trap,
        lambda t: packages(t, "arm", "arm/deep", "leg"),
        lambda t: [(t.root / "src/leg/package.xml").rename(t.root / "src/package.xml")],
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    (result,) = of_packages(outcome)
    assert "a package around a package of the base revision (src/arm)" in result["message"], outcome.report


@pytest.mark.parametrize(
    ("base", "head"),
    [
        (lambda t: packages(t, "arm", "arm/deep"), lambda t: packages(t, "leg")),
        (lambda t: packages(t, "arm/deep"), lambda t: t.git("mv", "src/arm/deep/package.xml", "src/arm/package.xml")),
        (lambda t: packages(t, "arm"), lambda t: packages(t, "arm/deep")),
        (lambda t: packages(t, "arm"), lambda t: (t.root / "src/arm/package.xml").unlink()),
        (
            lambda t: [packages(t, "arm/old"), t.write("src/arm/old/COLCON_IGNORE", "")],
            lambda t: packages(t, "arm"),
        ),
        (
            lambda t: [packages(t, "arm/old"), t.write(".haros-ci.yaml", "exclude: [src/arm/old]\n")],
            lambda t: packages(t, "arm"),
        ),
    ],
    ids=["beside", "moved up", "new one inside", "gone", "ignored inside", "excluded inside"],
)
def test_no_package_of_the_base_is_swallowed(
    base: Callable[[Trap], object], head: Callable[[Trap], object], trap: Trap
) -> None:
    pull_request(trap, base, head)
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert not of_packages(outcome) and not outcome.says("package around"), outcome.report


# -- submodules and other repositories ----------------------------------------------------------------------------


def other(trap: Trap, name: str, files: dict[str, str]) -> Path:
    """A repository beside the workspace."""
    aside = Trap.__new__(Trap)
    aside.root = trap.place / name
    aside.root.mkdir()
    for path, text in files.items():
        aside.write(path, text)
    aside.commit()
    return aside.root


def with_submodule(trap: Trap) -> Trap:
    lib = other(trap, "lib", {"lib.cpp": DEFECT})
    trap.git("init", "-q", "-b", "main")
    trap.git("-c", "protocol.file.allow=always", "submodule", "--quiet", "add", lib.as_uri(), "src/lib")
    inner = Trap.__new__(Trap)
    inner.root = trap.root / "src/lib"
    return inner


def test_a_marker_that_a_submodule_brings(trap: Trap) -> None:
    inner = with_submodule(trap)
    pull_request(trap, lambda t: None, lambda t: [inner.write("COLCON_IGNORE", ""), inner.commit()])
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert states(outcome)["src/lib/lib.cpp", "nullPointer"] == "unchanged"
    assert outcome.says("src/lib/COLCON_IGNORE does not count")


def test_a_marker_of_another_repository_counts(trap: Trap) -> None:
    """It is no part of the change."""
    pull_request(trap, lambda t: t.write(".gitignore", "/src/lib/\n"), lambda t: t.write("readme", ""))
    other(trap, "ws/src/lib", {"lib.cpp": DEFECT, "COLCON_IGNORE": ""})
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert ("src/lib/lib.cpp", "nullPointer") not in states(outcome) and not outcome.says("does not count")


def test_a_directory_that_becomes_a_submodule_that_is_not_there(trap: Trap) -> None:
    lib = other(trap, "lib", {"deep/arm.cpp": DEFECT})
    commit = os.popen(f"git -C {lib} rev-parse HEAD").read().strip()

    def head(t: Trap) -> None:
        t.git("rm", "-rq", "src/arm")
        (t.root / "src/arm").mkdir(parents=True)
        t.git("update-index", "--add", "--cacheinfo", f"160000,{commit},src/arm")
        t.git("commit", "-qm", "x")
        t.write("readme", "")

    pull_request(trap, lambda t: None, head)
    trap.git("checkout", "-q", "head")
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 1 and ("src/arm", None, "file-not-analysed") in outcome.findings(), outcome.notes()


# -- directories that are never analysed --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "directory",
    [".hidden", "src/.arm", "node_modules", "src/arm.egg-info", "src/__pycache__", ".github", "build"],
)
def test_sources_that_move_where_nobody_looks_are_named(directory: str, trap: Trap) -> None:
    pull_request(
        trap,
        lambda t: [t.write(".catkin_workspace", ""), t.write("src/x.cpp", ""), t.write(".github/ci.yml", "a: 1\n")],
        lambda t: moved(t, ARM, f"{directory}/arm.cpp"),
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    said = f"1 changed file lies in directories that are never analysed: {directory}/arm.cpp"
    assert outcome.says(said) and said in outcome.formats["text"], outcome.notes()
    assert_harmless(trap, outcome)


@pytest.mark.parametrize(
    ("directory", "path", "text"),
    [
        ("src/.arm", "src/lift.cpp", '#include ".arm/arm.cpp"\n'),
        ("src/.arm", "src/CMakeLists.txt", "file(GLOB SOURCES .arm/*.cpp)\n"),
        ("node_modules", "src/CMakeLists.txt", "add_library(arm ../node_modules/arm.cpp)\n"),
        ("attic", "src/CMakeLists.txt", "add_library(arm ../attic/arm.cpp)\n"),
        (".lib", "run.py", "import sys\n\nsys.path.append('.lib')\nimport arm\n"),
    ],
)
def test_sources_that_move_where_nobody_looks_and_are_used_there(
    directory: str, path: str, text: str, trap: Trap
) -> None:
    pull_request(
        trap,
        lambda t: [t.write("attic/COLCON_IGNORE", ""), t.write("attic/x.cpp", "")],
        lambda t: [moved(t, ARM, f"{directory}/arm.cpp"), t.write(path, text)],
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 1 and (f"{directory}/arm.cpp", None, "file-not-analysed") in outcome.findings()
    assert not outcome.says("never analysed"), "it is said once"
    assert_harmless(trap, outcome)


@pytest.mark.parametrize("name", ["lift.inc", "lift.txt", "lift"])
def test_code_that_is_included_under_any_name_is_a_finding(name: str, trap: Trap) -> None:
    """C++ includes what it likes: a header that is called otherwise would leave with all its findings."""

    def change(t: Trap) -> None:
        (t.root / "src/lift.hpp").unlink()
        t.write(f"src/{name}", DEFECT)
        t.write("src/lift.cpp", f'#include "{name}"\n')
        t.write("src/other.txt", "nothing includes it\n")

    pull_request(
        trap, lambda t: [t.write("src/lift.hpp", ""), t.write("src/lift.cpp", '#include "lift.hpp"\n')], change
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    [found] = [result for result in outcome.report["results"] if result["rule"] == "file-not-analysed"]
    assert (outcome.code, found["path"], found["state"]) == (1, f"src/{name}", "new")
    assert "C++ includes it, and no C++ file is called so" in found["message"]
    assert_harmless(trap, outcome)


@pytest.mark.parametrize(
    ("path", "text"),
    [
        (".github/ci.yml", "a: 2\n"),
        (".github/new.yml", "a: 1\n"),
        (".github/run.sh", "echo\n"),
        (".hidden/readme.md", "x\n"),
        (".hidden/data.txt", "x\n"),
        (".clang-tidy", "Checks: '*'\n"),
        ("src/.arm.cpp", DEFECT),
    ],
)
def test_what_tools_keep_there_is_not_named(path: str, text: str, trap: Trap) -> None:
    pull_request(trap, lambda t: t.write(".github/ci.yml", "a: 1\n"), lambda t: t.write(path, text))
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert not outcome.says("never analysed"), outcome.notes()


def test_unchanged_and_excluded_files_are_not_named(trap: Trap) -> None:
    pull_request(
        trap,
        lambda t: [t.write(".hidden/old.cpp", DEFECT), t.write(".haros-ci.yaml", "exclude: [.vendor]\n")],
        lambda t: t.write(".vendor/new.cpp", DEFECT),
    )
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.notes() == []


NODE = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32, String

rospy.init_node('talker')
rospy.Publisher('chat', String, queue_size=1)
rospy.Subscriber('chat', {}, print)
"""


def robot(trap: Trap, directory: str, type: str, name: str = "robot") -> None:
    """A package with a node whose two ends agree if *type* is String."""
    depends = "".join(f"<exec_depend>{other}</exec_depend>" for other in ("rospy", "std_msgs"))
    trap.write(
        f"{directory}/package.xml",
        f'<package format="2"><name>{name}</name><version>1.0.0</version><description>x</description>'
        f'<maintainer email="a@b.cd">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>{depends}</package>\n',
    )
    trap.write(
        f"{directory}/CMakeLists.txt",
        f"cmake_minimum_required(VERSION 3.0.2)\nproject({name})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        "catkin_install_python(PROGRAMS node.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
    )
    trap.write(f"{directory}/node.py", NODE.format(type))
    (trap.root / directory / "node.py").chmod(0o755)


@pytest.mark.parametrize(
    "case", ["a package is added", "a package is renamed", "a manifest is copied", "the other one is a copy of others"]
)
def test_another_package_of_the_name_does_not_take_its_place(case: str, trap: Trap) -> None:
    """Of several packages of one name one counts: that of the base revision, not one that the change puts before it."""

    def base(t: Trap) -> None:
        robot(t, "robot", "String")
        if case == "a package is renamed":
            robot(t, "arm", "String", "arm")

    def head(t: Trap) -> None:
        robot(t, "robot", "Int32")
        place = "arm" if case != "the other one is a copy of others" else "alpha/arm"
        if case == "a manifest is copied":
            t.write(f"{place}/package.xml", (t.root / "robot/package.xml").read_text())
        else:
            robot(t, place, "String")

    pull_request(trap, base, head)
    outcome = trap.run("--baseline-rev=main", "--profile=architecture")
    found = [(result["path"], result["rule"]) for result in outcome.report["results"] if result["state"] == "new"]
    assert ("robot/node.py", "topic-type-mismatch") in found
    assert outcome.code == 1
    assert outcome.says("is also that of robot, which the model has"), outcome.notes()


def test_of_two_packages_of_the_base_the_first_counts(trap: Trap) -> None:
    def base(t: Trap) -> None:
        robot(t, "arm", "String")
        robot(t, "robot", "String")

    pull_request(trap, base, lambda t: robot(t, "robot", "Int32"))
    outcome = trap.run("--baseline-rev=main", "--profile=architecture")
    assert outcome.says("is also that of arm, which the model has"), outcome.notes()
    assert "topic-type-mismatch" not in {result["rule"] for result in outcome.report["results"]}
