# SPDX-License-Identifier: Apache-2.0
"""Graph resource names of ROS 1 (wiki Names), and texts of launch files of which a part may be unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from haros_ci.model.architecture import Unknown
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Stands for an unknown part inside a text; shown as ``?``.
MARK = "\ue000"
MAX_TEXT = 100_000
MAX_UNKNOWN = 1_000
#: In how many steps a text may come from launch arguments, and from how many of them.
MAX_STEPS = 16
MAX_ARGUMENTS = 40

_LEGAL = regex(r"[~/A-Za-z][\w/]*\Z")


@dataclass(frozen=True, slots=True, eq=False)
class Origin:
    """How a text comes from launch arguments of the configuration's own files.

    *again* gives the text where some of these *arguments* have other values, None where nothing sets it then. *argument* is
    the one whose value it is as it stands.
    """

    arguments: frozenset[str]
    again: Callable[[Mapping[str, Text]], Text | None]
    argument: str | None = None
    steps: int = 0


@dataclass(frozen=True, slots=True)
class Text:
    """A substituted text: *raw* holds one MARK per unknown part, *reasons* say in the same order why.

    *origin* says how it comes from launch arguments, if it does and that is asked for; *vacant* why it is empty, where an environment
    variable that is not given may fill it; *chosen*, ``NAME=default``, says which environment variable may put another text in for the
    default of its ``$(optenv)``. Texts are the same without these.
    """

    raw: str
    reasons: tuple[str, ...] = ()
    origin: Origin | None = field(default=None, compare=False, repr=False)
    vacant: str = field(default="", compare=False, repr=False)
    chosen: str = field(default="", compare=False, repr=False)

    @property
    def known(self) -> bool:
        return not self.reasons

    @property
    def shown(self) -> str:
        """The text with ``?`` for each unknown part."""
        return self.raw.replace(MARK, "?")

    def stripped(self) -> Text:
        return Text(self.raw.strip(), self.reasons, chosen=self.chosen)

    def unknown(self, field: str, location: Location) -> tuple[Unknown, ...]:
        """The entry for *field* whose value this is; none if all is known."""
        return () if self.known else (Unknown(field, "; ".join(dict.fromkeys(self.reasons)), location),)


def literal(text: str) -> Text:
    """*text* as a wholly known text; a MARK in it is no mark."""
    return Text(text.replace(MARK, "\ufffd"))


def unknown(reason: str) -> Text:
    """A text of which nothing is known."""
    return Text(MARK, (reason,))


def derived(origins: Iterable[Origin], again: Callable[[Mapping[str, Text]], Text | None]) -> Origin:
    """The origin of what comes from texts of these *origins*; in too many steps, or from too many, it is unknown otherwise."""
    known = list(origins)
    steps = 1 + max(origin.steps for origin in known)
    depends = frozenset[str]().union(*(origin.arguments for origin in known))
    if steps > MAX_STEPS or len(depends) > MAX_ARGUMENTS:
        depends = frozenset(sorted(depends)[:MAX_ARGUMENTS])
        return Origin(depends, lambda assumed: unknown("it comes from too many launch arguments"), None, MAX_STEPS)
    return Origin(depends, again, None, steps)


def join_texts(parts: list[Text]) -> Text:
    """The parts in a row, wholly unknown parts of one reason as one; unknown if that is longer than MAX_TEXT."""
    kept = [part for before, part in zip([None, *parts], parts, strict=False) if part != before or part.raw != MARK]
    if sum(len(part.raw) for part in kept) > MAX_TEXT:
        return unknown(f"longer than {MAX_TEXT} characters")
    reasons = tuple(reason for part in kept for reason in part.reasons)
    if len(reasons) > MAX_UNKNOWN:
        return unknown(reasons[0])
    chosen = next((part.chosen for part in kept if part.chosen), "")
    return Text("".join(part.raw for part in kept), reasons, chosen=chosen)


def is_private(name: str) -> bool:
    return name.startswith("~")


def is_legal(name: str) -> bool:
    """Whether *name* is a graph resource name; unknown parts are taken to be fine."""
    name = name.replace(MARK, "x")
    return name == "" or (_LEGAL.match(name) is not None and "//" not in name)


def canonical(name: str) -> str:
    """*name* without repeated and trailing slashes."""
    if not name or name == "/":
        return name
    parts = "/".join(part for part in name.split("/") if part)
    return "/" + parts if name.startswith("/") else parts


def join(namespace: str, name: str) -> str:
    """*name* in *namespace*; global and private names stay; what begins unknown may be global."""
    if is_private(name) or name.startswith("/"):
        return name
    if name.startswith(MARK):
        return "/" + name
    if namespace == "~":
        return "~" + name
    if not namespace:
        return name
    return namespace + name if namespace.endswith("/") else f"{namespace}/{name}"


def join_in(namespace: Text, name: Text) -> Text:
    """*name* in *namespace*, in canonical form, with the reasons of the parts that are left."""
    joined = canonical(join(namespace.raw, name.raw)) or "/"
    if joined.count(MARK) == len(name.reasons):
        return Text(joined, name.reasons)
    return Text(joined, namespace.reasons + name.reasons)


def quoted(text: str) -> str:
    """*text* in quotes on one line, shortened to fit into a message."""
    line = " ".join(text.replace(MARK, "?").split())
    return f"'{line if len(line) <= 100 else line[:97] + '...'}'"
