# SPDX-License-Identifier: Apache-2.0
"""What a change of definitions does: each kind of change, and what is none."""

from __future__ import annotations

import pytest

from haros_ci.changes.interfaces import Defined, InterfaceChange, containing, in_words, interface_changes
from haros_ci.workspace.interfaces import read_interface


def defined(files: dict[str, str], ros: int | None = 2, package: str = "demo") -> list[Defined]:
    return [(read_interface(path, text, package)[0], ros) for path, text in files.items()]


def changes(before: str, after: str, ros: int | None = 2, path: str = "msg/Pose.msg") -> tuple[InterfaceChange, ...]:
    return interface_changes(defined({path: before}, ros), defined({path: after}, ros))


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("float64 x\nfloat64 y", "float64 x", [("field-removed", "y", "float64", "", 1)]),
        ("float64 x", "float64 x\nfloat64 y", [("field-added", "y", "", "float64", 2)]),
        ("float64 x\nint8 a", "float64 x\nfloat64 y\nint8 a", [("field-added", "y", "", "float64", 2)]),
        ("float64 x", "float32 x", [("field-retyped", "x", "float64", "float32", 1)]),
        ("float64 x", "float64[] x", [("field-retyped", "x", "float64", "float64[]", 1)]),
        ("float64[3] x", "float64[4] x", [("field-retyped", "x", "float64[3]", "float64[4]", 1)]),
        ("float64 x\nint8 a", "int8 a\nfloat64 x", [("field-moved", "a", "", "", 1)]),
        ("float64 x\nint8 a", "float64 y\nint8 a", [("field-renamed", "x", "x", "y", 1)]),
        ("float64 x\nint8 a", "int8 a\nfloat64 y", [
            ("field-added", "y", "", "float64", 2), ("field-removed", "x", "float64", "", 1),
        ]),
        ("string<=9 s", "string<=8 s", [("bound", "s", "string<=9", "string<=8", 1)]),
        ("string s", "string<=8 s", [("bound", "s", "string", "string<=8", 1)]),
        ("int8[<=2] s", "int8[] s", [("bound", "s", "int8[<=2]", "int8[]", 1)]),
        ("int8 A=1", "int8 A=2", [("constant-value", "A", "1", "2", 1)]),
        ("int8 A=1\nint8 B=2", "int8 B=2", [("constant-removed", "A", "int8 = 1", "", 1)]),
        ("int8 A=1", "int8 B=1", [("constant-renamed", "A", "A", "B", 1)]),
    ],
)  # fmt: skip
def test_what_breaks(before: str, after: str, expected: list[tuple[str, str, str, str, int]]) -> None:
    for ros in (1, 2, None):
        found = sorted(changes(before, after, ros), key=lambda each: each.what)
        assert [(c.what, c.field, c.before, c.after, c.location.line) for c in found] == expected
        assert all(c.is_breaking and c.is_in_head and c.name == "demo/Pose" and c.part == "" for c in found)
        if ros == 1 and "<=" not in before + after:
            assert all(c.hash_before and c.hash_after and c.hash_before != c.hash_after for c in found)
        if ros is None:
            assert all(c.hash_before is None for c in found)


@pytest.mark.parametrize(
    ("before", "after", "what", "breaks"),
    [
        ("int8 A=1", "int8 A=1\nint8 B=2", "constant-added", (True, False)),
        ("int8 A=16", "int8 A=0x10", "constant-value", (True, None)),
        ("int8 A=1", "uint8 A=1", "constant-retyped", (True, False)),
        ("int8 A=1\nint8 B=2", "int8 B=2\nint8 A=1", "constant-moved", (True, None)),
        ("char c", "uint8 c", "field-retyped", (True, None)),
        ("int8 x 1", "int8 x 2", "default", (False, False)),
        ("int8 x", "int8 x 2", "default", (False, False)),
    ],
)
def test_what_breaks_in_one_ros(before: str, after: str, what: str, breaks: tuple[bool | None, bool | None]) -> None:
    """None: it is no change at all."""
    for ros, expected in zip((1, 2), breaks):
        assert [(c.what, c.is_breaking) for c in changes(before, after, ros)] == (
            [] if expected is None else [(what, expected)]
        )


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("float64 x", "float64 x"),
        ("float64 x", "# metres\nfloat64 x  # along\n\n"),
        ("float64 x\nint8 A=1", "int8 A = 1\nfloat64 x"),
        ("float64 x", "float64   x"),
        ("geometry_msgs/Pose p", "geometry_msgs/msg/Pose p"),
        ("demo/Other o", "Other o"),
        ("float64 x", "float64 x\n<?>"),  # not read
        ("<?>", "float64 x"),
        ("", "# nothing"),
    ],
)
def test_what_is_no_change(before: str, after: str) -> None:
    assert [changes(before, after, ros) for ros in (1, 2, None)] == [(), (), ()]


def test_parts() -> None:
    (change,) = changes("int8 a\n---\nint8 b", "int8 a\n---\nint16 b", path="srv/Get.srv")
    assert (change.kind, change.part, change.field, change.location.line) == ("srv", "response", "b", 3)
    assert change.hash_before is not None and change.hash_after is not None
    (change,) = changes("---\n---\nint8 b", "---\n---\n", path="action/Go.action")
    assert (change.kind, change.part, change.what) == ("action", "feedback", "field-removed")


def test_whole_interfaces() -> None:
    before = defined({"msg/Same.msg": "int8 x", "msg/Old.msg": "int16 x", "msg/Gone.msg": "int32 x"})
    after = defined({"msg/Same.msg": "int8 x", "msg/New.msg": "int16 x", "msg/Fresh.msg": "int64 x"})
    found = {change.what: change for change in interface_changes(before, after)}
    assert {what: (c.name, c.before, c.after, c.location.path) for what, c in found.items()} == {
        "added": ("demo/Fresh", "", "demo/Fresh", "msg/Fresh.msg"),
        "removed": ("demo/Gone", "demo/Gone", "", "msg/Gone.msg"),
        "renamed": ("demo/Old", "demo/Old", "demo/New", "msg/New.msg"),
    }
    assert {what: (c.is_breaking, c.is_in_head) for what, c in found.items()} == {
        "added": (False, True),
        "removed": (True, False),
        "renamed": (True, True),
    }
    assert found["removed"].hash_before and found["removed"].hash_after is None


def test_a_rename_is_certain_or_none() -> None:
    before = defined({"msg/A.msg": "int8 x", "msg/E.msg": ""})
    after = defined({"msg/B.msg": "int8 x", "msg/C.msg": "int8 x", "msg/F.msg": ""})
    assert sorted(c.what for c in interface_changes(before, after)) == ["added"] * 3 + ["removed"] * 2


def test_a_package_that_is_renamed_renames_its_interfaces() -> None:
    before = defined({"msg/A.msg": "int8 x"}, package="old_msgs")
    after = defined({"msg/A.msg": "int8 x"}, package="new_msgs")
    assert [(c.what, c.after) for c in interface_changes(before, after)] == [("renamed", "new_msgs/A")]


def test_what_is_not_generated_is_no_interface() -> None:
    def one(text: str, is_generated: bool) -> list[Defined]:
        return [(read_interface("msg/A.msg", text, "demo", is_generated=is_generated)[0], 2)]

    assert interface_changes(one("int8 x", False), one("int16 x", False)) == ()
    assert interface_changes(one("int8 x", True), one("int16 x", False)) == ()
    assert interface_changes(one("int8 x", False), []) == ()
    assert interface_changes([], one("int8 x", False)) == ()


def test_a_nested_change_is_told_once() -> None:
    outer = {"msg/Outer.msg": "Inner[] inner", "srv/Ask.srv": "---\nOuter outer", "msg/Other.msg": "int8 x"}
    before = defined({"msg/Inner.msg": "int8 x", **outer})
    after = defined({"msg/Inner.msg": "int16 x", **outer})
    assert [c.name for c in interface_changes(before, after)] == ["demo/Inner"]
    assert [each.name for each in containing(after, "demo/Inner")] == ["demo/Outer", "demo/Ask"]
    assert containing(after, "demo/Other") == ()


def test_words() -> None:
    said = [
        in_words(change)
        for before, after in (
            ("int8 x\nint8 y", "int8 x"),
            ("int8 x", "int16 x"),
            ("int8 x\nint8 y", "int8 y\nint8 x"),
            ("int8 x", "int8 y"),
            ("int8 x 1", "int8 x"),
            ("int8 A=1", "int8 A=2"),
            ("string<=3 s", "string<=2 s"),
        )
        for change in changes(before, after)
    ]
    assert said == [
        "field y removed (int8)",
        "field x: int8 → int16",
        "field y moved",
        "field x renamed to y",
        "default of field x: 1 → none",
        "constant A: 1 → 2",
        "field s: string<=3 → string<=2",
    ]
    (change,) = changes("int8 a\n---\n", "---\n", path="srv/Get.srv")
    assert in_words(change) == "field a of the request removed (int8)"
