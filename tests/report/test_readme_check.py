# SPDX-License-Identifier: Apache-2.0
"""``--check-readme``: what a README says wrongly is told, and whatever an unknown could explain is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from interface_samples import BARE, BASE, CPP, LANE, RATE, SYSTEM, VAGUE, end

from haros_ci.cli import main
from haros_ci.commands.readme_check import differences
from haros_ci.model.architecture import Architecture, Endpoint, Node, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.report.readme_names import fits, may_be, same_tail, spelt
from haros_ci.report.readme_values import default_differs, type_differs

ALL_BUT_VAGUE = tuple(item for item in LANE.endpoints if item not in (VAGUE,) and "?" not in item.name and item.type)
CLEAR = replace(LANE, endpoints=ALL_BUT_VAGUE)


class Pages:
    """A reader of pages in memory."""

    def __init__(self, pages: dict[str, str]) -> None:
        self._pages = pages

    def text(self, path: str) -> str:
        return self._pages.get(path, "")


def system(*nodes: Node) -> Architecture:
    robot, old = SYSTEM.configurations
    return replace(SYSTEM, configurations=(replace(robot, nodes=nodes), old))


def told(text: str, *nodes: Node, notes: bool = False, path: str = "src/lane/README.md") -> list[str]:
    found = system(*(nodes or (CLEAR,)))
    workspace = Workspace(Path("/nowhere"), found.packages, (), Pages({path: text}))
    every = differences(workspace, found)
    return [f"{d.line}: {d.level}: {d.message} [{d.rule}]" for d in every if notes or d.level != "note"]


def page(heading: str, *rows: str, columns: str = "| Name | Type | Description |") -> str:
    width = columns.count("|") - 1
    return "\n".join(["# lane", f"## {heading}", columns, "|" + "---|" * width, *rows, ""])


DEFAULTS = "| Name | Type | Default |"


def test_what_classes_of_libraries_bring() -> None:
    """It may be what a row means, but rows of nodes are not about it, nor is a node's description not complete for it."""
    topic = end("publishers", "/extra", "std_msgs/msg/Empty", 40)
    more = (Unknown("endpoints", "its methods"),)
    tool = replace(CLEAR, name="/?", kind="library", type="lane::Tool", endpoints=(topic,), unknowns=more)
    text = page(
        "Output", "| ~/output/path | nav_msgs/msg/Path | |", "| extra | std_msgs/msg/Bool | |", "| gone | a/msg/B | |"
    )
    assert [line.partition(",")[0] for line in told(text, CLEAR, tool)] == [
        "6: warning: publisher extra has type std_msgs/msg/Bool in the document",
        "7: warning: publisher gone is documented",
    ]
    text = page("Output", "| ~/output/path | nav_msgs/msg/Path | |")
    assert told(text, CLEAR, tool, notes=True) == told(text, CLEAR, notes=True)
    assert told(page("Output", "| gone | a/msg/B | |"), tool) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            page("Input", "| ~/input/gone | a_msgs/msg/B | |"),
            ["5: warning: subscriber ~/input/gone is documented, but is not in the code [readme-missing]"],
        ),
        (
            page("Input", "| ~/output/path | nav_msgs/msg/Path | |"),
            [
                "5: warning: subscriber ~/output/path is documented, but is not in the code; "
                f"it is a publisher there ({CPP}:10:3) [readme-missing]"
            ],
        ),
        (
            page("Output", "| /somewhere/else | nav_msgs/Path | |", "| ~/output/path | nav_msgs/Path | |"),
            ["5: warning: publisher /somewhere/else is documented, but is not in the code [readme-missing]"],
        ),
        (
            page("Services", "| ~/clear | std_srvs/srv/Trigger | |"),
            ["5: warning: service ~/clear is documented, but is not in the code [readme-missing]"],
        ),
        (
            page("Topics", "| nothing | std_msgs/String | |"),
            ["5: warning: publisher or subscriber nothing is documented, but is not in the code [readme-missing]"],
        ),
        (
            page("Parameters", "| rate | double | |", "| speed | double | |"),
            ["6: warning: parameter speed is documented, but is not in the code [readme-missing]"],
        ),
        (
            page("Output", "| ~/output/path | nav_msgs/msg/Odometry | |"),
            [
                "5: warning: publisher ~/output/path has type nav_msgs/msg/Odometry in the document, "
                f"but nav_msgs/msg/Path in the code ({CPP}:10:3) [readme-type]"
            ],
        ),
        (
            page("Parameters", "| rate | int | |"),
            [
                "5: warning: parameter rate has type int in the document, "
                f"but double in the code ({CPP}:20:3) [readme-type]"
            ],
        ),
        (
            page("Parameters", "| rate | double | 15.0 |", columns=DEFAULTS),
            [
                "5: warning: parameter rate has default 15.0 in the document, "
                f"but 10.0 in the code ({CPP}:20:3) [readme-default]"
            ],
        ),
        (
            page("Parameters", "| map.frame | string | `odom` |", columns=DEFAULTS),
            [
                "5: warning: parameter map.frame has default odom in the document, "
                f"but map in the code ({CPP}:21:3) [readme-default]"
            ],
        ),
        (
            page("Parameters", "| limits | list | [1.0, 3.0] |", columns=DEFAULTS),
            [
                "5: warning: parameter limits has default [1.0, 3.0] in the document, "
                f"but [1.0, 2.5] in the code ({CPP}:22:3) [readme-default]"
            ],
        ),
    ],
)
def test_what_is_wrong_is_told(text: str, expected: list[str]) -> None:
    assert told(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        page("Output", "| ~/output/path | nav_msgs::msg::Path | |"),
        page("Output", "| ~output/path | nav_msgs/Path | |"),
        page("Output", "| /planning/path | Path | |"),  # remapped
        page("Output", "| output/path | nav_msgs/Path or nav_msgs/Odometry | |"),
        page("Output", "| path | nav_msgs/Path | |"),
        page("Output", "| /any/where/lane/output/path | nav_msgs/Path | |"),
        page("Output", "| ~/output/&lt;what&gt; | nav_msgs/Path | |"),
        page("Output", "| ~/{a}/path | nav_msgs/Path | |"),
        page("Output", "| `/tf` | - | |"),
        page("Input", "| odom | nav_msgs/Odometry | |", "| /odom | nav_msgs/Odometry | |"),
        page("Inputs / Outputs", "| odom | nav_msgs/Odometry | |", "| ~/output/path | nav_msgs/Path | |"),
        page("Services", "| ~/reset | std_srvs/Trigger | |", "| ask | std_srvs/SetBool | |"),
        page("Actions", "| ~/go | nav2_msgs/action/Wait | |"),
        page(
            "Parameters", "| rate | float | |", "| map.frame | std::string | |", "| `limits` | vector&lt;double&gt; | |"
        ),
        page("Parameters", "| frame | string | |"),
        page("Parameters", "| rate | Hertz | |"),
        page("Parameters", "| plugin.gain | double | |", "| gain | double | |", "| use_sim | bool | |"),
        page("Parameters", "| rate | double | 10 |", "| width | double | 3.5 |", columns=DEFAULTS),
        page("Parameters", "| rate | double | 20.0 |", columns=DEFAULTS),  # what a launch file sets
        page("Parameters", "| rate | double | see the file |", columns=DEFAULTS),
        page("Parameters", "| rate | double | N/A |", "| rate | double | `10.0` [Hz] |", columns=DEFAULTS),
        page("Parameters", '| map.frame | string | "map" |', "| limits | double[] | [1.0, 2.5] |", columns=DEFAULTS),
        page("Parameters", "| speed | double | |", "| mass | double | |"),  # not one is in the code
        page("Output", "| /somewhere/else | nav_msgs/Path | |"),  # perhaps ~/output/path, remapped elsewhere
        page("Algorithm", "| ~/input/gone | a_msgs/msg/B | |"),
    ],
)
def test_what_agrees_or_cannot_be_told_is_quiet(text: str) -> None:
    assert told(text) == []


def with_ends(*ends: Endpoint, **more: object) -> Node:
    return replace(CLEAR, endpoints=(*CLEAR.endpoints, *ends), **more)  # type: ignore[arg-type]


GONE = page("Output", "| ~/debug/gone | std_msgs/String | |")


@pytest.mark.parametrize(
    "node",
    [
        with_ends(VAGUE),
        with_ends(end("publishers", "/planning/lane/?", None)),
        with_ends(end("publishers", "?", "std_msgs/msg/String")),
        with_ends(end("publishers", "/?/gone", None)),
        with_ends(unknowns=(Unknown("endpoints", "a library"),)),
        replace(CLEAR, endpoints=()),
        replace(CLEAR, package="other"),
    ],
    ids=range(7),
)
def test_an_unknown_that_may_be_it_keeps_quiet(node: Node) -> None:
    assert told(GONE) and told(GONE, node) == []


@pytest.mark.parametrize(
    "node",
    [
        with_ends(end("publishers", "/planning/lane/?", "std_msgs/msg/Int32")),  # of another type
        with_ends(end("subscribers", "/planning/lane/?", None)),  # of another kind
        with_ends(end("publishers", "/planning/lane/?/info", None)),  # that ends otherwise
    ],
)
def test_an_unknown_that_cannot_be_it_does_not(node: Node) -> None:
    assert len(told(GONE, node)) == 1


def test_unknown_types_and_defaults_keep_quiet() -> None:
    untyped = with_ends(end("publishers", "/planning/lane/x", None), end("parameters", "/planning/lane:p", None))
    text = page("Output", "| ~/x | std_msgs/String | |") + page("Parameters", "| p | int | 5 |", columns=DEFAULTS)
    assert told(text, untyped) == []
    vague = replace(BARE, name="/planning/lane:p", original_name="/planning/lane:p", unknowns=(Unknown("value", "x"),))
    assert told(text, with_ends(end("publishers", "/planning/lane/x", None), replace(vague, type="int"))) == []


def test_of_several_nodes_one_that_agrees_is_enough() -> None:
    other = replace(CLEAR, name="/planning/right", endpoints=(replace(RATE, name="/planning/right:rate", value=15.0),))
    text = page("Parameters", "| rate | double | 15.0 |", columns=DEFAULTS)
    assert told(text) and told(text, CLEAR, other) == []


def test_code_without_a_default_gives_a_note_on_what_launch_files_set() -> None:
    text = page("Parameters", "| width | double | 1.0 |", columns=DEFAULTS)
    assert told(text) == []
    assert told(text, notes=True)[-1] == (
        "5: note: parameter width has default 1.0 in the document; "
        f"the code has none, launch files set 3.5 ({CPP}:23:3) "
        "[readme-default]"
    )


def test_what_is_not_documented_is_a_note_where_there_is_a_table_of_its_kind() -> None:
    assert told(page("Services", "| ~/reset | std_srvs/Trigger | |"), notes=True) == []
    assert told(page("Input", "| odom | nav_msgs/Odometry | |"), notes=True) == [
        "3: note: 2 subscribers of lane_node are in the code, but not documented: /vehicle/status, echo "
        "[readme-undocumented]"
    ]
    one = page("Input", "| odom | nav_msgs/Odometry | |", "| echo | std_msgs/Empty | |")
    assert told(one, notes=True) == [
        "3: note: subscriber /vehicle/status (lane_msgs/msg/Status) of lane_node is in the code, "
        f"but not documented ({CPP}:12:3) "
        "[readme-undocumented]",
    ]


def elsewhere(item: Endpoint) -> Endpoint:
    """The same, made in a file of the package ``base``."""
    return replace(item, location=Location("src/base/src/helper.cpp", 3))


def test_what_another_packages_code_makes_is_documented_there() -> None:
    others = replace(
        CLEAR,
        endpoints=tuple(elsewhere(item) if item.kind == "subscribers" else item for item in CLEAR.endpoints),
    )
    assert told(page("Input", "| odom | nav_msgs/Odometry | |"), others, notes=True) == []
    assert told(page("Input", "| odom | nav_msgs/Path | |"), others)  # what is documented is compared all the same


def with_parameters(*given: tuple[str, object]) -> Node:
    made = (end("parameters", f"/planning/lane:{name}", "double") for name, _ in given)
    known = (replace(item, value=value, location=RATE.location) for item, (_, value) in zip(made, given, strict=True))
    return replace(CLEAR, endpoints=(*CLEAR.endpoints, *known))


def test_a_row_for_a_group_of_parameters() -> None:
    node = with_parameters(("slow.car.speed", 1.0), ("slow.bus.speed", 2.0))
    for name in ("slow", "slow.car", ".car"):
        assert (
            told(page("Parameters", "| rate | double | |", f"| {name} | struct | 3.0 |", columns=DEFAULTS), node) == []
        )
    rows = page("Parameters", "| rate | double | |", "| fast | struct | |", "| slow.speed | | |")
    assert [line.split(":")[0] for line in told(rows, node)] == ["6", "7"]
    group = page("Parameters", "| rate | double | |", "| slow | struct | |")
    assert not any("slow" in line for line in told(group, node, notes=True))


def test_a_row_of_another_mode_with_its_own_default() -> None:
    one = page("Parameters", "| rate | double | 15.0 |", columns=DEFAULTS)
    assert told(one)
    assert told(one + page("Others", "| rate | double | 10.0 |", columns=DEFAULTS)) == told(
        one
    )  # no table of parameters
    assert told(one + page("Parameters of the other", "| rate | double | 10.0 |", columns=DEFAULTS)) == []


def test_defaults_of_launch_files_and_of_the_packages_own_parameter_files() -> None:
    text = page("Parameters", "| rate | double | 15.0 |", columns=DEFAULTS)
    assert told(text.replace("## Parameters", "## Launch file parameters")) == []
    found = system(CLEAR)
    config = SourceFile("src/lane/config/lane.param.yaml", "yaml", 1, "", "lane")
    for content, is_told in (
        ("/**:\n  ros__parameters:\n    rate: 15.0  # Hz\n", False),
        ('/**:\n  ros__parameters:\n    a.rate: "15.0"\n', False),
        ("/**:\n  ros__parameters:\n    rate: 10.0\n", True),
        ("/**:\n  ros__parameters:\n    rates: 15.0\n", True),
        ("rate: 15.0\n", True),
    ):
        pages = Pages({"src/lane/README.md": text, config.path: content})
        workspace = Workspace(Path("/nowhere"), found.packages, (config,), pages)
        assert any(item.rule == "readme-default" for item in differences(workspace, found)) is is_told, content


def test_what_a_plugin_has_by_its_hosts_code() -> None:
    """A host's code makes ``shared`` for the plug-in whose package documents it."""
    own = replace(RATE, name="/host:rate", original_name="/host:rate")
    shared = elsewhere(replace(RATE, name="/host:plugin.shared", original_name="/host:plugin.shared"))
    host = replace(CLEAR, package="base", name="/host", endpoints=(own, shared))
    script = replace(CLEAR, name="/script", type="script", endpoints=(replace(RATE, name="/script:other"),))
    text = page("Parameters", "| rate | double | |", "| shared | double | |", "| gone | double | |")
    assert [line.split(":")[0] for line in told(text, host, script)] == ["7"]


def test_a_plugin_in_another_packages_node_is_known_by_where_it_is_written() -> None:
    host = replace(CLEAR, package="host", name="/host")
    text = page("Parameters", "| rate | int | |", "| gone | int | |")
    assert [line.split(":")[0] for line in told(text, replace(host))] == ["5"]  # what else it may have is not known


def test_ros_1() -> None:
    base = "src/base/README.md"
    text = page("Published Topics", "| odom | nav_msgs/Odometry | |") + page(
        "Parameters", "| ~rate | int | |", "| robot | string | |"
    )
    assert told(text, path=base, notes=True) == []
    wrong = page("Subscribed Topics", "| ~cmd | geometry_msgs/TwistStamped | |", "| stop | std_msgs/Empty | |")
    assert told(wrong, path=base) == [
        "5: warning: subscriber ~/cmd has type geometry_msgs/TwistStamped in the document, "
        "but geometry_msgs/Twist in the code (src/base/src/base.cpp:1:3) [readme-type]",
        "6: warning: subscriber stop is documented, but is not in the code; "
        "it is a service there (src/base/src/base.cpp:1:3) [readme-missing]",
    ]
    assert BASE.ros == 1


def test_no_readme_another_file_and_files_not_to_report_on() -> None:
    assert told(GONE, path="src/lane/docs/README.md") == []
    found = system(CLEAR)
    workspace = Workspace(
        Path("/nowhere"), found.packages, (), Pages({"src/lane/README.md": GONE}), frozenset({"src/a.cpp"})
    )
    assert differences(workspace, found) == ()


@pytest.mark.parametrize(
    ("documented", "found", "exact", "tail"),
    [
        ("~/a", "~/a", True, True),
        ("~a", "~/a", True, True),
        ("a", "~/a", False, True),
        ("/x/a", "~/a", False, True),
        ("b/a", "~/c/a", False, False),
        ("<n>/a", "front/a", True, True),
        ("camera*/image", "camera0/image", True, True),
        ("image[0-7]", "image3", True, True),
        ("a", "b", False, False),
        ("", "a", False, False),
        ("*", "", False, False),
    ],
)
def test_names(documented: str, found: str, exact: bool, tail: bool) -> None:
    assert (fits(spelt(documented), found), same_tail(spelt(documented), found)) == (exact, tail)


@pytest.mark.parametrize(
    ("unknown", "documented", "may"),
    [
        ("~/?", "~/a", True),
        ("?", "/a/b", True),
        ("/a/?/c", "/a/b/c", True),
        ("~/a_?", "a_b", True),
        ("~/a_?", "b", False),
        ("/?/c", "~/x", False),
        ("~/?/c", "c", True),
        ("x_?_y", "x_1_z", False),
    ],
)
def test_what_an_unknown_name_may_be(unknown: str, documented: str, may: bool) -> None:
    assert may_be(unknown, documented) is may


@pytest.mark.parametrize(
    ("documented", "kind", "found", "differs"),
    [
        ("a/B", "publishers", "a/msg/B", False),
        ("a::msg::B", "publishers", "a/msg/B", False),
        ("c/B", "publishers", "a/msg/B", True),
        ("B", "publishers", "a/msg/B", False),
        ("a/B, a/C", "publishers", "a/msg/C", False),
        ("a/B", "publishers", None, None),
        ("a/B", "publishers", "a/msg/?", None),
        ("-", "publishers", "a/msg/B", None),
        ("TBD", "publishers", "a/msg/B", None),
        ("double", "parameters", "double", False),
        ("float", "parameters", "double", False),
        ("double", "parameters", "int", True),
        ("uint8_t", "parameters", "int", False),
        ("string", "parameters", "str", False),
        ("bool", "parameters", "str", True),
        ("number", "parameters", "int", False),
        ("number", "parameters", "bool", True),
        ("list of strings", "parameters", "str[]", False),
        ("vector<double>", "parameters", "double", True),
        ("[double]", "parameters", "double", None),
        ("<double>", "parameters", "int", None),
        ("double", "parameters", "yaml", None),
        ("enum", "parameters", "str", None),
    ],
)
def test_types(documented: str, kind: str, found: str | None, differs: bool | None) -> None:
    assert type_differs(documented, kind, found) is differs


@pytest.mark.parametrize(
    ("documented", "value", "differs"),
    [
        ("True", True, False),
        ("false", True, True),
        ("1", True, None),
        ("10", 10.0, False),
        ("10.0 [Hz]", 10.0, False),
        ("1.57", 1.5707963, False),
        ("1.5", 1.57, True),
        ("3", 4, True),
        ("1e-3", 0.001, False),
        ("M_PI / 2", 1.5707963, None),
        ("45 deg", 0.785, None),
        ("9" * 39, 1.0, True),
        ("1e999", 1.0, True),
        ('"map"', "map", False),
        ("'map'", "odom", True),
        ('" "', "", False),
        ("map", "odom", True),
        ("the map frame", "map", None),
        ("[1, 2]", (1.0, 2.0), False),
        ("[1, 2]", (1.0,), True),
        ("['a']", ["a"], False),
        ("[a]", ["a"], None),
        ("[" * 1500, [1], None),
        ("{}", {}, None),
        ("1", None, None),
    ],
)
def test_defaults(documented: str, value: object, differs: bool | None) -> None:
    assert default_differs(documented, value) is differs


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "src" / "lamp"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>lamp</name><version>1.0.0</version></package>")
    script = "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import Bool\nrospy.init_node('lamp')\n"
    (package / "lamp").write_text(
        f"{script}rospy.Publisher('light', Bool, queue_size=1)\nrate = rospy.get_param('~rate', 5)\n"
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def model(*options: str) -> int:
    return main(["model", "--no-cache", *options])


def test_the_command_fails_on_a_difference_only(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    readme = workspace / "src" / "lamp" / "README.md"
    assert (model("--check-readme"), capsys.readouterr().out) == (0, "")
    readme.write_text(page("Published topics", "| light | std_msgs/Bool | |"))
    assert (model("--check-readme"), capsys.readouterr().out) == (0, "")
    readme.write_text(page("Published topics", "| light | std_msgs/Empty | |"))
    assert model("--check-readme") == 1
    assert capsys.readouterr().out == (
        "src/lamp/README.md:5: warning: publisher light has type std_msgs/Empty in the document, "
        "but std_msgs/Bool in the code (src/lamp/lamp:5:1) [readme-type]\n"
    )
    readme.write_text(page("Published topics", "| lights | std_msgs/Bool | |"))
    assert model("--check-readme", "--output", "model.json", "--format", "json") == 1
    assert (workspace / "model.json").exists()


def test_the_command_writes_what_it_then_agrees_with(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    readme = workspace / "src" / "lamp" / "README.md"
    readme.write_text("# lamp\n\n<!-- haros-ci:interface -->\n<!-- /haros-ci:interface -->\n")
    assert model("--format", "readme", "--output", "src/lamp/README.md") == 0
    assert "| `~/rate` | `int` | `5` | |" in readme.read_text()
    assert (model("--check-readme"), capsys.readouterr().out) == (0, "")
    (workspace / "out").mkdir()
    assert model("--format", "nodl", "--output", "out") == 0
    assert [path.name for path in (workspace / "out").iterdir()] == ["lamp.nodl.xml"]


@pytest.mark.parametrize("format", ["text", "json", "dot", "mermaid", "sqlite"])
def test_other_formats_want_a_file(workspace: Path, format: str) -> None:
    assert model("--format", format, "--output", ".") == 2
