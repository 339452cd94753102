# SPDX-License-Identifier: Apache-2.0
"""Functions that part a text at characters: boost::split (boost/algorithm/string/split.hpp), mrpt::system::tokenize (mrpt/system/string_utils.h)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.walk import Walk
from haros_ci.index.types import SEQUENCES
from haros_ci.values.abstract import LIST_LIMIT, TEXT_LIMIT, Cell, Known, Library, Object, Opaque, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

ANY_OF = frozenset(("boost::is_any_of", "boost::algorithm::is_any_of"))
BOOST = frozenset(("boost::split", "boost::algorithm::split"))
MRPT = frozenset(("mrpt::system::tokenize", "mrpt::utils::tokenize"))
#: What is_any_of holds.
SIGNS = "[signs]"
_TEXT = syntax.Type("std::string")


def called(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What the function returns, with the parts of the text in its list; None if that is not known."""
    if name in ANY_OF and len(args) == 1:
        return Object("boost::is_any_of", fields={SIGNS: Cell(args[0].value)})
    if name in BOOST and len(args) in (3, 4):
        signs = args[2].value
        held = signs.fields[SIGNS].value if isinstance(signs, Object) and SIGNS in signs.fields else None
        mode = args[3].value if len(args) == 4 else Library("token_compress_off")
        merges = _word(mode) == "token_compress_on"
        if _word(mode) not in ("token_compress_on", "token_compress_off"):
            return None
        return _parted(walk, args[0], args[1].value, held, "+" if merges else "")
    if name in MRPT and len(args) == 3:
        return _parted(walk, args[2], args[0].value, args[1].value, None)
    return None


def _word(mode: Value) -> str:
    return mode.name.rpartition("::")[2] if isinstance(mode, Library) else ""


def _parted(walk: Walk, into: PassedArgument, text: Value, signs: Value | None, times: str | None) -> Value | None:
    """*into* with the parts of *text* between any of *signs*, so many *times*; without empty ones where that is None."""
    if not all(isinstance(value, Known) and issubclass(value.kind, str) for value in (text, signs)):
        return None
    assert isinstance(text, Known) and isinstance(signs, Known)
    written, kind = text.of(str), into.type or (into.cell.type if into.cell is not None else None)
    if (
        not signs.of(str)
        or len(written) > TEXT_LIMIT
        or (kind is not None and kind.name not in SEQUENCES - {"std::set"})
    ):
        return None
    parts = re.split(f"[{re.escape(signs.of(str))}]{'+' if times is None else times}", written)
    if times is None:
        parts = [part for part in parts if part]
    if len(parts) > LIST_LIMIT or not isinstance(into.value, Sequence):
        return None
    items: tuple[Cell, ...] | Opaque = tuple(Cell(Known(part), _TEXT) for part in parts)
    walk.state.write(into.value.content, items)
    return into.value
