# SPDX-License-Identifier: Apache-2.0
"""``haros-ci diff``: revisions, formats, exit codes; hostile names and broken files."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest
from commandline import commit, git, write
from revisions_of import launch, python_node

from haros_ci.checking.page import filled
from haros_ci.cli import main

PUB = 'pub = node.create_publisher(String, "chatter", 10)'
RATE = 'node.declare_parameter("rate", 10.0)'
NOTHING = "No change to interfaces, nodes, topics, services, actions or parameters.\n"


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = tmp_path / "ws"
    root.mkdir()
    files = {
        "talker.py": python_node("talker", PUB, RATE),
        "listener.py": python_node(
            "listener", PUB.replace("create_publisher", "create_subscription").replace("10", "print, 10")
        ),
        "launch/a.launch.xml": launch('pkg="demo" exec="talker.py"', 'pkg="demo" exec="listener.py"'),
    }
    write(root, filled(files))
    commit(root)
    monkeypatch.chdir(root)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return root


def change(root: Path, *lines: str) -> None:
    write(root, {"talker.py": python_node("talker", *lines)})


def out(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 0) -> str:
    assert main(["diff", *arguments]) == code
    return capsys.readouterr().out


def test_the_work_tree_against_a_commit(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(repository, PUB.replace("chatter", "chat"), RATE)
    text = out(capsys, "HEAD")
    assert "publisher renamed: /chatter → /chat; demo/talker.py; talker.py:9; used by /listener" in text
    assert out(capsys, "HEAD", "--exit-code", code=1) == text


def test_nothing_has_changed(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, {"README.md": "Hello."})
    for format in ("text", "markdown"):
        assert out(capsys, "HEAD", "--format", format, "--exit-code") == NOTHING
    assert json.loads(out(capsys, "HEAD", "--format", "json"))["changes"] == []


def test_a_page_of_the_change_alone(repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(repository, PUB.replace("chatter", "<script>alert(1)</script>"), RATE)
    out(capsys, "HEAD", "--format", "html", "--output", str(tmp_path / "one.html"))
    text = (tmp_path / "one.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>") and "alert(1)</script>" not in text and '"only":"changes"' in text
    out(capsys, "HEAD", "--format", "html", "--output", str(tmp_path / "two.html"))
    assert (tmp_path / "two.html").read_text(encoding="utf-8") == text
    git(repository, "checkout", "-q", ".")
    assert "No change to" in out(capsys, "HEAD", "--format", "html")


def test_two_commits_without_a_checkout(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    change(repository, PUB, RATE.replace("10.0", "20.0"))
    commit(repository)
    bare = tmp_path / "objects"
    subprocess.run(["git", "clone", "-q", "--no-checkout", str(repository), str(bare)], check=True)
    monkeypatch.chdir(bare)
    document = json.loads(out(capsys, "HEAD^", "HEAD", "--format", "json"))
    assert document["schema_version"] == 1
    assert document["head"] == git(repository, "rev-parse", "HEAD").strip()
    (found,) = document["changes"]
    assert (found["what"], found["action"], found["aspect"]) == ("parameter", "changed", "default")
    assert (found["before"], found["after"]) == ("10.0", "20.0")
    assert found["head"] == {"path": "talker.py", "line": 10, "column": 1}
    assert sorted(path.name for path in bare.iterdir()) == [".git"]


def test_from_where_the_histories_parted(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    git(repository, "branch", "side")
    change(repository, PUB, RATE.replace("10.0", "20.0"))
    commit(repository)
    git(repository, "checkout", "-q", "side")
    change(repository, PUB, RATE, 'node.declare_parameter("more", 1)')
    commit(repository)
    assert out(capsys, "main", "side", "--merge-base").count("parameter") == 2
    assert "10.0" in out(capsys, "main", "side")


def test_markdown_has_a_table_and_a_picture(repository: Path, tmp_path: Path) -> None:
    change(repository, PUB.replace("chatter", "chat"))
    assert main(["diff", "HEAD", "--format", "markdown", "--output", str(tmp_path / "out.md")]) == 0
    text = (tmp_path / "out.md").read_text(encoding="utf-8")
    assert text.startswith("**2 changes&#58; 1 publisher, 1 parameter**\n\n| What | Where | Before | After | Users |\n")
    assert "```mermaid\nflowchart LR\n" in text
    assert '(["/chat"])' in text and '["/talker"]' in text
    assert text.count("linkStyle") == 2


def test_names_cannot_break_out(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hostile = "a|b`c](http://x)<img src=x>@team\\n```##[error]"
    change(repository, PUB, RATE, f'node.declare_parameter("{hostile}", "{hostile}")')
    write(repository, {"launch/a.launch.xml": launch('pkg="demo" exec="talker.py" name="x&quot;]--&gt;|`|"')})
    for format in ("text", "markdown", "json"):
        text = out(capsys, "HEAD", "--format", format)
        assert "##[" not in text
        if format == "markdown":
            rows = [line for line in text.splitlines() if line.startswith("| ")]
            assert all(len(re.findall(r"(?<!\\)\|", row)) == 6 for row in rows)
            assert "<img" not in text and "](http" not in text and "@team" not in text
            assert text.count("```") in (0, 2)


@pytest.mark.parametrize(
    "arguments", [("nowhere",), ("HEAD", "nowhere"), ("--", "--upload-pack=x"), ("HEAD:talker.py",), ("",)]
)
def test_a_revision_that_cannot_be_had(
    arguments: tuple[str, ...], repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["diff", *arguments]) == 2
    assert "error: unknown revision" in capsys.readouterr().err


def test_outside_of_git(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["diff", "HEAD"]) == 2
    assert "not in a git repository" in capsys.readouterr().err


BROKEN = {
    "talker.py": "def (:\n",
    "launch/a.launch.xml": "<launch><node",
    "package.xml": "<package",
    "config/a.yaml": "a: ros__parameters: [\n",
    "msg/A.msg": "float64[ x\n\x00",
    "CMakeLists.txt": "add_executable(",
}


@pytest.mark.parametrize("path", BROKEN)
def test_broken_files_on_either_side(path: str, repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, {path: BROKEN[path]})
    commit(repository)
    change(repository, PUB, RATE, 'node.declare_parameter("more", 1)')
    for arguments in (("HEAD^", "HEAD"), ("HEAD",), ("HEAD", "HEAD^")):
        assert main(["diff", *arguments, "--format", "markdown"]) == 0
    assert capsys.readouterr().out


def test_a_check_against_a_revision_tells_in_the_job_summary(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    change(repository, PUB.replace("chatter", "chat"), RATE)
    page = tmp_path / "summary.md"
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(page))
    options = ("check", "--profile", "architecture", "--output", "github")
    assert main([*options, "--baseline-rev", "HEAD"]) == 1
    assert "graph-change" in capsys.readouterr().out
    text = page.read_text(encoding="utf-8")
    assert "### What changes in the system" in text and "publisher renamed" in text
    page.unlink()
    main([*options])
    assert "What changes" not in page.read_text(encoding="utf-8")


def test_a_symbolic_link_is_the_same_on_both_sides(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (repository / "launch" / "same.launch.xml").symlink_to("a.launch.xml")
    (repository / "params").symlink_to("launch")
    (repository / "away").symlink_to("/etc")
    commit(repository)
    for arguments in (("HEAD",), ("HEAD", "HEAD")):
        assert out(capsys, *arguments) == NOTHING
