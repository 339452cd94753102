# SPDX-License-Identifier: Apache-2.0
"""Interfaces as README tables: stable, escaped, made anew in their place, and read back without a difference."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from interface_samples import BASE, LANE, PACKAGES, PATH, RATE, SYSTEM, end
from test_model_json import HOSTILE

from haros_ci.commands.interface_files import put
from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture, Configuration, Qos, Unknown
from haros_ci.report import model_interface_table
from haros_ci.report.node_interface import Entry, qos_text
from haros_ci.report.readme_compare import compare, known
from haros_ci.report.readme_tables import rows

LANE_TABLES = """<!-- haros-ci:interface -->

### `lane_node`

#### Publishers

| Name | Type | QoS | Description |
| --- | --- | --- | --- |
| `/tf` | `tf2_msgs/msg/TFMessage` | depth 100 | |
| `echo` | `std_msgs/msg/Empty` | keep_all | |
| `~/debug/?` | `std_msgs/msg/String` | | |
| `~/output/path` | `nav_msgs/msg/Path` | depth 1, reliable, transient_local, deadline 0.5 s | |

#### Subscribers

| Name | Type | QoS | Description |
| --- | --- | --- | --- |
| `/vehicle/status` | `lane_msgs/msg/Status` | depth ?, reliability ? | |
| `echo` | `std_msgs/msg/Empty` | depth 5 | |
| `hint` | `?` | ? | |
| `odom` | `nav_msgs/msg/Odometry` | depth 10 | |

#### Services

| Name | Type | Description |
| --- | --- | --- |
| `~/reset` | `std_srvs/srv/Trigger` | |

#### Service clients

| Name | Type | Description |
| --- | --- | --- |
| `ask` | `std_srvs/srv/SetBool` | |

#### Action servers

| Name | Type | Description |
| --- | --- | --- |
| `~/go` | `nav2_msgs/action/Wait` | |

#### Parameters

| Name | Type | Default | Description |
| --- | --- | --- | --- |
| `limits` | `double[]` | `[1.0, 2.5]` | |
| `map.frame` | `str` | `"map"` | |
| `rate` | `double` | `10.0` | |
| `width` | `double` | | |

<!-- /haros-ci:interface -->
"""


def test_the_tables_of_a_package() -> None:
    assert model_interface_table.render(SYSTEM, "lane") == LANE_TABLES


def test_ros_1_has_queues_and_all_packages_have_headings() -> None:
    text = model_interface_table.render(SYSTEM)
    assert [line for line in text.splitlines() if line.startswith("## ")] == ["## `base`", "## `lane`"]
    assert (
        "| Name | Type | Queue | Description |\n| --- | --- | --- | --- |\n"
        "| `odom` | `nav_msgs/Odometry` | 50, latched | |" in text
    )
    assert "| `~/cmd` | `geometry_msgs/Twist` | ? | |" in text
    assert "| `robot` | `str` | | |\n| `~/rate` | `int` | `10` | |" in text


def test_what_is_read_back_has_no_difference() -> None:
    for package in PACKAGES:
        documented = rows(model_interface_table.render(SYSTEM, package.name))
        facts = known(model_interface_table.interfaces(SYSTEM), SYSTEM)[package.name]
        assert len(documented) == {"lane": 15, "base": 5}[package.name]
        assert list(compare("README.md", documented, facts)) == []


def test_nothing_and_no_endpoints() -> None:
    empty = "<!-- haros-ci:interface -->\n\nNo node was found.\n\n<!-- /haros-ci:interface -->\n"
    assert model_interface_table.render(Architecture()) == empty

    def said(node: object) -> str:
        found = Architecture(configurations=(Configuration(name="a", nodes=(node,)),), packages=PACKAGES)  # type: ignore[arg-type]
        return model_interface_table.render(found, "lane").splitlines()[4]

    assert said(replace(LANE, endpoints=())) == "No endpoints."
    assert said(replace(LANE, kind="library")) == "A class: this is what it brings into the node of whoever uses it."
    assert said(replace(LANE, unknowns=(Unknown("endpoints", "x"),))) == "There may be more than what stands here."


@pytest.mark.parametrize(
    ("qos", "text"),
    [
        (None, "?"),
        (Qos(), ""),
        (Qos(history="?"), "history ?"),
        (Qos(history="keep_last", depth=3, durability="?"), "depth 3, durability ?"),
        (Qos(lifespan="?", lease=1.5, liveliness="manual_by_topic"), "lifespan ?, lease 1.5 s, manual_by_topic"),
        (Qos(liveliness="automatic"), ""),
    ],
)
def test_qos(qos: Qos | None, text: str) -> None:
    assert qos_text(Entry("publishers", "x", "a/msg/B", (replace(PATH, qos=qos),)), 2) == text


def test_values_that_differ_stand_side_by_side() -> None:
    entry = Entry("parameters", "rate", "double", (RATE, replace(RATE, value=2.5), replace(RATE, value=None)))
    assert model_interface_table.defaults(entry) == ("10.0", "2.5")
    vague = replace(RATE, value=None, unknowns=(Unknown("value", "x"),))
    assert model_interface_table.defaults(Entry("parameters", "rate", "double", (vague,))) == ("?",)


@pytest.mark.parametrize(
    "name", [HOSTILE, "a|b", "`` ` ``", "x\n| y", "@team", "<!-- /haros-ci:interface -->", "![i](http://a)"]
)
def test_hostile_names_stay_in_their_cell(name: str) -> None:
    node = replace(LANE, type=f"{name}x", endpoints=(end("parameters", f"/planning/lane:{name}", name, value=name),))
    found = Architecture(configurations=(Configuration(name="a", nodes=(node,)),), packages=PACKAGES)
    text = model_interface_table.render(found, "lane")
    lines = text.splitlines()
    assert text.count("<!--") == 2 and len(lines) == 11 and len([line for line in lines if line.startswith("| ")]) == 3
    assert lines[8].count("|") == 5 and "](" not in text


def readme(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode())
    return path


def test_a_readme_is_refreshed_in_place_and_keeps_descriptions(tmp_path: Path) -> None:
    old = LANE_TABLES.replace("| depth 10 | |", "| depth 7 | Where *we* are, \\| or were. |").replace(
        "`rate`", "`speed`"
    )
    path = readme(tmp_path / "src" / "lane" / "README.md", f"# Lane\n\n{old}\nMore.\n")
    put(SYSTEM, "readme", path, tmp_path)
    wanted = LANE_TABLES.replace("| depth 10 | |", "| depth 10 | Where *we* are, \\| or were. |")
    assert path.read_text() == f"# Lane\n\n{wanted}\nMore.\n"
    put(SYSTEM, "readme", path, tmp_path)
    assert path.read_text() == f"# Lane\n\n{wanted}\nMore.\n"


def test_line_ends_stay_as_they_are(tmp_path: Path) -> None:
    path = readme(
        tmp_path / "src/lane/README.md", "a\r\n<!-- haros-ci:interface --><!-- /haros-ci:interface -->\r\nb\r\n"
    )
    put(SYSTEM, "readme", path, tmp_path)
    assert path.read_bytes() == b"a\r\n" + LANE_TABLES.replace("\n", "\r\n").encode() + b"b\r\n"


@pytest.mark.parametrize(
    "text", ["# Lane\n", "<!-- haros-ci:interface -->\n", "<!-- /haros-ci:interface --><!-- haros-ci:interface -->"]
)
def test_a_readme_without_a_place_is_not_touched(tmp_path: Path, text: str) -> None:
    path = readme(tmp_path / "README.md", text)
    with pytest.raises(UserError, match="has no place for the tables"):
        put(SYSTEM, "readme", path, tmp_path)
    assert path.read_text() == text


@pytest.mark.parametrize(("format", "suffix"), [("nodl", ".nodl.xml"), ("readme", ".md")])
def test_a_directory_gets_a_file_for_each_package(tmp_path: Path, format: str, suffix: str) -> None:
    put(SYSTEM, format, tmp_path, tmp_path / "elsewhere")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"base{suffix}", f"lane{suffix}"]
    assert (
        "lane_node" in (tmp_path / f"lane{suffix}").read_text()
        and "base_node" in (tmp_path / f"base{suffix}").read_text()
    )


def test_a_file_outside_any_package_gets_all_and_one_inside_gets_its_own(tmp_path: Path) -> None:
    put(SYSTEM, "nodl", tmp_path / "all.nodl.xml", tmp_path)
    put(SYSTEM, "nodl", tmp_path / "src" / "base" / "base.nodl.xml", tmp_path)
    assert "lane_node" in (tmp_path / "all.nodl.xml").read_text()
    assert "lane_node" not in (tmp_path / "src" / "base" / "base.nodl.xml").read_text()


def test_no_file_is_written_outside_the_directory(tmp_path: Path) -> None:
    found = Architecture(
        configurations=(Configuration(name="a", nodes=(replace(BASE, package="../out"),)),),
        packages=(replace(PACKAGES[1], name="../out"),),
    )
    (tmp_path / "in").mkdir()
    with pytest.raises(UserError, match="cannot be the name of a file"):
        put(found, "nodl", tmp_path / "in", tmp_path)
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["in"]


def test_a_name_that_is_not_known_at_all_has_no_row() -> None:
    blank = end("publishers", "/planning/lane/?", "a/msg/B", unknowns=(Unknown("name", "x"),))
    part = end("publishers", "/planning/lane/?/b", "a/msg/B", unknowns=(Unknown("name", "x"),))
    found = Architecture(
        configurations=(Configuration(name="a", nodes=(replace(LANE, endpoints=(blank, part)),)),), packages=PACKAGES
    )
    text = model_interface_table.render(found, "lane")
    assert "There may be more than what stands here." in text
    assert [line for line in text.splitlines() if line.startswith("| `")] == ["| `~/?/b` | `a/msg/B` | ? | |"]
