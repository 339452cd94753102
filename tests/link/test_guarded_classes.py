# SPDX-License-Identifier: Apache-2.0
"""C++: a class that a header defines in both branches of an #if, with the bodies of one of them in another file."""

from __future__ import annotations

import pytest

from haros_ci.model.architecture import Node
from tests.link.follow_kit import cpp, names

HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
FULL = "class Driver { public: void init(); ros::NodeHandle nh_; ros::Publisher pub_; };\n"
EMPTY = 'class Driver { public: void init() { ROS_ERROR("built without the camera"); } };\n'
MAKES = 'pub_ = nh_.advertise<std_msgs::String>("image", 1);'
BODY = f"void Driver::init() {{ {MAKES} }}\n"
GUARDED = f'#include "driver.h"\n#ifndef NO_CAMERA\n{BODY}#endif\n'


def found(header: str, source: str) -> Node:
    return cpp("Driver d; d.init();", '#include "driver.h"\n', driver__h=HEAD + header, driver__cpp=source)


def incomplete(node: Node) -> list[str]:
    return [unknown.reason for unknown in node.unknowns if unknown.field == "endpoints"]


@pytest.mark.parametrize(
    "header",
    [
        f"#ifndef NO_CAMERA\n{FULL}#else\n{EMPTY}#endif\n",
        f"#ifdef NO_CAMERA\n{EMPTY}#else\n{FULL}#endif\n",
        f"#if defined(WITH_A)\n{EMPTY}#elif !defined(NO_CAMERA)\n{FULL}#endif\n",
        f"#pragma once\n#ifndef NO_CAMERA\n{FULL}#else\n{EMPTY}#endif\n",
        f"#ifndef H\n#define H\n#ifndef NO_CAMERA\n{FULL}#else\n{EMPTY}#endif\n#endif\n",
    ],
)
@pytest.mark.parametrize("source", [GUARDED, f'#include "driver.h"\n{BODY}'])
def test_the_definition_in_another_file_is_followed(header: str, source: str) -> None:
    node = found(header, source)
    assert (names(node), incomplete(node)) == (["/image"], [])
    assert [end.location.path for end in node.endpoints if end.location] == ["p/src/driver.cpp"]


def test_what_is_not_followed_is_said_to_be_missing() -> None:
    other = (
        'class Driver { public: void init() { nh_.advertise<std_msgs::String>("plain", 1); } ros::NodeHandle nh_; };\n'
    )
    node = found(f"#ifndef NO_CAMERA\n{FULL}#else\n{other}#endif\n", GUARDED)
    assert names(node) == ["/image"]
    assert incomplete(node) == ["Driver::init is defined in two branches of an #if, and only one of them is followed"]


@pytest.mark.parametrize(
    ("header", "source"),
    [
        (FULL, f'#include "driver.h"\n{BODY}'),
        (FULL, GUARDED),
        (FULL + f"inline {BODY}", '#include "driver.h"\n'),
        (f"#ifndef NO_CAMERA\n{FULL}inline {BODY}#endif\n", '#include "driver.h"\n'),
        (f"#ifndef NO_CAMERA\n{FULL}#endif\n", GUARDED),
        (f"#ifndef H\n#define H\n{FULL}#endif\n", GUARDED),
        (f"#ifndef NO_CAMERA\n{FULL.replace('init();', 'init() { ' + MAKES + ' }')}#else\n{EMPTY}#endif\n", ""),
        (FULL.replace("init();", "init(); void init(int);"), GUARDED + "void Driver::init(int) {}\n"),
    ],
)
def test_one_definition_is_the_definition(header: str, source: str) -> None:
    node = found(header, source)
    assert (names(node), incomplete(node)) == (["/image"], [])


@pytest.mark.parametrize("header", [EMPTY, f"#ifndef NO_CAMERA\n{EMPTY}#else\n{EMPTY}#endif\n"])
def test_a_class_that_makes_nothing_makes_nothing(header: str) -> None:
    node = found(header, "")
    assert (names(node), incomplete(node)) == ([], [])
