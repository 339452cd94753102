# SPDX-License-Identifier: Apache-2.0
"""How far the types of C++ grow that ``typedef`` names: cppcheck writes what stands for each name in its place, and of one that is made of two others becomes more with every step."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import islice

from haros_ci.linters.linter import Unit
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Tokens of one type above which cppcheck is not asked: it takes four seconds for so many.
MOST_TOKENS = 12_000
LARGE_TYPE = f"its types are made of more than {MOST_TOKENS:,} tokens"

_TYPEDEF = regex(r"\btypedef\b")
_TOKEN = regex(r"[A-Za-z_]\w*|\d[\w.]*|[^\s\w]")
_POINTED = regex(r"[(*&\s](?:\w+\s*::\s*)?[*&]+\s*(?:const\s+)?([A-Za-z_]\w*)\s*\)\s*[\[(]")
_NAME = regex(r"([A-Za-z_]\w*)\s*(?:\[[^\]]*\]\s*|\([^()]*\)\s*)*\Z")
#: Tokens and characters of one definition that are read.
_LONGEST, _MOST = 2_000, 8_000
_MACRO = regex(r"[A-Z][A-Z0-9_]*")


def typedefs(text: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The names that *text* gives types, each with the tokens of its definition, the name itself left out."""
    if "typedef" not in text:
        return
    for part in text.split(";")[:-1]:
        at = part.rfind("typedef")
        words = part[at + len("typedef") : at + _MOST] if at >= 0 and _TYPEDEF.match(part, at) else ""
        if not words or "{" in words:
            continue  # a struct of its own is not written again
        found = _POINTED.search(words) or _NAME.search(words)
        if found is not None:
            tokens = islice((token[0] for token in _TOKEN.finditer(words)), _LONGEST)
            yield found[1], tuple(token for token in tokens if token != found[1])


def large(defined: Iterable[tuple[str, tuple[str, ...]]]) -> Iterator[str]:
    """The types that become more than MOST_TOKENS; of several definitions of a name the largest counts, what a name means in its own circle is one token.

    What a macro, or what looks like one, is given counts twice. Takes linear time.
    """
    of: dict[str, list[tuple[str, ...]]] = {}
    for name, tokens in defined:
        of.setdefault(name, []).append(tokens)
    sizes: dict[str, int] = {}  # -1 for those that are being counted
    waiting = list(of)
    while waiting:
        name = waiting[-1]
        if sizes.get(name, -1) < 0:
            words = () if name in sizes else {word for tokens in of[name] for word in tokens if word in of}
            inner = sorted(word for word in words if word not in sizes and word != name)
            sizes[name] = -1
            if inner:
                waiting += inner
                continue
            sizes[name] = max(_size(tokens, sizes) for tokens in of[name])
            if sizes[name] > MOST_TOKENS:
                yield name
        waiting.pop()


def _size(tokens: tuple[str, ...], sizes: Mapping[str, int]) -> int:
    total = 0
    times = [1]
    for before, token in zip(("", *tokens), tokens, strict=False):
        if token == "(":
            times.append(min(times[-1] * (2 if _MACRO.fullmatch(before) else 1), 10))
        elif token == ")" and len(times) > 1:
            times.pop()
        total += times[-1] * max(sizes.get(token, 1), 1)
    return min(total, 10 * MOST_TOKENS)


def why_not(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* that a tool which writes out types is not asked about the reason, by path.

    All types are looked at together first: where none is large then, none is in one unit, and most often there is none.
    """
    units = list(units)
    every = dict.fromkeys(path for unit in units for path in (unit.file.path, *unit.dependencies))
    types = {path: found for path in every if (found := list(typedefs(workspace.text(path))))}
    many = frozenset(large(entry for found in types.values() for entry in found))
    places = {path for path, found in types.items() if any(name in many for name, _ in found)}
    reasons = {}
    for unit in units if places else ():
        paths = (unit.file.path, *unit.dependencies)
        if not places.isdisjoint(paths) and any(large(entry for path in paths for entry in types.get(path, ()))):
            reasons[unit.file.path] = LARGE_TYPE
    return reasons
