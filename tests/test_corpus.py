# SPDX-License-Identifier: Apache-2.0
"""The bench of the corpus: its list, what is drawn of it, a run over checkouts, the score of a sheet, and fixes."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from bench.corpus import draw, fixes, repositories, run, score

CATKIN = "<package><buildtool_depend>catkin</buildtool_depend></package>"
AMENT = "<package><export><build_type>ament_python</build_type></export></package>"


def commit(place: Path, files: Mapping[str, str], message: str = "one") -> Path:
    """A git repository at *place* with one more commit, in which *files* are written; its git directory."""
    for path, text in files.items():
        (place / path).parent.mkdir(parents=True, exist_ok=True)
        (place / path).write_text(text, "utf-8")
    who = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"]
    for arguments in (["init", "-q"], ["add", "-A", "-f"], [*who, "commit", "-q", "-m", message]):
        subprocess.run(["git", "-C", str(place), *arguments], check=True)
    return place / ".git"


# The list


@pytest.mark.parametrize(
    ("manifests", "version"),
    [
        ([CATKIN], "1"),
        ([AMENT], "2"),
        (["<buildtool_depend>ament_cmake</buildtool_depend>"], "2"),
        (["<build_depend>roscpp</build_depend>"], "1"),
        (['<buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>' + AMENT], "1+2"),
        ([AMENT] * 9 + [CATKIN], "2"),
        ([AMENT, CATKIN], "1+2"),
        (["<depend>eigen</depend>"], ""),
        ([], ""),
    ],
)
def test_for_which_ros_a_repository_is(manifests: list[str], version: str) -> None:
    assert repositories.ros_version(manifests) == version


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ({"README": "x"}, "no package.xml"),
        ({"a/package.xml": CATKIN, "a/CMakeLists.txt": ""}, "neither source nor launch file"),
        ({"package.xml": "<package/>", "a.py": ""}, "no manifest says for which ROS it is"),
    ],
)
def test_what_is_not_listed(files: dict[str, str], reason: str, tmp_path: Path) -> None:
    assert repositories.described(commit(tmp_path, files)) == reason


def test_what_is_too_large_is_not_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = commit(tmp_path, {"package.xml": CATKIN, "a.py": "x = 1\n"})
    assert not isinstance(repositories.described(place), str)
    monkeypatch.setattr(repositories, "LARGEST", 10)
    assert repositories.described(place) == "0 MB"


def test_a_list_is_made_of_clones(tmp_path: Path) -> None:
    for number in range(6):
        commit(tmp_path / f"Owner+r{number}", {"p/package.xml": AMENT, "p/a.launch.py": "", "q/package.xml": AMENT})
    candidates = {f"Owner/r{number}": "drivers" for number in range(6)} | {"other/gone": "tools", "other/odd": "what"}
    found, left = repositories.listed(tmp_path, candidates)
    assert [entry["name"] for entry in found] == ["Owner/r0", "Owner/r1", "Owner/r2", "Owner/r3"]
    assert all(entry["ros"] == "2" and entry["packages"] == 2 for entry in found)
    assert left == [
        "Owner/r4: 4 of owner are listed",
        "Owner/r5: 4 of owner are listed",
        "other/gone: not cloned",
        "other/odd: no such kind: what",
    ]
    assert yaml.safe_load(repositories.rendered(found)) == found


def test_the_corpus() -> None:
    entries = repositories.entries_of()
    assert len(entries) >= 120
    assert len({entry["name"].lower() for entry in entries}) == len(entries)
    assert all(re.fullmatch("[0-9a-f]{40}", entry["commit"]) for entry in entries)
    assert {entry["kind"] for entry in entries} == set(repositories.KINDS)
    assert max(Counter(entry["name"].split("/")[0].lower() for entry in entries).values()) <= repositories.PER_OWNER
    two = sum("2" in entry["ros"] for entry in entries)
    assert 0.4 <= two / len(entries) <= 0.6


def test_rounds_are_of_the_corpus() -> None:
    names = {entry["name"] for entry in repositories.entries_of()}
    assert draw.earlier() and draw.earlier() <= names


def test_a_checkout_has_an_empty_file_where_the_clone_has_no_content(tmp_path: Path) -> None:
    place = commit(tmp_path / "clone", {"package.xml": AMENT, "meshes/arm.stl": "solid", "a.py": "x = 1\n"})
    blob = repositories.git(place, "rev-parse", "HEAD:meshes/arm.stl").strip()
    (place / "objects" / blob[:2] / blob[2:]).unlink()
    head = repositories.git(place, "rev-parse", "HEAD").strip()
    checkout = tmp_path / "checkout"
    assert repositories.check_out(place, head, checkout) == 1
    assert (checkout / "a.py").read_text() == "x = 1\n"
    assert (checkout / "meshes/arm.stl").read_bytes() == b""
    listed = subprocess.run(["git", "-C", str(checkout), "ls-files"], check=True, capture_output=True, text=True)
    assert listed.stdout.split() == ["a.py", "meshes/arm.stl", "package.xml"]


# The draw

NAMES = ["acme/arm_driver", "acme/simple", "b/Lidar2", "c/rover"]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("see acme/arm_driver", {"acme/arm_driver"}),
        ("https://github.com/Acme/Arm_Driver.", {"acme/arm_driver"}),
        ("arm_driver at 29abd0e", {"acme/arm_driver"}),
        ("| lidar2 | 3 |", {"b/Lidar2"}),
        ("acme/simple", {"acme/simple"}),
        ("a simple rover", set()),
        ("arm_drivers and my_arm_driver", set()),
        ("", set()),
    ],
)
def test_what_a_document_names(text: str, found: set[str]) -> None:
    assert draw.named(NAMES, [text]) == found


def test_documents_are_the_projects_and_not_the_corpus(tmp_path: Path) -> None:
    for path in (
        "docs/a.md",
        "tests/bench/history.yaml",
        "tests/bench/corpus/repositories.yaml",
        "CHANGELOG.md",
        "src/a.md",
    ):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(path)
    assert sorted(draw.documents(tmp_path)) == ["CHANGELOG.md", "docs/a.md", "tests/bench/history.yaml"]


def test_a_draw_leaves_out_and_is_the_same_again() -> None:
    names = [f"o/r{number}" for number in range(30)]
    left = {"o/r3", "o/r4"}
    drawn = draw.repositories(names, left, 17, 20)
    assert len(set(drawn)) == 20 and not left & set(drawn)
    assert drawn == draw.repositories(reversed(names), left, 17, 20)
    assert drawn != draw.repositories(names, left, 18, 20)
    with pytest.raises(ValueError, match="28 repositories are left, not 29"):
        draw.repositories(names, left, 17, 29)


def result(rule: str, level: str = "warning", tool: str = "haros-ci", **more: Any) -> dict[str, Any]:
    shown = {"path": "a.py", "line": 2, "message": f"says {rule}", "open": True, "related": []}
    return {"tool": tool, "rule": rule, "level": level} | shown | more


REPORTS = {
    "b/two": {"results": [result(f"w{number}") for number in range(20)]},
    "a/one": {
        "results": [
            *(result(f"e{number}", "error") for number in range(5)),
            result("known", "error", open=False),
            result("hint", "note"),
            *(result(f"x{number}", "error", "cppcheck") for number in range(20)),
            result("y", "note", "pylint"),
        ]
    },
}


def test_all_errors_and_samples_of_the_rest_are_drawn() -> None:
    rows = draw.findings(REPORTS, 17, {"own error": None, "own warning": 7, "linter": 9})
    assert Counter(row["group"] for row in rows) == {"own error": 5, "own warning": 7, "linter": 9}
    assert [row["rule"] for row in rows[:5]] == ["e0", "e1", "e2", "e3", "e4"]
    assert all(row["verdict"] == row["reason"] == "" for row in rows)
    assert rows == draw.findings(
        dict(reversed(REPORTS.items())), 17, {"own error": None, "own warning": 7, "linter": 9}
    )
    more = draw.findings(REPORTS, 17, {"own warning": 100, "linter": 100})
    assert Counter(row["group"] for row in more) == {"own error": 5, "own warning": 20, "linter": 21}


def test_of_each_rule_as_many_are_drawn_and_few_of_one_repository() -> None:
    many = {
        "a/one": {"results": [result("often") for _ in range(30)] + [result("seldom") for _ in range(3)]},
        "b/two": {"results": [result("often") for _ in range(3)] + [result("often", "note")]},
        "c/three": {"results": [result("often", "error"), result("alone", tool="pylint")]},
        "d/four": {"results": [result("alone", tool="pylint") for _ in range(12)]},
    }
    rows = draw.of_rules(many, 20, least=10, each=8, most=2)
    counts = Counter((row["rule"], row["repository"]) for row in rows)
    assert counts["often", "a/one"] + counts["often", "b/two"] == 7 and counts["often", "b/two"] >= 2
    assert counts["often", "c/three"] == counts["alone", "c/three"] == 1
    assert counts["alone", "d/four"] == 7 and len(rows) == 16
    assert rows == draw.of_rules(dict(reversed(many.items())), 20, least=10, each=8, most=2)
    assert "seldom" not in {row["rule"] for row in rows}


@pytest.mark.parametrize(
    ("path", "line", "shown"),
    [
        ("a.py", 1, ["1: one", "2: two", "3: three", "4: four"]),
        ("a.py", 5, ["2: two", "3: three", "4: four", "5: five"]),
        ("a.py", None, []),
        (None, None, []),
        ("gone.py", 1, []),
        ("../secret", 1, []),
        ("link", 1, []),
    ],
)
def test_a_frame_is_of_the_checkout(path: str | None, line: int | None, shown: list[str], tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret\n")
    root = tmp_path / "root"
    root.mkdir()
    (root / "link").symlink_to(tmp_path / "secret")
    (root / "a.py").write_text("one\ntwo\nthree\nfour\nfive\n")
    assert draw.frame(root, path, line) == shown


def test_a_sheet_is_a_line_a_finding(tmp_path: Path) -> None:
    for name, report in REPORTS.items():
        (tmp_path / (name.replace("/", "+") + ".json")).write_text(json.dumps(report))
    (tmp_path / "a+one").mkdir()
    (tmp_path / "a+one/a.py").write_text("x = 1\ny = 2\n")
    round_ = {"seed": 3, "repositories": sorted(REPORTS)}
    text = draw.sheet(round_, tmp_path, tmp_path, {"own warning": 1, "linter": 0})
    rows = score.rows_of(text)
    assert len(rows) == 6
    assert rows[0]["frame"] == ["1: x = 1", "2: y = 2"] and rows[5]["frame"] == []


# The run

PACKAGE = {
    "package.xml": "<package format='3'><name>p</name><version>0.0.1</version><description>d</description>"
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license>"
    "<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(p)\nfind_package(ament_cmake REQUIRED)\nament_package()\n",
    "launch/a.launch.py": "import launch\n\n\ndef generate_launch_description(:\n",
    # imported by a run that puts the workspace in front
    "yaml.py": "raise SystemExit(99)\n",
}


def test_checkouts_are_run_once_and_in_turn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: Any
) -> None:
    commit(tmp_path / "in/acme+p", PACKAGE)
    given = [
        "run.py",
        str(tmp_path / "in"),
        str(tmp_path / "out"),
        "--option=--profile=architecture",
        "--option=--jobs=1",
    ]
    monkeypatch.setattr(sys, "argv", given)
    assert run.main() == 0
    rows = run.rows_of(tmp_path / "out/runs.jsonl")
    assert [(row["name"], row["code"], row["packages"], row["report"]) for row in rows] == [("acme+p", 1, 1, True)]
    assert rows[0]["findings"]["warning haros-ci directory-not-installed"] == 1
    assert "| acme/p | 1 |" in capsys.readouterr().out
    assert run.main() == 0
    assert run.rows_of(tmp_path / "out/runs.jsonl") == rows


def test_what_takes_too_long_is_ended() -> None:
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"], start_new_session=True)
    assert run.ended(child, time.monotonic() - 1)[0] is None


def test_an_exit_code_is_that_of_the_run() -> None:
    child = subprocess.Popen([sys.executable, "-c", "raise SystemExit(3)"], start_new_session=True)
    assert run.ended(child, time.monotonic() + 600)[0] == 3


def report(*results: dict[str, Any], notifications: tuple[dict[str, Any], ...] = ()) -> dict[str, Any]:
    coverage = {"packages": 1, "files": 2, "lines": 500, "targets": None}
    runs = [{"tool": "cppcheck", "successful": False}, {"tool": "pylint", "successful": True}]
    return {"results": list(results), "coverage": coverage, "runs": runs, "notifications": list(notifications)}


def test_a_row_has_what_the_report_says(tmp_path: Path) -> None:
    file = tmp_path / "r.json"
    notes = (
        {"level": "error", "message": "internal error: KeyError", "tool": "haros-ci", "path": None},
        {"level": "warning", "message": "not read", "tool": "cppcheck", "path": "a.cpp"},
        {"level": "warning", "message": "not read either", "tool": "cppcheck", "path": "a.cpp"},
    )
    found = (result("a", "error"), result("a", "error"), result("b", open=False), result("c", "note", "pylint"))
    file.write_text(json.dumps(report(*found, notifications=notes)))
    row = run.read(file, "fine\nTraceback (most recent call last):\n")
    assert row["findings"] == {"error haros-ci a": 2, "note pylint c": 1}
    assert row["trouble"] == ["Traceback (most recent call last):", "internal error: KeyError"]
    assert (row["failed"], row["gave up"], row["lines"], row["report"]) == (["cppcheck"], 1, 500, True)


@pytest.mark.parametrize("text", [None, "", '{"results": ['])
def test_a_row_without_a_report_says_so(text: str | None, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / "r.json").write_text(text)
    row = run.read(tmp_path / "r.json", "")
    assert not row["report"] and row["trouble"] == []


def test_tables_show_trouble_and_count_rules() -> None:
    good = {
        "name": "a+b",
        "code": 1,
        "seconds": 2.0,
        "cpu": 1.0,
        "packages": 1,
        "lines": 1000,
        "trouble": [],
        "report": True,
    }
    good |= {"findings": {"error haros-ci x": 2, "warning cppcheck y": 1}, "failed": []}
    bad = good | {"name": "c+d", "code": None, "seconds": 300.0, "report": False, "findings": {}, "lines": 0}
    text = run.tables([good, bad])
    assert "| a/b | 1 | 2.0 | 1.0 | 1 | 1000 | 2 | 0 | 0 | 1 | 0 | 3.00 |" in text
    assert "2 repositories, 1000 lines, 3 findings, 3.00 per 1000 lines" in text
    assert "- c+d: exit None, failed none: no report" in text and "- a+b: exit" not in text
    assert text.index("- c+d: 300.0 s") < text.index("- a+b: 2.0 s")
    assert "| error haros-ci x | 2 | 1 | 2.000 |" in text


# The score


def judged(verdict: str, rule: str = "r", group: str = "own error", **more: Any) -> dict[str, Any]:
    row = draw._row(group, "a/b", result(rule)) | {"verdict": verdict, "reason": "because" if verdict else ""}
    return row | {"frame": ["1: secret code"]} | more


def test_precision_is_of_what_is_judged() -> None:
    rows = [judged("true"), judged("true"), judged("unwelcome"), judged("false"), judged("")]
    text = score.scored([*rows, judged("", "s", "linter")])
    assert "| own error | 2 | 1 | 1 | 1 | 50 % |" in text
    assert "| linter | 0 | 0 | 0 | 1 | – |" in text
    assert "| haros-ci r | 2 | 1 | 1 | 1 | 50 % |" in text
    assert "- haros-ci r, 2\n  - a/b:a.py:2: unwelcome: because\n  - a/b:a.py:2: false: because" in text


@pytest.mark.parametrize(
    ("row", "error"),
    [
        (judged("True"), "line 1: 'True' is no verdict"),
        (judged("maybe"), "line 1: 'maybe' is no verdict"),
        (judged("false", reason=" "), "line 1: a verdict without a reason"),
    ],
)
def test_a_sheet_that_is_filled_in_wrongly_is_refused(row: dict[str, Any], error: str) -> None:
    with pytest.raises(ValueError, match=re.escape(error)):
        score.rows_of(json.dumps(row) + "\n")


def test_density_is_of_the_repositories_of_the_sheet() -> None:
    runs = [
        {"name": "a+b", "lines": 2000, "findings": {"error haros-ci x": 3}},
        {"name": "c+d", "lines": 10, "findings": {"error haros-ci x": 30}},
    ]
    assert score.density(runs, {"a/b"}) == "1 repositories, 3 findings, 2000 lines: 1.50 per 1000 lines"
    assert score.density(runs, {"e/f"}) == "0 repositories, 0 findings, 0 lines: no lines"


def test_facts_have_no_code(tmp_path: Path, monkeypatch: Any, capsys: pytest.CaptureFixture[str]) -> None:
    sheet, facts = tmp_path / "sheet.jsonl", tmp_path / "facts.jsonl"
    sheet.write_text(json.dumps(judged("true")) + "\n\n")
    monkeypatch.setattr(sys, "argv", ["score.py", str(sheet), "--facts", str(facts)])
    assert score.main() == 0
    assert "| own error | 1 | 0 | 0 | 0 | 100 % |" in capsys.readouterr().out
    assert "secret" not in facts.read_text()
    assert score.rows_of(facts.read_text())[0]["reason"] == "because"


# The fixes


@pytest.mark.parametrize(
    ("message", "fits"),
    [
        ("Fix the remapping", True),
        ("launch: add missing include", True),
        ("TYPO in package.xml", True),
        ("Update a.py\n\nThis fixes #12", True),
        ("forgot to install the config", True),
        ("corrected topic name", True),
        ("doesn't work with two robots", True),
        ("add a fixture", False),
        ("publish fixed_frame", False),
        ("new prefix for the suffix", False),
        ("debug output", False),
        ("", False),
    ],
)
def test_which_message_is_of_a_fix(message: str, fits: bool) -> None:
    assert bool(fixes.WORDS.search(message)) == fits


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("p/launch/a.launch", "launch"),
        ("p/launch/sim/a.xml", "launch"),
        ("p/bringup_launch.py", "launch"),
        ("p/a.launch.yaml", "launch"),
        ("package.xml", "manifest"),
        ("p/CMakeLists.txt", "cmake"),
        ("p/setup.cfg", "setup"),
        ("p/config/a.yaml", "parameters"),
        ("p/arm_params/left/a.yml", "parameters"),
        ("p/msg/A.msg", "interface"),
        ("p/urdf/a.urdf.xacro", "description"),
        ("p/launcher/a.py", None),
        ("p/my_package.xml", None),
        (".github/workflows/ci.yaml", None),
        ("config.yaml", None),
        ("p/setup.sh", None),
    ],
)
def test_a_kind_is_known_by_a_path(path: str, kind: str | None) -> None:
    assert [name for name, pattern in fixes.KINDS.items() if pattern.search(path)] == ([kind] if kind else [])


@pytest.mark.parametrize(
    ("line", "call"),
    [
        ('pub = nh.advertise<std_msgs::Bool>("a", 1);', True),
        ('self.create_publisher(Bool, "a", 1)', True),
        ('node->declare_parameter<int>("a", 1);', True),
        ('pnh.param("a", a_, 1);', True),
        ('rospy.Subscriber("a", Bool, call)', True),
        ('rospy.get_param("~a")', True),
        ("publisher.publish(message)", False),
        ("def param(x):", False),
        ("// we subscribe to all", False),
        ("create_timer(1.0, tick)", False),
    ],
)
def test_a_call_names_a_topic_service_or_parameter(line: str, call: bool) -> None:
    assert bool(fixes.CALLS.search(line)) == call


def test_candidates_are_small_fixes_of_what_ros_reads(tmp_path: Path) -> None:
    commit(tmp_path, {"p/package.xml": CATKIN, "p/a.py": "x = 1\n", "p/a.launch": "<launch/>"}, "fix: all of it")
    commit(tmp_path, {"p/a.launch": "<launch></launch>"}, "Fix launch file")
    commit(tmp_path, {"p/a.launch": "<launch/>"}, "port launch file")
    commit(tmp_path, {"p/a.py": "x = 2\n"}, "fix x")
    commit(tmp_path, {"p/a.py": 'x = rospy.get_param("x")\n', "p/package.xml": AMENT}, "wrong x")
    commit(tmp_path, {f"p/{number}.launch": "" for number in range(fixes.FILES + 1)}, "fix many")
    place = commit(
        tmp_path, {f"p/{number}.msg": "" for number in range(fixes.FILES)}, "add missing messages\n\nall of them"
    )
    tip = repositories.git(place, "rev-parse", "HEAD").strip()
    found = fixes.candidates(place, "o/p", tip)
    assert [(entry["subject"], entry["kinds"]) for entry in found] == [
        ("add missing messages", ["interface"]),
        ("wrong x", ["manifest", "code"]),
        ("Fix launch file", ["launch"]),
    ]
    assert found[0]["commit"] == tip and found[0]["parent"] == repositories.git(place, "rev-parse", "HEAD~").strip()
    assert found[1]["files"] == ["p/a.py", "p/package.xml"]


def test_a_merge_is_no_candidate_and_a_fix_applied_twice_is_one(tmp_path: Path) -> None:
    place = commit(tmp_path, {"a.launch": "<launch/>"})
    run_git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@example.org"]
    subprocess.run([*run_git, "checkout", "-q", "-b", "other"], check=True)
    commit(tmp_path, {"b.launch": ""}, "fix b")
    subprocess.run([*run_git, "checkout", "-q", "-b", "third", "HEAD~"], check=True)
    commit(tmp_path, {"c.launch": ""}, "more")
    subprocess.run([*run_git, "cherry-pick", "other"], check=True, capture_output=True)
    subprocess.run([*run_git, "merge", "-q", "other", "-m", "fix merge"], check=True, capture_output=True)
    found = fixes.candidates(place, "o/p", "HEAD")
    assert [entry["subject"] for entry in found] == ["fix b"]


def test_a_draw_of_fixes_is_the_same_again_and_takes_few_of_one_repository() -> None:
    pool = [
        {"repository": f"o/r{of}", "commit": f"{of}-{number}", "kinds": ["launch"]}
        for of in range(5)
        for number in range(10)
    ]
    forked = [*pool, pool[0] | {"repository": "x/fork"}]
    taken = fixes.drawn(pool, 1, 12)
    assert taken == fixes.drawn(reversed(forked), 1, 12) != fixes.drawn(pool, 2, 12)
    assert max(Counter(entry["repository"] for entry in taken).values()) <= fixes.PER_REPOSITORY
    with pytest.raises(ValueError, match="15 fixes can be drawn, not 16"):
        fixes.drawn(pool, 1, 16)
    assert fixes.counted(pool, ["not read: o/z"]).splitlines()[:2] == [
        "50 candidates of 5 repositories; one may be of several kinds",
        "launch: 50",
    ]
