# SPDX-License-Identifier: Apache-2.0
"""Settings of tools that lie in the workspace: which file holds for a directory, what is in it, and how it is written.

Tools never get such a file itself: an adapter takes the keys that only count, switch or name things, writes them into a
file of its own and names that one to the tool.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from fnmatch import fnmatch
from posixpath import dirname, join, relpath
from typing import Any

from haros_ci.linters.linter import Unit
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: File names in the order in which they win, each with the texts one of which a file with settings holds; none: any content.
Marks = Mapping[str, tuple[str, ...]]

#: Settings files in INI, by name.
INI_FILES = frozenset(
    "setup.cfg tox.ini mypy.ini .mypy.ini .flake8 .isort.cfg .bandit .codespellrc pylintrc .pylintrc".split()
)
#: Options that the sections of an INI file may get from its ``[DEFAULT]``, all together.
MAX_INHERITED = 100_000
#: The standard library's parsers take quadratic time for these: a run of spaces in INI, a key of many parts in TOML.
_LONG_SPACE = regex(r"[^\S\r\n]{50,}")
_LONG_KEY = regex(r"""(?<![\w-])(?:(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*){40}""")


def nearest(workspace: Workspace, directory: str, marks: Marks) -> str | None:
    """The first file of *marks* with settings, from *directory* up to the workspace's root."""
    while True:
        for name, texts in marks.items():
            text = workspace.setting(join(directory, name))
            if any(mark in text for mark in texts) if texts else text.strip():
                return join(directory, name)
        if not directory:
            return None
        directory = dirname(directory)


def units(
    workspace: Workspace,
    languages: Collection[str],
    marks: Marks,
    needs: Callable[[str, str], Iterable[str]] = lambda path, config: (),
) -> Iterator[Unit]:
    """One unit per file of *languages* and one group per settings file; *needs* tells its dependencies (path, settings)."""
    configs: dict[str, str] = {}
    for file in workspace.files:
        if file.language in languages:
            directory = dirname(file.path)
            if directory not in configs:
                configs[directory] = nearest(workspace, directory, marks) or ""
            config = configs[directory]
            own = (config,) if config else ()
            yield Unit(file, group=config, dependencies=tuple(needs(file.path, config)), settings=own)


def read(workspace: Workspace, path: str) -> dict[str, dict[str, object]]:
    """The sections of the settings file at *path*; for TOML, the tables below ``tool``.

    A file that cannot be read is as if there were none.
    """
    if not path:
        return {}
    try:
        return toml(workspace.setting(path)) if path.endswith(".toml") else ini(workspace.setting(path))
    except (ValueError, RecursionError):
        return {}


def check(text: str, path: str) -> None:
    """Raises ValueError if *text*, the settings file at *path*, is not what its name promises."""
    name = path.rpartition("/")[2]
    if name.endswith(".toml"):
        tables(text)
    elif name in INI_FILES:
        ini(text)


def inert(settings: Mapping[str, object], keys: Collection[str]) -> dict[str, object]:
    """The plain values of *settings* whose key, written with ``-``, is one of *keys*."""
    options = ((key.strip().lower().replace("_", "-"), value) for key, value in settings.items())
    return {key: value for key, value in options if key in keys and plain(value)}


def excludes(globs: object, config: str, path: str) -> bool:
    """Whether *globs* in the settings file *config* name *path* or a directory that it is in.

    As tools do that look for files themselves and were started beside their settings: a glob is of a name, or of a
    whole path with or without ``./``.
    """
    inside = relpath(path, dirname(config) or ".")
    parts = inside.split("/")
    above = ("/".join(parts[:n]) for n in range(1, len(parts)))
    names = {*parts, *(f"{dot}{name}" for name in (inside, *above) for dot in ("", "./"))}
    patterns = [word.rstrip("/") for word in words(globs)]
    return any(fnmatch(name, pattern) for pattern in patterns for name in names)


def ini(text: str) -> dict[str, dict[str, object]]:
    """The sections of an INI file. Raises ValueError if it cannot be read."""
    import configparser

    parser = configparser.RawConfigParser(strict=False)
    try:
        parser.read_string(_LONG_SPACE.sub(" ", text))
        if len(parser.defaults()) * len(parser.sections()) > MAX_INHERITED:
            raise ValueError("too many defaults")
        return {section: dict(parser.items(section)) for section in parser.sections()}
    except configparser.Error as err:
        raise ValueError(str(err).splitlines()[0]) from err


def toml(text: str) -> dict[str, dict[str, object]]:
    """The tables below ``tool``. Raises ValueError if it cannot be read."""
    tool = tables(text).get("tool", {})
    return {k: v for k, v in tool.items() if isinstance(v, dict)} if isinstance(tool, dict) else {}


def tables(text: str) -> dict[str, Any]:
    """A whole TOML document. Raises ValueError if it cannot be read."""
    try:
        import tomllib
    except ModuleNotFoundError:  # Python 3.10, where the tools themselves bring tomli
        import tomli as tomllib  # type: ignore[no-redef,unused-ignore]  # the other one
    if _LONG_KEY.search(text):
        raise ValueError("a key of too many parts")
    document: dict[str, Any] = tomllib.loads(text)  # TOMLDecodeError is a ValueError
    return document


def plain(value: object) -> bool:
    """Whether a value is a text, a number, a switch or a list of such."""
    return all(isinstance(v, (str, int, float)) for v in (value if isinstance(value, list) else [value]))


def words(value: object) -> list[str]:
    """A list as either notation has it: a TOML list, or items on lines or between commas."""
    items = value if isinstance(value, list) else str(value).replace("\n", ",").split(",")
    return [word for word in (str(item).strip() for item in items) if word]


def as_text(value: object) -> str:
    """A plain value as INI files have it."""
    return ",".join(str(item) for item in value) if isinstance(value, list) else str(value)


def ini_text(section: str, options: Mapping[str, object]) -> str:
    """One section of an INI file; no value can begin another section or option."""
    name = "".join(c for c in section if c.isprintable() and c not in "[]")
    lines = (f"{key} = {continued(as_text(value))}" for key, value in sorted(options.items()))
    return f"[{name}]\n" + "\n".join(lines) + "\n"


def continued(value: str) -> str:
    """A value of several lines as INI continuation lines."""
    return "\n    ".join(line.strip() for line in value.splitlines() if line.strip())


def toml_text(table: str, options: Mapping[str, object]) -> str:
    """The table ``tool.<table>`` of plain values as TOML."""
    lines = (f"{json.dumps(key)} = {_toml(value)}" for key, value in sorted(options.items()))
    return f"[tool.{table}]\n" + "\n".join(lines) + "\n"


def _toml(value: object) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return str(value)
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
