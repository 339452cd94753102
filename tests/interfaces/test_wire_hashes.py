# SPDX-License-Identifier: Apache-2.0
"""Hashes against those that ROS itself published: in its headers, its documentation, and other projects' recordings of it."""

from __future__ import annotations

import pytest

from haros_ci.interfaces.definitions import Definitions, field_type
from haros_ci.interfaces.hashes import wire_hash
from haros_ci.interfaces.md5 import action_messages, md5
from haros_ci.interfaces.rihs import descriptions, hash_of, rihs01
from haros_ci.model.build import Interface
from haros_ci.workspace.interfaces import read_interface

OLD, NEW = Definitions((), 1), Definitions((), 2)


def read(path: str, text: str, package: str = "demo") -> Interface:
    return read_interface(path, text, package)[0]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("msg std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"),
        ("msg std_msgs/Header", "2176decaecbce78abc3b96ef049fabed"),
        ("msg std_msgs/Empty", "d41d8cd98f00b204e9800998ecf8427e"),
        ("msg geometry_msgs/Twist", "9f195f881246fdfa2798d1d3eebca84a"),
        ("msg geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"),
        ("msg sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"),
        ("msg sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369"),
        ("msg nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"),
        ("msg diagnostic_msgs/DiagnosticArray", "60810da900de1dd6ddd437c3503511da"),
        ("srv std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16"),
        ("srv std_srvs/Empty", "d41d8cd98f00b204e9800998ecf8427e"),
        ("srv nav_msgs/GetMap", "6cdd0a18e0aff5b0a3ca2326a89b54ff"),
        ("action nav_msgs/GetMap", "e611ad23fbf237c031b7536416dc7cd7"),
    ],
)
def test_ros_1(name: str, expected: str) -> None:
    found = OLD.find(*name.split())
    assert found is not None
    assert md5(found, OLD) == wire_hash(found, OLD) == expected


FIBONACCI = (
    "#goal definition\nint32 order\n---\n#result definition\nint32[] sequence\n---\n#feedback\nint32[] sequence\n"
)


def test_the_seven_messages_of_an_action_of_ros_1() -> None:
    found = read("action/Fibonacci.action", FIBONACCI, "actionlib_tutorials")
    assert action_messages(found, OLD) == {
        "Action": "f59df5767bf7634684781c92598b2406",
        "ActionGoal": "006871c7fa1d0e3d5fe2226bf17b2a94",
        "ActionResult": "bee73a9fe29ae25e966e105f5553dd03",
        "ActionFeedback": "73b8497a9f629a31c0020900e4148f07",
        "Goal": "6889063349a00b249bd1661df429d822",
        "Result": "b81e37d2a31925a0e8ae261a8699cb79",
        "Feedback": "b81e37d2a31925a0e8ae261a8699cb79",
    }


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("msg std_msgs/String", "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"),
        ("msg std_msgs/Empty", "20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312"),
        ("msg std_msgs/Header", "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01"),
        ("msg builtin_interfaces/Duration", "e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b"),
        ("msg geometry_msgs/Twist", "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"),
        ("msg geometry_msgs/AccelWithCovariance", "230d51bd53bc36f260574e73b42941cefe44684753480b6fc330c032c5db5997"),
        ("msg sensor_msgs/Image", "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"),
        ("msg rosgraph_msgs/Clock", "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"),
        ("msg action_msgs/GoalStatusArray", "6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e"),
        ("srv example_interfaces/AddTwoInts", "e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"),
    ],
)
def test_ros_2(name: str, expected: str) -> None:
    found = NEW.find(*name.split())
    assert found is not None
    assert rihs01(found, NEW) == wire_hash(found, NEW) == f"RIHS01_{expected}"


@pytest.mark.parametrize(
    ("name", "part", "expected"),
    [
        (
            "action example_interfaces/Fibonacci",
            "_SendGoal_Request",
            "3d088942b413247db536576f0286768c6be8fcd5d0c9a5d544f359fba090a238",
        ),
        (
            "action example_interfaces/Fibonacci",
            "_GetResult_Request",
            "c8a4f5e7d13b81286ee1043e2ecd084281cecf1ff06aaa799464f5f15479f003",
        ),
        (
            "action example_interfaces/Fibonacci",
            "_FeedbackMessage",
            "c1de71afd52e49a89c53d8262366884185bc0a02f78ce051c4e46b0a7fe59bb2",
        ),
        (
            "action example_interfaces/Fibonacci",
            "",
            "9508051da1ea4658de144b09bd0690ff3de52104683d847aed764d2915906f51",
        ),
        (
            "srv action_msgs/CancelGoal",
            "_Request",
            "3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af",
        ),
    ],
)
def test_parts_of_services_and_actions_of_ros_2(name: str, part: str, expected: str) -> None:
    kind, _, of = name.partition(" ")
    found = NEW.find(kind, of)
    assert found is not None
    package, _, short = of.partition("/")
    described = descriptions(found, NEW)
    assert described is not None
    assert hash_of(f"{package}/{kind}/{short}{part}", described) == f"RIHS01_{expected}"


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("int32 x", "int32   x   # metres\n\n# more"),
        ("int32 x\nint32 A=1", "int32 A = 1\nint32 x"),
        ("char c", "char  c"),
        ("float64[3] v", "float64[3] v  "),
    ],
)
def test_what_changes_no_hash(one: str, other: str) -> None:
    for known in (OLD, NEW):
        first, second = (wire_hash(read("msg/A.msg", text), Definitions((), known.ros)) for text in (one, other))
        assert first is not None and first == second


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("int32 x", "int64 x"),
        ("int32 x", "int32 y"),
        ("int32 x\nint32 y", "int32 y\nint32 x"),
        ("int32[3] x", "int32[4] x"),
        ("int32[] x", "int32 x"),
        ("std_msgs/Header h", "std_msgs/String h"),
    ],
)
def test_what_changes_both_hashes(one: str, other: str) -> None:
    for known in (OLD, NEW):
        first, second = (wire_hash(read("msg/A.msg", text), Definitions((), known.ros)) for text in (one, other))
        assert first is not None and second is not None and first != second


def test_what_changes_one_hash() -> None:
    def of(text: str, ros: int) -> str | None:
        return wire_hash(read("msg/A.msg", text), Definitions((), ros))

    assert of("int32 A=1", 1) != of("int32 A=2", 1)
    assert of("int32 A=1", 2) == of("int32 A=2", 2) == of("", 2)
    assert of("int32 x 1", 2) == of("int32 x", 2)
    assert of("string<=9 x", 2) != of("string<=8 x", 2) != of("string x", 2)
    assert of("int32[<=9] x", 2) != of("int32[9] x", 2)
    assert of("std_msgs/Header[] h", 1) == of("std_msgs/Header h", 1), "genmsg leaves brackets of nested types out"


def test_a_nested_type_of_the_workspace() -> None:
    inner, outer = read("msg/Inner.msg", "int32 x"), read("msg/Outer.msg", "Inner inner\nstd_msgs/Header header")
    for ros in (1, 2):
        alone = wire_hash(outer, Definitions((outer,), ros))
        known = wire_hash(outer, Definitions((inner, outer), ros))
        other = wire_hash(outer, Definitions((read("msg/Inner.msg", "int32 y"), outer), ros))
        assert alone is None and known is not None and other not in (None, known)


@pytest.mark.parametrize(
    ("text", "ros"),
    [
        ("other_pkg/Thing x", 1),
        ("other_pkg/Thing x", 2),
        ("A a", 1),  # contains itself
        ("time stamp", 2),
        ("Header header", 2),  # a type of the package itself, which has none
        ("sensor_msgs/Range range", 2),  # not the same in all distributions
        ("std_msgs/NoSuchMessage x", 2),
        ("int32 x\n<?>", 1),
        ("int32 x\n<?>", 2),
        ("string<=3 x", 1),
        ("int32[<=3] x", 1),
        ("int32 x 5", 1),
    ],
)
def test_an_unknown_part_leaves_no_hash(text: str, ros: int) -> None:
    found = read("msg/A.msg", text)
    assert wire_hash(found, Definitions((found,), ros)) is None


def test_two_different_definitions_of_one_name_leave_no_hash() -> None:
    outer = read("msg/Outer.msg", "Inner inner")
    both = (read("msg/Inner.msg", "int32 x"), read("msg/Inner.msg", "int32 y"), outer)
    assert wire_hash(outer, Definitions(both, 2)) is None
    same = (read("msg/Inner.msg", "int32 x"), read("other/Inner.msg", "int32 x # again"), outer)
    assert wire_hash(outer, Definitions(same, 2)) is not None


def test_a_package_of_the_workspace_hides_the_common_one() -> None:
    outer = read("msg/Outer.msg", "std_msgs/Header header")
    own = read("msg/Other.msg", "int32 x", "std_msgs")
    assert wire_hash(outer, Definitions((own, outer), 2)) is None


def test_parts_of_a_type() -> None:
    kind = field_type("string<=10[<=5]")
    assert kind is not None
    assert (kind.base, kind.length, kind.form, kind.size, kind.is_nested) == ("string", 10, "bounded", 5, False)
    assert field_type("a b") is None
