# SPDX-License-Identifier: Apache-2.0
"""Interface tables in READMEs: which are read and as what, and the many that are not about interfaces."""

from __future__ import annotations

import pytest

from haros_ci.report.readme_tables import TableRow, is_ros_type, kinds_of, plain, rows, split_names

TOPICS = ("publishers", "subscribers")
ACTIONS = ("action_servers", "action_clients")


def table(header: str, *body: str, above: str = "") -> str:
    columns = header.count("|") - 1
    return "\n".join([above, "", header, "|" + " --- |" * columns, *body, ""])


def said(text: str) -> list[tuple[tuple[str, ...], tuple[str, ...], str | None, str | None, int]]:
    return [(row.kinds, row.names, row.type, row.default, row.line) for row in rows(text)]


def test_a_page() -> None:
    page = """# autoware_lane

## Inputs / Outputs

### Input

| Name                 | Type                      | Description |
| -------------------- | :------------------------ | ----------- |
| `~/input/odometry`   | `nav_msgs::msg::Odometry` | pose \\| speed |
| ~input/twist         | geometry_msgs/Twist       |

### Output

|Name|Type|
|:-:|:-:|
|`~/output/path`, `~/output/markers`|nav_msgs/msg/Path|

## Parameters

| Name | Unit | Type | Description | Default value |
| ---- | ---- | ---- | ----------- | ------------- |
| `rate` | [Hz] | double | how often | 10.0 |
"""
    assert said(page) == [
        (("subscribers",), ("~/input/odometry",), "nav_msgs::msg::Odometry", None, 9),
        (("subscribers",), ("~/input/twist",), "geometry_msgs/Twist", None, 10),
        (("publishers",), ("~/output/path",), "nav_msgs/msg/Path", None, 16),
        (("publishers",), ("~/output/markers",), "nav_msgs/msg/Path", None, 16),
        (("parameters",), ("rate",), "double", "10.0", 22),
    ]
    first = rows(page)[0]
    assert (first.table, first.headings) == (7, ("autoware_lane", "Inputs / Outputs", "Input"))
    assert first.description == "pose | speed"


@pytest.mark.parametrize(
    ("heading", "kinds"),
    [
        ("Input", ("subscribers",)),
        ("Inputs", ("subscribers",)),
        ("**Input topics**", ("subscribers",)),
        ("Subscribed Topics", ("subscribers",)),
        ("Subscriptions", ("subscribers",)),
        ("Subscribers", ("subscribers",)),
        ("Output", ("publishers",)),
        ("Published topics", ("publishers",)),
        ("Publications", ("publishers",)),
        ("Publishers", ("publishers",)),
        ("Inputs / Outputs", TOPICS),
        ("Topics", TOPICS),
        ("Services", ("servers",)),
        ("Service clients", ("clients",)),
        ("Clients", ("clients",)),
        ("Action servers", ("action_servers",)),
        ("Action clients", ("action_clients",)),
        ("Actions", ACTIONS),
        ("Node Parameters", ("parameters",)),
        ("params", ("parameters",)),
        ("Input/Parameters", (*TOPICS, "parameters")),
        ("Purpose", ()),
        ("Inner-workings / Algorithms", ()),
        ("Interaction", ()),
        ("Publicity", ()),
    ],
)
def test_headings(heading: str, kinds: tuple[str, ...]) -> None:
    assert kinds_of(heading) == kinds


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            table("| Topic | Type |", "| plan | nav_msgs/msg/Path |", above="# Server\n\n## ROS Interfaces"),
            (TOPICS, ("plan",), "nav_msgs/msg/Path", None, 7),
        ),
        (
            table("| Input topic name | Type |", "| a/b | pkg/T |"),
            (("subscribers",), ("a/b",), "pkg/T", None, 5),
        ),
        (
            table("| Parameter | Definition |", "| `k_phi` | a ratio |"),
            (("parameters",), ("k_phi",), None, None, 5),
        ),
        (
            table("| SimpleDock Parameter | Description | Type | Default |", '| a.b | x | string | "" |'),
            (("parameters",), ("a.b",), "string", '""', 5),
        ),
        (
            table(
                "| Name | Type |", "| jerk_weight | double |", above="# x\n\n## Parameters\n\n### Weights\n\n#### L2"
            ),
            (("parameters",), ("jerk_weight",), "double", None, 11),
        ),
        (
            table("| Name | Type |", "| ~/scan | `sensor_msgs/LaserScan` |", above="## Node\n\n- Input"),
            (("subscribers",), ("~/scan",), "sensor_msgs/LaserScan", None, 7),
        ),
        (
            table("| Interface | Local Name | Global Name | Description |", "| Client | - | /api/start | x |"),
            (("clients",), ("/api/start",), None, None, 5),
        ),
        (
            table("| Interface | Local Name | Global Name | Description |", "| Subscription | ~/a | /b | x |"),
            (("subscribers",), ("~/a", "/b"), None, None, 5),
        ),
        (
            table("| Name | Type |", "| ~/pose | Pose |", above="## Output"),
            (("publishers",), ("~/pose",), "Pose", None, 5),
        ),
        (
            table("| Name | Type |", "| ~/a/&lt;name&gt; | a/B or a/C |", above="## Output"),
            (("publishers",), ("~/a/<name>",), "a/B or a/C", None, 5),
        ),
        (
            "## Input\n<table>\n<tr><th>Name</th><th>Type</th></tr>\n<tr>\n"
            "<td><code>~/a</code></td><td>p/T</td></tr></table>\n",
            (("subscribers",), ("~/a",), "p/T", None, 4),
        ),
        (
            "## Input\r\n\r\n| Name | Type |\r\n| --- | --- |\r\n| ~/a | p/T |\r\n",
            (("subscribers",), ("~/a",), "p/T", None, 5),
        ),
        (
            table("| Name | Type |", "| [`~/a`](http://x) | [p/msg/T](y.md) |", above="## Input"),
            (("subscribers",), ("~/a",), "p/msg/T", None, 5),
        ),
    ],
)
def test_real_ways_of_writing(text: str, expected: object) -> None:
    assert said(text) == [expected]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "| Name | Type |\n| ~/a | p/T |\n",
        table("| Name | Type |", "| ~/a | p/T |"),
        table("| Name | Type |", "| ~/a | p/T |", above="# input\n\n## Purpose"),
        table("| Name | Type |", "| path | std::vector<Point> |", above="## Input"),
        table("| Name | Type |", "| speed | double |", above="## Output"),
        table("| Name | Description |", "| path | what it makes |", above="## Output"),
        table("| Name | Type |", "| header | std_msgs/Header |", above="## Parameters"),
        table("| Name | Type |", "| a | p/T |", above="## Output\n\n### Message format"),
        table("| Name | Type |", "| ~/a | p/T |", above="## Output\n\n### `x_msgs::msg::Path`"),
        table("| Name | Type |", "| ~/a | p/T |", above="## Output\n\n### Example"),
        table("| Action | Button |", "| `start` | A |"),
        table("| I/O | Name | Type |", "| in | ~/a | p/T |", above="## Input"),
        table("| Parameter | Value |", "| `a` | 1 |"),
        table("| Name | Type |", "| two words | double |", above="## Parameters"),
        table("| Name | Type |", "| - | - |", above="## Parameters"),
        table("| Name | Type |", "| | |", above="## Parameters"),
        "```\n" + table("| Name | Type |", "| ~/a | p/T |", above="## Input") + "```\n",
        "~~~md\n" + table("| Name | Type |", "| ~/a | p/T |", above="## Input") + "```\n",
        "<!-- Example:\n" + table("| Name | Type |", "| ~/a | p/T |", above="## Input") + "-->\n",
        "## Input\n<table>\n<tr><td><img src='a.svg'></td></tr>\n</table>\n",
        "## Input\n<table",
    ],
)
def test_what_is_no_interface_table(text: str) -> None:
    assert rows(text) == ()


@pytest.mark.parametrize(
    ("cell", "names"),
    [
        ("`~/a`", ("~/a",)),
        ("~a", ("~/a",)),
        ("`a`, `b`", ("a", "b")),
        ("a / b", ("a", "b")),
        ("a/b", ("a/b",)),
        ("a<br>b", ("a", "b")),
        ("`a` (optional)", ("a",)),
        ("a and b", ("a", "b")),
        ("", ()),
    ],
)
def test_names(cell: str, names: tuple[str, ...]) -> None:
    assert split_names(cell) == names


def test_plain() -> None:
    assert plain("**`a\\_b`** [c](http://d) <br/> &lt;e&gt;") == "a_b c <e>"
    assert plain("<code>&#126;/x</code>") == "~/x"


@pytest.mark.parametrize("text", ["a/B", "a/msg/B", "a::msg::B", "a/B or a/C", "`a/B`".strip("`"), "a::B"])
def test_ros_types(text: str) -> None:
    assert is_ros_type(text)


@pytest.mark.parametrize("text", ["", "B", "double", "std::string", "vector<a/B>", "a/b", "a/B/C"])
def test_other_types(text: str) -> None:
    assert not is_ros_type(text)


@pytest.mark.parametrize(
    "text",
    [
        "<!--" * 50_000,
        "|" * 100_000 + "\n" + "|-" * 50_000 + "\n",
        "## Input\n" + "<table>" * 20_000,
        "## Input\n| Name | Type |\n|---|---|\n| " + "[" * 100_000 + " | " + "`" * 99_999 + " |\n",
        "#" * 100_000,
        "# " + "a " * 100_000,
        "## Parameters\n| Name | Type |\n|---|---|\n" + "| a | b |\n" * 10_000,
        "|a|\n|" + ":" * 100_000 + "|\n",
        "## Input\n<table>" + "<td>" * 30_000 + "</table>",
        "\x00\ud800|\n|-|\n",
    ],
    ids=range(10),
)
def test_hostile_pages_end_and_raise_nothing(text: str) -> None:
    assert isinstance(rows(text), tuple)


def test_a_row_is_a_value() -> None:
    assert TableRow(("servers",), ("a",), None, None, 1, 1) == TableRow(("servers",), ("a",), None, None, 1, 1)
