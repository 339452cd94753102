# SPDX-License-Identifier: Apache-2.0
"""Telling Python 2 source, and Python newer than this, from broken Python 3."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable

from haros_ci.regex import regex

_SHEBANG = regex(r"#!(?:(?!#!).)*\bpython2")
#: Statements that no Python 3 parser accepts and every Python 2 did.
_STATEMENTS = regex(
    r"""^[ \t]*(?:
        print[ \t]+(?![=.,:)\]%*/+&|<-])(?:>>|["'\w(\[{`]).*
        | print[ \t]*>>[ \t]*\w.*
        | except[ \t]+(?![ \t])[\w.()\[\], \t]*?[\w.)][ \t]*,[ \t]*\w+[ \t]*:.*
        | raise[ \t]+[\w.]+[ \t]*,[ \t]*.+
        | exec[ \t]+["'\w].*
    )$""",
    re.MULTILINE | re.VERBOSE,
)
#: Operators and numbers that Python 3 has no more; a zero before octal digits is no fraction's (``0.01``).
_OPERATORS = regex(r"<>|`[^`\n]{1,200}`|(?<![\w.])0[0-7]*[1-7][0-7]*[lL]?(?![\w.])|\bur\"")
#: Texts and comments of one line.
_REMARKS = regex(r"(?P<quote>['\"])(?:\\.|(?!(?P=quote))[^\\\n])*(?P=quote)|#[^\n]*")
#: Methods and names that Python 3 has no more (What's New in Python 3.0), in what its parser takes.
_GONE = regex(
    r"\.(?:iteritems|iterkeys|itervalues|has_key)[ \t]*\(|(?<![\w.])(?:xrange|raw_input|unicode|basestring)[ \t]*[(,)]"
    r"|^[ \t]*(?:import|from)[ \t]+(?:urllib2|ConfigParser|Queue|cPickle|StringIO|Tkinter|httplib|commands)\b",
    re.MULTILINE,
)
#: What makes a file run on either.
_EITHER = regex(
    r"\bversion_info\b|\bPY[23]\b|\bpython_version|\bimport[ \t]+six\b|\bfrom[ \t]+(?:six|past|future|builtins)\b"
    r"|\bexcept[ \t(]+[^\n:]{0,80}\b(?:NameError|ImportError|ModuleNotFoundError|AttributeError)\b|#!.*\bpython3"
)
_PYTHON3 = regex(r"#![^\n]*\bpython3")
#: ``<run_depend>python-yaml</run_depend>``: the key of rosdep for Python 2.
_KEY = regex(r"<(?:\w+_)?depend>\s*python-[\w-]+\s*<")
_REMARK = regex(r"<!--.*?(?:-->|\Z)", re.DOTALL)
#: Texts over several lines, in which a line may begin with any word.
_TEXTS = regex(r"\"\"\".{0,20000}?\"\"\"|'''.{0,20000}?'''", re.DOTALL)
#: What Python 3 does anyhow, and Python 2 by request.
_FUTURE = regex(
    r"^from[ \t]+__future__[ \t]+import[ \t(]+[^\n#]{0,200}?\b(?:absolute_import|division|print_function|unicode_literals)\b",
    re.MULTILINE,
)
#: Characters of a line that are looked at.
_LONGEST = 400
#: Type aliases, generic functions and classes (PEP 695).
_NEWER = regex(r"\s*(?:type[ \t]+\w+.*=|(?:async[ \t]+)?def[ \t]+\w+\[|class[ \t]+\w+\[)")

#: A line that ends inside the braces of an f-string, which Python 3.12 takes (PEP 701).
_OPEN_BRACES = regex(
    r"(?:^|(?<=[^\w'\"]))[rR]?[fF][rR]?(['\"])(?!\1)(?:(?!\1)[^\n{]|\{\{|\{[^\n{}]{0,200}\})*\{(?!\{)[^\n}]{0,200}$"
)


def is_python2(text: str) -> bool:
    """Whether *text*, which is not valid Python 3, has the marks of Python 2."""
    code = _TEXTS.sub("", text)
    if _SHEBANG.search(code) is not None or _STATEMENTS.search(code) is not None:
        return True
    return _OPERATORS.search(_REMARKS.sub(lambda found: '""' if found["quote"] else "", code)) is not None


def runs_only_on_python2(text: str) -> bool:
    """Whether *text*, which a parser of Python 3 takes, fails on Python 3 all the same."""
    return _SHEBANG.search(text) is not None or (_GONE.search(text) is not None and _EITHER.search(text) is None)


def names_python3(text: str) -> bool:
    """Whether the first line of *text* asks for Python 3."""
    return _PYTHON3.match(text) is not None


def is_of_python2(text: str, others: Iterable[str], manifest: str) -> bool:
    """Whether *text*, which a parser of Python 3 takes, is of a package of ROS 1 for Python 2.

    It says so itself, or one of the *others*, the Python of its package, can be read by Python 2 alone; or the *manifest* has keys of
    Python 2 without a condition, and none of Python 3.
    """
    if names_python3(text):
        return False
    if runs_only_on_python2(text):
        return True
    plain = _REMARK.sub("", manifest)
    if _KEY.search(plain) is not None and "python3" not in plain and "ROS_PYTHON_VERSION" not in plain:
        return True
    every = tuple(others)
    return not any(map(names_python3, every)) and any(
        _STATEMENTS.search(_TEXTS.sub("", other_text)) for other_text in every
    )


def imports_future(text: str) -> bool:
    """Whether *text* asks for what Python 3 does by itself: it is for Python 2, too."""
    return _FUTURE.search(text) is not None


def is_newer(line: str, message: str) -> bool:
    """Whether the syntax error *message* on *line* is of what Python 3.12 has brought and this interpreter lacks."""
    if sys.version_info >= (3, 12):
        return False
    is_broken_text = "unterminated string literal" in message or "EOL while scanning string literal" in message
    if is_broken_text and _OPEN_BRACES.search(line[:_LONGEST].rstrip()) is not None:
        return True
    return "f-string" in message or _NEWER.match(line) is not None


def why_unreadable(text: str) -> str:
    """Why a tool could not parse *text*, for a notification."""
    version = ".".join(map(str, sys.version_info[:2]))
    if sys.version_info < (3, 12) and any(map(_NEWER.match, _TEXTS.sub("", text).split("\n"))):
        return f"it is for Python 3.12 or later, and haros-ci runs on Python {version}; run it on that of the robot"
    return "it is Python 2" if is_python2(text) else f"it is not valid Python {version}"
