# SPDX-License-Identifier: Apache-2.0
"""A launch file that no launch can read is a finding, at its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import Settings
from haros_ci.pipeline import analyse
from haros_ci.results.rule import Level
from haros_ci.workspace.cache import MemoryCache

MANIFEST = """<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>Apache-2.0</license>
<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>
"""


def found(root: Path, name: str, text: str, ros: int = 2) -> list[tuple[str, int | None]]:
    place = root / "launch" / name
    place.parent.mkdir(parents=True)
    place.write_text(text, encoding="utf-8")
    (root / "package.xml").write_text(
        MANIFEST if ros == 2 else MANIFEST.replace("ament_cmake", "catkin"), encoding="utf-8"
    )
    report, _ = analyse(Settings(root=root, profile="architecture"), MemoryCache())
    return [(r.location.path, r.location.line) for r in report.results if r.rule == "malformed-launch-file"]


@pytest.mark.parametrize("name", ["a.launch", "a.launch.xml"])
@pytest.mark.parametrize(
    "text", ["<launch>\n  <node>\n</launch>\n", '<launch>\n\n<arg name="a" default="a & b"/></launch>\n']
)
def test_fires(name: str, text: str, tmp_path: Path) -> None:
    assert found(tmp_path, name, text) == [(f"launch/{name}", 3)]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.launch", "<launch/>\n"),
        ("a.launch.xml", '<launch><arg name="a" default="a &amp; b"/></launch>\n'),
        ("a.launch", "<!-- nothing yet -->\n<launch>\n</launch>\n"),
        ("a.launch.yaml", "launch: []\n"),
        ("a.launch.py", "def generate_launch_description():\n    return 1\n"),
        ("helper.py", "def generate_launch_description(:\n"),
        ("template/a.launch.py", "{% for x in y %}\n"),
        (
            "a.launch",
            '<launch><node pkg="p" exec="e" name="n" if="$(var x)" respawn="true" output="screen"/></launch>\n',
        ),
        (
            "a.launch",
            '<launch><arg name="a"/><let name="b" value="$(var a)"/><group><push_ros_namespace namespace="n"/></group></launch>',
        ),
        ("a.launch", '<launch><node pkg="p" type="t" name="n" bogus="1"/></launch>\n'),
        ("a.launch", '<launch><arg name="a"/><node pkg="p" exec="$(arg a)" nmae="n"/></launch>\n'),
        ("a.launch", '<launch><rosparam file="$(find p)/a.yaml"/></launch>\n'),
        ("a.launch.yaml", "launch:\n- node: {pkg: p, exec: e, name: n}\n"),
        ("a.launch", ""),
        ("template/a.launch", "<launch>\n  [NODES]<arg [NAME]/>\n</launch>\n"),
        ("a.launch", "launch:\n  - arg: {name: a}\n"),
    ],
)
def test_stays_quiet(name: str, text: str, tmp_path: Path) -> None:
    assert found(tmp_path, name, text) == []


def test_a_file_of_ros_2_in_a_package_of_ros_1(tmp_path: Path) -> None:
    text = '<launch><arg name="a"/><node pkg="p" exec="e" name="n"><param name="x" value="$(var a)"/></node></launch>\n'
    assert found(tmp_path / "two", "detect.ros2.launch", text, ros=1) == []
    assert found(tmp_path / "one", "detect.launch", '<launch>\n<node pkg="p" name="n" ns="x"/></launch>\n', ros=1) != []
    assert found(tmp_path / "even", "detect.launch", '<launch>\n<node pkg="p" name="n"/></launch>\n', ros=1) != []


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.launch.py", "def generate_launch_description(:\n", 1),
        ("arm_launch.py", "import launch\n\nprint 'a'\n", 3),
        ("a.launch", '<launch>\n<node pkg="p" exec="e" typ="x"/>\n</launch>\n', 2),
        ("a.launch.xml", '<launch>\n<node pkg="p" name="x"/>\n</launch>\n', 2),
        ("a.launch.xml", "<launch>\n<nod/>\n</launch>\n", 2),
        ("a.launch.xml", '<launch>\n<let name="b" value="$(var a"/>\n</launch>\n', 2),
        ("a.launch.yaml", "launch:\n- node: {pkg: p, exec: e, nmae: n}\n", 2),
        ("a.launch.yaml", "launch:\n- node: {pkg: p\n", 3),
    ],
)
def test_what_ros2_launch_refuses(name: str, text: str, line: int, tmp_path: Path) -> None:
    assert found(tmp_path, name, text) == [(f"launch/{name}", line)]


@pytest.mark.parametrize(
    "text",
    [
        "a = [f'/model/{'blimp'}/servo_{i}' for i in range(5)]\n",
        'a = f"{"-".join(["a"])}"\n',
        "def first[T](values: list[T]) -> T:\n    return values[0]\n",
    ],
)
def test_what_a_newer_python_reads(text: str, tmp_path: Path) -> None:
    """Python 3.12 (Jazzy) takes quotes in f-strings, and parameters of types; an older one that runs haros-ci does not."""
    assert found(tmp_path, "a.launch.py", text) == []


@pytest.mark.parametrize(
    ("tag", "code", "expected"),
    [
        ("<nod/>", "", [Level.ERROR]),
        ("<set_remaps/>", "", [Level.ERROR]),
        ('<param name="a" value="1"/>', "", [Level.ERROR]),
        ("<blink_lights/>", "", [Level.WARNING]),
        ('<group><trajectory-server rate="2"/></group>', "", [Level.WARNING]),
        ("<blink_lights/>", "@expose_action('other')\nclass Other(Action):\n    pass\n", [Level.WARNING]),
        ("<blink_lights/>", "@expose_action('blink_lights')\nclass Blink(Action):\n    pass\n", []),
    ],
)
def test_a_tag_that_an_extension_of_launch_may_have(tag: str, code: str, expected: list[Level], tmp_path: Path) -> None:
    (tmp_path / "demo").mkdir()
    (tmp_path / "demo" / "actions.py").write_text(code, encoding="utf-8")
    found(tmp_path, "a.launch.xml", f"<launch>\n{tag}\n</launch>\n")
    report, _ = analyse(Settings(root=tmp_path, profile="architecture"), MemoryCache())
    assert [r.level for r in report.results if r.rule == "malformed-launch-file"] == expected


@pytest.mark.parametrize(
    ("manifest", "cmake", "expected"),
    [
        ("<test_depend>catch_ros2</test_depend>", "", []),
        ("<exec_depend>ros_gz_sim</exec_depend>", "", []),
        ("<exec_depend>firm_launch_tags</exec_depend>", "", []),
        ("", "find_package(\n  catch_ros2 REQUIRED)\n", []),
        ("", "# find_package(catch_ros2 REQUIRED)\nfind_package(Eigen3)\n", [Level.WARNING]),
        ("<depend>rclcpp</depend><depend>std_msgs</depend><depend>eigen</depend>", "", [Level.WARNING]),
        ("<exec_depend>launch_ros</exec_depend><exec_depend>ros2launch</exec_depend>", "", [Level.WARNING]),
        ("<exec_depend>python3-numpy</exec_depend>", "", [Level.WARNING]),
    ],
)
def test_a_tag_that_a_declared_package_may_have(
    manifest: str, cmake: str, expected: list[Level], tmp_path: Path
) -> None:
    found(tmp_path, "a.launch.xml", "<launch>\n<blink_lights/>\n</launch>\n")
    (tmp_path / "package.xml").write_text(MANIFEST.replace("<export>", f"{manifest}<export>"), encoding="utf-8")
    (tmp_path / "CMakeLists.txt").write_text(cmake, encoding="utf-8")
    report, _ = analyse(Settings(root=tmp_path, profile="architecture"), MemoryCache())
    assert [r.level for r in report.results if r.rule == "malformed-launch-file"] == expected


NODE = '<node pkg="p" type="t" name="n"/>'


@pytest.mark.parametrize(
    "tag",
    [
        '<node pkg="p" type="t"/>',
        '<node pkg="p" type="t" name="a/b"/>',
        '<node pkg="p" type="t" name="$(arg ns)/b"/>',
        "<include/>",
        '<group><param value="1"/></group>',
        '<node pkg="p" type="t" name="n"><remap from="a"/></node>',
        '<arg default="1"/>',
    ],
)
def test_what_roslaunch_refuses(tag: str, tmp_path: Path) -> None:
    assert found(tmp_path, "a.launch", f"<launch>\n{tag}\n</launch>\n", ros=1) == [("launch/a.launch", 2)]


@pytest.mark.parametrize(
    "tag",
    [
        NODE,
        '<node pkg="p" type="t" name="$(anon a)"/>',
        '<node pkg="p" type="t" name="$(arg a)_b" bogus="1"/>',
        '<node pkg="p" type="t" name="$(eval str(4/2))"/>',
        '<group if="$(arg a)"><node pkg="p" type="t"/></group>',
        '<node pkg="p" type="t" unless="$(arg a)"/>',
        "<bogus><node/></bogus>",
        '<rosparam param="a">1</rosparam>',
        '<test pkg="p" type="t" test-name="n"/>',
        '<!-- <node pkg="p"/> -->',
    ],
)
def test_what_roslaunch_takes_or_may_never_read(tag: str, tmp_path: Path) -> None:
    assert found(tmp_path, "a.launch", f'<launch>\n<arg name="a" default="1"/>\n{tag}\n</launch>\n', ros=1) == []


PARAMETER = '<launch>\n  <param name="a" value="b"/>\n</launch>\n'


@pytest.mark.parametrize(
    ("text", "others", "expected"),
    [
        (PARAMETER, 3, 0),  # foreign-launch-construct tells of the package
        (PARAMETER.replace("param name", "remap from").replace("value", "to"), 3, 0),
        (PARAMETER, 2, 1),
        (PARAMETER, 0, 1),
        (PARAMETER.replace("param", "parma"), 3, 1),
        (PARAMETER.replace("launch", "lunch"), 3, 0),
    ],
)
def test_parameters_of_ros_1_beside_others_of_it(text: str, others: int, expected: int, tmp_path: Path) -> None:
    (tmp_path / "old").mkdir()
    for number in range(others):
        old = f'<launch><include file="$(find p)/{number}.launch"/></launch>\n'
        (tmp_path / "old" / f"{number}.launch").write_text(old, encoding="utf-8")
    assert len(found(tmp_path, "a.launch.xml", text)) == expected
