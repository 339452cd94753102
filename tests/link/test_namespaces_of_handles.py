# SPDX-License-Identifier: Apache-2.0
"""roscpp remaps the namespace of a handle where it is constructed (NodeHandle::construct in roscpp/src/libros/node_handle.cpp)."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

MAKE = 'h.advertise<std_msgs::String>("x", 1);'


def _made(handle: str, *remaps: str, space: str = "") -> list[str]:
    rules = "".join(f'<remap from="{source}" to="{target}"/>' for source, target in (r.split(" ") for r in remaps))
    launch = (
        f'<launch><node pkg="p" type="n" name="n"{space and f" ns={chr(34)}{space}{chr(34)}"}>{rules}</node></launch>'
    )
    return names(cpp(f"{handle}\n{MAKE}", launch=launch))


@pytest.mark.parametrize(
    ("handle", "remaps", "expected"),
    [
        ('ros::NodeHandle h("sub");', ("sub b/sub",), "/b/sub/x"),
        ('ros::NodeHandle h = ros::NodeHandle("sub");', ("sub /b",), "/b/x"),
        ('ros::NodeHandle h("/sub");', ("sub b/sub",), "/b/sub/x"),
        ('ros::NodeHandle h("~sub");', ("~sub b",), "/b/x"),
        ('ros::NodeHandle h("~");', ("~ b",), "?"),
        ('ros::NodeHandle h(nh, "sub");', ("sub b",), "/b/x"),
        ('ros::NodeHandle h(ros::NodeHandle("a"), "sub");', ("a b", "b/sub c"), "/c/x"),
        ('ros::NodeHandle h(ros::NodeHandle("~"), "sub");', ("~sub b",), "/b/x"),
        # the name in full is looked up again, as it is then
        ('ros::NodeHandle h("sub");', ("sub b", "b/x c"), "/c"),
        ('ros::NodeHandle h("sub");', ("sub b", "sub/x c"), "/b/x"),
        # once more with each copy of the handle: what it is then is not known
        ('ros::NodeHandle h("sub");', ("sub b", "b c"), "?"),
    ],
)
def test_remapped(handle: str, remaps: tuple[str, ...], expected: str) -> None:
    (found,) = _made(handle, *remaps)
    assert found == expected if expected != "?" else "?" in found


@pytest.mark.parametrize(
    ("handle", "remaps", "expected"),
    [
        # not by parts, and not by the beginning of a name
        ('ros::NodeHandle h("sub/deep");', ("sub b",), "/sub/deep/x"),
        ('ros::NodeHandle h("subs");', ("sub b",), "/subs/x"),
        ('ros::NodeHandle h("sub");', ("sub/x b",), "/b"),
        ('ros::NodeHandle h(ros::NodeHandle("a"), "sub");', ("sub b",), "/a/sub/x"),
        ('ros::NodeHandle h(ros::NodeHandle("a"), "/sub");', ("a b",), "/sub/x"),
        ('ros::NodeHandle h("/sub");', ("~sub b",), "/sub/x"),
        ('ros::NodeHandle h("~sub");', ("sub b",), "/n/sub/x"),
        ('ros::NodeHandle h("~");', ("sub b", "x c"), "/n/x"),
        # a handle without a namespace of its own
        ("ros::NodeHandle h;", ("sub b",), "/x"),
        ('ros::NodeHandle h("");', ("x b",), "/b"),
        ("ros::NodeHandle h(nh);", ("x b",), "/b"),
        # to itself, or nothing
        ('ros::NodeHandle h("sub");', ("sub sub",), "/sub/x"),
        ('ros::NodeHandle h("sub");', (), "/sub/x"),
        ("ros::NodeHandle h(name());", ("sub b",), "/?/x"),
    ],
)
def test_as_it_is(handle: str, remaps: tuple[str, ...], expected: str) -> None:
    assert _made(handle, *remaps) == [expected]


def test_a_private_name_below_a_handle_throws() -> None:
    (found,) = _made('ros::NodeHandle h(nh, "~sub");')
    assert "?" in found


def test_in_a_group() -> None:
    assert _made('ros::NodeHandle h("sub");', "sub b", space="g") == ["/g/b/x"]
    assert _made("ros::NodeHandle h;", "sub b", space="g") == ["/g/x"]
