# SPDX-License-Identifier: Apache-2.0
"""The data of the page: what is in it, what is left out, and that it says so."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from page_kit import CODE, NAME, SOURCE, Texts, broadcasts, checked, configuration, given, report

from haros_ci.behaviour.declared import in_project
from haros_ci.html_page.findings import chosen, standing
from haros_ci.html_page.frames import Frames
from haros_ci.html_page.launches import launch_tree
from haros_ci.html_page.measured import bars
from haros_ci.html_page.package_picture import direct, package_picture
from haros_ci.html_page.pool import Pool, presence_text
from haros_ci.html_page.properties import Held, held, properties
from haros_ci.html_page.transforms import transforms
from haros_ci.model.cycles import in_circles
from haros_ci.model.location import Location
from haros_ci.model.presence import Choice
from haros_ci.results.result import BaselineState, Suppression
from haros_ci.results.rule import Level


def texts(data: dict[str, Any], indexes: list[int]) -> list[str]:
    return [data["tables"]["texts"][index] for index in indexes]


def test_findings_have_their_states() -> None:
    data = checked(given())
    assert sorted(row[3] for row in data["findings"]) == ["gone", "known", "open", "open", "open", "open", "open"]


@pytest.mark.parametrize(
    ("change", "state"),
    [
        ({"state": None}, "open"),
        ({"state": BaselineState.NEW}, "open"),
        ({"state": BaselineState.UNCHANGED}, "known"),
        ({"state": BaselineState.UPDATED}, "known"),
        ({"state": BaselineState.ABSENT}, "gone"),
        ({"suppressions": (Suppression("inSource", "why"),)}, "suppressed"),
    ],
)
def test_standing(change: dict[str, Any], state: str) -> None:
    assert standing(replace(report().results[0], **change)) == state


def test_of_too_many_findings_the_open_and_worst_are_kept() -> None:
    kept, left = chosen(report(results=10), 3)
    assert left == 11
    assert len(kept) == 3 and all(standing(one) == "open" for _, one in kept)
    assert Level.ERROR in [one.level for _, one in kept]
    assert chosen(report(results=1), 30)[1] == 0


def test_ids_of_findings_stay_when_others_come() -> None:
    few, many = ({row[0]: row[4] for row in checked(given(results=n))["findings"]} for n in (2, 5))
    assert few.keys() <= many.keys()


def test_frames_have_the_lines_around_once() -> None:
    frames = Frames(Texts(SOURCE).text)
    frames.keep([Location(CODE, 5), Location(CODE, 7), Location(CODE, 30), Location(CODE), Location("away.cpp", 3)])
    ((_, runs),) = frames.document(Pool())
    assert [(first, len(lines)) for first, lines in runs] == [(2, 9), (27, 7)]
    assert not frames.is_full


def test_frames_end_with_the_room() -> None:
    frames = Frames(Texts(SOURCE).text, most=60)
    frames.keep([Location(CODE, 5), Location(CODE, 30)])
    assert frames.is_full


def test_a_secret_is_masked_in_a_frame() -> None:
    frames = Frames(lambda path: 'password = "hunter22hunter"\n')
    frames.keep([Location("a.py", 1)])
    assert "hunter" not in str(frames.document(Pool()))


def test_the_tree_of_launch_files() -> None:
    pool = Pool()
    tree = launch_tree(pool, configuration())
    (outer, inner), (argument,) = tree["includes"], tree["declared"]
    words = pool.document()["texts"]
    assert words[outer[2]] == "base/launch/inner.launch.py" and outer[5] == -1
    assert inner[2] == -1 and inner[5] == 0
    assert words[argument[1]] == "robot" and [words[each] for each in argument[3]] == ["one", "two"]


def test_the_same_text_stands_once() -> None:
    words = checked(given())["tables"]["texts"]
    assert len(words) == len(set(words))


@pytest.mark.parametrize(
    ("presence", "text"),
    [
        ((), ""),
        ((Choice("sim", "true"),), "sim:=true"),
        ((Choice("a", "b", equal=False), Choice("c", "d")), "c:=d a≠b"),
    ],
)
def test_presence_in_words(presence: tuple[Choice, ...], text: str) -> None:
    assert presence_text(presence) == text


@pytest.mark.parametrize(
    ("needs", "circles"),
    [
        ({}, {}),
        ({"a": ["b"], "b": []}, {}),
        ({"a": ["b"], "b": ["a"]}, {"a": 0, "b": 0}),
        ({"a": ["b", "x"], "b": ["c"], "c": ["a"], "d": ["a"], "x": []}, {"a": 0, "b": 0, "c": 0}),
        ({"a": ["b"], "b": ["a"], "c": ["d"], "d": ["c", "a"]}, {"a": 0, "b": 0, "c": 1, "d": 1}),
    ],
)
def test_circles_of_packages(needs: dict[str, list[str]], circles: dict[str, int]) -> None:
    assert in_circles(needs) == circles


@pytest.mark.parametrize(
    ("needs", "name", "kept"),
    [
        ({"a": ["b"], "b": []}, "a", ["b"]),
        ({"a": ["b", "c"], "b": ["c"], "c": []}, "a", ["b"]),
        ({"a": ["b", "c"], "b": [], "c": []}, "a", ["b", "c"]),
        ({"a": ["b", "d"], "b": ["c"], "c": ["d"], "d": []}, "a", ["b"]),
        ({"a": ["b"], "b": ["a"]}, "a", ["b"]),
        ({"a": ["b", "c"], "b": ["c"], "c": ["b"]}, "a", ["b", "c"]),
        ({"a": ["b", "c"], "b": ["a", "c"], "c": []}, "a", ["b"]),
    ],
)
def test_needs_that_follow_from_others_are_not_drawn(needs: dict[str, list[str]], name: str, kept: list[str]) -> None:
    assert direct(name, needs, in_circles(needs)) == kept


def test_packages_of_one_name_have_no_picture() -> None:
    made = given()
    assert checked(made)["package_picture"]["places"]
    twice = replace(made.workspace, packages=(*made.workspace.packages, made.workspace.packages[0]))
    assert checked(replace(made, workspace=twice))["package_picture"] is None


def test_circles_of_a_long_chain_need_no_deep_stack() -> None:
    chain = {f"p{n}": [f"p{n + 1}"] for n in range(5000)}
    assert in_circles(chain) == {}
    assert len(in_circles({**chain, "p5000": ["p0"]})) == 5001


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([3.0], [(3.0, 3.0, 1)]),
        ([1.0, 1.0, 2.0], [(1.0, 2.0, 2), (2.0, 3.0, 1)]),
        ([1.0, 3.0], [(1.0, 2.0, 1), (2.0, 3.0, 0), (3.0, 4.0, 1)]),
    ],
)
def test_bars(values: list[float], expected: list[tuple[float, float, int]]) -> None:
    assert bars(values) == expected


@pytest.mark.parametrize("values", [[0.0, 1e6], [0.1, 0.25, 0.9], [float(n) for n in range(1000)], [-5.0, 5.0]])
def test_bars_hold_every_value(values: list[float]) -> None:
    found = bars(values)
    assert sum(number for _, _, number in found) == len(values) and len(found) <= 24
    assert found[0][0] <= min(values) and found[-1][1] >= max(values)


def test_the_worst_come_first_and_limits_say_how_many() -> None:
    (metric,) = checked(given())["metrics"]
    assert metric["worst"][0][0] == 17 and metric["count"] == 79
    assert metric["limits"][0][3] == sum(n % 17 + 1 > 10 for n in range(1, 80))


def test_changes_and_their_picture() -> None:
    data = checked(given())
    assert [row[:2] for row in data["changes"]["rows"]] == [["publisher", "added"], ["node", "removed"]]
    picture = data["changes"]["picture"]
    states = dict(
        zip(texts(data, [one[0] for one in picture["nodes"]]), (one[1] for one in picture["nodes"]), strict=True)
    )
    assert states == {"/box/filter": "", "/camera": "changed", "/old": "removed"}
    assert sorted(edge[3] for edge in picture["edges"]) == ["", "added", "removed"]


def test_without_a_base_there_are_no_changes() -> None:
    made = given()
    runs = tuple(replace(run, changes=None) for run in made.report.runs)
    assert checked(replace(made, report=replace(made.report, runs=runs)))["changes"] is None


def test_configurations_of_launch_files_come_first() -> None:
    data = checked(given())
    assert texts(data, [one["name"] for one in data["configurations"]]) == [NAME, "tool/alone"]


def test_rates_in_words_and_none_that_nobody_asked_for() -> None:
    data = checked(given())
    with_rates = data["configurations"][0]["rates"]
    assert [texts(data, row) for row in with_rates["published"]] == [
        ["/camera", "/image", "30 Hz"],
        ["/arm/driver", "/arm/state", "unknown (the sleep is not known)"],
    ]
    assert texts(data, with_rates["topics"][0]) == ["/image", "30 Hz"]
    without = tuple(replace(one, rates=None) for one in given().configurations)
    quiet = checked(replace(given(), configurations=without))
    assert [one["rates"] for one in quiet["configurations"]] == 2 * [{"published": [], "topics": []}]


def test_what_is_left_out_is_said() -> None:
    data = checked(replace(given(), more_than_shown=2))
    assert texts(data, data["left_out"]) == ["2 configurations left out by --configuration."]


def test_transforms_that_are_at_odds() -> None:
    data = checked(given())
    ((rows, frames, picture),) = data["tables"]["transforms"]
    names = [(*texts(data, frame[:2]), frame[2]) for frame in frames]
    assert ("base_link", "/tf", 0) in names and ("lens", "/other/tf", 0) in names and ("lens", "/tf", 0) in names
    assert sorted(names[row[0]][0] for row in rows if row[3]) == ["base_link", "base_link"]
    assert [row[1] for row in rows if names[row[0]][0] == "loose"] == [-1]
    assert len(picture[1]) == len(frames) and len(picture[2]) == 5
    assert [one["transforms"] for one in data["configurations"]] == [0, -1]


def test_frames_in_a_circle() -> None:
    one = configuration()
    first, second, *_ = broadcasts(one)
    turned = replace(first, child="odom", parent="base_link", node=first.node)
    pool = Pool()
    assert transforms(pool, [first, turned]) == 0
    assert [row[2] for row in pool.document()["transforms"][0][1]] == [1, 1]
    assert transforms(pool, []) == -1


def test_properties_of_a_project() -> None:
    data = checked(given())
    promise, granted, broken = data["properties"]
    assert texts(data, [promise["id"], promise["text"]]) == ["stops", "globally: /stop causes /arm/state within 100 ms"]
    assert (promise["granted"], granted["granted"], promise["fault"]) == (0, 1, -1)
    assert broken["fault"] >= 0 and texts(data, [broken["text"]]) == ["globally no"]
    assert held(None) == ()


BLOCK = """configurations:
  robot:
    hpl:
      properties:
        - |
          # id: one
          globally:
            no /a

        - 'globally: no /b'
        - 'globally: no'
"""


def test_a_property_ends_before_the_next_begins() -> None:
    stated = tuple(Held(one) for one in in_project(BLOCK, "haros.yaml", lambda name: None))
    assert [row["until"] for row in properties(Pool(), stated)] == [8, 10, 11]


def test_packages_with_more_lines_are_taller() -> None:
    needs: dict[str, list[str]] = {"small": [], "large": ["small"], "empty": [], "middle": []}
    made = package_picture(needs, {}, {"small": 10, "large": 4000, "middle": 1000})
    assert made is not None
    heights = dict(zip(sorted(needs), (place[3] for place in made["places"]), strict=True))
    assert heights["empty"] < heights["small"] < heights["middle"] < heights["large"]
    assert heights["large"] - heights["empty"] == 2 * (heights["middle"] - heights["empty"])
