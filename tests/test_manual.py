# SPDX-License-Identifier: Apache-2.0
"""The help of every command, and what a shell completes."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path

import click
import pytest
from commandline import haros

from haros_ci.cli import haros_ci
from haros_ci.commands.completion import words
from haros_ci.commands.manual import ABOUT, EXAMPLES, SECTIONS, SHORT
from haros_ci.commands.output import FOLDERS, FORMATS, PAGES

ROOT = Path(__file__).resolve().parent.parent


def commands(group: click.Group, name: str = "") -> dict[str, click.Command]:
    found: dict[str, click.Command] = {}
    for word, command in group.commands.items():
        own = f"{name} {word}".strip()
        found |= commands(command, own) if isinstance(command, click.Group) else {own: command}
    return found


COMMANDS = commands(haros_ci)


def test_the_page_is_what_help_says() -> None:
    made = subprocess.run(
        [sys.executable, str(ROOT / "tools" / "build_cli_page.py")],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
    )
    page = (ROOT / "docs" / "cli.md").read_text(encoding="utf-8")
    assert made.stdout == page, "python tools/build_cli_page.py > docs/cli.md"


def test_the_tables_speak_of_commands_and_options_that_are_there() -> None:
    options = {name for command in COMMANDS.values() for param in command.params for name in param.opts}
    assert {name for names in SECTIONS.values() for name in names} <= options
    assert {*EXAMPLES} == {*COMMANDS} and {*ABOUT} <= {*COMMANDS}


@pytest.mark.parametrize(
    ("name", "command"), [(name, command) for name, examples in EXAMPLES.items() for _, command in examples]
)
def test_examples_are_spelt_right(name: str, command: str) -> None:
    """Every haros-ci command in an example parses: its options are there, and its arguments fit."""
    for part in command.replace("| dot -Tsvg", "").replace("source <(", "").rstrip(")").split("&&"):
        given = shlex.split(part)
        if given[0] != "haros-ci":
            continue
        length = len(name.split())
        assert " ".join(given[1 : length + 1]) == name
        COMMANDS[name].make_context(name, given[length + 1 :])


def test_the_list_of_commands_fits_a_narrow_terminal() -> None:
    assert {*SHORT} <= {*COMMANDS}
    assert (
        "..." not in haros("--help", cwd=ROOT, COLUMNS="80").stdout.partition("Commands:")[2].partition("Exit codes")[0]
    )


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_says_what_it_does(name: str) -> None:
    assert COMMANDS[name].help, name
    assert [param.name for param in COMMANDS[name].params if isinstance(param, click.Option) and not param.help] == []


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_script_for_each_shell(shell: str) -> None:
    done = haros("completion", shell, cwd=ROOT)
    assert done.returncode == 0 and "_HAROS_CI_COMPLETE" in done.stdout


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("haros-ci che", {"check"}),
        ("haros-ci baseline ", {"create", "update", "prune", "show"}),
        ("haros-ci check --profile str", {"strict"}),
        ("haros-ci explain topic-type-mis", {"topic-type-mismatch"}),
        ("haros-ci check --select metrics,topic-type-mis", {"metrics,topic-type-mismatch"}),
        ("haros-ci check --select no-such-", set()),
        ("haros-ci check --fail-on ", {"error", "warning", "note", "never"}),
    ],
)
def test_what_a_shell_is_told(line: str, expected: set[str]) -> None:
    done = haros(
        cwd=ROOT,
        _HAROS_CI_COMPLETE="bash_complete",
        COMP_WORDS=line,
        COMP_CWORD=str(len(line.split(" ")) - 1),
    )
    assert {told.partition(",")[2] for told in done.stdout.split()} == expected


@pytest.mark.parametrize(
    ("typed", "pieces", "expected"),
    [
        ("haros-ci che", ["che"], ["check"]),
        ("haros-ci explain haros-ci:topic-type-mis", ["explain", "haros-ci", ":", "topic-type-mis"], ["topic-type-mismatch"]),
        ("haros-ci explain shellcheck:", ["explain", "shellcheck", ":"], ["SC1008"]),
        ("haros-ci check --output=jun", ["check", "--output", "=", "jun"], ["junit"]),
        ("haros-ci check --output ", ["check", "--output", ""], ["checkstyle"]),
        ("haros-ci check --select flake8:E501,yamllint:tru", ["check", "--select", "flake8", ":", "E501,yamllint", ":", "tru"], ["truthy"]),
        ("haros-ci check --output junit=out", ["check", "--output", "junit", "=", "out"], ["FILES"]),
        ("haros-ci explain no-such:", ["explain", "no-such", ":"], []),
        ("haros-ci query 'a b' --fail-on-", ["query", "'a b'", "--fail-on-"], ["--fail-on-match"]),
    ],
)  # fmt: skip
def test_what_bash_is_told_of_words_that_it_has_split(
    typed: str, pieces: list[str], expected: list[str], tmp_path: Path
) -> None:
    """Bash hands a word over in pieces, at : and =, and replaces the last piece alone."""
    program = tmp_path / "haros-ci"
    program.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m haros_ci "$@"\n')
    program.chmod(0o755)
    told = subprocess.run(
        [
            *("bash", "-c"),
            'eval "$1"; compopt() { COMPREPLY=(FILES); }; COMP_LINE=$2; shift 2; COMP_WORDS=(haros-ci "$@"); COMP_CWORD=$#; '
            '_haros_ci_completion haros-ci; printf "%s\\n" "${COMPREPLY[@]:0:1}"',
            *("bash", haros("completion", "bash", cwd=ROOT).stdout, typed, *pieces),
        ],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"},
        check=True,
    )
    assert told.stderr == "" and told.stdout.split() == expected


def test_words_by_kind() -> None:
    assert words("formats", "") == sorted((*FORMATS, *FOLDERS, *PAGES))
    assert words("metrics", "nest") == ["nested-control"]
    assert "pylint" in words("tools", "py") and words("profiles", "strict,bugs") == ["strict,bugs-only"]
