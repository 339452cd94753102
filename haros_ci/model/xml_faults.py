# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a text that is no XML, where expat's words tell nobody."""

from __future__ import annotations


def hyphens(data: bytes, index: int) -> str:
    """What is wrong where a parser stops behind two hyphens in a comment, at the byte *index*; "" if it stops at something else.

    A comment ends at ``-->``, and has no ``--`` before (XML 1.0, 2.5): one that stands in another one begins with them.
    """
    if data[index - 2 : index] != b"--":
        return ""
    begin = data.find(b"<!--", data.rfind(b"-->", 0, index) + 1)
    if not 0 <= begin < index - 4:
        return ""
    line = data.count(b"\n", 0, begin) + 1
    if data[index - 4 : index] == b"<!--":
        return f"a comment inside of the comment that begins in line {line}"
    return f"'--' inside of the comment that begins in line {line}"
