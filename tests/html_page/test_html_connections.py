# SPDX-License-Identifier: Apache-2.0
"""Edges, quality of service and parameters in the picture of a system, in a browser; the page's rules against those of the checks."""

from __future__ import annotations

from dataclasses import asdict, replace
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from browser_kit import Page
from page_kit import configuration, end, given, node, written

from haros_ci.checking.compatibility import refuses
from haros_ci.html_page.document import asset
from haros_ci.model.architecture import Configuration, Parameter, Qos
from haros_ci.model.location import Location

#: What may stand for a value that is not known, by policy.
POSSIBLE: dict[str, tuple[Any, ...]] = {
    "reliability": ("reliable", "best_effort", "best_available"),
    "durability": ("volatile", "transient_local", "best_available"),
    "deadline": (None, 0.0001, 1.0, 1e6),
    "liveliness": ("automatic", "manual_by_topic"),
    "lease": (None, 0.0001, 1.0, 1e6),
}
#: What ends are compared with each other.
ENDS = {**POSSIBLE, "deadline": (0.01, 1.0, 100.0)}


def outcomes(policy: str, offer: Qos, request: Qos) -> set[bool]:
    """Whether the two are refused, for every value that what is not known of them may have."""
    names = ("liveliness", "lease") if policy == "liveliness" else (policy,)

    def meant(one: Qos) -> list[Qos]:
        def values(name: str) -> tuple[Any, ...]:
            value = getattr(one, name)
            is_open = value == "?" or (value is None and name in ("reliability", "durability"))
            return POSSIBLE[name][:2] if value is None and is_open else POSSIBLE[name] if is_open else (value,)

        return [
            replace(one, **dict(zip(names, chosen, strict=True)))
            for chosen in product(*(values(name) for name in names))
        ]

    if policy in ("reliability", "durability") and getattr(offer, policy) is None and getattr(request, policy) is None:
        return {False}  # both are what the middleware takes by default
    return {refuses(policy, one, other) for one, other in product(meant(offer), meant(request))}


@pytest.mark.parametrize("policy", ["reliability", "durability", "deadline", "liveliness"])
def test_quality_of_service_matches_by_the_rules_of_the_checks(page: Page, policy: str) -> None:
    if policy == "liveliness":
        ends = [
            Qos(liveliness=kind, lease=lease)
            for kind in (None, "?", *POSSIBLE[policy])
            for lease in (None, "?", 0.01, 1.0)
        ]
    else:
        ends = [Qos(**{policy: value}) for value in dict.fromkeys((None, "?", *ENDS[policy]))]
    pairs = list(product(ends, ends))
    told = page.run(
        asset("quality.js") + "; return arguments[1].map(([one, other]) => refusal(arguments[0], one, other))",
        policy,
        [[{name: str(value) for name, value in asdict(one).items() if value is not None} for one in pair] for pair in pairs],
    )  # fmt: skip
    words = {frozenset((True,)): "yes", frozenset((False,)): "no"}
    expected = [words.get(frozenset(outcomes(policy, *pair)), "perhaps") for pair in pairs]
    differ = [(*pair, one, other) for pair, one, other in zip(pairs, told, expected, strict=True) if one != other]
    assert differ == []


def test_a_topic_says_whether_its_ends_match(page: Page) -> None:
    page.go("system?element=%2Fimage")
    text = page.text(".detail .connections")
    assert "✕ does not match: reliability (best effort offered, reliable requested)" in text
    assert "best effort, volatile, keep last 5" in text and "reliable, volatile, keep last 1" in text
    assert "The quality of service of /camera and /box/filter does not match" in page.text(".detail .warning")


def test_ends_whose_quality_of_service_the_code_does_not_tell(page: Page) -> None:
    page.go("system?element=%2Fbox%2Ffound")
    assert "? not known: the code of" in page.text(".detail .connections")
    assert not page.all(".detail .warning")


@pytest.mark.parametrize("place", ["system?element=%2Fgo", "system?element=%2Fcamera"])
def test_actions_and_nodes_have_no_table_of_it(page: Page, place: str) -> None:
    page.go(place)
    assert page.text(".detail h2") and not page.all(".detail .connections")


def test_an_edge_leads_to_its_ends(page: Page) -> None:
    page.go("system")
    page.run(
        "const one = [...document.querySelectorAll('.edge')].find((each) => each.textContent.startsWith('/box/filter subscribes to /image'));"
        " one.dispatchEvent(new MouseEvent('click', { bubbles: true }))"
    )
    page.settled()
    text = page.text(".detail")
    assert "/box/filter – /image" in text and "✕ does not match" in text and "base/src/base.cpp:7" in text
    assert len(page.all(".edge.chosen")) == 1
    place = page.run("return location.hash")
    page.go("overview")
    page.go(place[1:])
    assert "/box/filter – /image" in page.text(".detail") and len(page.all(".edge.chosen")) == 1
    page.click(".detail a", "/camera")
    assert "/camera" in page.text(".detail h2") and "node=" not in page.run("return location.hash")


def test_edges_between_folded_boxes_are_listed(page: Page) -> None:
    page.go("system")
    page.click("button", "Fold all")
    page.run("document.querySelector('.edge.bundle').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    page.settled()
    assert page.text(".detail h2")
    page.click("button", "Unfold all")


def overlaps(page: Page) -> int:
    found = page.run(
        "const places = [...document.querySelectorAll('.stage .element > .shape')].map((one) => one.getBBox()); let found = 0;"
        " places.forEach((a, n) => places.slice(0, n).forEach((b) => { if (a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height) found += 1; }));"
        " return found"
    )
    return int(found)


def test_parameters_stand_in_their_nodes_where_they_are_asked_for(page: Page) -> None:
    page.go("system")
    assert not page.all(".own.parameter")
    before = page.run("return document.querySelector('[data-id=n0] .shape').getBBox().x")
    page.click(".switches label", "parameters")
    assert "rate = 5" in page.text(".own.parameter") and "unread = v" in page.text(".own.parameter")
    assert overlaps(page) == 0
    assert page.run("return document.querySelector('[data-id=n0] .shape').getBBox().x") == before
    page.click(".own.parameter", "rate")
    text = page.text(".detail")
    assert "/box/filter/rate parameter" in text and "base/config/p.yaml:4" in text and "declares double" in text
    assert page.run("return [...document.querySelectorAll('.element.chosen title')].map((one) => one.textContent)")[0].startswith("/box/filter")  # fmt: skip
    place = page.run("return location.hash")
    page.go("overview")
    page.go(place[1:])
    assert "/box/filter/rate parameter" in page.text(".detail")
    page.click(".switches label", "parameters")
    assert not page.all(".own.parameter")


def test_search_finds_parameters(page: Page) -> None:
    page.go("system")
    page.type(".search-box input", "filter/ra")
    page.click(".result", "/box/filter/rate")
    assert "base/config/p.yaml:4" in page.text(".detail")


def test_an_element_is_dragged_and_put_back(page: Page) -> None:
    from selenium.webdriver.common.action_chains import ActionChains

    page.go("system")
    (element,) = page.all('[data-id="c topics /image"] .shape')
    box = "return document.querySelector('[data-id=\"c topics /image\"]').getBoundingClientRect().y"
    first = page.run(box)
    ActionChains(page.driver).drag_and_drop_by_offset(element, 0, 60).perform()
    page.settled()
    assert page.run(box) - first > 30
    page.click(".switches label", "rosout")
    page.click(".switches label", "rosout")
    assert page.run(box) - first > 30
    page.run("document.querySelector('.picture').dispatchEvent(new MouseEvent('dblclick', { bubbles: true }))")
    page.settled()
    assert abs(page.run(box) - first) < 30


def test_parameters_of_ros_2_nodes_stand_in_them(driver: Any, tmp_path: Path) -> None:
    """Their names are /node:name."""
    one = configuration()
    rate = Parameter(
        name="/arm/driver:rate", type="double", value=5.0, location=Location("base/launch/base.launch.py", 3)
    )
    nothing = Parameter(name="/arm/driver:word", type="str", value="", location=rate.location)
    path = tmp_path / "page.html"
    path.write_text(
        written(replace(given(), configurations=(replace(one, parameters=(rate, nothing)),))), encoding="utf-8"
    )
    page = Page(driver, path)
    page.go("system?element=%2Farm%2Fdriver")
    assert "parameters (2)" in page.text(".detail") and "base/launch/base.launch.py:3" in page.text(".detail")
    page.click(".switches label", "parameters")
    lines = page.text("[data-id=n2] .own.parameter, .element .own.parameter").split("\n")
    assert "rate = 5.0" in lines and 'word = ""' in lines
    page.go("parameters")
    assert "no reader found" in page.text(".rows")
    assert page.complaints() == []


def test_a_large_picture_begins_folded_and_squeezed(driver: Any, tmp_path: Path) -> None:
    """What is not in a box around most of it can be read, and unfolds where it is."""
    nodes = tuple(
        node(f"/{space}/n{number}", *([end("subscribers", f"/{space}/t{number}")] if number else []), end("publishers", f"/{space}/t{number + 1}"))
        for space in ("front", "middle", "rear")
        for number in range(30)
    )  # fmt: skip
    path = tmp_path / "page.html"
    path.write_text(
        written(replace(given(), configurations=(Configuration(name="x", launch=("x",), nodes=nodes),))),
        encoding="utf-8",
    )
    page = Page(driver, path)
    page.go("system")
    page.settled()
    assert len(page.all(".box.closed")) == 3 and "folded, as it is large" in page.text("[role=status]")
    sizes = page.run(
        "return [...document.querySelectorAll('.box.closed text')].map((one) => one.getBoundingClientRect().height)"
    )
    assert min(sizes) > 9
    before = page.run("return document.querySelectorAll('.box.closed .shape')[1].getBoundingClientRect().y")
    page.click(".handle", "/middle")
    assert overlaps(page) == 0 and len(page.all(".box.closed")) == 2
    after = page.run("return [...document.querySelectorAll('.box:not(.closed) > .shape')][0].getBoundingClientRect().y")
    assert abs(after - before) < 3
    page.type(".search-box input", "rear/n12")
    page.click(".result", "/rear/n12")
    assert len(page.all(".box.closed")) == 1 and page.all(".element.chosen")
    page.click("button", "Unfold all")
    assert not page.all(".box.closed") and overlaps(page) == 0
    assert page.complaints() == []
