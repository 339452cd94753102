# SPDX-License-Identifier: Apache-2.0
"""What texts of launch files name, whatever stands in them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.launch.facts.texts import absolute_paths, is_file_name, named_files, named_packages, without_comments


@pytest.mark.parametrize("path", ["a.yaml", "/x/a.launch.py", "$(find p)/a.b.c", "a-b.rviz"])
def test_names_of_files(path: str) -> None:
    assert is_file_name(path)


@pytest.mark.parametrize("path", ["", "a", "/x/", ".yaml", "/x/.hidden", "v1.2", "a.", "/x.d/a", "a.b c"])
def test_no_names_of_files(path: str) -> None:
    assert not is_file_name(path)


def test_files_and_packages_of_a_command_line() -> None:
    text = "xacro $(find-pkg-share p)/urdf/a.xacro use:=true -d '$(find-pkg-prefix q)/share/q/x.rviz',$(find r)"
    assert list(named_files(text)) == [
        ("$(find-pkg-share p)/urdf/a.xacro", True),
        ("$(find-pkg-prefix q)/share/q/x.rviz", True),
        ("$(find r)", True),
    ]
    assert list(named_packages(text)) == ["p", "q", "r"]


def test_a_file_of_which_a_part_is_not_known() -> None:
    assert list(named_files("$(find-pkg-share p)/a\ue000.yaml")) == [("$(find-pkg-share p)/a", False)]
    assert list(named_files("$(find-pkg-share p)/a_%d.yaml")) == [("$(find-pkg-share p)/a_", False)]
    assert list(named_files("no path, no $(env X)/a.yaml")) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('<!-- of 1.0 -->\n<?xml version="1.0"?>\n<robot/>', '\n<?xml version="1.0"?>\n<robot/>'),
        ("<robot><!-- $(find p)\n $(find q) --><link/></robot>", "<robot><link/></robot>"),
        ("a<!----><!-- b -->c<!--d-->", "ac"),
        ("a <!-- b", "a <!-- b"),
        ("a --> b", "a --> b"),
        ("$(find p)/a.yaml", "$(find p)/a.yaml"),
        ("", ""),
    ],
)
def test_a_text_without_the_comments_of_xml(text: str, expected: str) -> None:
    assert without_comments(text) == expected
    assert without_comments("<!--" * 5_000 + text[:0]) == "<!--" * 5_000


PARTS = st.lists(
    st.sampled_from(
        ("$(find p)", "$(find-pkg-share ", ")", "/", "~", "home", ".yaml", "'", '"', " ", "\ue000", "a", ":", "=")
    ),
    max_size=30,
)


@given(PARTS)
def test_any_text(parts: list[str]) -> None:
    text = "".join(parts)
    for path, _ in named_files(text):
        assert path.startswith("$(") and path in text
    for kind, path in absolute_paths(text):
        assert kind in ("home", "absolute") and path in text and path[0] in "/~"


def test_what_a_bridge_is_given_is_no_path() -> None:
    assert list(absolute_paths("/world/x/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock")) == []
    assert list(absolute_paths("/data/maps/clock.yaml")) == [("absolute", "/data/maps/clock.yaml")]


@pytest.mark.parametrize("part", ["/a", "'a", "a.", "~/", "$(find a)/", " ", "/home/a/"])
def test_long_texts(part: str) -> None:
    text = part * 20_000
    assert len(list(named_files(text))) <= 20_000
    assert len(list(absolute_paths(text))) <= 20_000
    assert isinstance(is_file_name(text), bool)
