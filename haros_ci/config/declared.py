# SPDX-License-Identifier: Apache-2.0
"""Entries of ``linters`` with an ``exec``: tools of the user's own (docs/declared-tools.md)."""

from __future__ import annotations

from typing import Any

from haros_ci.config.exemptions import pattern
from haros_ci.config.shapes import File, kind
from haros_ci.config.suggestion import quoted
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.model.declared_tool import FILE, FILES, OUTPUTS, PARTS, STREAMS, DeclaredTool
from haros_ci.model.package import LANGUAGES
from haros_ci.regex import regex
from haros_ci.results.linear_regex import compiled

EXEC_KEYS = ("exec", "files", "languages", "reads", "output", "pattern", "fields", "levels", "stream", "exit")
LEVELS = ("error", "warning", "note", "off")
MAX_ARGUMENTS = 100
MAX_ARGUMENT = 1_000  # characters
MAX_FIELD = 200  # characters
MAX_CODES = 20
FORM = "my-tool: {exec: [my-tool, '{files}'], languages: [cpp], output: gcc}"
_NAME = regex(r"[A-Za-z0-9][A-Za-z0-9_.+-]{0,59}")


def read_declared(file: File, name: str, value: YamlValue, *, trust: bool) -> DeclaredTool | None:
    """The tool *name* if its entry has an ``exec``; a note where the file is not trusted, so that it will not run."""
    entries = _entries(value)
    if "exec" not in entries:
        for key in EXEC_KEYS:
            if key in entries:
                message = f"{quoted(key)} of linter {quoted(name)} is for a tool of your own, with an 'exec'"
                raise file.error(entries[key].key_line, message, f"write {FORM}")
        return None
    what, line = f"linter {quoted(name)}", value.key_line
    if not _NAME.fullmatch(name):
        raise file.error(line, f"{what}: a tool's name has letters, digits and _.+-", "choose another name")
    if "arguments" in entries:
        raise file.error(entries["arguments"].key_line, f"{what} has an 'exec'", "write its arguments there")
    tool = DeclaredTool(
        name=name,
        argv=_argv(file, entries["exec"], what),
        files=_globs(file, entries, "files"),
        languages=_languages(file, entries),
        reads=_globs(file, entries, "reads"),
        output=_choice(file, entries, "output", OUTPUTS, "gcc"),
        pattern=_pattern(file, entries, what),
        fields=_fields(file, entries, what),
        levels=_levels(file, entries),
        stream=_choice(file, entries, "stream", STREAMS, "both" if _output(entries) == "gcc" else "stdout"),
        exits=_exits(file, entries, what),
        origin=f"{file.name}:{line}",
    )
    if not tool.files and not tool.languages:
        raise file.error(
            line, f"{what} does not say which files it is for", "add languages: [cpp] or files: ['**/*.c']"
        )
    off = "enabled" in entries and entries["enabled"].data is False
    if not trust and not off:
        file.note(f"{what} starts a program, so it is run only with --trust-config", line)
    return tool


def _entries(value: YamlValue) -> dict[str, YamlValue]:
    if not isinstance(value.data, dict):
        return {}
    return {str(key): item for key, item in value.data.items() if item.data is not None}


def _output(entries: dict[str, YamlValue]) -> object:
    return entries["output"].data if "output" in entries else "gcc"


def _choice(file: File, entries: dict[str, YamlValue], key: str, known: tuple[str, ...], usual: str) -> str:
    return file.choice(entries[key], f"'{key}'", known) if key in entries else usual


def _argv(file: File, value: YamlValue, what: str) -> tuple[str, ...]:
    """The arguments, beginning with the program. A list is required, because no shell splits the line."""
    if not isinstance(value.data, tuple):
        raise file.error(value.line, f"'exec' of {what} must be a list, not {kind(value)}", f"write {FORM}")
    if not value.data or len(value.data) > MAX_ARGUMENTS:
        raise file.error(value.line, f"'exec' of {what} must have 1 to {MAX_ARGUMENTS} entries", f"write {FORM}")
    argv: list[str] = []
    for item in value.data:
        if not isinstance(item.data, str) or (not argv and not item.data.strip()):
            raise file.error(item.line, f"an argument in 'exec' of {what} must be text, not {kind(item)}", "quote it")
        if len(item.data) > MAX_ARGUMENT or "\0" in item.data:
            raise file.error(item.line, f"an argument in 'exec' of {what} is too long or has a NUL", "shorten it")
        argv.append(item.data)
    places = [item for item in argv if FILES in item]
    if places and (places != [FILES] or any(FILE in item for item in argv) or argv[0] == FILES):
        message = f"'exec' of {what}: {FILES} stands once, as an argument of its own, and not beside {FILE}"
        raise file.error(value.line, message, f"write {FORM}")
    if FILE in argv[0]:
        raise file.error(value.line, f"'exec' of {what} begins with a file", "begin with the program")
    if argv[0].startswith("-"):
        raise file.error(value.line, f"'exec' of {what} begins with an option", "begin with the program")
    return tuple(argv)


def _globs(file: File, entries: dict[str, YamlValue], key: str) -> tuple[str, ...]:
    return tuple(file.glob(named) for named in file.texts(entries[key], key)) if key in entries else ()


def _languages(file: File, entries: dict[str, YamlValue]) -> tuple[str, ...]:
    if "languages" not in entries:
        return ()
    file.texts(entries["languages"], "languages")
    items: Any = entries["languages"].data
    return tuple(file.choice(item, "a language", LANGUAGES) for item in items)


def _pattern(file: File, entries: dict[str, YamlValue], what: str) -> str:
    expected = _output(entries) == "regex"
    if expected != ("pattern" in entries):
        line = entries["pattern" if not expected else "output"].key_line
        raise file.error(
            line, f"{what}: 'pattern' goes with output: regex, and that needs one", "see docs/declared-tools.md"
        )
    if not expected:
        return ""
    text = pattern(file, entries["pattern"], "'pattern'")
    groups = compiled(text).groups
    line = entries["pattern"].line
    for group in groups:
        if _part(group) not in PARTS:
            raise file.error(line, f"'pattern' of {what}: no group is called {quoted(group)}", f"one of: {_spelt()}")
    for group in ("path", "message"):
        if group not in groups:
            raise file.error(line, f"'pattern' of {what} has no group {quoted(group)}", f"add (?P<{group}>…)")
    return text


def _part(group: str) -> str:
    return group.replace("_", "-")


def _spelt() -> str:
    return ", ".join(part.replace("-", "_") for part in PARTS)


def _fields(file: File, entries: dict[str, YamlValue], what: str) -> tuple[tuple[str, str], ...]:
    """Where the parts of a finding stand in JSON; without it, under their own names."""
    if "fields" not in entries:
        return ()
    line = entries["fields"].key_line
    if _output(entries) not in ("json", "json-lines"):
        raise file.error(line, f"{what}: 'fields' goes with output: json or json-lines", "leave it out")
    form = "fields: {results: issues, path: file, line: location.row}"
    parts = file.map(entries["fields"], f"'fields' of {what}", form, ("results", *PARTS))
    found = []
    for key, value in parts.items():
        text = file.text(value, f"'{key}' in 'fields'")
        if len(text) > MAX_FIELD:
            raise file.error(value.line, f"'{key}' in 'fields' has more than {MAX_FIELD} characters", "shorten it")
        found.append((key, text))
    return tuple(sorted(found))


def _levels(file: File, entries: dict[str, YamlValue]) -> tuple[tuple[str, str], ...]:
    if "levels" not in entries:
        return ()
    found = []
    for word, value in file.map(entries["levels"], "'levels'", "levels: {E: error, '*': note}").items():
        # YAML 1.1 reads a bare off as false
        level = "off" if value.data is False else file.choice(value, f"the level of {quoted(word)}", LEVELS)
        found.append((word, level))
    return tuple(sorted(found))


def _exits(file: File, entries: dict[str, YamlValue], what: str) -> tuple[int, ...]:
    if "exit" not in entries:
        return (0, 1)
    value = entries["exit"]
    if value.data == "any":
        return ()
    items = value.data if isinstance(value.data, tuple) else (value,)
    codes = [item.data for item in items]
    if not codes or len(codes) > MAX_CODES or not all(type(code) is int and 0 <= code <= 255 for code in codes):
        raise file.error(
            value.line, f"'exit' of {what} must be a list of codes from 0 to 255", "write exit: [0, 1], or exit: any"
        )
    return tuple(sorted({code for code in codes if isinstance(code, int)}))
