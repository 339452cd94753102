# SPDX-License-Identifier: Apache-2.0
"""The actions of launch files written in Python, exactly; and what of them is not known."""

from __future__ import annotations

from typing import Any

import pytest
from launch_python_kit import HEAD, PATH, Context, actions, brief, describe, unknowns, var

from haros_ci.model.launch_actions import Action, ParameterSource
from haros_ci.model.location import Location


def one(expression: str, before: str = "", **options: Any) -> Action:
    found = actions(f"ld.add_action({expression})", before, **options)
    assert len(found) == 1
    return found[0]


def phrases(action: Action) -> dict[str, Any]:
    return {name: brief(phrase) for name, phrase in action.phrases}


def values(source: ParameterSource) -> list[tuple[Any, Any]]:
    def shown(value: Any) -> Any:
        if isinstance(value, tuple) and all(isinstance(part, tuple) for part in value) and value:
            return tuple(brief(part) for part in value)
        return ("phrase", brief(value)) if isinstance(value, tuple) else value

    return [(brief(name), shown(value)) for name, value in source.values]


def test_node() -> None:
    node = one(
        "Node(package='p', executable='e', name=LaunchConfiguration('n'), namespace='ns', exec_name='x', prefix='gdb',\n"
        "  arguments=['-d', LaunchConfiguration('a'), 'two words'], ros_arguments=['--log-level', 'info'], respawn=True,\n"
        "  remappings=[('a', 'b'),\n   ('c', ['d/', LaunchConfiguration('e')])], additional_env={'K': 'v'}, output='screen')"
    )
    assert node.kind == "node"
    assert phrases(node) == {
        "package": "p",
        "executable": "e",
        "name": (var("n"),),
        "namespace": "ns",
        "exec_name": "x",
        "launch-prefix": "gdb",
        "args": ("-d '", var("a"), "' 'two words'"),
        "ros_args": "--log-level info",
        "respawn": "true",
    }
    first = HEAD.count("\n") + 4
    assert node.location == Location(PATH, first, 19)
    assert [(brief(a), brief(b), place) for a, b, place in node.remaps] == [
        ("a", "b", Location(PATH, first + 2, 19)),
        ("c", ("d/", var("e")), Location(PATH, first + 3, 8)),
    ]
    assert [(brief(a), brief(b)) for a, b in node.environment] == [("K", "v")]
    assert node.tests == ()


def test_columns_count_code_points() -> None:
    node = one("[('é€𝄞', Node(package='p', executable='e'))][0][1]")
    assert node.location.column == 28


def test_parameters() -> None:
    node = one(
        "Node(package='p', executable='e', parameters=[\n"
        "  'a.yaml', Path('b') / 'c.yaml', [FindPackageShare('q'), '/d.yaml'], LaunchConfiguration('f'),\n"
        "  ParameterFile('g.yaml', allow_substs=True), ParameterFile(LaunchConfiguration('h')),\n"
        "  {'i': 1, 'j': {'k': 2.5, 'l': [True, False]}, 'm': 'text', 'n': LaunchConfiguration('o'),\n"
        "   'p': ['a', LaunchConfiguration('q')], 'r': [['a'], [LaunchConfiguration('q')]],\n"
        "   ('s', LaunchConfiguration('t')): None},\n"
        "  {'u': ParameterValue(LaunchConfiguration('v'), value_type=str)}, Parameter('w', 3, value_type=int),\n"
        "])"
    )
    files = [(brief(s.path), s.substitutes) for s in node.parameters if s.kind == "file"]
    assert files == [
        ("a.yaml", False),
        ("b/c.yaml", False),
        ((("find-pkg-share", ("q",)), "/d.yaml"), False),
        ((var("f"),), False),
        ("g.yaml", True),
        ((var("h"),), False),
    ]
    rest = [s for s in node.parameters if s.kind == "values"]
    assert values(rest[0]) == [
        ("i", 1),
        ("j.k", 2.5),
        ("j.l", [True, False]),
        ("m", "text"),
        ("n", ("phrase", (var("o"),))),
        ("p", ("phrase", ("a", var("q")))),
        ("r", ("a", (var("q"),))),
        (("s", var("t")), None),
    ]
    assert (values(rest[1]), rest[1].types) == ([("u", ("phrase", (var("v"),)))], (("u", "str"),))
    assert (values(rest[2]), rest[2].types) == ([("w", 3)], (("w", "int"),))
    assert rest[0].location.line == HEAD.count("\n") + 7
    assert len(node.parameters) == 9


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ("os.environ['P']", "the environment variable P is not known"),
        ("[yaml.safe_load(open('x.yaml'))]", "x.yaml is not in the workspace"),
        ("[3]", "a int is not supported here"),
        ("[Node(package='a', executable='b')]", "launch_ros.actions.Node is no source of parameters that is known"),
        ("[f()]", "`f` has no value here"),
    ],
)
def test_unknown_parameters(parameters: str, reason: str) -> None:
    node = one(f"Node(package='p', executable='e', parameters={parameters})")
    assert [(s.kind, s.reason) for s in node.parameters] == [("?", reason)]


def test_rewritten_yaml() -> None:
    node = one(
        "Node(package='p', executable='e', parameters=[ParameterFile(RewrittenYaml(source_file=LaunchConfiguration('f'),\n"
        "  root_key='r', param_rewrites={'a.b': LaunchConfiguration('c')}, convert_types=True), allow_substs=True)])"
    )
    (source,) = node.parameters
    (part,) = source.path
    assert source.substitutes
    assert not isinstance(part, str)
    assert part.kind == "rewritten"
    assert brief(part.data["source"]) == (var("f"),)
    assert [(brief(a), brief(b)) for a, b in part.data["rewrites"]] == [("a.b", (var("c"),))]
    assert part.data["root_key"] == ("r",)
    assert (part.data["key_rewrites"], part.data["value_rewrites"], part.data["convert_types"]) == ((), (), True)


def test_containers_and_components() -> None:
    body = """
c = ComposableNodeContainer(name='c', namespace='/ns', package='rclcpp_components', executable='component_container',
    composable_node_descriptions=[ComposableNode(package='p', plugin='p::A', name='a', parameters=[{'k': 1}],
        remappings=[('x', 'y')], condition=IfCondition(LaunchConfiguration('i')))])
ld.add_action(c)
ld.add_action(LoadComposableNodes(target_container=c, composable_node_descriptions=[ComposableNode(package='p', plugin='B')]))
ld.add_action(LoadComposableNodes(target_container='other', composable_node_descriptions=os.environ['N']))
"""
    container, load, other = actions(body)
    assert phrases(container) == {
        "package": "rclcpp_components",
        "executable": "component_container",
        "name": "c",
        "namespace": "/ns",
        "handle": "robot/launch/robot.launch.py:1",
    }
    (child,) = container.children
    assert (child.kind, phrases(child)) == ("component", {"package": "p", "plugin": "p::A", "name": "a"})
    assert values(child.parameters[0]) == [("k", 1)]
    assert [brief(t.phrases[0]) for t in child.tests] == [(var("i"),)]
    assert (load.kind, phrases(load), [phrases(c) for c in load.children]) == (
        "load",
        {"target": "/ns/c", "handle": "robot/launch/robot.launch.py:1"},
        [{"package": "p", "plugin": "B"}],
    )
    assert (phrases(other), [c.kind for c in other.children]) == ({"target": "other"}, ["?"])


def test_a_list_that_grows_after_the_container_is_made_counts() -> None:
    body = """
nodes = [ComposableNode(package='p', plugin='A')]
ld.add_action(ComposableNodeContainer(name='c', namespace='', package='q', executable='e', composable_node_descriptions=nodes))
nodes.append(ComposableNode(package='p', plugin='B'))
"""
    (container,) = actions(body)
    assert [brief(child.get("plugin")) for child in container.children] == ["A", "B"]


SIMPLE = [
    (
        "DeclareLaunchArgument('a', default_value='b', choices=['b', 'c'])",
        "arg",
        {"name": "a", "default": "b", "choices": "c"},
    ),
    ("DeclareLaunchArgument('a')", "arg", {"name": "a"}),
    ("SetLaunchConfiguration('a', ['b', LaunchConfiguration('c')])", "let", {"name": "a", "value": ("b", var("c"))}),
    ("SetEnvironmentVariable(name='A', value='b')", "set-env", {"name": "A", "value": "b"}),
    ("AppendEnvironmentVariable('A', 'b')", "append-env", {"name": "A", "value": "b"}),
    ("UnsetEnvironmentVariable('A')", "unset-env", {"name": "A"}),
    (
        "ExecuteProcess(cmd=['ros2', 'run', 'p', 'e', ['a', LaunchConfiguration('b')]], output='screen')",
        "executable",
        {"cmd": ("ros2 run p e a", var("b"))},
    ),
    ("PushRosNamespace('n')", "push-namespace", {"namespace": "n"}),
    ("launch_ros.actions.PushROSNamespace(LaunchConfiguration('n'))", "push-namespace", {"namespace": (var("n"),)}),
    ("SetUseSimTime(True)", "set-use-sim-time", {"value": "true"}),
    ("LogInfo(msg='x')", "log", {}),
    ("Shutdown(reason='x')", "shutdown", {}),
    ("EmitEvent(event=ShutdownEvent())", "shutdown", {}),
    (
        "LifecycleNode(package='p', executable='e', name='n', namespace='')",
        "lifecycle-node",
        {"package": "p", "executable": "e", "name": "n", "namespace": ()},
    ),
    ("ResetLaunchConfigurations()", "reset", {}),
]


@pytest.mark.parametrize(("expression", "kind", "expected"), SIMPLE, ids=[item[0][:40] for item in SIMPLE])
def test_simple_actions(expression: str, kind: str, expected: dict[str, Any]) -> None:
    action = one(expression)
    assert (action.kind, phrases(action)) == (kind, expected)


SUBSTITUTIONS = [
    ("LaunchConfiguration('a', default='b')", (("var", ("a", "b")),)),
    ("EnvironmentVariable('A')", (("env", ("A",)),)),
    ("TextSubstitution(text='t')", "t"),
    (
        "PathJoinSubstitution([FindPackageShare('p'), 'a', LaunchConfiguration('b')])",
        (("join", ((("find-pkg-share", ("p",)),), "a", (var("b"),))),),
    ),
    ("PythonExpression(['not ', LaunchConfiguration('a')])", (("eval", (("not ", var("a")),)),)),
    ("Command(['xacro ', 'x'])", (("command", ("xacro x",)),)),
    ("FindExecutable(name='e')", (("find-exec", ("e",)),)),
    ("ExecutableInPackage(executable='e', package='p')", (("exec-in-pkg", ("e", "p")),)),
    ("FindPackagePrefix('p')", (("find-pkg-prefix", ("p",)),)),
    ("AnonName('a')", (("anon", ("a",)),)),
    ("ThisLaunchFileDir()", (("dirname", ()),)),
    ("FileContent('f')", (("file-content", ("f",)),)),
    (
        "AndSubstitution(NotSubstitution('a'), OrSubstitution('b', 'c'))",
        (("and", ((("not", ("a",)),), (("or", ("b", "c")),))),),
    ),
    ("AnySubstitution('a', 'b')", (("any", ("a", "b")),)),
    ("NotEqualsSubstitution('a', 'b')", (("not-equals", ("a", "b")),)),
    ("IfElseSubstitution(LaunchConfiguration('a'), 'b')", (("if", ((var("a"),), "b", ())),)),
    ("LaunchConfigAsBool('a')", (("eval", (("'", var("a"), "'.strip().lower() in ['true', '1', 'yes', 'on']"),)),)),
    ("os.getenv('A', 'd')", (("env", ("A", "d")),)),
    ("get_package_share_directory(os.getenv('A', 'd'))", (("find-pkg-share", ((("env", ("A", "d")),),)),)),
    ("os.path.join('a', os.getenv('A', 'd'), 'b')", ("a/", ("env", ("A", "d")), "/b")),
]


@pytest.mark.parametrize(("expression", "expected"), SUBSTITUTIONS, ids=[item[0][:40] for item in SUBSTITUTIONS])
def test_substitutions(expression: str, expected: Any) -> None:
    assert brief(one(f"DeclareLaunchArgument('x', default_value={expression})").get("default")) == expected


@pytest.mark.parametrize(
    "expression",
    [
        "ReplaceString('f', {'a': 'b'})",
        "HasNodeParams('f', 'n')",
        "LocalSubstitution('x')",
        "unknown.Substitution()",
        "[LaunchConfiguration('a'), unknown]",
        "LaunchConfiguration()",
    ],
)
def test_unknown_substitutions(expression: str) -> None:
    assert unknowns(one(f"DeclareLaunchArgument('x', default_value={expression})").get("default") or ())


def test_includes() -> None:
    include = one(
        "IncludeLaunchDescription(PythonLaunchDescriptionSource([FindPackageShare('p'), '/x.launch.py']),\n"
        "  launch_arguments={'a': 'b', 'c': LaunchConfiguration('d')}.items(), condition=UnlessCondition('false'))"
    )
    assert (include.kind, phrases(include)) == ("include", {"file": (("find-pkg-share", ("p",)), "/x.launch.py")})
    assert [(brief(a), brief(b)) for a, b in include.arguments] == [("a", "b"), ("c", (var("d"),))]
    assert [(t.kind, t.phrases, t.text) for t in include.tests] == [
        ("unless", (("false",),), "UnlessCondition('false')")
    ]
    inner = one("IncludeLaunchDescription(LaunchDescription([LogInfo(msg='a')]), launch_arguments=[('a', 'b')])")
    assert (inner.kind, [child.kind for child in inner.children]) == ("list", ["let", "list"])
    lost = one("IncludeLaunchDescription(PythonLaunchDescriptionSource(f()), launch_arguments=g())")
    assert unknowns(lost.get("file") or ()) == ["`f` has no value here"]
    assert unknowns(lost.arguments[0][0]) == ["`g` has no value here"]


def test_groups() -> None:
    group = one(
        "GroupAction([SetRemap('a', 'b'), SetParameter('k', 3)], scoped=False, forwarding=LaunchConfiguration('f'),\n"
        "  launch_configurations={'x': 'y'})"
    )
    assert phrases(group) == {"scoped": "false", "forwarding": (var("f"),)}
    assert [(brief(a), brief(b)) for a, b in group.arguments] == [("x", "y")]
    remap, parameter = group.children
    assert [(a, b) for a, b, _ in remap.remaps] == [(("a",), ("b",))]
    assert (parameter.kind, values(parameter.parameters[0])) == ("set-parameter", [("k", 3)])


def test_conditions() -> None:
    found = [
        one(f"LogInfo(msg='x', condition={condition})").tests[0]
        for condition in (
            "IfCondition(LaunchConfiguration('a'))",
            "LaunchConfigurationEquals('a', 'b')",
            "LaunchConfigurationNotEquals('a', 'b')",
            "IfCondition(PythonExpression(['1 == ', LaunchConfiguration('a')]))",
            "f()",
            "LaunchConfigurationEquals('a', None)",
        )
    ]
    assert [(t.kind, tuple(brief(p) for p in t.phrases)) for t in found] == [
        ("if", ((var("a"),),)),
        ("equals", ("a", "b")),
        ("not-equals", ("a", "b")),
        ("if", ((("eval", (("1 == ", var("a")),)),),)),
        ("?", ()),
        ("?", ()),
    ]


def test_events() -> None:
    body = """
n = Node(package='p', executable='e', on_exit=[LogInfo(msg='x'), Node(package='p', executable='late')])
ld.add_action(n)
ld.add_action(RegisterEventHandler(OnProcessExit(target_action=n, on_exit=[Node(package='p', executable='f')])))
ld.add_action(RegisterEventHandler(OnProcessStart(on_start=lambda event, context: Node(package='p', executable='g'))))
ld.add_action(TimerAction(period=2.0, actions=[Node(package='p', executable='h')]))
ld.add_action(Node(package='p', executable='e', on_exit=Shutdown()))
ld.add_action(RegisterEventHandler(f()))
"""
    found = actions(body)
    assert [(a.kind, a.deferred, [brief(c.get("executable")) for c in a.children]) for a in found] == [
        ("node", "", []),
        ("event", "on_exit", [None, "late"]),
        ("event", "OnProcessExit", ["f"]),
        ("event", "OnProcessStart", ["g"]),
        ("event", "after 2.0 s", ["h"]),
        ("node", "", []),
        ("event", "event", [None]),
    ]


def test_branches_on_the_unknown() -> None:
    body = """
if os.environ['U'] == '1':
    ld.add_action(LogInfo(msg='a'))
elif os.environ['V']:
    ld.add_action(Shutdown())
else:
    ld.add_action(PushRosNamespace('n'))
for name in os.environ['W'].split():
    ld.add_action(Node(package='p', executable='e', name=name))
"""
    first, second, third, fourth = actions(body)
    a, b = "os.environ['U'] == '1'", "os.environ['V']"
    assert [[t.text for t in action.tests] for action in (first, second, third, fourth)] == [
        [a],
        [f"not ({a})", b],
        [f"not ({a})", f"not ({b})"],
        ["for each of os.environ['W'].split()"],
    ]
    assert {t.kind for action in (first, second, third, fourth) for t in action.tests} == {"?"}
    assert unknowns(fourth.get("name") or ()) == ["the environment variable W is not known"]


def test_an_early_return_puts_the_rest_under_a_test() -> None:
    text = """
def generate_launch_description():
    if os.environ['U']:
        return LaunchDescription([LogInfo(msg='a')])
    return LaunchDescription([Shutdown()])
"""
    first, second = describe(text).actions
    assert [(a.kind, [c.kind for c in a.children], a.tests[0].text) for a in (first, second)] == [
        ("list", ["log"], "os.environ['U']"),
        ("list", ["shutdown"], "not (os.environ['U'])"),
    ]


OPAQUE = """
count = []

def setup(context, *args, **kwargs):
    count.append(1)
    name = LaunchConfiguration('name').perform(context)
    made = [Node(package='p', executable='e', name=f'{name}_{len(count)}', arguments=[*args, kwargs.get('k', '')])]
    if context.launch_configurations['mode'] == 'two':
        made.append(Node(package='p', executable='two'))
    if IfCondition(LaunchConfiguration('flag')).evaluate(context):
        made.append(OpaqueFunction(function=lambda context: [Node(package='p', executable=made[0] and name)]))
    context.launch_configurations['left'] = name + '!'
    return made
"""


def test_opaque_functions_run_in_their_context() -> None:
    opaque = one("OpaqueFunction(function=setup, args=['-a'], kwargs={'k': 'v'})", OPAQUE)
    assert opaque.kind == "opaque"
    assert opaque.function is not None
    for _ in range(2):
        context = Context(name="n", mode="two", flag="true")
        node, two, inner = opaque.function(context)
        assert (brief(node.get("name")), brief(node.get("args"))) == ("n_1", "-a v")
        assert brief(two.get("executable")) == "two"
        assert inner.function is not None
        assert [brief(a.get("executable")) for a in inner.function(context)] == ["n"]
        assert context.configurations["left"].text == "n!"
    found = opaque.function(Context(mode="one", name="m", flag="0"))
    assert [brief(a.get("name")) for a in found] == ["m_1"]


def test_opaque_functions_in_an_unknown_context() -> None:
    opaque = one("OpaqueFunction(function=setup)", OPAQUE)
    assert opaque.function is not None
    node, two, inner = opaque.function(Context())
    assert unknowns(node.get("name") or ()) == ["name is not set"]
    assert [t.text for t in two.tests] == ["context.launch_configurations['mode'] == 'two'"]
    assert [t.text for t in inner.tests] == ["IfCondition(LaunchConfiguration('flag')).evaluate(context)"]


def test_for_each_of_a_text() -> None:
    before = "def robot(name='', pose={}):\n    return [Node(package='p', executable='e', name=name + str(pose.get('x', 0)))]\n"
    action = one("ForEach(LaunchConfiguration('robots'), function=robot)", before)
    assert action.function is not None
    found = action.function(Context(robots="{name: a, pose: {x: 1}};{name: b};"))
    assert [brief(a.get("name")) for a in found] == ["a1", "b0"]
    assert [a.kind for a in action.function(Context())] == ["?"]


def test_moveit() -> None:
    share = "$(find-pkg-share arm_moveit_config)/config"
    files = {
        f"{share}/kinematics.yaml": "arm: {solver: kdl}\n",
        f"{share}/joint_limits.yaml": "joint_limits: {j1: {max_velocity: 1.0}}\n",
        f"{share}/moveit_controllers.yaml": "moveit_simple_controller_manager: {controller_names: [c1]}\n",
        f"{share}/ompl_planning.yaml": "planner_configs: {}\nplanning_plugins: [o]\n",
    }
    before = "from moveit_configs_utils import MoveItConfigsBuilder\nfrom moveit_configs_utils.launches import *\n"
    made = "MoveItConfigsBuilder('arm').planning_pipelines(pipelines=['ompl']).to_moveit_configs()"
    parts = "m.robot_description_kinematics, m.joint_limits, m.planning_pipelines, m.robot_description"
    node = actions(
        f"m = {made}\nld.add_action(Node(package='p', executable='e', parameters=[{parts}]))", before, files=files
    )[0]
    kinematics, limits, pipelines, robot = node.parameters
    assert values(kinematics) == [("robot_description_kinematics.arm.solver", "kdl")]
    assert values(limits) == [("robot_description_planning.joint_limits.j1.max_velocity", 1.0)]
    assert values(pipelines) == [
        ("planning_pipelines", ["ompl"]),
        ("default_planning_pipeline", "ompl"),
        ("ompl.planning_plugins", ["o"]),
    ]
    assert unknowns(robot.values[0][1]) == ["a robot description made by xacro"]
    (spawners,) = actions(f"ld.add_action(generate_spawn_controllers_launch({made}))", before, files=files)
    assert [brief(a.get("args")) for a in spawners.children] == ["c1", "joint_state_broadcaster"]
    (group,) = actions(f"ld.add_action(generate_move_group_launch({made}))", before, files=files)
    nodes = [(brief(a.get("executable")), a.tests[0].kind) for a in group.children if a.kind == "node"]
    assert nodes == [("move_group", "unless"), ("move_group", "if")]
    (demo,) = actions(f"ld.add_action(generate_demo_launch({made}))", before, files=files)
    assert [a.kind for a in demo.children] == ["arg"] * 3 + ["include"] * 5 + ["node", "include"]


@pytest.mark.parametrize(
    "expression",
    [
        "Node(package='p')",
        "Node(**unknown)",
        "ComposableNode(package='p', plugin='q', condition=None).x",
        "ExecuteLocal(x=1)",
        "PushLaunchConfigurations()",
        "UnknownAction()",
        "Node",
        "'text'",
        "LaunchConfiguration('x')",
    ],
)
def test_unknown_actions(expression: str) -> None:
    action = one(expression)
    assert action.kind == "?"
    assert action.reason
