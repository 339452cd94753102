# SPDX-License-Identifier: Apache-2.0
"""Whether the bytes of a file can be analysed, and what to say if not."""

from __future__ import annotations

import re

from haros_ci.model.package import OTHER
from haros_ci.model.workspace import LATIN_1, Problem
from haros_ci.workspace.files import decode

#: Longest line in characters. Beyond, a file is generated or minified, and tools take quadratic time on it.
LONGEST_LINE = 20_000
LONGEST_CODE_LINE = 5_000

#: What macOS writes beside each file on a disk of another kind, and into archives (``__MACOSX/._a.py``): attributes, no source. No language
#: has a text that begins so (RFC 1740, appendix A: AppleDouble).
_APPLE_DOUBLE = b"\x00\x05\x16\x07"
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
#: How a file begins that git-lfs has not replaced by the contents (its specification, "The Pointer").
_LFS = b"version https://git-lfs.github.com/spec/"


def examine(path: str, language: str, data: bytes) -> tuple[bool, Problem | None]:
    """Whether the file is text to analyse, and a problem to report: the reason if it is not, a remark if it is.

    Of prose, and of what only tools of the user's own read, nothing is reported: no tool that runs by default reads it.
    """
    usable, problem = _examined(path, language, data)
    return usable, None if language in ("markdown", OTHER) else problem


def _examined(path: str, language: str, data: bytes) -> tuple[bool, Problem | None]:
    if data.startswith(_APPLE_DOUBLE) and path.rpartition("/")[2].startswith("._"):
        return False, None
    if data.startswith(_UTF_16):
        return False, Problem(path, "skipped: encoded as UTF-16; save it as UTF-8")
    if b"\0" in data:
        return False, Problem(path, f"skipped: binary data where {language} text was expected")
    if data.startswith(_LFS):
        return False, Problem(path, "skipped: a pointer of Git LFS, not the contents; fetch them (git lfs pull)")
    limit = LONGEST_CODE_LINE if language in ("cpp", "python") else LONGEST_LINE
    line = _overlong_line(data, limit)
    if line is not None:
        return False, Problem(path, f"skipped: a line of more than {limit} characters; minified or generated?", line)
    if not data.isascii():
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as err:
            line = data.count(b"\n", 0, err.start) + 1
            return True, Problem(path, LATIN_1, line)
    return True, None


def _overlong_line(data: bytes, limit: int) -> int | None:
    """The number of the first line with more than *limit* characters."""
    start = 0
    while start + limit < len(data):  # each window of limit + 1 bytes must hold a line feed
        end = data.rfind(b"\n", start, start + limit + 1)
        if end < 0:
            break
        start = end + 1
    else:
        return None
    # Only bytes were counted so far, and only line feeds as ends of lines.
    for number, line in enumerate(re.split("\r\n|\n|\r", decode(data)), start=1):
        if len(line) > limit:
            return number
    return None
