# SPDX-License-Identifier: Apache-2.0
"""Whether a documented name and one in the code are the same: exactly, by pattern, or by how they end."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: What stands for anything: ``<name>``, ``{name}``, ``*``, ``...``, ``[0-7]``, ``$(x)``.
_WILD = regex(r"<[^<>]*>|\$?\{[^{}]*\}|\$\([^()]*\)|\*+|\.\.\.|\[[^\[\]]*\]")
_LONGEST = 300


def spelt(name: str, dotted: bool = False) -> str:
    """*name* in the one form that is compared: ``~/x`` for ``~x``; a parameter's (*dotted*) with dots between parts."""
    name = re.sub(r"^~(?=[^/])", "~/", name)
    if not dotted:
        return name
    return ".".join(part for part in re.split(r"[./:]", name.replace("...", "*")) if part and part != "~")


def fits(documented: str, found: str) -> bool:
    """Whether they are the same, or *documented* has wild parts that can stand for what *found* has there."""
    if documented == found:
        return True
    if len(documented) > _LONGEST or not _WILD.search(documented):
        return False
    texts = _WILD.split(documented)
    return _in_order(texts, found)


def same_tail(documented: str, found: str) -> bool:
    """Whether the shorter is how the longer ends, segment by segment; ``~`` and a first slash do not count."""
    ours, theirs = _segments(documented), _segments(found)
    count = min(len(ours), len(theirs))
    return count > 0 and all(fits(a, b) for a, b in zip(ours[-count:], theirs[-count:], strict=True))


def is_group(documented: str, found: str) -> bool:
    """Whether *found*, the name of a parameter, lies below *documented*, or below something that ends so."""
    ours, theirs = _segments(documented), _segments(found)
    if not ours:
        return False
    starts = range(len(theirs) - len(ours))
    return any(all(fits(a, b) for a, b in zip(ours, theirs[start:], strict=False)) for start in starts)


def may_be(unknown: str, documented: str) -> bool:
    """Whether *unknown*, a name with ``?``, or any end of it, can be the end of *documented*, or the reverse."""
    ours, segments = _segments(documented), _segments(unknown)
    expected = "/".join(ours)[-_LONGEST:]
    if 0 < len(ours) < len(segments):
        pairs = zip(ours, segments[-len(ours) :], strict=True)
        if all(fits(a, b) or ("?" in b and _in_order(b.split("?"), a)) for a, b in pairs):
            return True
    for start in range(len(segments)):
        texts = "/".join(segments[start:]).split("?")
        if len(texts) > 1 and (_in_order(texts, expected) or _in_order(["", *texts], f"/{expected}")):
            return True
    return bool(_WILD.search(documented)) and bool(segments)


def _segments(name: str) -> list[str]:
    return [part for part in re.split(r"[./]" if "/" not in name else "/", _masked(name)) if part and part != "~"]


def _masked(name: str) -> str:
    """*name* with every wild part as ``*``, so that dots and slashes in it part nothing."""
    return _WILD.sub("*", name[:_LONGEST])


def _in_order(texts: list[str], whole: str) -> bool:
    """Whether *whole* is the *texts* in this order with something, at least one character, between each two."""
    if not whole.startswith(texts[0]):
        return False
    at = len(texts[0])
    for text in texts[1:-1]:
        at = whole.find(text, at + 1)
        if at < 0:
            return False
        at += len(text)
    return len(whole) - len(texts[-1]) > at and whole.endswith(texts[-1])
