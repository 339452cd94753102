# SPDX-License-Identifier: Apache-2.0
"""The pictures: what is drawn, that nothing lies on anything else, and that boxes are around what they hold."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import pytest
from page_kit import HOSTILE, checked, configuration, end, given, node

from haros_ci.html_page.changed import changed
from haros_ci.html_page.elements import MOST_ELEMENTS, ancestors, elements, switch_of
from haros_ci.html_page.layout import Layout, Rectangle, laid_out
from haros_ci.html_page.pool import Pool
from haros_ci.model.architecture import Configuration
from haros_ci.model.changes import ADDED, Changes, Edge
from haros_ci.report.channels import channels


def overlap(one: Rectangle, other: Rectangle) -> bool:
    return (
        one[0] < other[0] + other[2]
        and other[0] < one[0] + one[2]
        and one[1] < other[1] + other[3]
        and other[1] < one[1] + one[3]
    )


def drawn(one: Configuration) -> Layout:
    layout = laid_out(elements(one))
    assert layout is not None
    return layout


def fleet(robots: int) -> Configuration:
    """Robots that are alike, each in its namespace, all with one station."""
    nodes = [node("/station", *(end("subscribers", f"/r{n}/pose") for n in range(robots)))]
    for n in range(robots):
        nodes += [node(f"/r{n}/drive", end("publishers", f"/r{n}/pose"), end("subscribers", f"/r{n}/cmd")), node(f"/r{n}/plan", end("publishers", f"/r{n}/cmd"), end("publishers", "/tf"), *(end("publishers", f"/r{n}/own{k}") for k in range(12)))]  # fmt: skip
    return Configuration(name="fleet", launch=("a/b",), nodes=tuple(nodes))


SYSTEMS = {
    "small": configuration(),
    "fleet": fleet(9),
    "none": Configuration(name="x"),
    "one": Configuration(name="x", nodes=(node("/a"),)),
}
SYSTEMS |= {f"hostile {n}": configuration(word) for n, word in enumerate(HOSTILE)}


@pytest.mark.parametrize("name", SYSTEMS)
def test_no_two_elements_overlap(name: str) -> None:
    layout = drawn(SYSTEMS[name])
    assert not [pair for pair in combinations([*layout.nodes, *layout.channels], 2) if overlap(*pair)]
    assert all(
        x >= 0 and y >= 0 and x + w <= layout.size[0] and y + h <= layout.size[1]
        for x, y, w, h in (*layout.nodes, *layout.channels, *layout.boxes)
    )


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_box_is_around_its_own_and_no_others(name: str) -> None:
    made = elements(SYSTEMS[name])
    layout = laid_out(made)
    assert layout is not None
    shown = [(each.box, place) for each, place in zip(made.channels, layout.channels, strict=True) if not each.switch]
    for box, place in enumerate(layout.boxes):
        for inner, what in [*zip(made.box_of, layout.nodes, strict=True), *shown]:
            inside = box in ancestors(made.boxes, inner)
            assert overlap(place, what) == inside
            assert not inside or (place[0] <= what[0] and what[0] + what[2] <= place[0] + place[2])


def test_boxes_are_containers_and_namespaces() -> None:
    made = elements(configuration())
    assert {(box.kind, box.name) for box in made.boxes} == {("container", "/box/container"), ("namespace", "/arm")}
    at = {one.name: made.boxes[box].name if box >= 0 else "" for one, box in zip(made.nodes, made.box_of, strict=True)}
    assert at == {
        "/arm/driver": "/arm",
        "/arm/watch": "/arm",
        "/box/container": "/box/container",
        "/box/filter": "/box/container",
        "/camera": "",
        "/odd": "",
    }
    inside = {each.channel.name: made.boxes[each.box].name for each in made.channels if each.box >= 0}
    assert inside["/arm/state"] == inside["/arm/stop"] == "/arm" and "/box/found" not in inside


def test_what_one_node_has_alone_stands_in_it_where_there_is_much() -> None:
    made = elements(fleet(9))
    plan = next(n for n, one in enumerate(made.nodes) if one.name == "/r0/plan")
    assert [each.name for each in made.own[plan]] == sorted(f"/r0/own{k}" for k in range(12))
    assert not [each for each in made.channels if "own" in each.channel.name]


def test_a_name_that_is_not_known_meets_no_other() -> None:
    made = elements(configuration())
    assert [each.name for each in made.own[[one.name for one in made.nodes].index("/odd")]] == ["/box/?"]


@pytest.mark.parametrize(
    ("name", "switch"),
    [("/rosout", "rosout"), ("/robot/tf", "tf"), ("/tf_static", "tf"), ("/clock", "clock"), ("/a/get_parameters", "parameter services"), ("/a/change_state", "life cycle services"),
     ("/image", ""), ("/tf2", ""), ("/clock/now", ""), ("/my_rosout", "")],
)  # fmt: skip
def test_switches(name: str, switch: str) -> None:
    (channel,) = channels(Configuration(name="x", nodes=(node("/a", end("publishers", name)),)))
    assert switch_of(channel) == switch


def test_what_is_too_large_is_not_drawn() -> None:
    many = tuple(node(f"/n{n}") for n in range(MOST_ELEMENTS + 1))
    assert laid_out(elements(Configuration(name="x", nodes=many))) is None
    data = checked(given(configurations=(Configuration(name="x", nodes=many),)))
    assert data["configurations"][0]["picture"] == -1


def test_arrows_go_as_data_does() -> None:
    one = configuration()
    made = elements(one)
    layout = drawn(one)
    said = {(made.nodes[n].name, made.channels[c].channel.name, gives) for n, c, gives, _ in layout.edges}
    assert {
        ("/camera", "/image", True),
        ("/box/filter", "/image", False),
        ("/arm/watch", "/arm/stop", True),
        ("/arm/driver", "/arm/stop", False),
        ("/arm/watch", "/go", True),
        ("/odd", "/go", False),
    } <= said


def test_an_edge_leads_from_one_end_to_the_other() -> None:
    one = fleet(3)
    made, layout = elements(one), drawn(one)
    for number, channel, gives, points in layout.edges:
        if made.channels[channel].switch:
            assert points == ()
            continue
        first, last = (layout.nodes[number], layout.channels[channel])[:: 1 if gives else -1]
        for (x, y), (left, top, width, height) in (((points[0], points[1]), first), ((points[-2], points[-1]), last)):
            assert left - 2 <= x <= left + width + 2 and top - 2 <= y <= top + height + 2


def test_order_of_nodes_does_not_matter() -> None:
    one = configuration()
    assert one.dependence is not None
    other = replace(one, nodes=one.nodes[::-1], dependence=replace(one.dependence, nodes=one.dependence.nodes[::-1]))
    assert checked(given(configurations=(other,))) == checked(given(configurations=(one,)))


def test_names_in_the_picture_of_a_change_have_room_for_their_sign() -> None:
    """The page writes ``+ /name`` with 6.5 px for a character, 28 px less than the element is wide."""
    name = "/kb_teleop/cmd_vel"
    edge = Edge(node="/husky_alpha/twist_mux", channel=name, kind="topic", is_giver=False, state=ADDED)
    pool = Pool()
    picture = changed(pool, Changes(changes=(), edges=(edge,)))["picture"]
    texts = pool.document()["texts"]
    [(_, channel, _, _, width, _)], [(node, _, _, _, wide, _)] = picture["channels"], picture["nodes"]
    assert texts[channel] == name and (width - 28) / 6.5 >= len(f"+ {name}")
    assert texts[node] == edge.node and (wide * 1.12 - 14) / 6.5 >= len(edge.node)
