# SPDX-License-Identifier: Apache-2.0
"""``--fix`` mends what is open, once, and nothing else of the file; ``--diff`` says the same and writes nothing."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from haros_ci.cli import main
from haros_ci.commands.fixing import FixPlan, Mended, patch, plan, write
from haros_ci.model.location import Location
from haros_ci.results.fix import Edit, Fix
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

MANIFEST = (
    '<?xml version="1.0"?>\n<package format="3">\n  <name>demo</name><version>1.0.0</version><description>d</description>\n'
    '  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>\n'
    "  <buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend><exec_depend>launch_ros</exec_depend>\n"
    "  <export><build_type>ament_cmake</build_type></export>\n</package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\n"
    "add_executable(talker talker.cpp)\ntarget_link_libraries(talker rclcpp::rclcpp)\n"
    "install(TARGETS talker DESTINATION lib/demo)\ninstall(DIRECTORY launch DESTINATION share/demo)\nament_package()\n"
)
TALKER = (
    "#include <rclcpp/rclcpp.hpp>\nint main(int argc, char ** argv)\n{\n  rclcpp::init(argc, argv);\n"
    '  rclcpp::spin(std::make_shared<rclcpp::Node>("talker"));\n}\n'
)
LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([  # kept: é\n"
    "        Node(package='demo',   executable='talker', node_name='talker'),\n    ])\n"
)
RULE = "deprecated-launch-keyword"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "launch").mkdir()
    for path, text in {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "talker.cpp": TALKER,
        "launch/a.launch.py": LAUNCH,
    }.items():
        (tmp_path / path).write_bytes(text.encode())
    monkeypatch.chdir(tmp_path)
    return tmp_path / "launch" / "a.launch.py"


def check(*flags: str) -> int:
    return main(["check", ".", "--no-cache", "--isolated", "--profile", "architecture", "--select", RULE, *flags])


def test_it_is_mended_and_then_clean(here: Path) -> None:
    assert check("--fix") == 0
    assert here.read_text() == LAUNCH.replace("node_name=", "name=")
    assert check("--fix") == 0
    assert here.read_text() == LAUNCH.replace("node_name=", "name=")


def test_a_patch_says_the_same(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = here.read_bytes()
    assert check("--diff") == 1
    said = capfd.readouterr().out
    assert here.read_bytes() == before
    subprocess.run(["git", "apply", "-"], input=said.encode(), check=True, cwd=here.parent.parent)
    assert here.read_text() == LAUNCH.replace("node_name=", "name=")
    assert check("--diff") == 0
    assert capfd.readouterr().out == ""


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"], ids=["plain", "with a mark"])
def test_ends_of_lines_and_a_mark_are_kept(here: Path, mark: bytes) -> None:
    old = mark + LAUNCH.replace("\n", "\r\n").encode()
    here.write_bytes(old)
    assert check("--fix") == 0
    assert here.read_bytes() == old.replace(b"node_name=", b"name=")


def test_sarif_says_it_too(here: Path) -> None:
    assert check("--output", "sarif=out.sarif", "--output", "json=out.json") == 1
    runs = json.loads(Path("out.sarif").read_text())["runs"]
    (result,) = [each for run in runs for each in run["results"]]
    ((change,),) = [fix["artifactChanges"] for fix in result["fixes"]]
    assert change["artifactLocation"]["uri"] == "launch/a.launch.py"
    (replacement,) = change["replacements"]
    line = LAUNCH.split("\n")[6]
    column = line.index("node_name") + 1
    region = {"startLine": 7, "startColumn": column, "endLine": 7, "endColumn": column + len("node_name")}
    assert replacement == {"deletedRegion": region, "insertedContent": {"text": "name"}}
    (finding,) = json.loads(Path("out.json").read_text())["results"]
    assert finding["fixes"][0]["edits"][0]["text"] == "name"


@pytest.mark.parametrize(
    "old",
    [
        LAUNCH.replace(
            "        Node(", "        # haros:ignore-next-line deprecated-launch-keyword\n        Node("
        ).encode(),
        LAUNCH.replace("node_name='talker'", "**{'node_name': 'talker'}").encode(),
        LAUNCH.replace("node_name='talker'", "name='a', node_name='talker'").encode(),
        LAUNCH.encode("latin-1"),
    ],
    ids=["suppressed", "unpacked", "both", "not UTF-8"],
)
def test_it_is_left_alone(here: Path, old: bytes) -> None:
    here.write_bytes(old)
    check("--fix")
    assert here.read_bytes() == old


def test_what_is_known_is_left_alone(here: Path) -> None:
    flags = ["--no-cache", "--isolated", "--profile", "architecture", "--select", RULE]
    assert main(["baseline", "create", ".", *flags]) == 0
    assert check("--fix") == 0
    assert here.read_text() == LAUNCH


def result(*edits: Edit) -> Result:
    return Result("haros-ci", "x", Level.WARNING, "m", Location("a"), fixes=(Fix("do it", edits),))


def test_of_two_that_overlap_one_is_made() -> None:
    made = plan([result(Edit("a", (1, 1), (1, 3), "X")), result(Edit("a", (1, 2), (1, 4), "Y"))], lambda path: "abcd\n")
    assert [(file.path, file.after) for file in made.files] == [("a", "Xcd\n")]
    assert len(made.mended) == 1


def test_the_same_edit_twice_is_one() -> None:
    one = Edit("a", (1, 1), (1, 1), "X")
    made = plan([result(one), result(one), result()], lambda path: "abcd\n")
    assert made.files[0].after == "Xabcd\n"


def test_execute_bits(tmp_path: Path) -> None:
    script = tmp_path / "a"
    script.write_text("#!/bin/sh\n")
    script.chmod(0o640)
    made = plan([result(Edit.executable("a"))], lambda path: "#!/bin/sh\n")
    assert patch(made) == "diff --git a/a b/a\nold mode 100644\nnew mode 100755\n"
    assert write(tmp_path, made) == {}
    assert script.stat().st_mode & 0o777 == 0o750


def test_a_last_line_without_an_end() -> None:
    said = patch(FixPlan((Mended("a", "one", "two"),)))
    assert said.splitlines()[-4:] == ["-one", "\\ No newline at end of file", "+two", "\\ No newline at end of file"]


def test_what_is_not_ours_is_not_written(tmp_path: Path) -> None:
    root, outside = tmp_path / "root", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    (outside / "a").write_text("old")
    (root / "link").symlink_to(outside / "a")
    (root / "directory").symlink_to(outside)
    (root / "changed").write_text("new")
    (root / "shorter").write_text("a long text")
    made = FixPlan(
        tuple(Mended(path, "old", "bad") for path in ("link", "directory/a", "changed", "gone"))
        + (Mended("shorter", "a long text", "short"),)
    )
    assert sorted(write(root, made)) == ["changed", "directory/a", "gone", "link"]
    assert (outside / "a").read_text() == "old"
    assert (root / "changed").read_text() == "new"
    assert (root / "shorter").read_text() == "short"
