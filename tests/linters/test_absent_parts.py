# SPDX-License-Identifier: Apache-2.0
"""Parts of robot descriptions under conditions that never hold are named where a change brings the condition."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.absent_parts import absent, notifications

JOINT = '<joint name="elbow" type="fixed"/>'
FIRES = {
    "a literal": ("", '<xacro:if value="false">'),
    "a number": ("", '<xacro:if value="0">'),
    "an expression": ("", '<xacro:if value="${False}">'),
    "a comparison": ("", "<xacro:if value=\"${'a' == 'b'}\">"),
    "greater": ("", '<xacro:if value="${1 > 2}">'),
    "not": ("", '<xacro:if value="${not true}">'),
    "and with what is not known": ("", '<xacro:if value="${side and false}">'),
    "unless": ("", '<xacro:unless value="${1 == 1}">'),
    "unless or": ("", '<xacro:unless value="${side or 1}">'),
    "a property": ('<xacro:property name="has" value="false"/>', '<xacro:if value="${has}">'),
    "a property that is compared": ('<xacro:property name="n" value="2"/>', '<xacro:unless value="${n &lt; 3}">'),
    "below one that is not known": ('<xacro:if value="$(arg side)">', '<xacro:if value="${0}">'),
    "over lines": ("", '<xacro:if\n  value = "${ 1\n== 2 }"\n>'),
}
QUIET = {
    "an argument": ('<xacro:arg name="has" default="false"/>', '<xacro:if value="$(arg has)">'),
    "an argument by a property": ('<xacro:property name="has" value="$(arg has)"/>', '<xacro:if value="${has}">'),
    "true": ("", '<xacro:if value="true">'),
    "unless false": ("", '<xacro:unless value="${false}">'),
    "the environment": ("", '<xacro:if value="$(optenv HAS false)">'),
    "a name from elsewhere": ("", '<xacro:if value="${has}">'),
    "a parameter of a macro": (
        '<xacro:property name="has" value="false"/><xacro:macro name="m" params="has:=true">',
        '<xacro:if value="${has}">',
    ),
    "set twice": (
        '<xacro:property name="has" value="false"/><xacro:property name="has" value="true"/>',
        '<xacro:if value="${has}">',
    ),
    "by default": ('<xacro:property name="has" default="false"/>', '<xacro:if value="${has}">'),
    "in a scope": ('<xacro:property name="has" value="false" scope="parent"/>', '<xacro:if value="${has}">'),
    "a file that may set it": (
        '<xacro:property name="has" value="false"/><xacro:include filename="a.xacro"/>',
        '<xacro:if value="${has}">',
    ),
    "a text and a number": ("", "<xacro:if value=\"${'1' == 1}\">"),
    "a call": ("", "<xacro:if value=\"${len('') > 0}\">"),
    "several at once": ("", '<xacro:if value="${a}${b}">'),
    "no expression": ("", '<xacro:if value="${(}">'),
    "no value": ("", "<xacro:if>"),
    "in a comment": ("<!--", '<xacro:if value="false"> -->'),
    "a condition of another language": ("", '<if value="false">'),
    "nothing under it": ("", '<xacro:if value="false"/>'),
}


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    before, condition = FIRES[name]
    kind = condition[1:].split()[0]
    text = f"<robot>\n{before}\n{condition}{JOINT}<xacro:arm a='>'/></{kind}></robot>"
    assert [(line, parts) for line, _, parts in absent(text)] == [(3, "1 <joint>, 1 <xacro:arm>")]


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    before, condition = QUIET[name]
    assert list(absent(f'<robot xmlns:xacro="x">\n{before}\n{condition}{JOINT}</xacro:if></robot>')) == []


def test_what_is_no_part_and_what_stands_beside() -> None:
    text = '<robot><xacro:if value="0"><xacro:property name="a" value="1"/><material/></xacro:if>' + JOINT
    assert list(absent(text)) == []
    assert list(absent('<xacro:if value="0"><!--' + JOINT + "--></xacro:if>")) == []
    nested = f'<xacro:if value="0">\n<xacro:if value="0">{JOINT}</xacro:if>{JOINT}</xacro:if>{JOINT}'
    assert [(line, parts) for line, _, parts in absent(nested)] == [(1, "2 <joint>")]


def test_what_a_change_brings(tmp_path: Path) -> None:
    def said(place: str, base: str, head: str) -> list[tuple[int | None, str]]:
        sides = [
            workspace(tmp_path / place / side, {"arm/urdf/arm.urdf": text}) for side, text in (("b", base), ("h", head))
        ]
        assert notifications(sides[1], None) == ()
        return [(note.line, note.message) for note in notifications(sides[1], sides[0])]

    hidden = f'<robot>\n<xacro:if value="${{false}}">{JOINT}</xacro:if></robot>'
    ((line, message),) = said("1", f"<robot>\n{JOINT}</robot>", hidden)
    assert line == 2
    assert message == (
        'since this change <xacro:if value="${false}"> leaves out 1 <joint>: the condition never holds, and no check sees them'
    )
    assert said("2", hidden, f"<!-- arm -->\n{hidden}") == []
    switched = (
        '<robot><xacro:property name="has" value="{}"/><xacro:if value="${{has}}">' + JOINT + "</xacro:if></robot>"
    )
    assert len(said("3", switched.format("true"), switched.format("false"))) == 1
    assert said("4", switched.format("false"), switched.format("true")) == []


def test_a_long_file_takes_linear_time() -> None:
    assert len(list(absent(f'<xacro:if value="0">{JOINT}</xacro:if>\n' * 20_000))) == 20_000
    assert list(absent('<xacro:if value="1">' * 50_000 + JOINT * 50_000)) == []
    assert list(absent("xacro:" + '<a b="' * 50_000 + "<!--" * 50_000)) == []
