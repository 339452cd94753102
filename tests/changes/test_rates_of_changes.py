# SPDX-License-Identifier: Apache-2.0
"""Rates compared: what a change of a period reaches, once; and what is no change of a rate."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import commit, write
from revisions_of import launch, revision

from haros_ci.changes.revision import changes_of
from haros_ci.checking.page import filled
from haros_ci.cli import main
from haros_ci.model.changes import Change

HEAD = "import rclpy\nfrom std_msgs.msg import String\n\nrclpy.init()\nnode = rclpy.create_node({!r})\n"
LAUNCH = {
    "launch/a.launch.xml": launch(
        'pkg="demo" exec="driver.py"', 'pkg="demo" exec="filter.py"', 'pkg="demo" exec="sink.py"'
    )
}
FILTER = (
    HEAD.format("filter") + 'pub = node.create_publisher(String, "clean", 10)\n\n\ndef on_raw(message):\n'
    '    pub.publish(message)\n\n\nsub = node.create_subscription(String, "raw", on_raw, 10)\nrclpy.spin(node)\n'
)
SINK = HEAD.format("sink") + 'sub = node.create_subscription(String, "clean", print, 10)\nrclpy.spin(node)\n'


def driver(period: str = "0.05", body: str = "pub.publish(String())", first: str = "") -> dict[str, str]:
    """A node that publishes /raw in a timer, one that passes it on, and one that takes that."""
    text = (
        HEAD.format("driver")
        + f'pub = node.create_publisher(String, "raw", 10)\n{first}\n\ndef tick():\n    {body}\n\n\n'
        f"timer = node.create_timer({period}, tick)\nrclpy.spin(node)\n"
    )
    return {**LAUNCH, "driver.py": text, "filter.py": FILTER, "sink.py": SINK}


def rates(tmp_path: Path, base: dict[str, str], head: dict[str, str], *, asked: bool = False) -> list[Change]:
    found = changes_of(revision(tmp_path / "base", base), revision(tmp_path / "head", head), {}, rates=asked)
    return [change for change in found.changes if change.what == "rate"]


def test_a_period_is_one_change_with_all_that_it_reaches(tmp_path: Path) -> None:
    (change,) = rates(tmp_path, driver(), driver("0.1"))
    assert (change.names, change.before, change.after, change.nodes) == (("/raw",), "20 Hz", "10 Hz", ("/driver",))
    assert change.users == ("/sink", "/filter")
    assert change.details == ("/clean of /filter: 20 Hz → 10 Hz",)
    assert change.head is not None and change.head.path == "driver.py"


PARAMETER = 'period = node.declare_parameter("period", 0.05).value'
QUIET = {
    "nothing": (driver(), driver()),
    "another topic": (driver(), driver(first='other = node.create_publisher(String, "other", 10)')),
    "the same period, written otherwise": (driver("0.5"), driver("1 / 2")),
    "a period that is not known any more": (driver(), driver("input()")),
    "a period that was not known": (driver("input()"), driver()),
    "a timer without a publication": (driver(), driver(first="second = node.create_timer(1.0, print)")),
}


@pytest.mark.parametrize(("base", "head"), QUIET.values(), ids=QUIET)
def test_no_change_of_a_rate(base: dict[str, str], head: dict[str, str], tmp_path: Path) -> None:
    assert rates(tmp_path, base, head, asked=True) == []


LOUD = {
    "a parameter's default": (
        driver("period", first=PARAMETER),
        driver("period", first=PARAMETER.replace("5", "4")),
        "25 Hz",
    ),
    "a constant": (driver("PERIOD", first="PERIOD = 0.05"), driver("PERIOD", first="PERIOD = 0.2"), "5 Hz"),
}


@pytest.mark.parametrize(("base", "head", "after"), LOUD.values(), ids=LOUD)
def test_another_rate(base: dict[str, str], head: dict[str, str], after: str, tmp_path: Path) -> None:
    assert [(change.before, change.after) for change in rates(tmp_path, base, head)] == [("20 Hz", after)]


CONDITION = "node.has_parameter('on') and pub.publish(String())"


def test_a_rate_that_no_period_shows_is_compared_if_that_is_asked_for(tmp_path: Path) -> None:
    assert rates(tmp_path / "a", driver(), driver(body=CONDITION)) == []
    (change,) = rates(tmp_path / "b", driver(), driver(body=CONDITION), asked=True)
    assert (change.before, change.after) == ("20 Hz", "0 to 20 Hz")


def test_nodes_that_call_each_other_are_affected_and_have_no_rate(tmp_path: Path) -> None:
    echo = SINK.replace("print", "lambda m: out.publish(m)").replace(
        "sub =", 'out = node.create_publisher(String, "raw", 10)\nsub ='
    )
    (change,) = rates(tmp_path, {**driver(), "sink.py": echo}, {**driver("0.1"), "sink.py": echo})
    assert (change.users, change.details) == (("/sink", "/filter"), ())


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = tmp_path / "ws"
    root.mkdir()
    write(root, filled(driver()))
    commit(root)
    monkeypatch.chdir(root)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return root


def test_the_formats_say_who_is_affected(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, {"driver.py": driver("0.1")["driver.py"]})
    assert main(["diff", "HEAD"]) == 0
    said = "rate changed: /raw: 20 Hz → 10 Hz; demo/driver.py; driver.py:6; 2 nodes are affected: /sink, /filter"
    assert said in capsys.readouterr().out
    assert main(["diff", "HEAD", "--format", "json"]) == 0
    (change,) = json.loads(capsys.readouterr().out)["changes"]
    assert (change["what"], change["before"], change["after"]) == ("rate", "20 Hz", "10 Hz")
    assert main(["diff", "HEAD", "--format", "markdown"]) == 0
    assert "| 2 nodes are affected&#58; /sink, /filter |" in capsys.readouterr().out


def test_a_condition_needs_the_option(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, {"driver.py": driver(body=CONDITION)["driver.py"]})
    assert main(["diff", "HEAD"]) == 0
    assert "rate" not in capsys.readouterr().out
    assert main(["diff", "HEAD", "--rates"]) == 0
    assert "20 Hz → 0 to 20 Hz" in capsys.readouterr().out
