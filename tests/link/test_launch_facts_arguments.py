# SPDX-License-Identifier: Apache-2.0
"""Launch arguments, includes, conditions and constructs as facts; what is not certain is None."""

from __future__ import annotations

import pytest
from launch_facts_kit import CMAKE, facts, ros1

from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    ConditionUse,
    ConstructUse,
    IncludeUse,
)

SUB = '<include file="$(dirname)/b.launch.xml"/>'
NODE = '<node pkg="p" exec="n" {}/>'


def used(body: str, files: dict[str, str] | None = None, name: str = "a.launch.xml") -> dict[str, bool | None]:
    return {fact.name: fact.is_used for fact in facts(ArgumentDeclaration, body, files, name=name)}


def sub(text: str) -> dict[str, str]:
    return {"p/launch/b.launch.xml": f"<launch>{text}</launch>"}


ARG = '<arg name="x" default="1"/>'
USED = [
    pytest.param(ARG + NODE.format(""), {}, False, id="nothing-reads-it"),
    pytest.param(ARG + NODE.format('namespace="$(var x)"'), {}, True, id="read"),
    pytest.param(ARG + NODE.format('output="$(var x)"'), {}, True, id="read-in-what-is-not-followed"),
    pytest.param(ARG + NODE.format('if="false" name="$(var x)"'), {}, True, id="read-where-nothing-is-started"),
    pytest.param(ARG + SUB, sub(NODE.format('name="$(var x)"')), True, id="read-in-an-include"),
    pytest.param(ARG + SUB, sub(ARG), True, id="declared-in-an-include"),
    pytest.param(ARG + SUB, sub(NODE.format("")), False, id="not-read-in-an-include"),
    pytest.param(ARG + '<include file="$(find-pkg-share q)/b.launch.xml"/>', {}, None, id="an-include-of-elsewhere"),
    pytest.param(ARG + '<include file="$(env WHERE)/b.launch.xml"/>', {}, None, id="an-unknown-include"),
    pytest.param(
        ARG + '<node pkg="p" exec="n"><param from="$(dirname)/b.yaml" allow_substs="true"/></node>',
        {"p/launch/b.yaml": "n:\n  ros__parameters:\n    a: $(var x)\n"},
        True,
        id="read-in-parameters",
    ),
]


@pytest.mark.parametrize(("body", "files", "expected"), USED)
def test_whether_an_argument_is_used(body: str, files: dict[str, str], expected: bool | None) -> None:
    found = facts(ArgumentDeclaration, body, files)
    assert [fact.is_used for fact in found if fact.is_top] == [expected]


def test_arguments_of_python() -> None:
    declared = "DeclareLaunchArgument('x', default_value='1', choices=['1', '2']),"
    (fact,) = facts(ArgumentDeclaration, declared + "Node(package='p', executable='n')", name="a.launch.py")
    assert (fact.name, fact.default, fact.choices, fact.is_used) == ("x", "1", ("1", "2"), False)
    read = declared + "Node(package='p', executable='n', namespace=LaunchConfiguration('x'))"
    assert used(read, name="a.launch.py") == {"x": True}
    assert used(declared + "OpaqueFunction(function=unknown)", name="a.launch.py") == {"x": None}
    assert used(declared + "LogInfo(msg=LaunchConfiguration('x'))", name="a.launch.py") == {"x": None}
    (needed,) = facts(ArgumentDeclaration, "DeclareLaunchArgument('x')", name="a.launch.py")
    assert needed.default is None


def test_arguments_of_ros1() -> None:
    tag = '<arg name="x" default="1"/>'
    node = '<node pkg="p" type="n" name="n" {}/>'

    def told(body: str) -> list[bool | None]:
        return [fact.is_used for fact in ros1(ArgumentDeclaration, tag + body)]

    assert told(node.format("")) == [False]
    assert told(node.format('ns="a$(arg x)"')) == [True]
    assert told(node.format('if="$(eval x == 1)"')) == [None]
    assert told('<include file="$(find q)/b.launch" pass_all_args="true"/>') == [None]
    assert told('<include file="$(find q)/b.launch"><arg name="x" value="1"/></include>') == [False]


READ = [
    (NODE.format('namespace="$(var x)"'), {}, ["x"]),
    (SUB, sub(NODE.format('namespace="$(var x)"')), ["x"]),
    (ARG + NODE.format('namespace="$(var x)"'), {}, []),
    ('<let name="x" value="1"/>' + NODE.format('namespace="$(var x)"'), {}, []),
    ('<arg name="x"/>' + NODE.format('namespace="$(var x)"'), {}, []),
    (NODE.format("namespace=\"$(var x 'y')\""), {}, []),
    (SUB + NODE.format('namespace="$(var x)"'), sub(ARG), []),
    (f"<group>{ARG}</group>" + NODE.format('namespace="$(var x)"'), {}, []),
    ('<include file="$(find-pkg-share q)/b.launch.xml"/>' + NODE.format('namespace="$(var x)"'), {}, []),
    (f'<group scoped="false" if="$(env E)">{ARG}</group>' + NODE.format('namespace="$(var x)"'), {}, []),
]


@pytest.mark.parametrize(("body", "files", "expected"), READ)
def test_what_is_read_but_never_set(body: str, files: dict[str, str], expected: list[str]) -> None:
    assert [fact.name for fact in facts(ArgumentRead, body, files)] == expected


def test_what_is_read_but_never_set_in_ros1() -> None:
    node = '<node pkg="p" type="n" name="n" ns="$(arg speeds)"/>'
    (fact,) = ros1(ArgumentRead, '<arg name="speed" default="1"/>' + node)
    assert (fact.name, fact.similar, fact.ros) == ("speeds", ("speed",), 1)
    assert ros1(ArgumentRead, '<arg name="speeds"/>' + node) == []
    assert ros1(ArgumentRead, '<arg name="speeds" default="1"/>' + node) == []


def test_an_include_and_its_arguments() -> None:
    body = '<include file="$(dirname)/b.launch.xml"><arg name="x" value="1"/><arg name="z" value="1"/></include>'
    (use,) = facts(IncludeUse, body, sub(f'{ARG}<arg name="y"/>' + NODE.format('name="$(var w)"')))
    assert [passed.name for passed in use.passed] == ["x", "z"]
    assert (use.declared, use.read, use.missing, use.is_whole) == (("x", "y"), ("w",), ("y",), True)
    (lost,) = facts(IncludeUse, body)
    assert (lost.path, lost.missing, lost.is_whole) == (None, (), False)
    deeper = {**sub('<include file="$(find-pkg-share q)/c.launch.xml"/>')}
    assert facts(IncludeUse, body, deeper)[0].is_whole is False


def test_an_include_of_ros1() -> None:
    body = '<include file="$(find p)/launch/b.launch">\n<arg name="z" value="1"/></include>'
    inner = {"p/launch/b.launch": '<launch><arg name="x"/><arg name="y"/><param name="a" value="$(arg x)"/></launch>'}
    (use,) = ros1(IncludeUse, body, inner)
    assert [(each.name, each.location.line) for each in use.passed] == [("z", 2)]
    assert (use.declared, use.missing, use.is_whole) == (("x", "y"), ("x",), True)
    (every,) = ros1(IncludeUse, body.replace("launch/b.launch", 'launch/b.launch" pass_all_args="true'), inner)
    assert every.is_whole is False


CONDITIONS = [
    ('if="true"', True, True),
    ('unless="1"', False, True),
    ("if=\"$(eval '1 == 1')\"", None, True),
    ('if="$(var x)"', True, False),
    ('if="$(not $(var x))"', False, False),
    ('if="$(env E)"', None, False),
]


@pytest.mark.parametrize(("attribute", "value", "constant"), CONDITIONS)
def test_conditions(attribute: str, value: bool | None, constant: bool) -> None:
    (fact,) = facts(ConditionUse, ARG + NODE.format(attribute))
    assert fact.is_constant is constant
    assert value is None or fact.value is value
    assert fact.statement == attribute.partition("=")[0]


def compared(body: str, name: str = "a.launch.xml") -> list[tuple[str, str, str, tuple[str, ...], bool]]:
    found = [each for fact in facts(ConditionUse, body, name=name) for each in fact.comparisons]
    return [(each.left, each.sign, each.right, each.values, each.is_quoted) for each in found]


def test_comparisons() -> None:
    arg = '<arg name="x" default="true"/>'
    quoted = "if=\"$(eval &quot;'$(var x)' == 'True'&quot;)\""
    assert compared(arg + NODE.format(quoted)) == [("$(var x)", "==", "True", ("true",), True)]
    bare = "if=\"$(eval &quot;$(var x) != 'True'&quot;)\""
    assert compared(arg + NODE.format(bare)) == [("$(var x)", "!=", "True", ("true",), False)]
    choices = '<arg name="x" default="true"><choice value="true"/><choice value="True"/></arg>'
    assert compared(choices + NODE.format(quoted))[0][3] == ("true", "True")
    assert compared('<arg name="x"/>' + NODE.format(quoted))[0][3] == ()
    assert compared(arg + NODE.format('if="$(var x)"')) == []


def test_comparisons_of_python() -> None:
    declared = "DeclareLaunchArgument('x', default_value='true'),"
    node = "Node(package='p', executable='n', condition={})"
    equals = declared + node.format("LaunchConfigurationEquals('x', 'True')")
    assert compared(equals, "a.launch.py") == [("x", "==", "True", ("true",), True)]
    text = "IfCondition(PythonExpression([\"'\", LaunchConfiguration('x'), \"' == 'True'\"]))"
    assert compared(declared + node.format(text), "a.launch.py") == [("$(var x)", "==", "True", ("true",), True)]
    (fact,) = facts(ConditionUse, node.format("IfCondition('false')"), name="a.launch.py")
    assert fact.is_constant
    (made,) = facts(ConditionUse, node.format("IfCondition(str(1 > 2).lower())"), name="a.launch.py")
    assert not made.is_constant


def test_conditions_of_ros1() -> None:
    node = '<node pkg="p" type="n" name="n" {}/>'
    (fact,) = ros1(ConditionUse, node.format('if="true"'))
    assert (fact.value, fact.is_constant, fact.ros) == (True, True, 1)
    arg = '<arg name="x" default="true"/>'
    (fact,) = ros1(ConditionUse, arg + node.format("if=\"$(eval arg('x') == 'true')\""))
    assert [(each.left, each.right, each.values) for each in fact.comparisons] == [("x", "true", ("true",))]
    (fact,) = ros1(ConditionUse, arg + node.format('if="$(arg x)"'))
    assert (fact.is_constant, fact.comparisons) == (False, ())


def texts(found: list[ConstructUse]) -> list[tuple[str, str]]:
    return [(fact.kind, fact.text) for fact in found]


def test_constructs_of_the_other_version() -> None:
    assert texts(facts(ConstructUse, ARG + '<node pkg="p" exec="n" namespace="$(arg x)"/>')) == [
        ("foreign", "$(arg ...)")
    ]
    assert texts(
        ros1(ConstructUse, '<node pkg="p" type="n" name="n" ns="x"><param name="a" value="$(var x)"/></node>')
    ) == [("foreign", "$(var ...)")]
    assert facts(ConstructUse, ARG + NODE.format('namespace="$(var x)"')) == []
    assert ros1(ConstructUse, '<node pkg="p" type="n" name="n" ns="$(arg x)"/>') == []


@pytest.mark.parametrize(
    ("build", "expected"),
    [
        ("install(DIRECTORY launch DESTINATION share/p)", True),
        ("install(FILES launch/a.launch.xml DESTINATION share/p)", True),
        ("install(DIRECTORY config DESTINATION share/p)", False),
        ("install_my_files(launch/a.launch.xml)", None),
    ],
)
def test_whether_a_file_with_foreign_constructs_is_installed(build: str, expected: bool | None) -> None:
    files = {"p/CMakeLists.txt": CMAKE.replace("launch config", "config") + build + "\n"}
    (fact,) = facts(ConstructUse, ARG + '<node pkg="p" exec="n" namespace="$(arg x)"/>', files)
    assert fact.is_installed is expected


def test_keywords_that_are_gone() -> None:
    old = "Node(package='p', node_executable='n', node_name='m')"
    assert texts(facts(ConstructUse, old, name="a.launch.py")) == [
        ("deprecated", "node_executable="),
        ("deprecated", "node_name="),
    ]
    assert facts(ConstructUse, "Node(package='p', executable='n', name='m')", name="a.launch.py") == []


def test_a_fact_is_told_once_for_each_way_that_leads_to_it() -> None:
    body = SUB + SUB + "<group>" + SUB + "</group>"
    found = facts(ArgumentDeclaration, body, sub(ARG))
    assert len(found) == len({fact.included for fact in found})
    assert all(not fact.is_top and len(fact.included) == 1 for fact in found)
