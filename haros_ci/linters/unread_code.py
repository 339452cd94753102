# SPDX-License-Identifier: Apache-2.0
"""Code of C++ at which cppcheck does not look, though a compiler compiles it: what has values in it that may be wrong is named.

cppcheck follows values through bodies of functions. A lambda that stands outside of one (as a default argument, in the value of a member
or of a variable of a namespace), the statements of ``({ … })``, and what a coroutine returns are none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.regex import regex

#: What opens and closes, with what tells what a block is; and the beginning of a lambda.
_TOKEN = regex(
    r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,12}'"
    r"|(?P<lambda>(?<=[=(,{])\s*\[(?!\[)[^\[\]{};]{0,200}\])"
    r"|(?P<kind>\b(?:namespace|class|struct|union|enum|extern)\b)"
    r"|[{}();=]"
)
#: Without one of these nothing of this is in a text.
UNREAD = regex(r"[=(,{]\s*\[|\bco_(?:return|yield)\b|\(\s*\{")
_COROUTINE = regex(r"\bco_(?:return|yield)\b\s*(?:\*|[^;{}\n]{0,200}(?:->|\[|/|%))")
_STATEMENTS = regex(r"(?:[-=<>+*/%?:&|!]|\breturn)\s*\(\s*\{[^{}]{0,400};\s*\}\s*\)")
#: What can be wrong in a lambda that cppcheck would see: something is reached through a pointer or an index, divided, or made.
_MAY_BE_WRONG = regex(r"(?:^|[\s(=,{;!])\*\s*\w|(?<!\bthis)->|\w\s*\[|[/%]|\bnew\b|\bdelete\b|\bmalloc\b|\bfree\b")
_DIRECTIVE = regex(r"^[ \t]*(?:#|%:)[^\n]*", re.M)
#: A name, and words behind which a function's body stands.
_BEFORE = regex(r"(?<!\w)(\w+)(?:<[^<>{};]{0,60}>)?\s*\Z")
_BEFORE_BODY = frozenset("const noexcept override final try else do mutable volatile".split())
_BRACE = regex(r"[{}]")
#: Characters of a body, and of what stands before it, that are looked at.
_LONGEST, _LONGEST_HEAD = 20_000, 400


def unread_code(code: str) -> Iterator[str]:
    """Such code in *code*, without comments and with spliced lines joined, in words; takes linear time."""
    code = _DIRECTIVE.sub("", code)
    if "[" in code and any(_lambdas(code)):
        yield "a lambda outside of functions"
    if "co_" in code and _COROUTINE.search(code) is not None:
        yield "what a coroutine returns"
    if "{" in code and _STATEMENTS.search(code) is not None:
        yield "a block of statements that is a value"


def _lambdas(code: str) -> Iterator[int]:
    """Where lambdas begin that stand in no function's body, and whose own bodies do more than a call."""
    blocks: list[bool] = []  # whether each open one is that of a function, or a value
    kind, depth = "", 0
    for match in _TOKEN.finditer(code):
        word = match[0]
        if match["lambda"] is not None:
            if not any(blocks) and _MAY_BE_WRONG.search(_body(code, match.end())) is not None:
                yield match.start()
        elif match["kind"] is not None:
            kind = word if depth == 0 else kind
        elif word == "{":
            blocks.append(not kind and not _begins_value(code, match.start()))
            kind = ""
        elif word == "(":
            kind, depth = "" if depth == 0 else kind, depth + 1
        elif word == ")":
            depth = max(depth - 1, 0)
        elif word in ("}", ";", "="):
            kind = ""
            if word == "}" and blocks:
                blocks.pop()


def _begins_value(code: str, at: int) -> bool:
    """Whether the brace there begins a value that is a lambda: ``member{[] { … }}``."""
    if not code[at + 1 : at + 41].lstrip().startswith("["):
        return False
    before = _BEFORE.search(code, max(0, at - 80), at)
    return before is not None and before[1] not in _BEFORE_BODY


def _body(code: str, at: int) -> str:
    """The body of the lambda whose brackets end there."""
    begin = code.find("{", at, at + _LONGEST_HEAD)
    depth = 0
    for match in _BRACE.finditer(code, begin, begin + _LONGEST) if begin >= 0 else ():
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return code[begin : match.end()]
    return ""
