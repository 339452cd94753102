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
import sys
from collections.abc import Callable, Mapping
from typing import Any


class GuardedPattern:
    """A compiled pattern that is only tried on lines that contain its literal *word*."""

    def __init__(self, pattern: Any, word: str) -> None:
        self._search = pattern.search
        self._word = word

    def search(self, line: str) -> Any:
        return self._search(line) if self._word in line else None


def hasten(cpplint: Any) -> None:
    """Short cuts that change no verdict: much of cpplint's time goes to patterns whose word is not in the line."""
    for name in ("_re_pattern_types_or_objs", "_re_pattern_functions", "_re_pattern_templates"):
        rows = getattr(cpplint, name, [])
        rows[:] = [_guarded(*row) if len(row) == 3 else row for row in rows]
    width: Callable[[str], int] | None = getattr(cpplint, "GetLineWidth", None)
    if width is not None:
        cpplint.GetLineWidth = lambda line: len(line) if line.isascii() else width(line)


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
    request = json.load(sys.stdin.buffer)
    give_settings(os.getcwd(), "CPPLINT.cfg", request["settings"])
    sys.argv = ["cpplint", *options, *request["files"]]
    cpplint.main()


if __name__ == "__main__":
    main()
