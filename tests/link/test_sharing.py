# SPDX-License-Identifier: Apache-2.0
"""One program under several names and parameters: followed once where it only passes them on, and each time as if followed alone."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, ros2_files
from test_kept import Cache, digested

import haros_ci.systems.ros2_processes as ros2_processes
from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.report.model_json import render
from haros_ci.systems import sharing
from haros_ci.values.abstract import Known, Opaque
from haros_ci.values.given import Marks, shape
from haros_ci.values.marks import BEGIN, END, filled

PYTHON = """\
from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([{}])
"""


def started(*nodes: str) -> dict[str, str]:
    """A launch file that starts the program ``n`` of ``p`` with the words of *nodes* (keyword arguments) each."""
    return {"a.launch.py": PYTHON.format(", ".join(f"Node(package='p', executable='n', {words})" for words in nodes))}


def program(body: str, members: str = "") -> str:
    return ROS2_HEAD + ROS2_NODE % (body, members)


@contextmanager
def exact(patch: pytest.MonkeyPatch) -> Iterator[None]:
    """Every node is followed with its own names and parameters, and nothing stands for them."""
    with patch.context() as inside:
        inside.setattr(sharing, "without_names", lambda *groups: (groups, {}, {}))
        inside.setattr(Marks, "given", lambda self, cell, key, value: value)
        yield


def model(files: dict[str, str]) -> str:
    return render(architecture(digested(files, 2), Settings(root=Path("/nowhere")), Cache(), environment={}))


def follows(files: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> int:
    """How many times the program is followed for the launch file; the model is that of following each."""
    calls: list[Any] = []
    original = ros2_processes.followed_in

    def counted(*arguments: Any) -> Any:
        calls.append(arguments)
        return original(*arguments)

    with monkeypatch.context() as inside:
        inside.setattr(ros2_processes, "followed_in", counted)
        shared = model(files)
    with exact(monkeypatch):
        assert shared == model(files)
    assert BEGIN not in shared and END not in shared
    assert '"/' in shared
    return len(calls)


TWO = ("name='one', namespace='left'", "name='two', namespace='right/arm'")
GIVEN = "name='{0}', parameters=[{{'text': {1!r}, 'count': {2}}}]"
READ = 'const auto text = declare_parameter<std::string>("text", "x");\n'
COUNT = 'const int count = declare_parameter<int>("count", 1);\n'
PUBLISHER = 'create_publisher<String>("{}", 1);\n'


COUNTS = (GIVEN.format("one", "a", 3), GIVEN.format("two", "a", 9))
TEXTS = (GIVEN.format("one", "a", 3), GIVEN.format("two", "b", 3))


@pytest.mark.parametrize(
    ("body", "nodes"),
    [
        (PUBLISHER.format("chatter"), TWO),
        (PUBLISHER.format("~/chatter"), TWO),
        (PUBLISHER.format("/chatter"), TWO),
        ('create_publisher<String>(std::string(get_name()) + "/state", 1);', TWO),
        ('create_publisher<String>(get_namespace() + std::string("/state"), 1);', TWO),
        ('create_publisher<String>(std::string(get_fully_qualified_name()) + "/state", 1);', TWO),
        (PUBLISHER.format("chatter"), ("name='one', namespace='/'", "name='two', namespace='/right'")),
        ('create_publisher<String>(get_namespace() + std::string("/state"), 1);', ("namespace='/'", "namespace='/r'")),
        (PUBLISHER.format("chatter"), tuple(f"{words}, remappings=[('chatter', '/talk')]" for words in TWO)),
        (PUBLISHER.format("chatter"), tuple(f"{words}, remappings=[('/tf', 'tf')]" for words in TWO)),
        ('auto other = create_sub_node("inner"); other->' + PUBLISHER.format("x"), TWO),
        (READ + COUNT, (GIVEN.format("one", "a", 3), GIVEN.format("two", "b", 4))),
        (READ + "create_publisher<String>(text, 1);", (GIVEN.format("one", "a", 3), GIVEN.format("two", "b/c", 3))),
        (
            READ + 'create_publisher<String>(text + "/x", 1);',
            (GIVEN.format("one", "a", 3), GIVEN.format("two", "b", 3)),
        ),
        (
            READ + 'create_publisher<String>("/x/" + text, 1);',
            (GIVEN.format("one", "a", 3), GIVEN.format("two", "b", 3)),
        ),
        (
            READ + "text_ = text; create_publisher<String>(text_, 1);",
            (GIVEN.format("o", "a", 3), GIVEN.format("t", "b", 3)),
        ),
        (READ + COUNT + PUBLISHER.format("x"), (GIVEN.format("one", "a", 3), GIVEN.format("two", "a", 9))),
        # What is asked of a value has the same answer.
        (COUNT + 'if (count > 2) { create_publisher<String>("x", 1); }', COUNTS),
        (COUNT + 'if (count == 2 || 1 >= count) { create_publisher<String>("x", 1); }', COUNTS),
        (COUNT + 'if (count) { create_publisher<String>("x", 1); }', COUNTS),
        (READ + 'if (text == "c") { create_publisher<String>("x", 1); }', TEXTS),
        (READ + 'if (text != "c") { create_publisher<String>(text, 1); }', TEXTS),
        (READ + "if (!text.empty() && text.size() < 9) { create_publisher<String>(text, 1); }", TEXTS),
        (READ + "if (text.back() == '/' || text[0] == '_') { create_publisher<String>(\"x\", 1); }", TEXTS),
        (READ + 'if (text.find("map") == std::string::npos) { create_publisher<String>(text, 1); }', TEXTS),
        (READ + "if (text.find('q') == std::string::npos) { create_publisher<String>(text, 1); }", TEXTS),
        (READ + 'std::string to = "c"; if (flag_) { to = text; } create_publisher<String>("x", 1);', TEXTS),
        (
            READ
            + "rclcpp::PublisherOptions o; o.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();"
            " create_publisher<String>(text, 1, o);",
            TEXTS,
        ),
        (
            "const std::string s = get_namespace(); if (!s.empty() && s.back() == '/') { create_publisher<String>(\"x\", 1); }",
            TWO,
        ),
    ],
)
def test_followed_once(body: str, nodes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    files = ros2_files(program(body, "std::string text_; bool flag_;"), started(*nodes))
    assert follows(files, monkeypatch) == 1


@pytest.mark.parametrize(
    ("body", "nodes"),
    [
        ("auto other = std::make_shared<rclcpp::Node>(\"other\", get_namespace()); other->" + PUBLISHER.format("x"), TWO),
        ('if (std::string(get_name()) == "one") { create_publisher<String>("x", 1); }', TWO),
        ('if (std::string(get_namespace()).size() > 5) { create_publisher<String>("x", 1); }', TWO),
        ("create_publisher<String>(std::string(get_namespace()).substr(1), 1);", TWO),
        ("create_publisher<String>(get_namespace() + std::string(\"/x\"), count_);", ("namespace='/'", "name='n', namespace='/r'")),
        (READ + 'if (text == "a") { create_publisher<String>("x", 1); }', (GIVEN.format("o", "a", 3), GIVEN.format("t", "b", 3))),
        (READ + 'if (text.empty()) { create_publisher<String>("x", 1); }', (GIVEN.format("o", "", 3), GIVEN.format("t", "b", 3))),
        (READ + "create_publisher<String>(text, 1);", (GIVEN.format("one", "a", 3), GIVEN.format("two", "/a", 3))),
        (READ + "create_publisher<String>(text, 1);", (GIVEN.format("one", "a", 3), GIVEN.format("two", "~/a", 3))),
        (READ + "create_publisher<String>(text, 1);", (GIVEN.format("one", "a", 3), GIVEN.format("two", "{node}", 3))),
        (COUNT + 'create_publisher<String>("x", count);', (GIVEN.format("o", "a", 3), GIVEN.format("t", "a", 9))),
        (COUNT + 'if (count > 5) { create_publisher<String>("x", 1); }', (GIVEN.format("o", "a", 3), GIVEN.format("t", "a", 9))),
        (COUNT + 'create_publisher<String>("x" + std::to_string(count), 1);', (GIVEN.format("o", "a", 3), GIVEN.format("t", "a", 9))),
        (COUNT + 'for (int i = 0; i < count; ++i) { create_publisher<String>("x" + std::to_string(i), 1); }',
         (GIVEN.format("o", "a", 2), GIVEN.format("t", "a", 3))),
        (COUNT, (GIVEN.format("o", "a", 3), GIVEN.format("t", "a", 2.5))),
        (READ + 'declare_parameter<int>(text + "_rate", 1);', (GIVEN.format("o", "a", 3), GIVEN.format("t", "b", 3))),
        (READ + PUBLISHER.format("x"), (GIVEN.format("one", "a", 3), "name='two'")),
        # What is asked of a value has another answer.
        (READ + 'if (text.size() > 1) { create_publisher<String>("x", 1); }', (GIVEN.format("o", "a", 3), GIVEN.format("t", "bb", 3))),
        (READ + 'if (text[0] == \'a\') { create_publisher<String>("x", 1); }', TEXTS),
        (READ + 'if (text < "b") { create_publisher<String>("x", 1); }', TEXTS),
        (READ + 'if (text.find("a") == 0) { create_publisher<String>("x", 1); }', TEXTS),
        (COUNT + 'if (count) { create_publisher<String>("x", 1); }', (GIVEN.format("o", "a", 3), GIVEN.format("t", "a", 0))),
        (COUNT + 'if (5 < count) { create_publisher<String>("x", 1); }', COUNTS),
        (READ + 'std::string to = "a"; if (flag_) { to = text; } create_publisher<String>(to, 1);', TEXTS),
        (READ + 'const auto other = declare_parameter<std::string>("other", "y"); if (text == other) { create_publisher<String>("x", 1); }',
         ("name='one', parameters=[{'text': 'a', 'other': 'b'}]", "name='two', parameters=[{'text': 'a', 'other': 'a'}]")),
        (READ + 'if (text == get_name()) { create_publisher<String>("x", 1); }',
         ("name='a', parameters=[{'text': 'a'}]", "name='b', parameters=[{'text': 'a'}]")),
        (PUBLISHER.format("x"), ("name='one'", "")),
        (PUBLISHER.format("x"), ("name='one', remappings=[('x', 'y')]", "name='two'")),
        (PUBLISHER.format("x"), ("name='one', arguments=['-a']", "name='two'")),
    ],
)  # fmt: skip
def test_followed_for_each(body: str, nodes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    files = ros2_files(program(body, "std::string text_; int count_ = 1; bool flag_;"), started(*nodes))
    assert follows(files, monkeypatch) >= 2 or "namespace='/'" in nodes


@pytest.mark.parametrize(
    "body",
    [
        'declare_parameter("letter", text[0]);',
        'const char letter = text.back(); declare_parameter("letter", letter);',
        'const int letter = text.front(); declare_parameter<int>("letter", letter);',
        'declare_parameter("rest", text.substr(0, 1));',
    ],
)
def test_a_part_of_a_text_is_not_the_text(body: str, monkeypatch: pytest.MonkeyPatch) -> None:
    nodes = (GIVEN.format("one", "ab", 3), GIVEN.format("two", "cd", 3))
    assert follows(ros2_files(program(READ + body), started(*nodes)), monkeypatch)


def test_a_text_that_is_looked_at_and_passed_on(monkeypatch: pytest.MonkeyPatch) -> None:
    body = READ + 'if (text == "a") { create_publisher<String>(text, 1); }'
    files = ros2_files(program(body), started("parameters=[{'text': 'a'}]"))
    assert follows(files, monkeypatch) == 1


def test_two_topics_that_are_one_under_some_names(monkeypatch: pytest.MonkeyPatch) -> None:
    body = 'for (const std::string & key : {"a", "b"}) { create_publisher<String>(declare_parameter<std::string>(key, "x"), 1); }'
    nodes = [f"name='{name}', parameters=[{{'a': '{a}', 'b': '{b}'}}]" for name, a, b in ("ocd", "toe", "pzz")]
    assert follows(ros2_files(program(body), started(*nodes)), monkeypatch) >= 2


def test_components_in_containers(monkeypatch: pytest.MonkeyPatch) -> None:
    component = "ComposableNode(package='p', plugin='N', name='{0}', namespace='/{1}', parameters=[{{'text': '{0}'}}])"
    inside = ", ".join(component.format(name, space) for name, space in ("ax", "by"))
    container = (
        "ComposableNodeContainer(package='rclcpp_components', executable='component_container', name='c', namespace='/k', "
        f"composable_node_descriptions=[{inside}])"
    )
    body = READ + "create_publisher<String>(text, 1); create_publisher<String>(std::string(get_name()) + text, 1);"
    files = ros2_files(program(body), {"a.launch.py": PYTHON.format(container)})
    assert follows(files, monkeypatch) == 1


@pytest.mark.parametrize(
    ("text", "texts", "expected"),
    [
        (f"/{BEGIN}s1{END}/x", {"s1": "/"}, "/x"),
        (f"/{BEGIN}s1{END}", {"s1": "/"}, "/"),
        (f"/{BEGIN}s1{END}x", {"s1": "/"}, "/x"),
        (f"/{BEGIN}s1{END}/{BEGIN}n0{END}", {"s1": "/a/b", "n0": "n"}, "/a/b/n"),
        (f"{BEGIN}p12{END}_x", {"p12": "v"}, "v_x"),
        (f"{BEGIN}p1{END}", {}, f"{BEGIN}p1{END}"),
        (f"{BEGIN}q1{END}{BEGIN}", {"q1": "v"}, f"{BEGIN}q1{END}{BEGIN}"),
    ],
)
def test_filled(text: str, texts: dict[str, str], expected: str) -> None:
    assert filled(text, texts) == expected


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Known("a/b c"), "str"),
        (Known(""), None),
        (Known("/a"), None),
        (Known("~a"), None),
        (Known("a{node}"), None),
        (Known("a?"), None),
        (Known("é"), None),
        (Known("a\n"), None),
        (Known(3), "int"),
        (Known(-3), None),
        (Known(2**31), None),
        (Known(True), "bool"),
        (Known(2.5), "double"),
        (Known(float("nan")), None),
        (Known([1]), None),
        (Known(None), None),
        (Opaque("why"), None),
        (None, None),
    ],
)
def test_shape(value: Any, expected: str | None) -> None:
    assert shape(value) == expected


def test_a_program_that_is_started_too_often(monkeypatch: pytest.MonkeyPatch) -> None:
    """The budget of one program: what is beyond is named, and is the same from a cache and in other processes."""
    body = COUNT + 'for (int i = 0; i < count; ++i) { create_publisher<String>("x" + std::to_string(i), 1); }'
    files = ros2_files(program(body), started(*(f"name='n{i}', parameters=[{{'count': {i + 1}}}]" for i in range(9))))
    whole = model(files)
    assert ros2_processes.TOO_OFTEN not in whole
    monkeypatch.setattr(ros2_processes, "OF_ONE_PROGRAM", 20)
    cache = Cache()

    def kept() -> str:
        settings = Settings(root=Path("/nowhere"))
        return render(architecture(digested(files, 2), settings, cache, environment={}))

    cut = kept()
    assert cut.count(ros2_processes.TOO_OFTEN) > 1
    assert cut == kept() == model(files)
    settings = Settings(root=Path("/nowhere"))
    assert cut == render(architecture(digested(files, 2), settings, Cache(), environment={}, processes=2))
    monkeypatch.setattr(ros2_processes, "OF_ONE_PROGRAM", 10**6)
    assert kept() == whole
    monkeypatch.setattr(ros2_processes, "OF_ONE_PROGRAM", 20)
    assert kept() == cut


@pytest.mark.parametrize("words", ("", "name='one', namespace='left'"))
def test_a_number_that_is_looked_at_is_what_the_parameter_has(words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    body = COUNT + 'if (count > 5) { create_publisher<String>("x", 1); }'
    given = ", ".join(part for part in (words, "parameters=[{'count': 9}]") if part)
    assert follows(ros2_files(program(body), started(given)), monkeypatch) == 1
