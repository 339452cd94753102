# SPDX-License-Identifier: Apache-2.0
"""Frames with a leading slash in the text of C++ and Python: in messages, markers and transforms, and in look-ups."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

_QUOTED = r"[\"'](/[A-Za-z]\w*(?:/\w+)*)[\"']"
#: What code does with a frame: it puts it into a header, or asks tf2 for it.
_IN_CODE = regex(
    r"(?P<set>(?:\b(?P<of>\w+)\s*(?:\.|->)\s*)?(?:\bheader\s*\.\s*)?"
    r"\b(?:child_)?frame_id\s*=\s*(?:(?=[\"'])|(?:std::)?string\(\s*))" + _QUOTED + "|"
    r"(?P<ask>\b(?:lookup_?transform|can_?transform|lookup_transform_full)\w*\s*\((?:[^;()]{0,80}?,)?\s*)" + _QUOTED,
    re.IGNORECASE,
)
#: The declaration of a variable: its type, or what it is made by.
_DECLARED = (
    r"(?:\b(?P<type>[A-Z]\w*)(?:::(?:Shared|Unique|)Ptr|Ptr|>)?[\s&*]+{word}\s*[;=,)({{:\[]"
    r"|\b{word}\s*(?::[^=\n]{{1,80}})?=[^=;\n]{{0,80}}?\b(?P<made>[A-Z]\w*)\s*(?:>\s*)?[({{])"
)
#: Messages whose frames MoveIt looks up in its planning scene, which takes the slash off (PlanningScene::getFrameTransform, knowsFrameTransform).
_OF_MOVEIT = frozenset(("CollisionObject", "AttachedCollisionObject"))
#: An element of an array of markers, before its header.
_ELEMENT = regex(r"\bmarkers\s*(?:\[[^\[\]\n]{0,40}\]|\.(?:back|front)\(\)|\.at\([^()\n]{0,40}\))\s*(?:\.|->)\s*$")


@dataclass(frozen=True, slots=True)
class FrameUse:
    """A *frame* with a slash in code; *kind*: a ``look-up``, a ``message``, a ``marker``, or a ``transform`` that is sent."""

    place: Location
    frame: str
    kind: str
    #: The variable that is asked for a look-up.
    asked: str = ""


def frames_in(path: str, text: str) -> Iterator[FrameUse]:
    """The frames with a leading slash in *text*, of the file at *path*; none of comments."""
    if ("frame_id" not in text and "ransform" not in text) or ('"/' not in text and "'/" not in text):
        return
    for found in _IN_CODE.finditer(text):
        start = text.rfind("\n", 0, found.start()) + 1
        before = text[start : found.start()]
        if "//" in before or "#" in before or before.lstrip().startswith("*"):
            continue
        asked = None
        end = re.search(r"(?:\bheader\s*\.\s*)?\b(?:child_)?frame_id", found[0])
        at = found.start() + (end.start() if end is not None else 0)
        line = text.rfind("\n", 0, at) + 1
        place = Location(path, text.count("\n", 0, at) + 1, at - line + 1)
        frame = found[3] or found[5]
        if found["ask"] is not None:
            kind, asked = "look-up", re.search(r"(\w+)\s*(?:\.|->)\s*\Z", before)
        elif not _OF_MOVEIT.isdisjoint(_kinds(found["of"], text, found.start())[-1:]):
            continue
        elif _is_sent(found["of"], text):
            kind = "transform"
        else:
            kind = "marker" if _is_marker(found, text) else "message"
        yield FrameUse(place, frame, kind, asked[1] if asked is not None else "")


def _is_sent(name: str | None, text: str) -> bool:
    """Whether the variable *name* is a transform for a broadcaster: it is declared as one, or given to ``sendTransform``.

    A broadcaster hands it to tf2, which takes the slash off (geometry2's BufferCore::setTransform, ``stripSlash``).
    """
    if not name or name in ("self", "this"):
        return False
    word = re.escape(name)
    return any(
        re.search(pattern, text) is not None
        for pattern in (
            rf"\bTransformStamped(?:Ptr)?(?:\s*[&*]\s+|\s+)[&*]?{word}\b",
            rf"\b{word}\s*(?::[^=\n]*)?=\s*(?:\w+\s*(?:\.|::)\s*)*TransformStamped\b",
            rf"\bsendTransform\s*\([^;\n]*\b{word}\b",
        )
    )


def _is_marker(found: re.Match[str], text: str) -> bool:
    """Whether the frame is of a marker, which only rviz takes, and nothing here looks that frame up.

    rviz takes the slash off (FrameManager::transform of rviz2; rviz of ROS 1 up to Melodic looks up by tf).
    """
    name = found["of"]
    if name in (None, "header"):
        element = _ELEMENT.search(text, max(0, found.start() - 80), found.start())
        return element is not None and element.end() == found.start()
    if name in ("self", "this"):
        return False
    word, kinds = re.escape(name), _kinds(name, text, found.start())
    if not kinds or re.fullmatch(r"Marker(?:::)?", kinds[-1]) is None:
        return False
    return re.search(rf"ransform\w{{0,80}}\s*\([^;\n]{{0,200}}\b{word}\s*(?:\.|->)\s*header\b", text) is None


def _kinds(name: str | None, text: str, end: int) -> list[str]:
    """The types that the variable *name* is declared with before *end*, or anywhere, without their namespaces."""
    if not name or name in ("self", "this", "header"):
        return []
    pattern = _DECLARED.format(word=re.escape(name))
    before = [match["type"] or match["made"] for match in re.finditer(pattern, text[:end])]
    return before or [match["type"] or match["made"] for match in re.finditer(pattern, text)]
