# SPDX-License-Identifier: Apache-2.0
"""Flags of gflags: their defaults, and what a command line gives them."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp_files, follow

from haros_ci.model.architecture import Node

FLAGS = (
    'DEFINE_string(topic, "chat", "help");\nDEFINE_bool(latch, false, "help");\nDEFINE_int32(queue, 3, "help");\n'
    'DEFINE_string(computed, word(), "help");\nDEFINE_string(pasted, "a" "b",\n  "help");\n'
)
PARSE = "google::ParseCommandLineFlags(&argc, &argv, true); "
MADE = "ros::Publisher p = nh.advertise<std_msgs::String>(FLAGS_topic, FLAGS_queue, FLAGS_latch);"


def node(body: str, words: str | None = None, flags: str = FLAGS, **others: str) -> Node:
    begun = body.replace("INIT", 'ros::init(argc, argv, "n"); ros::NodeHandle nh; ')
    main = f"int main(int argc, char** argv) {{ {begun} }}"
    launch = (
        ""
        if words is None
        else f'<launch><arg name="w" default="w"/><arg name="open"/><node pkg="p" type="n" name="n" args="{words}"/></launch>'
    )
    ((found,),) = (
        each.nodes for each in follow(cpp_files(f"{CPP_HEAD}{flags}{main}", launch, **others)).configurations
    )
    return found


def made(found: Node) -> list[tuple[str, int | None, bool | None]]:
    return [(e.name, e.queue_size, e.latched) for e in found.endpoints if e.kind == "publishers" and not e.implicit]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (None, ("/chat", 3, False)),
        ("", ("/chat", 3, False)),
        ("--topic=other", ("/other", 3, False)),
        ("-topic=other", ("/other", 3, False)),
        ("--topic other --queue 7", ("/other", 7, False)),
        ("--latch", ("/chat", 3, True)),
        ("--latch --nolatch", ("/chat", 3, False)),
        ("--latch=true", ("/chat", 3, True)),
        ("--latch=no", ("/chat", 3, False)),
        ("--unknown=other", ("/chat", 3, False)),
        ("other --topic=$(arg w)", ("/w", 3, False)),
        ("-- --topic=other", ("/chat", 3, False)),
    ],
)
def test_known_flags(words: str | None, expected: tuple[str, int, bool]) -> None:
    assert made(node(f"{PARSE}INIT {MADE}", words)) == [expected]
    assert made(node(f"{PARSE.replace('google', 'gflags')}INIT {MADE}", words)) == [expected]


@pytest.mark.parametrize("words", ["$(arg open)", "--flagfile=flags.txt", "--topic=$(arg open)"])
def test_a_command_line_that_is_not_known(words: str) -> None:
    assert [name for name, _, _ in made(node(f"{PARSE}INIT {MADE}", words))] == ["/?"]


def test_a_number_that_is_none() -> None:
    assert made(node(f"{PARSE}INIT {MADE}", "--queue=many")) == [("/chat", None, False)]


def test_flags_that_are_not_read_from_the_command_line() -> None:
    assert made(node(f"INIT {MADE}", "--topic=other")) == [("/chat", 3, False)]


@pytest.mark.parametrize(
    ("flags", "name"),
    [
        (FLAGS, "computed"),  # what the default is, is not known
        (FLAGS, "elsewhere"),
        ('DECLARE_string(topic);\nDEFINE_int32(queue, 1, "");\nDEFINE_bool(latch, false, "");\n', "topic"),
        (
            'OTHER_string(topic, "chat", "help");\nDEFINE_int32(queue, 1, "");\nDEFINE_bool(latch, false, "");\n',
            "topic",
        ),
        ('DEFINE_string(topic);\nDEFINE_int32(queue, 1, "");\nDEFINE_bool(latch, false, "");\n', "topic"),
    ],
)
def test_what_is_not_known(flags: str, name: str) -> None:
    assert [n for n, _, _ in made(node(f"{PARSE}INIT {MADE.replace('topic', name)}", None, flags))] == ["/?"]


def test_pasted_texts_assignments_and_other_files() -> None:
    assert [n for n, _, _ in made(node(f"{PARSE}INIT {MADE.replace('topic', 'pasted')}"))] == ["/ab"]
    assert [n for n, _, _ in made(node(f'{PARSE}FLAGS_topic = "mine"; INIT {MADE}', "--topic=other"))] == ["/mine"]
    declared = 'DECLARE_string(topic);\nDEFINE_int32(queue, 3, "");\nDEFINE_bool(latch, false, "");\n'
    found = node(
        f"{PARSE}INIT {MADE}",
        None,
        declared,
        flags__cpp='#include <gflags/gflags.h>\nDEFINE_string(topic, "far", "help");\n',
    )
    assert [n for n, _, _ in made(found)] == ["/far"]


def test_what_is_left_of_the_command_line() -> None:
    body = f"{PARSE}INIT ros::Publisher p = nh.advertise<std_msgs::String>(argv[1], 1);"
    assert [n for n, _, _ in made(node(body, "other"))] == ["/other"]
    assert [n for n, _, _ in made(node(body, "--latch other"))] == ["/?"]


def test_a_text_that_is_empty_is_given_by_whoever_starts_the_program() -> None:
    flags = FLAGS.replace('"chat"', '""')
    assert [n for n, _, _ in made(node(f"{PARSE}INIT {MADE}", None, flags))] == ["/?"]
    assert [n for n, _, _ in made(node(f"{PARSE}INIT {MADE}", "--topic=other", flags))] == ["/other"]
