# SPDX-License-Identifier: Apache-2.0
"""Names of projects, packages and configurations as ids: file names, parts of addresses and of HTML in one.

The visualizer puts an id as it stands into the address that it asks for, into ``<option>`` and into its own routes; so an id
holds nothing that means something in any of them. A name of ROS stays as it is.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from hashlib import sha256

from haros_ci.regex import regex

#: Bytes of an id; the longest file name of common file systems is 255, and a suffix is to follow.
LONGEST = 150
_ALLOWED = frozenset(" _-.+=@,()")
#: Names of devices on Windows, with any suffix.
_DEVICES = regex(r"(con|prn|aux|nul|(com|lpt)[0-9])(\..*)?", re.IGNORECASE)
#: What every object of JavaScript has, so that a look-up by such an id finds what was never put there; and our own file.
_TAKEN = frozenset(
    "__proto__ __definegetter__ __definesetter__ __lookupgetter__ __lookupsetter__ constructor hasownproperty isprototypeof"
    " propertyisenumerable tolocalestring tostring valueof projects.json".split()
)

#: A name, and what distinguishes two entities of the same name.
Key = tuple[str, str]


def safe(name: str) -> str:
    """*name* with ``_`` for what a file name, an address or HTML would not carry; two names may become one."""
    text = unicodedata.normalize("NFC", name)
    text = " ".join("".join(c if c.isalnum() or c in _ALLOWED else " " if c.isspace() else "_" for c in text).split())
    text = text.encode("utf-8", "replace")[:LONGEST].decode("utf-8", "ignore").rstrip(" ")
    if text[:1] in ("", ".", "-"):
        text = f"_{text[1:]}"
    if text.endswith("."):
        text = f"{text[:-1]}_"
    return f"{text}_" if _DEVICES.fullmatch(text) or text.lower() in _TAKEN else text


def unique(keys: Iterable[Key]) -> Mapping[Key, str]:
    """An id for each of *keys*: no two are equal when case is ignored; those that would be get a digest appended.

    What an id is depends on the set of *keys*, not on their order.
    """
    every = sorted(set(keys))
    alike: dict[str, list[Key]] = {}
    for key in every:
        alike.setdefault(_folded(safe(key[0])), []).append(key)
    made = {group[0]: safe(group[0][0]) for group in alike.values() if len(group) == 1}
    taken = {_folded(id) for id in made.values()}
    for key in every:
        round = 0
        while key not in made:
            digest = sha256(f"{round}\0{key[0]}\0{key[1]}".encode("utf-8", "surrogatepass")).hexdigest()[:8]
            id = f"{safe(key[0])}-{digest}"
            if _folded(id) not in taken:
                made[key] = id
                taken.add(_folded(id))
            round += 1
    return made


def _folded(id: str) -> str:
    return unicodedata.normalize("NFKC", id).casefold()
