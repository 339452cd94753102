# SPDX-License-Identifier: Apache-2.0
"""codespell: common misspellings in every text file, with the workspace's lists of words."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from posixpath import dirname, join, normpath

from haros_ci.linters import columns, installed, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.package import LANGUAGES as ALL_LANGUAGES
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "codespell"
LANGUAGES = frozenset(ALL_LANGUAGES)
WHEN = When.ASKED
COST = 2.0

RULE = "misspelling"
#: codespell reads them all, the later over the earlier; here the first one counts.
MARKS = {".codespellrc": ("[codespell]",), "setup.cfg": ("[codespell]",), "pyproject.toml": ("[tool.codespell",)}
#: Left out is what writes (write-changes, interactive), changes the output, or reads further files but for those below.
INERT = frozenset("ignore-words-list uri-ignore-words-list ignore-regex ignore-multiline-regex regex builtin".split())
#: Lists of words and of lines in files of the workspace.
FILES = ("ignore-words", "exclude-file", "dictionary")
#: As much of such a list is passed on.
LIST_SIZE = 1_000_000
#: As many of them count for each option.
MOST_LISTS = 8

_LINE = regex(r"(.+):(\d+): (\S+) ==> (.+)$")


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options, "codespell_lib")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return json.dumps([options.arguments.get(NAME, ()) if options.trust_config else ()])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Files but those that the settings skip; the lists that the settings name are settings, too."""
    settings: dict[str, dict[str, object]] = {}
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        config = unit.group
        if config not in settings:
            settings[config] = settings_files.read(workspace, config).get(NAME, {}) if config else {}
        if not settings_files.excludes(settings[config].get("skip", ""), config, unit.file.path):
            named = (path for key in FILES for path in lists(key, settings[config], config))
            yield Unit(unit.file, group=config, settings=(*unit.settings, *named))


def command(program: Program, batch: Batch) -> Command:
    """It runs where no settings are: it would read those of its directory, and what they say cannot be taken back."""
    settings = settings_files.read(batch.workspace, batch.group).get(NAME, {})
    chosen = {key: settings_files.as_text(value) for key, value in settings_files.inert(settings, INERT).items()}
    options = [f"--{key}={value}" for key, value in sorted(chosen.items()) if value]
    for key in FILES:
        for number, path in enumerate(lists(key, settings, batch.group)):
            copy = batch.scratch / f"{key}-{number}"
            copy.write_text(batch.workspace.setting(path)[:LIST_SIZE], encoding="utf-8")
            options.append(f"--{key}={copy}")
        if key == "dictionary" and "-" in settings_files.words(settings.get(key, "")):
            options.append("--dictionary=-")
    if batch.options.trust_config:
        options += batch.options.arguments.get(NAME, ())
    layout = ("--check-hidden", "--disable-colors", "--quiet-level=35")
    names = (os.path.join(batch.workspace.root, file.path) for file in batch.files)
    return Command((*program.argv, *layout, *options, "--", *names), cwd=batch.scratch)


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """``file:line: word ==> corrections``; exit code 65 says that there are some, 64 that the options are wrong."""
    if output.code not in (0, 65):
        raise ValueError(f"exit code {output.code}")
    paths = {os.path.join(batch.workspace.root, file.path): file.path for file in batch.files}
    seen: dict[tuple[str, int, str], int] = {}
    for message in output.stdout.decode("utf-8", "replace").split("\n")[:-1]:
        match = _LINE.match(message)
        if match is None:
            raise ValueError("not a line of codespell")
        path, line, word = paths[match[1]], int(match[2]), match[3]
        nth = seen.get((path, line, word), 0)
        seen[path, line, word] = nth + 1
        place = columns.word_at(path, batch.workspace.text(path), line, word, nth)
        yield Finding(path, Result(NAME, RULE, Level.WARNING, _message(word, match[4]), place))


def _message(word: str, corrections: str) -> str:
    """``fix1, fix2,  | reason``: a word with several corrections is the writer's to choose."""
    suggested, _, reason = corrections.partition("  | ")
    choices = [choice.strip() for choice in suggested.split(",") if choice.strip()]
    message = (
        f"'{word}' should be '{choices[0]}'"
        if len(choices) == 1
        else f"'{word}' should be one of: {', '.join(choices)}"
    )
    return f"{message} ({reason.strip()})." if reason.strip() else f"{message}."


def lists(key: str, settings: dict[str, object], config: str) -> list[str]:
    """The files that the option *key* names, if they are in the workspace."""
    value = settings.get(key, settings.get(key.replace("-", "_"), ""))
    named = [normpath(join(dirname(config), word)) for word in settings_files.words(value) if word != "-"]
    return [path for path in dict.fromkeys(named) if not path.startswith(("..", "/"))][:MOST_LISTS]
