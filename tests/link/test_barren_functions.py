# SPDX-License-Identifier: Apache-2.0
"""A function that goes on making nothing new in the beginning of a node is not followed any more; that is said of the node."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, follow, main, names, python_files

from haros_ci.follow import barren

ONE = "int twice(int a) { int b = a; b = b + a; return b; }\nvoid f(ros::NodeHandle& nh, const std::string& name) {\nint a = 1;\na = a + 1;\na = a + 2;\nnh.advertise<std_msgs::String>(name, 1);\n}\n"
SAME = 'f(nh, "a");\n' * 8
SCRIPT = "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\ndef f(name):\n    a = 1\n    a = a + 1\n    rospy.Publisher(name, String)\nrospy.init_node('n')\n"


def node(files: dict[str, str]) -> tuple[list[str], bool]:
    """The names that the node makes, and whether it is said that a function is not followed any more."""
    found = follow(files)
    (one,) = (node for configuration in found.configurations for node in configuration.nodes)
    return names(one), any(unknown.reason == barren.NO_MORE for unknown in one.unknowns)


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(barren, "BARREN", 20)
    monkeypatch.setattr(barren, "OFTEN", 3)


@pytest.mark.usefixtures("short")
def test_a_function_that_makes_the_same_again_and_again_is_not_followed() -> None:
    made, is_said = node(cpp_files(main(f'{SAME}f(nh, "b"); nh.advertise<std_msgs::String>("c", 1);', ONE)))
    assert {"/a", "/c"} <= set(made) and "/b" not in made
    assert is_said


@pytest.mark.usefixtures("short")
def test_so_it_is_in_python() -> None:
    made, is_said = node(python_files(SCRIPT + "f('a')\n" * 8 + "f('b')\nrospy.Publisher('c', String)\n"))
    assert {"/a", "/c"} <= set(made) and "/b" not in made
    assert is_said


@pytest.mark.usefixtures("short")
@pytest.mark.parametrize(
    "code",
    [
        "".join(f'f(nh, "{name}");\n' for name in "efghijkl") + 'f(nh, "b");',  # something new each time
        'f(nh, "a");\n' * 3 + 'f(nh, "d");\n' + 'f(nh, "a");\n' * 3 + 'f(nh, "b");',  # now and then
        'f(nh, "a"); f(nh, "a"); f(nh, "b");',  # few calls
        "int a = 0;\n" + "a = twice(a);\n" * 20 + 'f(nh, "b");',  # another function, that makes nothing anyway
        'nh.advertise<std_msgs::String>("b", 1);\n' * 20,  # no function of the workspace
        'if (argc > 1) { f(nh, "a"); } else { f(nh, "b"); }',
    ],
)
def test_what_makes_something_new_is_followed(code: str) -> None:
    made, is_said = node(cpp_files(main(code, ONE)))
    assert "/b" in made
    assert not is_said


@pytest.mark.parametrize(("dry", "is_there"), [(60, False), (600, True)])
def test_where_nothing_was_made_for_long_fewer_steps_are_enough(
    dry: int, is_there: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(barren, "DRY", dry)
    monkeypatch.setattr(barren, "BARREN_DRY", 20)
    made, is_said = node(cpp_files(main(f'{SAME * 2}f(nh, "b");', ONE)))
    assert ("/b" in made) is is_there
    assert is_said is not is_there


def test_few_steps_are_always_followed() -> None:
    made, is_said = node(cpp_files(main(f'{SAME * 4}f(nh, "b");', ONE)))
    assert {"/a", "/b"} <= set(made)
    assert not is_said


@pytest.mark.usefixtures("short")
def test_what_callbacks_call_is_counted_by_itself() -> None:
    before = f'{ONE}void cb(const std_msgs::String&) {{ ros::NodeHandle nh; f(nh, "b"); }}\n'
    made, is_said = node(cpp_files(main(f'{SAME}nh.subscribe("s", 1, cb);', before)))
    assert "/b" in made
    assert is_said


#: A helper that makes something, called where a condition does not hold, and by what goes on making nothing.
HELPER = "def helper():\n    rospy.Publisher('late', String)\ndef step(n):\n    a = 1\n    a = a + 1\n    if n == 100:\n        helper()\ndef other(n):\n    a = 1\n    a = a + 1\n"
DEAD = "flag = False\nif flag:\n    helper()\n"


@pytest.mark.usefixtures("short")
@pytest.mark.parametrize(
    ("calls", "expected"),
    [
        ("step(1)\n" * 12 + "step(100)\n", False),  # step is not followed any more
        ("step(1)\n" * 12, False),  # which of its calls it is cannot be known then
        ("step(1)\n", True),
        ("other(1)\n" * 12, True),  # it calls no helper
        ("if flag:\n" + "    step(1)\n" * 12, True),  # nor does what is ruled out itself
    ],
)
def test_what_it_calls_is_not_ruled_out(calls: str, expected: bool) -> None:
    text = SCRIPT.replace("rospy.init_node", f"{HELPER}rospy.init_node")
    found = follow(python_files(text + DEAD + calls))
    (one,) = (node for configuration in found.configurations for node in configuration.nodes)
    (late,) = (end for end in one.endpoints if end.name == "/late")
    assert late.is_ruled_out is expected
    assert expected or "conditions" in {unknown.field for unknown in late.unknowns}
