# SPDX-License-Identifier: Apache-2.0
"""Every view in a real browser: opened, searched, filtered, folded, traced, by mouse and keyboard; no script of a workspace runs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from browser_kit import Page
from page_kit import HOSTILE, NAME, configuration, end, given, node, samples, written

from haros_ci.html_page.change_page import change_page
from haros_ci.model.architecture import Parameter, Unknown

VIEWS = (
    "overview",
    "findings",
    "system",
    "programs",
    "launch",
    "parameters",
    "transforms",
    "properties",
    "packages",
    "interfaces",
    "metrics",
    "changes",
)


def shown(page: Page) -> set[str]:
    """The ids of the elements in the picture."""
    return set(
        page.run("return [...document.querySelectorAll('.picture .element')].map((one) => one.dataset.id || '')")
    ) - {""}


def test_each_view_opens(page: Page) -> None:
    for view in VIEWS:
        page.go(view)
        assert page.run("return document.querySelector('nav [aria-current]').dataset.view") == view
        assert len(page.text()) > 50, view


@pytest.mark.parametrize(
    "word", [" ".join(each for each in (*HOSTILE, *samples().HOSTILE) if len(each) < 100), "__proto__", HOSTILE[-1]]
)
def test_no_text_of_a_workspace_is_more_than_text(driver: Any, tmp_path: Path, word: str) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(given(word)), encoding="utf-8", errors="backslashreplace")
    page = Page(driver, path)
    for view in (
        *VIEWS,
        "system?element=%2Fodd",
        "system?element=%2Fbox%2Ffilter&hops=2",
        "system?element=%2Fbox%2Ffound&way=behind",
    ):
        page.go(view)
    for view in ("properties", "findings"):
        page.go(view)
        page.click(".rows .row", "")
    assert page.complaints() == []
    assert page.run("return window.hacked") is None
    assert page.run("return document.querySelectorAll('script').length") == 2
    assert page.all("main script, main img, main iframe, main object, main [src], main [onerror], main [onload]") == []
    addresses = page.run("return [...document.querySelectorAll('a')].map((one) => one.getAttribute('href'))")
    assert addresses and all(each.startswith("#") for each in addresses)


def test_an_unknown_address_shows_the_overview(driver: Any, plain: Path) -> None:
    page = Page(driver, plain, "nowhere?%E0%A4%A=1&x")
    assert "fleet" in page.text("h1") and page.complaints() == []


def test_figures_lead_to_what_they_count(page: Page) -> None:
    page.click("a.figure", "error")
    assert "1 of 7 findings" in page.text(".bar-of-filters")
    page.go("overview")
    page.click("a.figure", "gone")
    assert "A gone one" in page.text(".rows")


def test_findings_are_searched_filtered_and_sorted(page: Page) -> None:
    page.go("findings")
    assert "5 of 7 findings" in page.text("[role=status]")
    page.type("input.search", "member 2")
    assert "1 of 7 findings" in page.text("[role=status]") and "Member 2" in page.text(".rows")
    page.go("findings?tool=haros-ci")
    assert "2 of 7" in page.text("[role=status]")
    page.go("findings?state=known")
    assert "An old one" in page.text(".rows")
    page.go("findings?path=base%2Flaunch")
    assert "0 of 7" in page.text("[role=status]")
    page.go("findings")
    page.click(".head button", "place")
    page.click(".head button", "place")
    assert "haros.yaml:3" in page.run("return document.querySelector('.rows .row').textContent")


def test_a_finding_has_its_code_ways_rule_and_address(page: Page) -> None:
    page.go("findings?rule=cppcheck%3Auninit")
    page.click(".rows .row", "Member 1 ")
    text = page.text(".detail")
    assert "int line_2 = 2" in text and "declared" in text and "haros: ignore[cppcheck:uninit]" in text
    assert page.text(".detail mark") == "line"
    assert page.text(".page-of-rule strong") == "member" and len(page.all(".page-of-rule li")) == 2
    assert len(page.all(".page-of-rule table td")) >= 1
    place = page.run("return location.hash")
    page.go("overview")
    page.go(place[1:])
    assert "int line_2 = 2" in page.text(".detail")


def test_keys(page: Page) -> None:
    from selenium.webdriver.common.keys import Keys

    page.go("findings")
    page.key("/")
    assert page.run("return document.activeElement.classList.contains('search')")
    page.key("member")
    assert "3 of 7" in page.text("[role=status]")
    page.key(Keys.ESCAPE)
    page.run("document.querySelector('.table').focus()")
    page.key(Keys.ARROW_DOWN)
    assert "Member 0" in page.text(".detail")
    page.key(Keys.ARROW_DOWN)
    assert "Member 1" in page.text(".detail")
    page.key(Keys.ESCAPE)
    assert page.text(".detail") == ""


def test_ten_thousand_findings_are_few_rows(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(given(results=10_000, configurations=())), encoding="utf-8")
    page = Page(driver, path, "findings")
    page.settled()
    assert "10,002 of 10,004" in page.text("[role=status]")
    for top in (0, 90_000, 299_000):
        page.run("document.querySelector('.table').scrollTop = arguments[0]", top)
        page.settled()
        assert 10 < len(page.all(".rows .row")) < 90
    page.type("input.search", "member 9999 is")
    assert "1 of 10,004" in page.text("[role=status]")
    assert page.complaints() == []


def test_the_picture_has_what_connects_nodes_and_switches_for_the_rest(page: Page) -> None:
    page.go("system")
    every = shown(page)
    assert {"n0", "c topics /image", "c services /arm/stop", "c actions /go"} <= every
    assert "c topics /rosout" not in every
    page.click(".switches label", "rosout")
    assert "c topics /rosout" in shown(page)
    page.click(".switches label", "rosout")
    assert "c topics /rosout" not in shown(page)


def test_boxes_fold_and_their_edges_are_bundled(page: Page) -> None:
    page.go("system")
    before = page.run("return document.querySelector('[data-id=\"c topics /image\"]').getBoundingClientRect().x")
    page.click(".handle", "/arm")
    every = shown(page)
    assert "c topics /arm/state" not in every and "c topics /image" in every
    assert (
        page.run("return document.querySelector('[data-id=\"c topics /image\"]').getBoundingClientRect().x") == before
    )
    assert "/arm (2 nodes)" in page.text(".box.closed")
    assert page.all(".edge.bundle")
    assert "folded=%2Farm" in page.run("return location.hash")
    page.go("overview")
    page.go(f"system?configuration={NAME.replace('/', '%2F')}&folded=%2Farm")
    assert "c topics /arm/state" not in shown(page)
    page.click("button", "Unfold all")
    assert "c topics /arm/state" in shown(page)
    page.click("button", "Fold all")
    assert len(page.all(".box.closed")) == 2


def test_the_neighbourhood_grows_with_the_hops(page: Page) -> None:
    page.go("system?element=%2Fbox%2Ffilter&hops=1")
    one = shown(page)
    assert "c topics /image" in one and "c topics /arm/state" not in one
    page.click(".detail button", "2 hops")
    two = shown(page)
    assert one < two
    page.click("button", "Whole system")
    assert two < shown(page)


@pytest.mark.parametrize(
    ("element", "way", "inside", "outside"),
    [
        ("/image", "behind", {"c topics /box/found", "c topics /arm/state"}, {"n4"}),
        ("/arm/state", "before", {"c topics /image", "n4"}, {"c actions /go"}),
    ],
)
def test_traces(page: Page, element: str, way: str, inside: set[str], outside: set[str]) -> None:
    page.go(f"system?element={element.replace('/', '%2F')}&way={way}")
    assert inside <= shown(page)
    assert not outside & shown(page)


@pytest.mark.parametrize(
    ("start", "goal", "inside", "said"),
    [
        ("/camera", "/arm/state", {"/camera", "/image", "/box/filter", "/box/found", "/arm/driver", "/arm/state"}, "6 elements on the paths to /arm/state"),
        ("/image", "/box/filter", {"/image", "/box/filter"}, "2 elements on the paths"),
        ("/arm/state", "/camera", {"/arm/state", "/camera"}, "There is no path from /arm/state to /camera."),
    ],
)  # fmt: skip
def test_the_way_from_one_element_to_another(page: Page, start: str, goal: str, inside: set[str], said: str) -> None:
    page.go(f"system?element={start}")
    page.run(
        "const one = document.querySelector('.detail input[list]'); one.value = arguments[0];"
        " one.dispatchEvent(new Event('change'))",
        goal,
    )
    page.settled()
    assert said in page.text("[role=status]")
    titles = page.text(".picture .element title")
    assert all(f"{name}" in titles for name in inside) and len(shown(page)) == len(inside)
    place = page.run("return location.hash")
    page.go("overview")
    page.go(place[1:])
    assert len(shown(page)) == len(inside) and said in page.text("[role=status]")


def test_a_way_to_nothing_is_the_whole_system(page: Page) -> None:
    page.go("system?element=/camera")
    before = shown(page)
    page.go("system?element=/camera&way=to&to=/nowhere")
    assert shown(page) == before


def test_details_of_a_node_and_of_a_topic(page: Page) -> None:
    page.go("system?element=%2Fbox%2Ffilter")
    text = page.text(".detail")
    assert "base::Filter" in text and "/box/container" in text and "rate" in text and "base/config/p.yaml:4" in text
    assert "differ" in text  # the finding about it
    page.go("system?element=%2Fimage")
    text = page.text(".detail")
    assert "best effort offered" in text and "keep last 5" in text
    page.go("system?element=%2Fgo")
    assert "int32 goal" in page.text(".detail")
    page.go("system?element=%2Fodd")
    assert "what strip returns is not known" in page.text(".detail")


def test_rates_of_publishers_and_topics(page: Page) -> None:
    page.go("system?element=%2Fcamera")
    assert "30 Hz" in page.text(".detail")
    page.go("system?element=%2Fimage")
    assert page.text(".detail").count("30 Hz") == 2, "of the topic and of its publisher"
    page.go("system?element=%2Farm%2Fdriver")
    assert "rate unknown (the sleep is not known)" in page.text(".detail")
    page.go("system?element=%2Fbox%2Ffound")
    assert "rate" not in page.text(".detail dl"), "none is known of it"


def test_what_causes_what_in_a_node(page: Page) -> None:
    page.go("system?element=%2Fbox%2Ffilter")
    text = page.text(".dependence")
    assert "publishes /box/found because of/image · through state last_" in text
    assert (
        "not debug asks for parameter rate at base/src/base.cpp:3" in text
        and "Filter::on_image is the callback" in text
    )
    page.go("system?element=%2Fcamera")
    assert "a timer base/src/base.cpp:4 · each time" in page.text(".dependence")
    page.go("system?element=%2Farm%2Fdriver")
    assert "by itself" in page.text(".dependence") and "/box/found causes none of these" in page.text(".dependence")
    page.go("system?element=%2Farm%2Fwatch")
    assert "? others may be causes: setup gives it to others" in page.text(".dependence")
    page.go("system?element=%2Fodd")
    assert not page.all(".dependence")


def test_a_trace_follows_the_code_where_it_is_asked_for(page: Page) -> None:
    page.go("system?element=%2Fimage&way=behind")
    assert {"c topics /box/found", "c topics /arm/state"} <= shown(page)
    page.click(".detail .toggle input")
    assert shown(page) == {"c topics /image", "n3", "c topics /box/found", "n0"}
    assert "by=code" in page.run("return location.hash")
    page.go("system?element=%2Farm%2Fstop&way=before&by=code")
    assert {"c topics /arm/state", "n0", "n1"} <= shown(page) and "c topics /box/found" not in shown(page)
    assert page.all(".edge.perhaps")
    page.go("system?element=%2Fcamera&way=to&to=%2Farm%2Fdriver&by=code")
    assert "c topics /box/found" in shown(page)
    page.go("system?element=%2Fcamera&way=to&to=%2Farm%2Fstate&by=code")
    assert "There is no path" in page.text("[role=status]")


def test_a_page_without_dependence_says_how_to_have_it(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(
        written(given(configurations=(replace(configuration(), dependence=None, rates=None),))), encoding="utf-8"
    )
    page = Page(driver, path, "system")
    page.settled()
    assert "report --dependence, rates with --rates" in page.text(".detail")
    page.go("system?element=%2Fimage&way=behind&by=code")
    assert "c topics /arm/state" in shown(page) and not page.all(".detail .toggle")
    assert page.complaints() == []


def test_an_unknown_name_has_candidates(page: Page) -> None:
    page.go("system?element=%2Fbox%2F%3F")
    assert "It may be" in page.text(".detail") and "/box/found" in page.text(".candidates")
    assert "/arm/state" not in page.text(".candidates")


def test_findings_are_red_and_more_than_red(page: Page) -> None:
    page.go("system")
    assert page.run(
        "return [...document.querySelectorAll('.stage .element.red')].map((one) => one.dataset.id).sort()"
    ) == [
        "c topics /box/found",
        "c topics /image",
        "n3",
    ]
    assert page.run("return getComputedStyle(document.querySelector('.element.red > .shape')).strokeWidth") == "3px"


def test_search_finds_and_shows_an_element(page: Page) -> None:
    page.go("system")
    page.type(".search-box input", "arm/st")
    assert page.text(".result").split("\n")[0].startswith("/arm/st")
    page.click(".result", "/arm/state")
    assert page.run("return document.querySelector('.element.chosen').dataset.id") == "c topics /arm/state"
    assert "/arm/driver" in page.text(".detail")


def test_another_configuration_and_one_that_is_not_there(page: Page) -> None:
    page.go("system?configuration=tool%2Falone")
    assert "tool/alone" in page.text(".detail h2")
    page.go("system?configuration=away")
    assert "There is no configuration away." in page.text("[role=status]")


def test_programs_and_where_they_run(page: Page) -> None:
    page.go("overview")
    page.click("a.figure", "programs that are nodes")
    assert page.run("return location.hash") == "#programs"
    assert page.text("[role=status]") == "6 of 6 programs"
    page.type("input.search", "filter")
    assert page.text("[role=status]") == "1 of 6 programs"
    page.click(".rows .row", "filter")
    assert "/box/filter in base/launch/base.launch.py" in page.text(".detail")
    page.click(".detail a", "/box/filter")
    assert page.run("return location.hash").startswith("#system?")


def test_launch_files_as_a_tree(page: Page) -> None:
    page.go("launch")
    assert "base/launch/inner.launch.py" in page.text(".tree")
    assert "away" in page.text(".tree .tree")
    assert "/camera" in page.text(".card") and "sim:=true" in page.text()


def test_parameters(page: Page) -> None:
    page.go("parameters")
    rate, unread = (
        page.run(
            "return [...document.querySelectorAll('.rows .row')].find((one) => one.textContent.includes(arguments[0])).textContent",
            name,
        )
        for name in ("/box/filter/rate", "/camera/unread")
    )
    assert "base/config/p.yaml:4" in rate and "no reader" not in rate
    assert "no reader found" in unread


def test_of_nodes_outside_the_workspace_no_reader_is_known(driver: Any, tmp_path: Path) -> None:
    """Data on them does not tell all that they read."""
    made = configuration()
    away = node("/away", end("publishers", "/far", source="known-node"), source="launch")
    near = node("/near", end("publishers", "/close"))
    asked = tuple(Parameter(name=name, type="str", value="x") for name in ("/away/one", "/near/one"))
    made = replace(made, nodes=(*made.nodes, away, near), parameters=asked, dependence=None)
    path = tmp_path / "page.html"
    path.write_text(written(given(configurations=(made,))), encoding="utf-8")
    page = Page(driver, path, "parameters")
    page.settled()
    rows = page.run("return [...document.querySelectorAll('.rows .row')].map((one) => one.textContent)")
    marks = {name: [row for row in rows if name in row][0] for name in ("/away/one", "/near/one")}
    assert "no reader known" in marks["/away/one"] and "no reader found" in marks["/near/one"]
    for name, words in (("away", "no reader known"), ("near", "no reader found")):
        page.go(f"system?element=%2F{name}")
        assert words in page.text(".detail")


def test_a_picture_stays_in_sight_when_its_room_changes(page: Page) -> None:
    whole = "const box = document.querySelector('.stage .picture > g').getBoundingClientRect(), room = document.querySelector('.stage').getBoundingClientRect(); return box.right <= room.right + 1 && box.left >= room.left - 1"
    page.go("system")
    assert page.run(whole)
    page.run("document.querySelector('.stage').style.maxWidth = '300px'")
    page.settled(50)
    assert page.run(whole)
    page.click("button", "+")
    page.run("document.querySelector('.stage').style.maxWidth = '250px'")
    page.settled(50)
    assert not page.run(whole), "what was enlarged stays so"


def test_packages_stand_in_circles(page: Page) -> None:
    page.go("packages?package=base")
    assert "A dependency cycle, these need each other to be built" in page.text(".detail")
    assert "cycle 1" in page.text(".rows")
    page.click("button", "Picture")
    assert shown(page) == {"p0", "p1", "p2"} and len(page.all(".stage .edge")) == 3
    page.click(".element", "toolsx")
    assert "toolsx" in page.text(".detail")


def test_metrics_and_interfaces_and_changes(page: Page) -> None:
    page.go("metrics")
    assert len(page.all(".histogram .column")) == 17 and "are above" in page.text()
    page.go("interfaces")
    page.click(".rows .row", "base/Go")
    assert "/odd" in page.text(".detail") and "int32 goal" in page.text(".detail")
    page.go("changes")
    names = page.text(".stage .element .name").split("\n")
    assert "/image" in names, names
    assert "publisher added" in page.text() and page.all(".picture .edge.added") and page.all(".picture .edge.removed")


def test_details_are_as_wide_as_their_place(driver: Any, tmp_path: Path) -> None:
    reason = Unknown("endpoints", "boost::" * 60 + "begin returns what is not known")
    made = replace(configuration(), nodes=(node("/a", end("publishers", "/b"), unknowns=(reason,)),), dependence=None)
    path = tmp_path / "page.html"
    path.write_text(written(given(configurations=(made,))), encoding="utf-8")
    page = Page(driver, path, "system?element=%2Fa")
    page.settled()
    wide = "const one = document.querySelector('.detail'); return one.scrollWidth <= one.clientWidth"
    assert "boost::" in page.text(".detail") and page.run(wide)


def test_a_narrow_window_needs_no_sideways_scrolling(page: Page) -> None:
    page.driver.set_window_size(500, 900)
    try:
        for view in VIEWS:
            page.go(view)
            assert page.run("return document.documentElement.scrollWidth <= window.innerWidth"), view
            assert page.run(
                "const main = document.querySelector('main'); return main.scrollWidth <= main.clientWidth"
            ), view
    finally:
        page.driver.set_window_size(1400, 900)


def test_everything_that_can_be_clicked_can_be_reached_by_keyboard(page: Page) -> None:
    for view in VIEWS:
        page.go(view)
        loose = page.run(
            "return [...document.querySelectorAll('main a, main button, main summary, main select, main input, main .handle')].filter((one) => one.tabIndex < 0).length"
        )
        unnamed = page.run(
            "return [...document.querySelectorAll('main input, main select')].filter((one) => !one.ariaLabel && !one.closest('label')).length"
        )
        assert (loose, unnamed) == (0, 0), view


def test_the_tree_of_frames(page: Page) -> None:
    page.go("transforms")
    page.settled(50)
    assert "7 frames, 3 trees, 1 in conflict" in page.text("[role=status]")
    assert page.run("return document.querySelectorAll('.stage .element').length") == 7
    assert page.text(".picture .red .name") == "base_link" and len(page.all(".picture .edge.red")) == 2
    assert "tf_static" not in page.text(".detail") and "base_link map, odom" in page.text(".detail")
    page.type("input.search", "lens")
    assert "lens" in page.text(".detail h2") and "static, code" in page.text(".detail")
    page.go("transforms?frame=base_link")
    page.settled(50)
    text = page.text(".detail")
    assert "It has 2 parents" in text and "int line_5 = 5" in text and "base_link → map" in text
    page.click(".detail a", "/arm/driver")
    assert page.run("return location.hash").startswith("#system?")


def test_transforms_of_a_configuration_without_any(page: Page) -> None:
    page.go("transforms?configuration=tool%2Falone")
    assert "No transform of this configuration is known" in page.text()


def test_a_page_without_transforms_has_no_such_view_and_says_why(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(given(configurations=())), encoding="utf-8")
    page = Page(driver, path)
    assert "Transforms" not in page.text("nav") and page.complaints() == []
    page.go("transforms")
    assert "This page has no Transforms: no transform is known." in page.text()
    page.go("findings")
    assert "This page has no" not in page.text()


def test_properties_with_what_is_wrong_with_them(page: Page) -> None:
    page.go("properties")
    assert "4 of 4 properties" in page.text("[role=status]")
    assert "not readable" in page.text(".rows") and "assumption" in page.text(".rows")
    page.click(".head button", "findings")
    page.click(".rows .row", "stops")
    text = page.text(".detail")
    assert (
        "globally: /stop causes /arm/state within 100 ms" in text and "No node has /away" in text and "line 3" in text
    )
    assert "no end of it is known" in text and "node base/driver" in text
    place = page.run("return location.hash")
    page.go("overview")
    page.go(place[1:])
    assert "within 100 ms" in page.text(".detail")
    page.type("input.search", "data")
    assert "1 of 4 properties" in page.text("[role=status]")
    page.go("properties")
    page.click(".rows .row", "stops")
    page.click(".detail a", "/arm/stop")
    assert page.run("return location.hash").startswith("#system?")


def test_a_violation_is_a_sequence_of_messages(page: Page) -> None:
    page.go("overview")
    assert "4properties1violated by recordings" in page.text(".figures")
    page.go("properties")
    assert "drive.mcap" in page.text(".recordings") and "1,234 messages" in page.text(".recordings")
    assert "✗ violated" in page.text(".rows") and "not asked" in page.text(".rows")
    page.click(".rows .row", "within 100 ms")
    lives = page.text(".sequence .life-name title").split("\n")
    assert lives == ["/camera", "/box/filter", "(not known)", "/arm/driver"]
    said = page.text(".sequence .said")
    assert "+0.500 s  /image" in said and "+1.250 s  /box/found" in said and "✗ violated +2.000 s" in said
    steps = page.text(".detail ol.steps")
    assert "trigger: message 105 on /image" in steps and "published by /camera at base/src/base.cpp:7" in steps
    page.click(".rows .row", "no /other")
    assert "asked of a recording alone" in page.text(".detail") and not page.all(".detail .sequence")


def test_a_page_without_recordings(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(replace(given(), verdicts=())), encoding="utf-8")
    page = Page(driver, path, "properties")
    page.settled()
    assert "3 of 3 properties" in page.text("[role=status]") and "not asked" not in page.text()
    assert page.complaints() == []
    page.go("overview")
    assert "3properties" in page.text(".figures") and "violated" not in page.text(".figures")


def test_findings_by_tag_and_by_configuration(page: Page) -> None:
    page.go("findings?tag=architecture")
    assert "1 of 7" in page.text("[role=status]")
    page.go("findings?tag=not%20architecture")
    assert "4 of 7" in page.text("[role=status]")
    page.go("findings?configuration=base%2Flaunch%2Fbase.launch.py")
    assert "1 of 7" in page.text("[role=status]") and "/odd and /box/filter differ" in page.text(".rows")
    page.go("findings?configuration=nowhere")
    assert "0 of 7" in page.text("[role=status]")
    labels = page.run(
        "return [...document.querySelectorAll('.bar-of-filters select')].map((one) => one.getAttribute('aria-label'))"
    )
    assert {"tag", "configuration"} <= set(labels)


def test_quality_over_time(page: Page) -> None:
    page.go("overview")
    assert "findings: 5 now, 7 at first" in page.text("#history figcaption") and len(page.all("#history .point")) == 2
    page.run(
        "const one = document.querySelector('#history select'); one.value = 'lines of code'; one.dispatchEvent(new Event('change'))"
    )
    assert "lines of code: 1,200 now, 100 at first" in page.text("#history figcaption")
    assert "2024-02-01 00:00" in page.text("#history table")


def test_a_page_without_history(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(replace(given(), history=())), encoding="utf-8")
    page = Page(driver, path)
    assert page.all("#history") == [] and page.complaints() == []


def test_what_runs_under_other_launch_arguments(page: Page) -> None:
    page.go("system")
    page.settled(50)
    before = shown(page)
    places = "return Object.fromEntries([...document.querySelectorAll('.stage .element')].map((one) => [one.dataset.id, one.querySelector('.shape').getAttribute('x')]))"
    old = page.run(places)
    words = page.text("select[aria-label=arguments]")
    assert "sim:=true (+1)" in words and "watch:=false (−1)" in words
    page.go("system?with=sim%3A%3Dtrue")
    page.settled(50)
    assert "simulator" in page.text(".stage") and len(shown(page) - before) == 1
    new = page.run(places)
    assert all(new[name] == x for name, x in old.items())
    assert "sim:=true" in page.text(
        ".detail"
    ) and "parameters and names are those of the default arguments" in page.text(".detail")
    page.go("system?with=sim%3A%3Dtrue&element=%2Fimage")
    page.settled(50)
    assert "/simulator" in page.text(".detail")
    page.click(".detail a", "/simulator")
    assert "with=sim" in page.run("return location.hash")
    page.click(".detail button", "1 hop")
    assert "simulator" in page.text(".stage")
    page.go("system?with=watch%3A%3Dfalse")
    page.settled(50)
    assert "/arm/watch" not in page.text(".stage")
    page.go("system?with=nonsense")
    page.settled(50)
    assert shown(page) == before


@pytest.mark.parametrize("word", ["", HOSTILE[0]])
def test_a_page_of_a_change_alone(driver: Any, tmp_path: Path, word: str) -> None:
    made = given(word)
    assert made.report.changes is not None
    path = tmp_path / "page.html"
    path.write_text(change_page(made.report.changes, made.workspace, f"fleet{word}", "ab" * 20, None), encoding="utf-8")
    page = Page(driver, path)
    page.settled()
    assert page.text("nav") == "Changes" and f"/image{word}" in page.text("main table")
    assert "new findings" not in page.text() and "since abababababab" in page.text()
    assert page.complaints() == [] and page.run("return window.hacked") is None


def test_on_paper_every_row_is_whole(driver: Any, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(written(given(results=300)), encoding="utf-8")
    page = Page(driver, path, "findings?rule=cppcheck%3Auninit")
    page.settled()
    seen = len(page.all(".rows .row"))
    page.run("window.dispatchEvent(new Event('beforeprint'))")
    assert len(page.all(".printed tbody tr")) > 250 > seen
    assert "Findings · rule: cppcheck:uninit" in page.text(".print-title")
    page.run("window.dispatchEvent(new Event('afterprint'))")
    assert not page.all(".printed, .print-title") and len(page.all(".rows .row")) == seen
    assert page.complaints() == []


def test_on_paper_a_picture_is_whole(page: Page) -> None:
    page.go("system")
    before = page.run("return document.querySelector('.picture > g').getAttribute('transform')")
    page.run("window.dispatchEvent(new Event('beforeprint'))")
    assert page.run("return document.querySelector('.picture').getAttribute('viewBox')").startswith("0 0 ")
    assert NAME in page.text(".print-title")
    page.run("window.dispatchEvent(new Event('afterprint'))")
    assert page.run("return document.querySelector('.picture > g').getAttribute('transform')") == before


def test_each_view_prints_on_few_pages(page: Page) -> None:
    import base64

    for view in VIEWS:
        page.go(view)
        document = base64.b64decode(page.driver.print_page())
        pages = document.count(b"/Type /Page\n") + document.count(b"/Type /Page ")
        assert document.startswith(b"%PDF") and pages < 12, view


def test_a_narrow_window_begins_a_picture_readable_and_goes_to_the_details(driver: Any, plain: Path) -> None:
    page = Page(driver, plain)
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": 420, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    )
    try:
        page.go("system")
        assert page.run("return document.querySelector('.picture > g').getCTM().a") >= 0.6
        assert "drag the picture" in page.text("[role=status]")
        page.click("button", "Fit")
        assert page.run("return document.querySelector('.picture > g').getCTM().a") < 0.6
        page.go("findings")
        assert page.run("return document.querySelector('.detail').getBoundingClientRect().height") == 0
        page.click(".rows .row [role=cell]")
        assert 0 <= page.run("return document.querySelector('.detail').getBoundingClientRect().top") < 400
    finally:
        driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
