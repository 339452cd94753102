# SPDX-License-Identifier: Apache-2.0
"""No command writes through a link that the workspace planted: not the last name of an output, nor a directory on the way."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from commandline import commit, write
from small_robot import FILES

from haros_ci.cli import main
from haros_ci.commands.output import FORMATS

OLD = b"precious\n"
QUICK = ("--isolated", "--profile", "architecture")
#: Each command that writes a file, and where: ``OUT`` stands for its name.
WRITERS = {
    **{f"check {name}": ("check", ".", *QUICK, "--output", f"{name}=OUT") for name in FORMATS},
    "check html": ("check", ".", *QUICK, "--output", "html=OUT"),
    "report": (
        "report",
        ".",
        *QUICK,
        "--allow-tool-failure",
        "lizard",
        "--allow-tool-failure",
        "radon",
        "--output",
        "OUT",
    ),
    "check shard": ("check", ".", *QUICK, "--shard", "1/1", "--output", "shard=OUT"),
    "merge": ("merge", "../1.shard", *QUICK, "--output", "sarif=OUT"),
    "merge costs": ("merge", "../1.shard", *QUICK, "--write-costs", "OUT"),
    **{
        f"model {name}": ("model", ".", "--isolated", "--format", name, "--output", "OUT")
        for name in ("text", "json", "dot", "mermaid", "sqlite", "nodl", "readme")
    },
    **{
        f"diff {name}": ("diff", "HEAD", "--isolated", "--format", name, "--output", "OUT")
        for name in ("text", "markdown", "json", "html")
    },
    **{
        f"metrics {name}": ("metrics", ".", "--isolated", "--format", name, "--output", "OUT")
        for name in ("text", "json", "csv")
    },
    "policy": ("policy", "--isolated", "--output", "OUT"),
    "baseline create": ("baseline", "create", *QUICK, "--file", "OUT"),
}
#: Commands that fill a directory.
FILLERS = {
    "haros-json": (("check", ".", *QUICK, "--output", "haros-json=OUT"), "projects.json"),
    "model nodl": (("model", ".", "--isolated", "--format", "nodl", "--output", "OUT"), "robot.nodl.xml"),
    "model readme": (("model", ".", "--isolated", "--format", "readme", "--output", "OUT"), "robot.md"),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The workspace as a repository, of which each test has a copy, beside a cache that all of them share."""
    root = write(tmp_path_factory.mktemp("made") / "ws", FILES)
    commit(root)
    return root


@pytest.fixture
def here(tmp_path: Path, made: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The workspace, which is the current directory; beside it ``outside``, which nothing may write into."""
    root = tmp_path / "ws"
    shutil.copytree(made, root)
    write(tmp_path / "outside", {"precious": OLD, "dir/keep": OLD})
    monkeypatch.chdir(root)
    for name in ("CI", "GITHUB_ACTIONS", "GITHUB_STEP_SUMMARY", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(made.parent / "xdg"))
    return root


def outside(root: Path) -> dict[str, bytes]:
    place = root.parent / "outside"
    return {path.relative_to(place).as_posix(): path.read_bytes() for path in place.rglob("*") if path.is_file()}


UNTOUCHED = {"precious": OLD, "dir/keep": OLD}


def argv(words: tuple[str, ...], name: str) -> list[str]:
    if "../1.shard" in words and not Path("../1.shard").exists():
        assert main(["check", ".", *QUICK, "--shard", "1/1", "--output", "shard=../1.shard"]) == 0
    return [word.replace("OUT", name) for word in words]


def to_a_file(root: Path) -> str:
    (root / "out").symlink_to("../outside/precious")
    return "out"


def to_nothing(root: Path) -> str:
    (root / "out").symlink_to(root.parent / "outside" / "new")
    return "out"


def through_a_directory(root: Path) -> str:
    (root / "out").symlink_to("../outside")
    return "out/dir/new"


def through_a_chain(root: Path) -> str:
    (root / "one").symlink_to("two")
    (root / "two").symlink_to("../outside/dir")
    return "./one/../new"


@pytest.mark.parametrize("plant", [to_a_file, to_nothing, through_a_directory, through_a_chain])
@pytest.mark.parametrize("command", WRITERS)
def test_nothing_is_written_through_a_link(
    here: Path, command: str, plant: Callable[[Path], str], capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(argv(WRITERS[command], plant(here))) == 2
    assert outside(here) == UNTOUCHED
    said = capfd.readouterr().err
    assert "symbolic link leads out of" in said and "internal error" not in said
    assert not list(here.glob(".haros-ci-*.new"))


@pytest.mark.parametrize("command", WRITERS)
def test_a_file_without_a_link_is_written(here: Path, command: str) -> None:
    assert main(argv(WRITERS[command], "made/out")) in (0, 1)
    assert Path("made/out").stat().st_size > 0
    assert os.listdir("made") == ["out"]
    assert outside(here) == UNTOUCHED


@pytest.mark.parametrize("command", FILLERS)
def test_no_directory_is_filled_through_a_link(here: Path, command: str, capfd: pytest.CaptureFixture[str]) -> None:
    words, own = FILLERS[command]
    (here / "out").symlink_to("../outside/dir")
    assert main(argv(words, "out")) == 2
    assert outside(here) == UNTOUCHED
    assert "symbolic link" in capfd.readouterr().err


@pytest.mark.parametrize("command", FILLERS)
def test_no_file_of_a_directory_is_written_through_a_link(here: Path, command: str) -> None:
    words, own = FILLERS[command]
    (here / "out").mkdir()
    (here / "out" / own).symlink_to("../../outside/precious")
    assert main(argv(words, "out")) == 2
    assert outside(here) == UNTOUCHED


@pytest.mark.parametrize("action", ["create", "update", "prune"])
@pytest.mark.parametrize("place", [".", "robot", ".."], ids=["at the root", "below it", "above it"])
def test_the_baseline_at_the_root_is_no_way_out(
    here: Path, action: str, place: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Also where the root is not below the current directory."""
    known = here.parent / "outside" / "known"
    if action != "create":
        assert main(["baseline", "create", *QUICK, "--file", str(known)]) == 0
    else:
        known.write_bytes(OLD)
    before = known.read_bytes()
    (here / ".haros-ci-baseline.jsonl").symlink_to(known)
    monkeypatch.chdir(here / place)
    path = [str(here)] if place == ".." else []
    assert main(["baseline", action, *path, *QUICK]) == 2
    assert known.read_bytes() == before
    assert "internal error" not in capfd.readouterr().err


@pytest.mark.parametrize("link", [".github", ".github/workflows", ".haros-ci.yaml", ".pre-commit-config.yaml"])
def test_init_follows_no_link(here: Path, link: str) -> None:
    (here / link).parent.mkdir(exist_ok=True)
    (here / link).symlink_to(here.parent / "outside" / ("new" if link.endswith("yaml") else "dir"))
    main(["init"])
    assert outside(here) == UNTOUCHED


def test_new_check_follows_no_link(here: Path) -> None:
    (here.parent / "outside" / "__init__.py").write_text("")
    (here / "checks").symlink_to("../outside")
    assert main(["new-check", "topic-without-name"]) == 2
    assert outside(here) == {**UNTOUCHED, "__init__.py": b""}


@pytest.mark.parametrize("name", ["topic_without_name.py", "topic_without_name.md"])
def test_new_check_replaces_no_link(here: Path, name: str) -> None:
    write(here, {"checks/__init__.py": ""})
    (here / "checks" / name).symlink_to("../../outside/new")
    assert main(["new-check", "topic-without-name"]) == 2
    assert outside(here) == UNTOUCHED


def test_the_job_summary_follows_no_link(
    here: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    (here / "summary").symlink_to("../outside/precious")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", "summary")
    main(["check", ".", *QUICK, "--output", "github"])
    assert outside(here) == UNTOUCHED
    assert "the job summary cannot be written" in capfd.readouterr().err


def test_fixes_follow_no_link(here: Path) -> None:
    launch = here / "robot" / "launch" / "a.launch.py"
    (here.parent / "outside" / "a.launch.py").write_bytes(launch.read_bytes())
    launch.unlink()
    launch.symlink_to(here.parent / "outside" / "a.launch.py")
    before = outside(here)
    main(["check", ".", *QUICK, "--select", "deprecated-launch-keyword", "--fix"])
    assert outside(here) == before


# -- what is the user's own is written as ever -------------------------------------------------------------------


def test_links_inside_stay_links(here: Path) -> None:
    write(here, {"reports/real": "old"})
    (here / "out").symlink_to("reports/real")
    assert main(["model", ".", "--isolated", "--format", "sqlite", "--output", "out"]) == 0
    assert (here / "out").is_symlink()
    assert (here / "reports" / "real").read_bytes().startswith(b"SQLite format 3")
    assert os.listdir(here / "reports") == ["real"]


def test_links_of_the_user_outside_are_followed(here: Path) -> None:
    """Nobody but the user can have put a link beside the workspace."""
    (here.parent / "link").symlink_to("outside")
    assert main(["model", ".", "--isolated", "--format", "sqlite", "--output", "../link/new"]) == 0
    assert outside(here)["new"].startswith(b"SQLite format 3")


def test_a_workspace_may_be_reached_through_a_link(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (here.parent / "link").symlink_to(here)
    monkeypatch.chdir(here.parent / "outside")
    assert main(["baseline", "create", str(here.parent / "link"), *QUICK]) == 0
    assert (here / ".haros-ci-baseline.jsonl").is_file()
