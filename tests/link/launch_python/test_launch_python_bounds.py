# SPDX-License-Identifier: Apache-2.0
"""Programs that would not end, or would fill the memory, and random ones: nothing is raised, no budget is overrun."""

from __future__ import annotations

import random
from collections.abc import Iterable

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from launch_python_kit import HEAD, PATH, Context

from haros_ci.launch.python import Budget, heap, interpret
from haros_ci.model.launch_actions import Action, Description

MARKERS = ("$(find-pkg-share ", "$(workspace ")


def follow(text: str, opaque: int = 3) -> Description:
    """Interpret *text* and a few of its OpaqueFunctions; the budget is held and no path leaves the workspace."""
    budget = Budget()

    def read(path: str) -> str | None:
        assert path.startswith(MARKERS), path
        assert ".." not in path.split(")")[0].split(" ")[1].split("/"), path
        assert ".." not in path.split("/"), path
        return "/**: {ros__parameters: {a: 1}}\n" if path.endswith("yaml") else None

    made = interpret(PATH, text, read, {"A": "1"}, None, budget)
    check(budget)
    for action in [item for item in every(made.actions) if item.function is not None][:opaque]:
        assert action.function is not None
        action.function(Context(x="1", name="n"))
        check(budget)
    return made


def check(budget: Budget) -> None:
    assert budget.steps <= heap.STEPS
    assert budget.size <= heap.SIZE


def every(actions: Iterable[Action]) -> Iterable[Action]:
    for action in actions:
        yield action
        yield from every(action.children)


BOMBS = [
    "while True:\n    pass",
    "x = 'a'\nwhile True:\n    x += x",
    "x = 'a'\nfor i in range(60):\n    x = x + x",
    "x = [1]\nfor i in range(60):\n    x = x + x",
    "x = [1]\nfor i in range(60):\n    x.extend(x)",
    "x = 3\nfor i in range(1000):\n    x = x * 10 ** 9",
    "x = 3\nfor i in range(60):\n    x = x * x",
    "x = 2 ** 2 ** 2 ** 2 ** 2 ** 2",
    "x = [[[[[i for i in range(999)] for j in range(999)] for k in range(999)] for l in range(999)] for m in range(999)]",
    "x = [(a, b, c, d) for a in range(99) for b in range(99) for c in range(99) for d in range(99)]",
    "for i in range(10 ** 15):\n    pass",
    "def f(n):\n    return f(n + 1) + f(n + 2)\nf(0)",
    "def f():\n    return [f() for i in range(3)]\nf()",
    "f = lambda g: g(g)\nf(f)",
    "x = " + "(" * 90 + "1" + ")" * 90,
    "x = " + "-" * 3000 + "1",
    "x = " + " + ".join(["1"] * 20000),
    "x = " + "[" * 80 + "]" * 80,
    "x = " + "a." * 3000 + "b",
    "x = " + "f(" * 80 + ")" * 80,
    "x = " + "lambda: " * 80 + "1",
    "if a:\n    pass\n" + "elif a:\n    pass\n" * 600,
    "".join("    " * i + f"if os.environ['{i}']:\n" for i in range(60)) + "    " * 60 + "pass",
    "".join("    " * i + f"for a{i} in range(99):\n" for i in range(15)) + "    " * 15 + "pass",
    "x = []\nx.append(x)\nLaunchDescription(x)\nld = str(x)\ny = x == x\nimport copy\nz = copy.deepcopy(x)",
    "x = {}\nx['a'] = x\nNode(package='p', executable='e', parameters=[x])",
    "x = []\ny = [x]\nx.append(y)\nz = x == y\nassert [x] == [y]",
    "x = LaunchDescription()\nx.add_action(x)\nx.add_action(GroupAction([x]))",
    "import yaml\nx = yaml.safe_load('a: &a [x, x, x]\\nb: &b [*a, *a, *a, *a]\\nc: &c [*b, *b, *b, *b]\\nd: [*c, *c, *c]')",
    "import yaml\nx = yaml.safe_load('&a [*a]')",
    "import json\nx = json.loads('9' * 5000)",
    "x = int('9' * 100000)",
    "x = 'x' * 100000\ny = [x.replace('x', x[:2]) for i in range(1000)]",
    "x = '{0}{0}'\nfor i in range(40):\n    x = x.format(x)",
    "x = '%s%s'\nfor i in range(40):\n    x = x % (x, x)",
    "x = f'a'\nfor i in range(40):\n    x = f'{x}{x}'",
    "x = ','.join(['a' * 100000] * 100000)",
    "x = [[]] * 100000\nx = x * 100000",
    "x = list(zip(*[range(100000)] * 100))",
    "import itertools\nx = list(itertools.product(*[range(100)] * 50))",
    "for i in range(50):\n    for j in os.environ['X']:\n        if j:\n            break",
    "x = {}\nwhile True:\n    x[len(x)] = x",
    "class A:\n    @property\n    def a(self):\n        return self.a\nA().a",
    "class A:\n    def __call__(self):\n        return self()\nA()()",
    "def g():\n    while True:\n        yield 1\nlist(g())",
    "x = sorted(range(100000), key=lambda i: [i] * 100)",
    "globals()['x'] = 1\n__builtins__.x = 1\n().__class__.__bases__[0].__subclasses__()",
    "def f(*a, **k):\n    return f(*a, *a, **k)\nf(1)",
    "x = 'a' if os.environ['Q'] else 'b'\nfor i in range(12):\n    x = x if os.environ['R'] else x + 'c'",
]


@pytest.mark.parametrize("body", BOMBS, ids=range(len(BOMBS)))
def test_bombs(body: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(heap, "STEPS", 10_000)  # of any number of steps all of them are taken
    monkeypatch.setattr(heap, "SIZE", 400_000)
    inside = "".join(f"    {line}\n" for line in body.splitlines())
    for text in (
        f"{HEAD}\n{body}\ndef generate_launch_description():\n    return LaunchDescription([])\n",
        f"{HEAD}\ndef generate_launch_description():\n{inside}\n    return LaunchDescription([])\n",
        f"{HEAD}\ndef f(context):\n{inside}\n    return []\n"
        "def generate_launch_description():\n    return LaunchDescription([OpaqueFunction(function=f)])\n",
    ):
        follow(text)


def test_what_is_too_long_says_so() -> None:
    (action,) = follow("while True:\n    while True:\n        x = 1\n").actions or (None,)
    assert action is not None
    assert action.kind == "?"
    assert action.reason.startswith("the launch file is not followed to its end: ")


NAMES = st.sampled_from(["x", "y", "z", "f", "ld", "context", "nodes"])
ATOMS = st.one_of(
    NAMES,
    st.sampled_from(
        [
            "None",
            "True",
            "0",
            "1",
            "-3",
            "2.5",
            "''",
            "'a'",
            "'$(find-pkg-share p)/c.yaml'",
            "'../..'",
            "[]",
            "{}",
            "()",
            "set()",
            "LaunchConfiguration('x')",
            "os.environ['A']",
            "os.environ['B']",
            "get_package_share_directory('p')",
            "__file__",
            "Path('a')",
            "LaunchDescription()",
            "FindPackageShare('p')",
            "'$(workspace ..)/x.yaml'",
            "context",
        ]
    ),
)


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    binary = st.sampled_from(
        ["+", "*", "-", "/", "%", "**", "==", "<", "in", "not in", "and", "or", "is", "|", "<<", "//"]
    )
    called = st.sampled_from(
        [
            "str",
            "len",
            "list",
            "sorted",
            "int",
            "open",
            "yaml.safe_load",
            "os.path.join",
            "os.path.dirname",
            "Node",
            "GroupAction",
            "LaunchDescription",
            "IfCondition",
            "PathJoinSubstitution",
            "LaunchConfiguration",
            "OpaqueFunction",
            "f",
            "x",
            "Path",
            "ComposableNode",
            "RewrittenYaml",
            "PythonExpression",
            "DeclareLaunchArgument",
            "range",
            "dict",
            "tuple",
            "map",
            "isinstance",
            "unknown",
            "SetParameter",
            "ParameterFile",
            "enumerate",
            "zip",
            "any",
            "set",
            "sum",
            "next",
            "getattr",
        ]
    )
    attribute = st.sampled_from(
        [
            "append",
            "items",
            "perform",
            "get",
            "split",
            "format",
            "join",
            "add_action",
            "update",
            "parent",
            "read_text",
            "lower",
            "replace",
            "entities",
            "extend",
            "pop",
            "launch_configurations",
            "keys",
            "evaluate",
            "startswith",
            "find",
            "copy",
        ]
    )
    keyword = st.sampled_from(
        ["package", "executable", "parameters", "condition", "function", "actions", "name", "remappings"]
    )
    return st.one_of(
        st.tuples(inner, binary, inner).map(lambda p: f"({p[0]} {p[1]} {p[2]})"),
        st.tuples(called, inner, inner).map(lambda p: f"{p[0]}({p[1]}, {p[2]})"),
        st.tuples(called, keyword, inner, keyword, inner).map(
            lambda p: f"{p[0]}({p[1]}={p[2]}, **{{'{p[3]}': {p[4]}}})"
        ),
        st.tuples(inner, attribute, inner).map(lambda p: f"{p[0]}.{p[1]}({p[2]})" if p[0][0].isalpha() else p[0]),
        st.tuples(inner, inner).map(lambda p: f"({p[0]})[{p[1]}]"),
        st.tuples(inner, inner, inner).map(lambda p: f"({p[0]} if {p[1]} else {p[2]})"),
        st.lists(inner, max_size=3).map(lambda p: "[" + ", ".join(p) + "]"),
        st.tuples(inner, inner).map(lambda p: "{" + f"{p[0]}: {p[1]}, **{{}}" + "}"),
        st.tuples(inner, NAMES, inner, inner).map(lambda p: f"[{p[0]} for {p[1]} in {p[2]} if {p[3]}]"),
        st.tuples(NAMES, inner).map(lambda p: f"(lambda {p[0]}: {p[1]})"),
        inner.map(lambda p: 'f"{' + p.replace('"', "'").replace("\\", "").replace("{", "(").replace("}", ")") + '}"'),
        st.tuples(inner, inner).map(lambda p: f"({p[0]})[{p[1]}:]"),
    )


EXPRESSIONS = st.recursive(ATOMS, grown, max_leaves=8)


@st.composite
def blocks(draw: st.DrawFn, depth: int = 0) -> list[str]:
    lines: list[str] = []
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.integers(0, 12 if depth < 3 else 5))
        name, value = draw(NAMES), draw(EXPRESSIONS)
        if kind <= 2:
            lines.append(f"{name} = {value}")
        elif kind == 3:
            lines.append(f"{name} += {value}")
        elif kind == 4:
            lines.append(value)
        elif kind == 5:
            lines.append(
                draw(
                    st.sampled_from(
                        [
                            f"return {value}",
                            f"{name}['k'] = {value}",
                            f"{name}.a = {value}",
                            f"del {name}",
                            f"{name}, *y = {value}",
                            "raise ValueError",
                            "global x",
                            f"yield {value}",
                        ]
                    )
                )
            )
        else:
            head = [
                f"if {value}:",
                f"for {name} in {value}:",
                f"while {value}:",
                "try:",
                f"with open({value}) as {name}:",
                f"def {name}(x, y={value}, *z):",
                f"if {value}:",
            ][kind - 6]
            inner = draw(blocks(depth + 1))
            lines += [head, *(f"    {line}" for line in inner)]
            if head == "try:":
                lines += ["except Exception as x:", "    x = 1"]
            elif head.startswith("if") and draw(st.booleans()):
                lines += ["else:", *(f"    {line}" for line in draw(blocks(depth + 1)))]
    return lines


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(blocks())
def test_random_programs(lines: list[str]) -> None:
    inside = "\n".join(f"    {line}" for line in lines)
    follow(
        f"{HEAD}\nx = y = z = nodes = []\ndef f(context=None, *args):\n    global ld\n{inside}\n    return nodes\n"
        f"def generate_launch_description():\n    ld = LaunchDescription([OpaqueFunction(function=f)])\n{inside}\n    return ld\n"
    )


FIXTURE = (
    HEAD
    + """
def helper(name, default=None):
    return DeclareLaunchArgument(name, default_value=default)

def setup(context, *args):
    path = LaunchConfiguration('file').perform(context)
    with open(os.path.join(get_package_share_directory('p'), 'config', 'c.yaml'), 'r') as f:
        data = yaml.safe_load(f)['/**']['ros__parameters']
    nodes = []
    for index, item in enumerate(['a', 'b']):
        if data['a'] == 1 and item != path:
            nodes.append(ComposableNode(package='p', plugin=f'p::{item}', name='{}_{}'.format(item, index), parameters=[data]))
    container = ComposableNodeContainer(name='c', namespace='', package='q', executable='e', composable_node_descriptions=nodes)
    loader = LoadComposableNodes(composable_node_descriptions=nodes, target_container=container)
    return [container, loader] if IfCondition(LaunchConfiguration('x')).evaluate(context) else [container]

def generate_launch_description():
    ld = LaunchDescription()
    share = FindPackageShare(package='p').find('p')
    params = RewrittenYaml(source_file=LaunchConfiguration('file'), root_key='r', param_rewrites={'a': 'b'}, convert_types=True)
    ld.add_action(helper('file', os.path.join(share, 'config', 'c.yaml')))
    ld.add_action(GroupAction([PushRosNamespace('n'), Node(package='p', executable='e', parameters=[params, {'k': [1, 2]}])]))
    ld.add_action(OpaqueFunction(function=setup, args=[1]))
    for name in sorted({'b': 1, 'a': 2}.keys()):
        ld.add_action(IncludeLaunchDescription(PythonLaunchDescriptionSource([share, '/launch/', name, '.launch.py'])))
    ld.add_action(RegisterEventHandler(OnProcessExit(on_exit=[TimerAction(period=1.0, actions=[LogInfo(msg='x')])])))
    return ld
"""
)


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 6))
def test_mutated_files(seed: int, count: int) -> None:
    chance = random.Random(seed)
    lines = FIXTURE.splitlines()
    head = HEAD.count("\n")
    for _ in range(count):
        row, other = chance.randrange(head, len(lines)), chance.randrange(head, len(lines))
        kind = chance.randrange(6)
        if kind == 0:
            lines[row], lines[other] = lines[other], lines[row]
        elif kind == 1:
            lines[row] = ""
        elif kind == 2:
            lines.insert(row, lines[other])
        else:
            words = lines[row].replace("(", " ( ").replace(")", " ) ").replace(",", " , ").split(" ")
            place = chance.randrange(len(words))
            words[place] = chance.choice(
                ["", "x", "None", "(", ")", "[", "]", "'..'", "*", "not", words[chance.randrange(len(words))]]
            )
            lines[row] = " ".join(words) if kind < 5 else lines[row].replace("'", chance.choice(["", '"', "'../"]), 1)
    follow("\n".join(lines))


def test_the_fixture_itself() -> None:
    made = follow(FIXTURE)
    assert [action.kind for action in made.actions] == ["arg", "group", "opaque", "include", "include", "event"]
    function = made.actions[2].function
    assert function is not None
    found = function(Context(file="b", x="true"))
    assert [(a.kind, len(a.children)) for a in found] == [("container", 1), ("load", 1)]
