# SPDX-License-Identifier: Apache-2.0
"""Runs cpplint over the files that stdin names, with the settings that stdin brings: the same words in less time.

Run as a script in isolated mode: ``cpplint_worker.py DIRECTORY OPTIONS``, in the workspace's root. The request is
``{"files": [NAME, …], "settings": {PATH: TEXT, …}}``, where the paths are those of CPPLINT.cfg files relative to the root.
"""

from __future__ import annotations

import codecs
import importlib
import io
import json
import os
import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

try:
    from re import _constants as codes  # type: ignore[attr-defined]  # has no stub
    from re import _parser as syntax  # type: ignore[attr-defined]  # has no stub
except ImportError:  # Python 3.10
    import sre_constants as codes
    import sre_parse as syntax

if not __package__:  # run as a script: haros_ci itself, also where it is not installed
    sys.path.append(str(Path(__file__).resolve().parents[2]))

from haros_ci.linters.metrics_worker import cpu_limit, seconds_for

#: How many patterns are kept: cpplint makes some of names that it reads.
KEPT = 4000


class GuardedPattern:
    """A compiled pattern that is only tried on lines that contain its literal *word*."""

    def __init__(self, pattern: Any, word: str) -> None:
        self._search = pattern.search
        self._word = word

    def search(self, line: str) -> Any:
        return self._search(line) if self._word in line else None


def needed_text(pattern: str) -> str:
    """The longest text that stands in all that *pattern* matches, as far as its sequence of items shows it; "" if none does.

    Raises ``re.error`` for what is no pattern.
    """
    tree = syntax.parse(pattern)
    return "" if tree.state.flags & re.IGNORECASE else _needed(tree)


def _needed(tree: Any) -> str:
    """As :func:`needed_text`, of the items of a parsed pattern."""
    best = run = ""
    for code, value in tree:
        if code is codes.LITERAL:
            run += chr(value)
            best = max(best, run, key=len)
        elif code is not codes.AT:  # an anchor is no letter; all else ends the run
            run = ""
            if code is codes.SUBPATTERN and not value[1] & re.IGNORECASE:
                best = max(best, _needed(value[3]), key=len)
            elif code in (codes.MAX_REPEAT, codes.MIN_REPEAT) and value[0] > 0:
                best = max(best, _needed(value[2]), key=len)
    return best


class Quick:
    """``re.search`` or ``re.match``, by its name: a pattern is compiled and tried only on texts that contain what it needs (:func:`needed_text`)."""

    def __init__(self, method: str) -> None:
        self._method = method
        self._plain: Callable[..., re.Match[str] | None] = getattr(re, method)
        self._needs: dict[str, str] = {}
        self._tries: dict[str, Callable[[str], re.Match[str] | None]] = {}

    def find(self, pattern: Any, text: str, flags: int = 0) -> re.Match[str] | None:
        """As the function of ``re``, for a pattern and a text."""
        need = self._needs.get(pattern)
        if need is None or flags:
            if flags or not isinstance(pattern, str):
                return self._plain(pattern, text, flags)
            need = self._learn(pattern)
        if need not in text:
            return None
        attempt = self._tries.get(pattern)
        if attempt is None:
            attempt = self._tries[pattern] = getattr(re.compile(pattern), self._method)
        return attempt(text)

    def _learn(self, pattern: str) -> str:
        if len(self._needs) >= KEPT:
            self._needs.clear()
            self._tries.clear()
        return self._needs.setdefault(pattern, needed_text(pattern))


def hasten(cpplint: Any) -> None:
    """Short cuts that change no verdict: much of cpplint's time goes to patterns whose word is not in the line."""
    cpplint.re = SimpleNamespace(**{**vars(re), **{name: Quick(name).find for name in ("search", "match")}})
    for name in ("_re_pattern_types_or_objs", "_re_pattern_functions", "_re_pattern_templates"):
        rows = getattr(cpplint, name, [])
        rows[:] = [_guarded(*row) if len(row) == 3 else row for row in rows]
    width: Callable[[str], int] | None = getattr(cpplint, "GetLineWidth", None)
    if width is not None:
        cpplint.GetLineWidth = lambda line: len(line) if line.isascii() else width(line)
    info = getattr(cpplint, "FileInfo", None)
    if info is not None and hasattr(info, "RepositoryName"):
        info.RepositoryName = _kept_by_file(info.RepositoryName)


def _kept_by_file(ask: Callable[[Any], str]) -> Callable[[Any], str]:
    """*ask* of a ``FileInfo``, once for a file: cpplint looks through the directories above it for many of its lines."""
    names: dict[str, str] = {}

    def name(info: Any) -> str:
        path: str = info._filename
        if path not in names:
            names[path] = ask(info)
        return names[path]

    return name


def bound(cpplint: Any) -> None:
    """A file has processor time by its size, and then is left: cpplint takes the square of what some lines hold. A line on stdout names it."""
    process: Callable[..., None] = cpplint.ProcessFile
    restore: Callable[[], None] = getattr(cpplint, "_RestoreFilters", lambda: None)

    def process_in_time(name: str, *arguments: Any, **options: Any) -> None:
        try:
            size = os.path.getsize(name) if os.path.isfile(name) else 0
            with cpu_limit(seconds_for(size)):
                process(name, *arguments, **options)
        except TimeoutError:
            restore()
            print(f"\nStopped processing {name}", flush=True)

    cpplint.ProcessFile = process_in_time


def give_settings(root: str, name: str, settings: Mapping[str, str]) -> None:
    """Files called *name* are those of *settings* (by paths below *root*) and no others, wherever cpplint looks for them."""
    isfile: Callable[[Any], bool] = os.path.isfile
    opened: Callable[..., Any] = codecs.open
    texts = {os.path.join(root, path): text for path, text in settings.items()}

    def is_visible_file(path: Any) -> bool:
        return path in texts if os.path.basename(path) == name else isfile(path)

    def open_given(path: Any, *arguments: Any, **options: Any) -> Any:
        return io.StringIO(texts[path]) if path in texts else opened(path, *arguments, **options)

    os.path.isfile = is_visible_file
    codecs.open = open_given  # type: ignore[assignment]  # for cpplint alone, in this process


def _guarded(pattern: Any, item: Any, header: str) -> tuple[Any, Any, str]:
    word = item.removesuffix("<>") if isinstance(item, str) else ""
    needed = (before + word + after for before in (r"\b", ")") for after in (r"\b", r"\([^\)]", r"\s*\<"))
    literal = word.isidentifier() and pattern.pattern.endswith(tuple(needed))
    return (GuardedPattern(pattern, word) if literal else pattern, item, header)


def main() -> None:
    _, directory, *options = sys.argv
    if directory not in sys.path:
        sys.path.append(directory)
    cpplint = importlib.import_module("cpplint")
    hasten(cpplint)
    bound(cpplint)
    request = json.load(sys.stdin.buffer)
    give_settings(os.getcwd(), "CPPLINT.cfg", request["settings"])
    sys.argv = ["cpplint", *options, *request["files"]]
    cpplint.main()


if __name__ == "__main__":
    main()
