# SPDX-License-Identifier: Apache-2.0
"""Packages of others that came whole and were hardly changed, as the history of the checkout has it."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from git_histories import Git, plant

from haros_ci.analysis.public_copies import copies, quiet
from haros_ci.config.settings import Settings
from haros_ci.workspace import imported
from haros_ci.workspace.discover import discover

PAGE = '<url type="website">https://github.com/lasers/lidars</url>'
GRETE = '<maintainer email="grete@lasers.org">Grete Stromberg</maintainer>'
OURS = '<maintainer email="ada@robots.org">Ada</maintainer>'


@pytest.fixture(autouse=True)
def who_commits(monkeypatch: pytest.MonkeyPatch) -> None:
    for role in ("AUTHOR", "COMMITTER"):
        monkeypatch.setenv(f"GIT_{role}_EMAIL", "ada@robots.org")


def manifest(name: str, people: str, page: str = "", version: str = "1.2.0") -> bytes:
    inside = f"<name>{name}</name><version>{version}</version><description>d</description>{people}<license>BSD</license>{page}"
    return f'<package format="3">{inside}</package>\n'.encode()


def package(path: str, people: str, page: str = "", **files: str) -> dict[str, bytes]:
    name = path.rpartition("/")[2]
    more = {f"{path}/{file.replace('__', '.')}": text.encode() for file, text in files.items()}
    return {f"{path}/package.xml": manifest(name, people, page), f"{path}/run.py": b"print(1)\n", **more}


TEAM = package("src/arm_of_ours", OURS)
LASER = package("src/beam_of_theirs", GRETE, PAGE)


def work(git: Git, first: Mapping[str, bytes], path: str = "src/arm_of_ours/run.py", times: int = 4) -> None:
    """A history: what came first, and commits that change one file."""
    git.commit(first)
    for number in range(times):
        git.commit({path: f"print({number + 2})\n".encode()})


def found(git: Git, root: str = "") -> set[str]:
    return set(copies(discover(git.top / root, (".",))))


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (LASER, {"src/beam_of_theirs"}),
        (package("src/beam_of_theirs", GRETE, LICENSE="BSD", README__md="beam"), {"src/beam_of_theirs"}),
        (package("src/beam_of_theirs", GRETE, CHANGELOG__rst="1.2.0"), {"src/beam_of_theirs"}),
        # its name begins as ours: people and history tell it
        (package("src/arm_of_theirs", GRETE, PAGE), {"src/arm_of_theirs"}),
        # the top of a repository, with two packages in it
        (
            {
                **package("src/lidars/beam", GRETE),
                **package("src/lidars/beam_more", GRETE),
                "src/lidars/LICENSE": b"BSD",
                "src/lidars/README.md": b"lidars",
            },
            {"src/lidars"},
        ),
        # a package without a page, by the people of one with a page
        ({**LASER, **package("src/beam_more", GRETE)}, {"src/beam_of_theirs", "src/beam_more"}),
    ],
)
def test_packages_put_in_whole_are_copies(git: Git, files: dict[str, bytes], expected: set[str]) -> None:
    work(git, {**TEAM, **files})
    assert found(git) == expected


def test_it_may_come_later_and_be_moved(git: Git) -> None:
    work(git, TEAM)
    git.commit(package("beam_of_theirs", GRETE, PAGE))
    git("mv", "beam_of_theirs", "src/beam_of_theirs")
    git.commit()
    assert found(git) == {"src/beam_of_theirs"}


def test_the_workspace_may_lie_below_the_top(git: Git) -> None:
    work(git, {f"ws/{path}": data for path, data in {**TEAM, **LASER}.items()}, "ws/src/arm_of_ours/run.py")
    assert found(git, "ws") == {"src/beam_of_theirs"}


@pytest.mark.parametrize(
    "files",
    [
        package("src/beam_of_theirs", GRETE),  # nothing but a name that commits nothing: one of the team may be called so
        package("src/beam_of_theirs", GRETE, LICENSE="BSD"),  # ros2 pkg create writes it
        package("src/beam_of_theirs", GRETE, README__md="beam"),
        package("src/beam_of_theirs", "", PAGE),
        package("src/beam_of_theirs", '<maintainer email="user@todo.todo">user</maintainer>', PAGE),
        package("src/beam_of_theirs", '<maintainer email="he@todo.todo">he</maintainer>', PAGE),  # a user of a computer
        package("src/beam_of_theirs", OURS, PAGE),
        package("src/beam_of_theirs", GRETE + OURS, PAGE),
        # another address of who commits, the name with a second word, somebody of the same house
        package("src/beam_of_theirs", '<maintainer email="ada@lasers.org">A. L.</maintainer>', PAGE),
        package("src/beam_of_theirs", '<maintainer email="al@lasers.org">Ada Lovage</maintainer>', PAGE),
        package("src/beam_of_theirs", '<maintainer email="eva@labs.robots.org">Eva Kant</maintainer>', PAGE),
        package("src/beam_of_theirs", GRETE, "<url>TODO</url>"),
        # the MoveIt Setup Assistant puts it into what it makes
        package("src/beam_of_theirs", GRETE, '<url type="repository">https://github.com/ros-planning/moveit</url>'),
        package("src/beam_of_theirs", GRETE, '<url type="website">http://moveit.ros.org/</url>'),
    ],
)  # fmt: skip
def test_who_may_be_of_the_team_keeps_a_package(git: Git, files: dict[str, bytes]) -> None:
    work(git, {**TEAM, **files})
    assert found(git) == set()


@pytest.mark.parametrize(
    "change",
    [
        {"src/beam_of_theirs/run.py": b"print(0)\n"},  # a fork that the team changes
        {"src/beam_of_theirs/more.py": b"print(0)\n"},
        # a package that is changed names the same people, somebody of the same house, or a page of the same owner
        {"src/arm_of_ours/package.xml": manifest("arm_of_ours", GRETE)},
        {"src/arm_of_ours/package.xml": manifest("arm_of_ours", GRETE.replace("grete@", "eva@").replace("Grete", "Eva"))},
        {"src/arm_of_ours/package.xml": manifest("arm_of_ours", OURS, PAGE.replace("/lidars<", "/arms<"))},
    ],
)  # fmt: skip
def test_what_the_team_changes_is_its_own(git: Git, change: dict[str, bytes]) -> None:
    work(git, {**TEAM, **LASER})
    git.commit(change)
    assert found(git) == set()


MANY = {f"src/beam_of_theirs/beam/part_{number}.py": b"print(1)\n" for number in range(14)}


def test_files_that_the_team_has_changed_have_findings(git: Git) -> None:
    """Two of sixteen: the others are as they came."""
    work(git, {**TEAM, **LASER, **MANY})
    git.commit({"src/beam_of_theirs/run.py": b"print(0)\n", "src/beam_of_theirs/beam/part_1.py": b"print(0)\n"})
    workspace = quiet(discover(git.top, (".",)), Settings(root=git.top))
    kept = [file.path for file in workspace.files if not file.third_party]
    assert kept == [
        "src/arm_of_ours/package.xml",
        "src/arm_of_ours/run.py",
        "src/beam_of_theirs/beam/part_1.py",
        "src/beam_of_theirs/run.py",
    ]


@pytest.mark.parametrize(
    "changed",
    [
        ("run.py", "beam/part_1.py", "beam/part_2.py"),
        ("more.py",),
        ("package.xml",),  # who writes the manifest has the package
    ],
)
def test_more_changes_are_a_fork(git: Git, changed: tuple[str, ...]) -> None:
    work(git, {**TEAM, **LASER, **MANY})
    texts = {path: git.top.joinpath("src/beam_of_theirs", path) for path in changed}
    git.commit(
        {
            f"src/beam_of_theirs/{path}": (place.read_bytes() if place.exists() else b"") + b"\n"
            for path, place in texts.items()
        }
    )
    assert found(git) == set()


@pytest.mark.parametrize("is_compared", [True, False])
def test_with_something_to_compare_with_nothing_is_quiet(git: Git, is_compared: bool) -> None:
    work(git, {**TEAM, **LASER})
    settings = Settings(root=git.top, baseline_rev="HEAD" if is_compared else None)
    workspace = quiet(discover(git.top, (".",)), settings)
    assert any(file.third_party for file in workspace.files) is not is_compared


def test_a_move_with_changes_is_no_coming(git: Git) -> None:
    work(git, {**TEAM, **package("beam_of_theirs", GRETE, PAGE)})
    git("mv", "beam_of_theirs", "src/beam_of_theirs")
    git.commit({"src/beam_of_theirs/run.py": b"import os\n\nprint(os.sep)\n"})
    assert found(git) == set()


def test_without_work_on_the_rest_nothing_is_a_copy(git: Git) -> None:
    """One commit, or a few: who has put everything into a repository has not shown what is his."""
    work(git, {**TEAM, **LASER}, times=2)
    assert found(git) == set()


def test_work_on_other_files_is_none_on_a_package(git: Git) -> None:
    work(git, {**TEAM, **LASER}, "README.md")
    assert found(git) == set()


def test_its_own_repository(git: Git) -> None:
    """Colleagues of one house, of whom one has left."""
    work(git, {**package("arm", OURS), **package("leg", GRETE.replace("lasers.org", "robots.org"), PAGE)}, "arm/run.py")
    assert found(git) == set()


def test_a_shallow_clone_says_nothing(git: Git, tmp_path: Path) -> None:
    work(git, {**TEAM, **LASER})
    subprocess.run(
        ["git", "clone", "-q", "--depth=2", f"file://{git.top}", str(tmp_path / "shallow")], check=True, capture_output=True
    )  # fmt: skip
    assert set(copies(discover(tmp_path / "shallow", (".",)))) == set()


def test_no_repository(tmp_path: Path) -> None:
    plant(tmp_path, {**TEAM, **LASER})
    assert set(copies(discover(tmp_path, (".",)))) == set()


def test_a_long_history_is_not_read(git: Git, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(imported, "MOST_COMMITS", 4)
    work(git, {**TEAM, **LASER})
    assert found(git) == set()


def test_names_of_any_bytes(new_git: Callable[[str], Git]) -> None:
    """Names of files that look like the letters of git's answer, with line breaks and spaces."""
    git = new_git("odd")
    odd = {f"src/beam_of_theirs/{name}": b"x\n" for name in ("M", "A\n\x01b", " R100", "ä ö")}
    work(git, {**TEAM, **LASER, **odd})
    assert found(git) == {"src/beam_of_theirs"}
