# SPDX-License-Identifier: Apache-2.0
"""Names, globs and patterns of the settings that fit nothing in the workspace."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import PackagePolicy, PathPolicy, Policy, Settings
from haros_ci.config.unmatched import unmatched
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.excludes import idle

NAMES = ("src/arm/package.xml", "src/arm/node.py", "src/arm/test/test_node.py", "src/arm/meshes/hand.stl")
FILES = tuple(
    SourceFile(name, "python" if name.endswith(".py") else "package", 1, "", "arm_driver") for name in NAMES[:3]
)
WORKSPACE = Workspace(Path("/"), (Package("arm_driver", "src/arm"),), FILES, None, names=frozenset(NAMES))  # type: ignore[arg-type]


def notes(**more: object) -> tuple[str, ...]:
    return unmatched(Settings(root=Path("/"), **more), WORKSPACE, idle)  # type: ignore[arg-type]


@pytest.mark.parametrize("glob", ["src/**", "src/arm/*.py", "*.py", "test", "test/", "src/arm/test/**", "**/test_*.py"])
def test_a_glob_that_names_an_analysed_file_is_in_order(glob: str) -> None:
    assert notes(per_path=(PathPolicy(globs=(glob,), policy=Policy()),)) == ()


@pytest.mark.parametrize("glob", ["tests/**", "arm/**", "*.pyx", "/node.py", "src/arm/Test/**", "*.stl"])
def test_a_glob_that_names_none_is_said(glob: str) -> None:
    entry = PathPolicy(globs=("src/**", glob), policy=Policy())
    assert notes(per_path=(entry,), origins=(("per-path", ".haros-ci.yaml:4"),)) == (
        f".haros-ci.yaml:4: no analysed file matches '{glob}', so what is said for it has no effect",
    )


@pytest.mark.parametrize(
    "pattern",
    [
        *(
            "src",
            "src/arm",
            "src/arm/",
            "src/arm/**",
            "arm",
            "arm/",
            "meshes",
            "*.stl",
            "hand.stl",
            "**/test",
            "test_*",
        ),
        *("/src", "./src", "!node.py", "# a comment", "", "src/*/test"),
        *("build", "build/", "build/**", "install/**", "**/build/**", ".venv", ".git/**", "node_modules", "log"),
    ],
)
def test_a_pattern_that_leaves_something_out_or_is_for_outputs_is_in_order(pattern: str) -> None:
    assert notes(exclude=(pattern,)) == ()


@pytest.mark.parametrize(
    "pattern",
    ["third_party", "third_party/**", "src/third_party/", "arm/**", "/arm", "hand.stl/", "*.obj", "src/arm/tests"],
)
def test_a_pattern_that_leaves_nothing_out_is_said(pattern: str) -> None:
    assert notes(exclude=("src/arm/test", pattern), origins=(("exclude", "command line"),)) == (
        f"command line: no file here matches '{pattern}' of 'exclude'; what git ignores is left out without it",
    )


def test_packages_that_are_not_there() -> None:
    def unknown(*names: str) -> tuple[str, ...]:
        return notes(per_package=(PackagePolicy(names=names, policy=Policy()),))

    assert unknown("arm_driver", "arm*", "*") == ()
    assert unknown("arm_drivr") == ("per-package: no package 'arm_drivr' here; did you mean 'arm_driver'?",)
    assert unknown("leg_*") == ("per-package: no package 'leg_*' here",)
    assert notes(packages=("arm_driver",)) == ()
    assert notes(packages=("arm_drivr",)) == ("packages: no package 'arm_drivr' here; did you mean 'arm_driver'?",)


@pytest.mark.parametrize(("pattern", "said"), [("arm_driver/test/*", False), ("*/node.py", False), ("test/*", True)])
def test_patterns_of_haros(pattern: str, said: bool) -> None:
    expected = f"analysis.ignore.files: no file matches '{pattern}'; write it as package/path/in/the/package"
    assert notes(ignore_files=(pattern,)) == (expected,) * said


def test_nothing_is_said_of_a_part_of_the_workspace() -> None:
    assert notes(exclude=("third_party",), paths=("src/arm",)) == ()
    assert notes(exclude=("third_party",), paths=("src/arm/node.py",)) == ()


def test_notes_have_an_end() -> None:
    found = notes(exclude=tuple(f"third_party_{number}" for number in range(50)))
    assert len(found) == 21 and found[-1] == "and 30 more names and globs that fit nothing here"
