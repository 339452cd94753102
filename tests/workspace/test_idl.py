# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.hashes import wire_hash
from haros_ci.model.build import Interface
from haros_ci.workspace.interfaces import read_interface

WHOLE = """// generated from rosidl_adapter
#include "geometry_msgs/msg/Pose.idl"

module arm {
  module msg {
    typedef double double__36[36];
    module Grip_Constants {
      const uint8 OPEN = 0;
      @verbatim (language="comment", text="a (word)" "\\n more")
      const string NAME = "grip";
    };
    @verbatim (language="comment", text=
      "What it is.")
    struct Grip {
      geometry_msgs::msg::Pose pose;
      @unit (value="m")
      @default (value=1.5)
      double width;
      double__36 covariance;
      sequence<arm::msg::Finger> fingers;
      sequence<float, 5> forces; /* at most */
      sequence<string<9>> names;
      wstring label;
      boolean is_on, is_hot;
      octet raw[4];
    };
  };
};
"""


def read(text: str, path: str = "arm/msg/Grip.idl") -> Interface:
    found, problems = read_interface(path, text, "arm")
    assert problems == []
    return found


def test_a_message() -> None:
    found = read(WHOLE)
    assert found.is_whole and found.kind == "msg"
    assert [(f.type, f.name, f.default, f.line) for f in found.sections[0]] == [
        ("uint8", "OPEN", 0, 8),
        ("string", "NAME", '"grip"', 10),
        ("geometry_msgs/Pose", "pose", None, 15),
        ("float64", "width", 1.5, 18),
        ("float64[36]", "covariance", None, 19),
        ("arm/Finger[]", "fingers", None, 20),
        ("float32[<=5]", "forces", None, 21),
        ("string<=9[]", "names", None, 22),
        ("wstring", "label", None, 23),
        ("bool", "is_on", None, 24),
        ("bool", "is_hot", None, 24),
        ("byte[4]", "raw", None, 25),
    ]
    assert [f.is_constant for f in found.sections[0][:3]] == [True, True, False]


def wrap(inner: str, kind: str = "msg") -> str:
    return f"module arm {{ module {kind} {{ {inner} }}; }};"


def test_parts() -> None:
    text = wrap("struct Go_Request { int8 a; }; struct Go_Response { int8 b; };", "srv")
    assert [[f.name for f in part] for part in read(text, "arm/srv/Go.idl").sections] == [["a"], ["b"]]
    text = wrap("struct Go_Goal {int8 a;}; struct Go_Result {int8 b;}; struct Go_Feedback {int8 c;};", "action")
    assert [[f.name for f in part] for part in read(text, "arm/action/Go.idl").sections] == [["a"], ["b"], ["c"]]


@pytest.mark.parametrize(
    "inner",
    [
        "struct Grip { char c; };",  # another type than a .msg's
        "struct Grip { long l; };",
        "struct Grip { sequence<sequence<double>> x; };",
        "struct Grip { double x[2][3]; };",
        "struct Grip { Other x; };",
        "struct Grip { int8 x };",
        "struct Grip { int8 x;",
        "struct Other { int8 x; };",
        "struct Grip { int8 x; }; struct Other { int8 x; };",
        "enum Color { RED }; struct Grip { int8 x; };",
        "module Other_Constants { const int8 A = 1; }; struct Grip { int8 x; };",
        "@verbatim (struct Grip { int8 x; };",
        "",
    ],
)
def test_what_is_not_of_the_form(inner: str) -> None:
    found = read(wrap(inner))
    assert not found.is_whole and found.sections == ((),)
    assert wire_hash(found, Definitions((found,), 2)) is None


def test_depth_is_bounded() -> None:
    assert not read("module a { " * 5_000).is_whole


@pytest.mark.parametrize(
    ("idl", "msg"),
    [
        ("struct Grip { uint8 structure_needs_at_least_one_member; };", ""),
        ("struct Grip { std_msgs::msg::Header header; double x; };", "std_msgs/Header header\nfloat64 x"),
        ("struct Grip { sequence<int8, 4> x; string<7> y; };", "int8[<=4] x\nstring<=7 y"),
    ],
)
def test_the_hash_is_that_of_the_message(idl: str, msg: str) -> None:
    found = wire_hash(read(wrap(idl)), Definitions((), 2))
    other = wire_hash(read_interface("arm/msg/Grip.msg", msg, "arm")[0], Definitions((), 2))
    assert found is not None and found == other
