# SPDX-License-Identifier: Apache-2.0
"""Programs as JSON text, for the cache: what is read from it is what was written, in one form, or nothing."""

from __future__ import annotations

import re

import msgspec

from haros_ci.regex import regex
from haros_ci.syntax.program import Program
from haros_ci.syntax.walk import Part

_ENCODER = msgspec.json.Encoder()
_DECODER = msgspec.json.Decoder(Program)
_BEYOND_ASCII = regex(r"[^\x00-\x7f]")


def encoded(program: Program) -> str | None:
    """*program* as JSON of ASCII characters alone; None where it is nested too deeply to be read again."""
    try:
        text = _ENCODER.encode(program).decode("utf-8")
    except (RecursionError, UnicodeEncodeError):
        return None
    return text if text.isascii() else _BEYOND_ASCII.sub(_escaped, text)


def decoded(text: str | None) -> Program | None:
    """The Program that *text* is the JSON of; None where it is another's, spoiled, or nested too deeply."""
    if text is None:
        return None
    try:
        return _DECODER.decode(text)
    except (msgspec.MsgspecError, RecursionError, UnicodeError):
        return None


def plain(part: Part) -> bytes:
    """*part* as bytes that differ where parts differ, if only in 1 and 1.0, which are equal otherwise."""
    return _ENCODER.encode(part)


def _escaped(match: re.Match[str]) -> str:
    code = ord(match[0])
    if code < 0x10000:
        return f"\\u{code:04x}"
    code -= 0x10000
    return f"\\u{0xD800 + (code >> 10):04x}\\u{0xDC00 + (code & 0x3FF):04x}"
