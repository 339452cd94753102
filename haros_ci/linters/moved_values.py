# SPDX-License-Identifier: Apache-2.0
"""Values of C++ that ``std::move()`` copies, as they hold all that they have in themselves."""

from __future__ import annotations

import re

from haros_ci.linters.function_text import function_text
from haros_ci.regex import regex

#: ``Access of moved variable 'force'.``
_MOVED = regex(r"moved variable '([A-Za-z_]\w*)'")
#: Vectors, matrices and points of a size that the type says, of numbers.
_FIXED = (
    r"(?:(?:blaze\s*::\s*)?Static(?:Vector|Matrix)\s*<[^;(){{}}]{{1,80}}>"
    r"|(?:Eigen\s*::\s*)?(?:(?:Row)?Vector[2-4]|Matrix[2-4]|Array(?:22|33|44|[2-4])|Quaternion|Isometry[23]|Affine[23]|AngleAxis|Translation[23])[fdi]"
    r"|(?:Eigen\s*::\s*)?Matrix\s*<\s*(?:float|double|int)\s*,\s*\d+\s*,\s*\d+\s*>"
    r"|(?:std\s*::\s*)?array\s*<\s*(?:float|double|int|bool|char|u?int\d+_t|size_t)\s*,[^;(){{}}<>]{{1,60}}>"
    r"|cv\s*::\s*(?:Point(?:[23][fdi])?|Vec[2-6][bdfiswu]|Size|Rect|Scalar|Matx[1-6][1-6][fd])"
    r"|tf2?\s*::\s*(?:Vector3|Quaternion|Transform|Matrix3x3))"
    r"\s+(?:\w+\s*,\s*){{0,20}}{name}\s*[;,=({{]"
)


def is_copied_by_move(message: str, line: int, text: str) -> bool:
    """Whether the variable that *message* calls moved is of a type that has nothing to give away: it keeps its value."""
    name = _MOVED.search(message)
    return name is not None and re.search(_FIXED.format(name=name[1]), function_text(line, text)) is not None
