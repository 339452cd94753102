# SPDX-License-Identifier: Apache-2.0
"""What the first line of a script asks for, as ``env -S`` reads it: without quotes, and without variables that nothing sets."""

from __future__ import annotations

from haros_ci.regex import regex
from haros_ci.workspace.code_text import is_python

_LINE = regex(r"#!([^\n]{0,500})")
_QUOTES = regex(r"[\"'\\\\]|\$\{\w{0,100}\}")
_PYTHON = regex(r"(?:python|pypy)[\d.]{0,6}")
#: Interpreters of other languages.
_OTHERS = regex(
    r"(?:perl|ruby|node|deno|bun|zx|ts-node|julia|octave|gnuplot|lua|luajit|Rscript|tclsh|wish|[gm]?awk|make|cmake|php|expect|fish|nu|pwsh|bats|sed|bc|dc|gdb"
    r"|m4|osascript|groovy|scala|dart|swift|racket|guile|sbcl|runhaskell|ansible-playbook|nft|(?:ba|da|k|z|c|tc)?sh)[\d.]{0,6}"
)
#: Programs that start another one, which their next words name.
_BEFORE = frozenset(("env", "nice", "stdbuf", "time", "timeout", "setsid", "nohup", "sudo", "exec"))


def asks_for_python(text: str) -> bool:
    """Whether the first line asks for an interpreter of Python: by its name, or for one that is not known, where the rest is a program of Python."""
    names = _names(text)
    if any(_PYTHON.fullmatch(name) for name in names):
        return True
    return bool(names) and _OTHERS.fullmatch(_interpreter(names)) is None and is_python(text)


def asks_for_another(text: str) -> bool:
    """Whether the first line asks for an interpreter of another language."""
    names = _names(text)
    return not any(map(_PYTHON.fullmatch, names)) and _OTHERS.fullmatch(_interpreter(names)) is not None


def _names(text: str) -> list[str]:
    """The words of the first line, without the directories before them; none where it asks for no interpreter."""
    found = _LINE.match(text)
    return [] if found is None else [word.rpartition("/")[2] for word in _QUOTES.sub("", found[1]).split()]


def _interpreter(names: list[str]) -> str:
    """The first of *names* that is no option, variable, number or program that starts another one."""
    plain = (name for name in names if name not in _BEFORE and "=" not in name and name[:1] != "-")
    return next((name for name in plain if not name.isdigit()), "")
