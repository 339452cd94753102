# SPDX-License-Identifier: Apache-2.0
"""Names and texts of a hostile workspace in generated monitors: literals of ASCII, and nothing else."""

from __future__ import annotations

import ast
from typing import Any

import pytest

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import core_text
from haros_ci.monitor_files.literals import literal
from haros_ci.monitor_files.monitor_file import Watched, monitor_file, plain_name
from haros_ci.monitoring.patterns import monitor_of

TEXTS = [
    'it\'s "quoted"',
    '"""\nimport os; os.system("x")\n"""',
    "'''\nraise SystemExit\n'''",
    "a\nb\r\nc\rd",
    "a\u2028b\u2029c\x85d\x0be\x0cf\x1cg",
    "\\",
    "\\'; __import__('os')",
    "{0} %s %(x)s {{}} #",
    "\x00\x1b[2J\u202e\ufeff\ud800",
    "\N{FULLWIDTH APOSTROPHE}\N{ZERO WIDTH SPACE}x",
]
OF_THE_INTERPRETER = {"__import__", "exec", "eval", "compile", "globals"}


def constants(text: str) -> set[Any]:
    return {node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Constant)}


def shape(text: str) -> list[str]:
    """The program without its literals."""
    return [type(node).__name__ for node in ast.walk(ast.parse(text))]


def written(word: str) -> str:
    described = Described(
        monitor_of(parse_property("globally: no /a {x = 1}"), {"/a": word}), word, word, word, word, place=(word, 1, 2)
    )
    action = {"publish": word, "type": word, "message": {word: [word, {word: 1.5}]}}
    watched = Watched(word, 1, {word: word}, {word: ((word, word, 1),)}, {word: [action]}, {word: {word: word}})
    return monitor_file(watched, [described])[0]


@pytest.mark.parametrize("word", TEXTS)
def test_texts_are_literals_alone(word: str) -> None:
    made = written(word)
    assert made.isascii() and word in constants(made)
    assert shape(made) == shape(written("plain"))
    assert [line.count("\r") for line in made.split("\n") if "\r" in line] == []
    compile(made, "generated", "exec")


@pytest.mark.parametrize("word", ["it's", "a\\\\b", "\u2028", "'''", "{}", "\ud800", "\x1b[2J", '\\"', "\\n"])
def test_texts_of_predicates_are_literals_alone(word: str) -> None:
    def text(value: str) -> str:
        described = Described(
            monitor_of(
                parse_property(f'globally: /a as A causes /b {{name = "{value}" and y in {{"{value}", @A.z}}}}')
            ),
            "a",
            "b",
        )
        return monitor_file(Watched("a", 1, {}), [described])[0]

    made = text(word)
    assert made.isascii() and shape(made) == shape(text("plain"))
    compile(made, "generated", "exec")


@pytest.mark.parametrize(
    "name", ["__class__", "__import__", "exec", "lambda", "None", "m", "known", "get", "import", "_x"]
)
def test_names_of_fields_and_variables_are_no_names_of_python(name: str) -> None:
    text = f"globally: no /a {{{name}.x > 1 and (exists {name} in list: list[@{name}] = {name})}}"
    described = Described(monitor_of(parse_property(text)), "a", "b")
    made = monitor_file(Watched("a", 1, {}), [described])[0]
    names = {node.id for node in ast.walk(ast.parse(made)) if isinstance(node, ast.Name)}
    assert not OF_THE_INTERPRETER & names


@pytest.mark.parametrize("name", ["__class__", "__dict__", "__init__", "_fields", "serialize", "mro"])
def test_predicates_reach_no_insides_of_objects(name: str) -> None:
    class Message:
        __slots__ = ("x", "_fields")

        def serialize(self) -> None:
            raise AssertionError

    described = Described(monitor_of(parse_property(f"globally: no /a {{{name} = 1 or {name}.x = 1}}")), "a", "b")
    found: dict[str, Any] = {"__name__": "generated"}
    exec(core_text([described])[0], found)
    monitors = found["Monitors"](found["PROPERTIES"])
    monitors.on_message("/a", Message(), 0)
    assert monitors.finish(1)[0]["faults"] == 1


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("robot", "robot"),
        ("../../etc/passwd", "etc_passwd"),
        ("a b\n", "a_b"),
        ("", "all"),
        ("\u2028", "all"),
        ("x" * 500, "x" * 100),
        ("-rf", "rf"),
    ],
)
def test_names_of_files(name: str, file: str) -> None:
    assert plain_name(name) == file


@pytest.mark.parametrize(
    "value", [None, True, 0, -3, 1.5, float("inf"), float("-inf"), "a'b", (1,), (1, 2), [1, []], {"a": {"b": (None,)}}]
)
def test_a_literal_is_the_value(value: Any) -> None:
    assert eval(literal(value), {"__builtins__": {}, "float": float}) == value
