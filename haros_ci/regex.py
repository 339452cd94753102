# SPDX-License-Identifier: Apache-2.0
"""Regular expressions that are compiled when they are first used: a run needs a small part of the twelve hundred that modules define."""

from __future__ import annotations

import re
from typing import Any, AnyStr, cast


class _Regex:
    """A regular expression: until one of its methods is asked for it is a text, and from then on these are the compiled one's."""

    __slots__ = (
        "_flags",
        "findall",
        "finditer",
        "flags",
        "fullmatch",
        "groupindex",
        "groups",
        "match",
        "pattern",
        "search",
        "split",
        "sub",
        "subn",
    )

    def __init__(self, pattern: str | bytes, flags: int) -> None:
        self.pattern = pattern
        self._flags = flags

    def __getattr__(self, name: str) -> Any:
        if name not in _COMPILED:
            raise AttributeError(name)
        compiled = re.compile(self.pattern, self._flags)
        for method in _COMPILED:
            setattr(self, method, getattr(compiled, method))
        return getattr(compiled, name)

    def __reduce__(self) -> tuple[Any, ...]:
        return _Regex, (self.pattern, self._flags)


_COMPILED = tuple(name for name in _Regex.__slots__ if name not in ("_flags", "pattern"))


def regex(pattern: AnyStr, flags: int = 0) -> re.Pattern[AnyStr]:
    """*pattern* as ``re.compile`` has it, compiled when it is first asked to find something.

    For what modules and classes define; functions of ``re`` do not take it as their pattern. A mistake in *pattern* is raised then as
    well, which is why a test compiles all of them.
    """
    return cast("re.Pattern[AnyStr]", _Regex(pattern, flags))
