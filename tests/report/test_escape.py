# SPDX-License-Identifier: Apache-2.0
"""Foreign text stays text in a terminal, a workflow command and Markdown."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from report_samples import HOSTILE

from haros_ci.report import escape


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b]52;c;x\x07", "�]52;c;x�"),
        ("a\nb\rc", "a�b�c"),
        ("a\tb", "a b"),
        ("\u202eexe.png", "�exe.png"),
        ("\u2066\u2069\u200f\u061c", "����"),
        ("\x7f\x85\x9b31m", "���31m"),
        ("caf\udce9", "caf�"),
        ("\u2028\u2029", "��"),
        ("x\U000e0041", "x�"),
    ],
)
def test_terminal_replaces(text: str, shown: str) -> None:
    assert escape.terminal(text) == shown


@pytest.mark.parametrize(
    "text",
    [
        "",
        "plain",
        "größe",
        "漢字",
        "👩‍🚀",
        "a b",
        "a%b|c:d,e",
        "::error::",
        "<b>",
        "\u00ad",
        "e\u0301",
        "שלום",
        "C:\\x",
    ],
)
def test_terminal_leaves(text: str) -> None:
    assert escape.terminal(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("::error::x", "./::error::x"),
        (" \t::stop-commands::x", "  ./::stop-commands::x"),
        ("a ::error::x", "a ::error::x"),
        (":error", ":error"),
        ("##[error]x", "##�error]x"),
        ("a\n::error::x", "a�::error::x"),
        ("", ""),
    ],
)
def test_no_line_begins_as_a_command(text: str, shown: str) -> None:
    assert escape.log_line(text) == shown


def test_multiline_keeps_lines() -> None:
    assert escape.multiline("a\r\n\tb\x1b\rc") == "a\n\tb��c"


@pytest.mark.parametrize(
    ("text", "data", "value"),
    [
        ("50% of\nit", "50%25 of%0Ait", "50%25 of%0Ait"),
        ("%0A::x", "%250A::x", "%250A%3A%3Ax"),
        ("a:b,c", "a:b,c", "a%3Ab%2Cc"),
        ("a\r\nb", "a%0Ab", "a%0Ab"),
        ("plain text", "plain text", "plain text"),
    ],
)
def test_workflow_commands(text: str, data: str, value: str) -> None:
    assert escape.workflow_data(text) == data
    assert escape.workflow_property(text) == value


@pytest.mark.parametrize("text", HOSTILE)
def test_nothing_active_is_left(text: str) -> None:
    assert escape.terminal(text).isprintable() and len(escape.terminal(text)) == len(text)
    for value in (escape.workflow_data(text), escape.workflow_property(text)):
        assert "\n" not in value and "\r" not in value
    assert not set(":,") & set(escape.workflow_property(text))
    written = escape.markdown(text)
    assert not re.search(r"[<>|`*\[\]()\\@:!$]", written)
    assert not re.search(r"&#64;[A-Za-z]", written), "a mention is found after rendering"
    inner = escape.markdown_code(text).removeprefix("<code>").removesuffix("</code>")
    assert not re.search(r"[<>|`*\[\]()\\@:!$]", inner)


@pytest.mark.parametrize("text", ["src/base-node.cpp", "The scope of 'x' can be reduced.", "größe 3.5, 'a' \"b\"; 50%"])
def test_markdown_leaves(text: str) -> None:
    assert escape.markdown(text) == text


COMMANDS = (
    "##[error]x.py",
    "##vso[task.setvariable variable=PATH]x",
    "a ##VSO[task.complete]",
    "##teamcity[message text='x']",
)
EVIL = ("\u202ered.py", "\x1b[31m.py", *COMMANDS, "a\u2028b", "\ud800")


@pytest.mark.parametrize("text", EVIL)
def test_json_is_ascii_and_no_command(text: str) -> None:
    found = escape.json_document({text: [text]}, 1)
    assert found.isascii() and not re.search(r"##\w*\[", found) and json.loads(found) == {text: [text]}
    assert not any(ord(c) < 32 and c != "\n" for c in found)


@pytest.mark.parametrize("text", COMMANDS)
def test_no_text_is_a_command_to_a_runner(text: str) -> None:
    for sink in (escape.terminal, escape.multiline, escape.patch, escape.workflow_data):
        assert not re.search(r"##\w*\[", sink(text))


@pytest.mark.parametrize("text", ["## heading [a]", "#define A(x) x##y[0]", "##vso is not one", "a[0] ## b"])
def test_hashes_that_are_no_command_stay(text: str) -> None:
    assert escape.terminal(text) == escape.multiline(text) == escape.no_command(text) == text


def test_what_commands_print_as_json_goes_through_it() -> None:
    """A document that is laid out is printed, or shown to people; the rules of ``rules --json`` are haros-ci's own words."""
    package = Path(escape.__file__).parent
    texts = {
        file: file.read_text("utf-8") for room in (package, package.parent / "commands") for file in room.glob("*.py")
    }
    by_hand = {file.name for file, text in texts.items() if re.search(r"json\.dumps\([^\n]*\bindent=", text)}
    assert by_hand == {"escape.py", "rules.py"}
