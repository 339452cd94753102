# SPDX-License-Identifier: Apache-2.0
"""Words of command lines that a launch file has one after the other."""

from __future__ import annotations

import shlex

from haros_ci.regex import regex
from haros_ci.substitutions.names import Text

_DIRECTORY = regex(r"\$\([\w-]+ [^\s()]+\)")
#: What a shell takes for one word as it is.
_PLAIN = regex(r"[^\s'\"\\;&|<>()#*$`]+")


def word(text: Text) -> Text:
    """*text* as a word of a command line; a blank in a marker of a package needs no quotes."""
    if _PLAIN.fullmatch(_DIRECTORY.sub("", text.raw)) is not None:
        return text
    return Text(shlex.quote(text.raw), text.reasons)
