# SPDX-License-Identifier: Apache-2.0
"""``haros-ci hpl``, and properties in ``haros-ci check``: what is said where, and the exit codes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from commandline import TALKER_PACKAGE

from haros_ci.cli import main

FILES = {
    **TALKER_PACKAGE,
    "src/demo/talker.py": "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import UInt8\n\nrospy.init_node('talker')\n"
    "out = rospy.Publisher('level', UInt8, queue_size=1)\nrospy.spin()\n",
    "src/demo/launch/demo.launch": "<launch><node pkg='demo' type='talker.py' name='a' ns='robot'/></launch>",
    "src/demo/hpl/demo.hpl": "# id: low\nglobally: no /robot/level {data > 100}\n\nglobally: no /robot/lvel\n",
    "src/demo/hpl/node.hpl": "globally: no /level {dta > 100}\n",
}
PROJECT = """\
packages: [demo]
configurations:
  demo:
    launch: [demo/launch/demo.launch]
    hpl:
      properties:
        - 'globally: no /robot/level {data = 300}'
        - 'globally: no /robot/level {data = 3'
      files: [demo/hpl/demo.hpl]
nodes:
  demo/talker.py:
    hpl:
      properties:
        - 'globally: no /level {dta > 100}'
        - 'globally: no level {data > 100}'
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in {**FILES, "haros.yaml": PROJECT}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def said(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, list[tuple[str, str, int, int]]]:
    code = main([*arguments, "--no-cache", "--output", "json"])
    found = json.loads(capsys.readouterr().out)["results"]
    return code, [(each["rule"], each["path"], each["line"], each["column"]) for each in found if "hpl" in each["rule"]]


EXPECTED = [
    ("hpl-out-of-range", "haros.yaml", 7, 46),
    ("hpl-syntax", "haros.yaml", 8, 47),
    ("hpl-unknown-field", "haros.yaml", 14, 33),
    ("hpl-unknown-topic", "src/demo/hpl/demo.hpl", 4, 14),
]


def test_check_reports_them_where_they_stand(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert said(capsys, "check", ".", "--profile", "architecture") == (1, EXPECTED)


def test_the_command_says_the_same_of_the_project_file(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, found = said(capsys, "hpl", "haros.yaml")
    assert (code, found) == (1, EXPECTED)


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("src/demo/hpl/demo.hpl",), (1, ["hpl-unknown-topic"])),
        (("src/demo/hpl/demo.hpl", "--configuration", "demo"), (1, ["hpl-unknown-topic"])),
        (("src/demo/hpl/demo.hpl", "--configuration", "demo", "--fail-on", "error"), (0, ["hpl-unknown-topic"])),
        (("src/demo/hpl/demo.hpl", "--node", "demo/talker.py"), (1, ["hpl-foreign-topic"])),
        (("src/demo/hpl/node.hpl", "--node", "demo/talker.py"), (1, ["hpl-unknown-field"])),
        (("src/demo/hpl/node.hpl", "src/demo/hpl/demo.hpl"), (1, ["hpl-unknown-topic", "hpl-unknown-topic"])),
    ],
)
def test_what_properties_of_a_file_are_about(
    workspace: Path,
    capsys: pytest.CaptureFixture[str],
    arguments: tuple[str, ...],
    expected: tuple[int, list[str]],
) -> None:
    code, found = said(capsys, "hpl", *arguments)
    assert (code, [each[0] for each in found]) == expected


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("none.hpl",), "no such file"),
        (("src/demo/hpl",), "no file of the workspace"),
        (("haros.yaml", "--configuration", "demi"), "no configuration demi"),
        (("haros.yaml", "--node", "demo/talker"), "no node demo/talker"),
        (("haros.yaml", "--output", "yaml"), "yaml"),
    ],
)
def test_wrong_usage(
    workspace: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    assert main(["hpl", *arguments, "--no-cache"]) == 2
    assert message in capsys.readouterr().err


def test_text_has_a_frame_and_counts(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["hpl", "haros.yaml", "--no-cache"])
    captured = capsys.readouterr()
    assert "haros.yaml:7:46: warning: data is uint8, 0 to 255, and never 300" in captured.out
    assert captured.err.endswith("5 properties read\n")


def test_a_comment_silences(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = workspace / "src/demo/hpl/demo.hpl"
    path.write_text(FILES["src/demo/hpl/demo.hpl"].replace("lvel\n", "lvel  # haros: ignore[hpl-unknown-topic]\n"))
    code, _ = said(capsys, "hpl", "src/demo/hpl/demo.hpl")
    assert code == 0


def test_a_property_that_has_moved_is_the_same_finding(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def git(*arguments: str) -> None:
        subprocess.run(
            ["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], check=True, capture_output=True
        )

    git("init", "-q")
    git("add", "-A")
    git("commit", "-q", "-m", "a")
    moved = PROJECT.replace("        - 'globally: no /robot/level {data = 300}'\n", "").replace(
        "        - 'globally: no /robot/level {data = 3'\n",
        "        - 'globally: some /robot/level'\n        - 'globally:  no /robot/level { data = 300 }'\n"
        "        - 'globally: no /robot/level {data = 256}'\n",
    )
    (workspace / "haros.yaml").write_text(moved, encoding="utf-8")
    main(["check", ".", "--profile", "architecture", "--baseline-rev", "HEAD", "--no-cache", "--output", "json"])
    found = json.loads(capsys.readouterr().out)["results"]
    states = {(each["rule"], each["line"]): each["state"] for each in found if "out-of-range" in each["rule"]}
    assert states == {("hpl-out-of-range", 8): "unchanged", ("hpl-out-of-range", 9): "new"}


def test_nothing_of_it_is_loaded_where_no_property_is_stated() -> None:
    code = (
        "import sys; from haros_ci.registry import checks; import haros_ci.analysis.inspection, haros_ci.checking.project; checks();"
        "print([name for name in sys.modules if name.startswith(('haros_ci.behaviour', 'haros_ci.checking.properties'))])"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout == "[]\n"
