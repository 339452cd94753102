# SPDX-License-Identifier: Apache-2.0
"""Launch files in XML: tags with their places, and what is refused."""

from __future__ import annotations

import json

import pytest

from haros_ci.extract.launch.xml import MAX_DEPTH, from_json, read_launch, to_json
from haros_ci.model.launch import LaunchElement, LaunchFile


def root(text: str) -> LaunchElement:
    launch = read_launch(text)
    assert launch.problems == ()
    assert launch.root is not None
    return launch.root


def places(element: LaunchElement) -> list[tuple[str, int, int]]:
    found = [(element.tag, element.line, element.column)]
    return found + [place for child in element.children for place in places(child)]


def test_tags_attributes_and_order() -> None:
    launch = root('<launch a="1" b="x &amp; y"><node name="n"/>\n<param/></launch>')
    assert launch.attributes == (("a", "1"), ("b", "x & y"))
    assert [child.tag for child in launch.children] == ["node", "param"]
    assert launch.children[0].get("name") == "n"
    assert launch.children[0].get("type") is None


def test_places_count_code_points_tabs_as_one_and_no_byte_order_mark() -> None:
    text = '\ufeff<?xml version="1.0"?>\r\n<!-- é\n -->\t<launch>\n\té😀<node/><node\n  a="1"/>\n</launch>'
    assert places(root(text)) == [("launch", 3, 6), ("node", 4, 4), ("node", 4, 11)]


def test_the_declared_encoding_does_not_count_for_decoded_text() -> None:
    assert root('<?xml version="1.0" encoding="iso-8859-1"?><launch a="é"/>').get("a") == "é"


def test_text_knows_its_lines_across_comments_and_cdata() -> None:
    (body,) = root("<launch>\n <rosparam>a: 1\n<!-- x\n\n-->b: 2\n<![CDATA[c: <]]>\n</rosparam></launch>").children
    assert body.text == "a: 1\nb: 2\nc: <\n"
    assert body.text_lines == ((0, 2), (5, 5))


def test_blank_text_is_none() -> None:
    assert root("<launch>\n  <group/>\n</launch>").text == ""


BAD = "the launch file is not well-formed XML: {}; correct it"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 1, BAD.format("no element found")),
        ("<launch>\n<node>\n</launch>", 3, BAD.format("mismatched tag, while <node> of line 2 is open")),
        ("<launch>\n<a><b/></a>\n<c>\n", 4, BAD.format("no element found, while <c> of line 3 is open")),
        (
            "<launch>\n<!-- <a/>\n<!-- b -->\n-->\n</launch>",
            3,
            BAD.format("a comment inside of the comment that begins in line 2"),
        ),
        ("<launch>\n&bomb;</launch>", 2, BAD.format("undefined entity")),
        (
            "<launch>\n<a b='1 & 2'/></launch>",
            2,
            BAD.format(
                "not well-formed (invalid token) (such as & or < in a text, which are &amp; and &lt;, or an attribute without quotes)"
            ),
        ),
        (
            "<launch/>\n<launch/>",
            2,
            BAD.format("junk after document element (something stands behind the end of <launch>)"),
        ),
        ('<a b="1" b="2"/>', 1, BAD.format("duplicate attribute (one stands twice in this tag)")),
        (
            '<!DOCTYPE a [<!ENTITY b "c">]>\n<a>&b;</a>',
            1,
            "a document type or entity declaration is not allowed; remove it",
        ),
        ("<!DOCTYPE launch>\n<launch/>", 1, "a document type or entity declaration is not allowed; remove it"),
        ("<a>" * (MAX_DEPTH + 1), 1, "tags nested deeper than 100 levels; flatten the file"),
    ],
)
def test_what_is_no_launch_file_is_a_problem(text: str, line: int, message: str) -> None:
    assert read_launch(text) == LaunchFile(None, ((line, message),))


def test_too_many_tags() -> None:
    assert read_launch("<a>" + "<b/>" * 100_000 + "</a>").problems == ((1, "more than 100000 tags; split the file"),)


@pytest.mark.parametrize("text", ["<launch>\udc80</launch>", "\x00", "<a\x0b/>", "<a>\ue000</a>", "<é/>"])
def test_odd_characters_never_raise(text: str) -> None:
    read_launch(text)


@pytest.mark.parametrize("text", ['<launch a="1">\n<rosparam>x: 1</rosparam><a><b/></a></launch>', "<launch>", ""])
def test_json_there_and_back(text: str) -> None:
    launch = read_launch(text)
    assert from_json(json.loads(json.dumps(to_json(launch)))) == launch


@pytest.mark.parametrize(
    "value",
    [
        None,
        {},
        [],
        [None],
        [None, None],
        [None, [["1", "x"]]],
        [None, [[True, "x"]]],
        [["launch", 1, 1, [], "", []], []],
        [["launch", "1", 1, [], "", [], []], []],
        [["launch", 1, 1, [["a"]], "", [], []], []],
        [["launch", 1, 1, [], "", [], [1]], []],
    ],
)
def test_json_of_another_shape_is_no_launch_file(value: object) -> None:
    assert from_json(value) is None


def test_json_that_is_nested_too_deeply_is_no_launch_file() -> None:
    value: list[object] = ["a", 1, 1, [], "", [], []]
    for _ in range(2 * MAX_DEPTH):
        value = ["a", 1, 1, [], "", [], [value]]
    assert from_json([value, []]) is None
