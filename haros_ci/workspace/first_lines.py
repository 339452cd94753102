# SPDX-License-Identifier: Apache-2.0
"""What the first line of a script asks for, as ``env -S`` reads it: without quotes, and without variables that nothing sets."""

from __future__ import annotations

import re

from haros_ci.workspace.code_text import is_python

_LINE = re.compile(r"#!([^\n]{0,500})")
_QUOTES = re.compile(r"[\"'\\\\]|\$\{\w{0,100}\}")
_PYTHON = re.compile(r"\b(?:python|pypy)[\d.]{0,6}(?:\s|\Z)")
#: Interpreters of other languages.
_OTHERS = re.compile(
    r"\b(?:perl|ruby|node|deno|bun|zx|ts-node|julia|octave|gnuplot|lua|luajit|Rscript|tclsh|wish|[gm]?awk|make|cmake|php|expect|fish|nu|pwsh|bats|sed|bc|dc|gdb"
    r"|m4|osascript|groovy|scala|dart|swift|racket|guile|sbcl|runhaskell|ansible-playbook|nft|(?:ba|da|k|z|c|tc)?sh)\b"
)


def asks_for_python(text: str) -> bool:
    """Whether the first line asks for an interpreter of Python: by its name, or for one that is not known, where the rest is a program of Python."""
    line = _asked(text)
    if line is None or _PYTHON.search(line):
        return line is not None
    return _OTHERS.search(line) is None and is_python(text)


def asks_for_another(text: str) -> bool:
    """Whether the first line asks for an interpreter of another language."""
    line = _asked(text)
    return line is not None and _PYTHON.search(line) is None and _OTHERS.search(line) is not None


def _asked(text: str) -> str | None:
    found = _LINE.match(text)
    return None if found is None else _QUOTES.sub("", found[1])
