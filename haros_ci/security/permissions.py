# SPDX-License-Identifier: Apache-2.0
"""What an end of a node needs to be allowed, and what a rule of a policy allows, both in names of DDS.

A policy becomes DDS permissions of the enclave, the set of all its profiles: topics are called ``rt/…``, requests and replies of a
service ``rq/…Request`` and ``rr/…Reply``, and an action is three services and two topics (permissions.xsl of sros2, and the design
article on topic and service names). A ``*`` in a rule stands for anything, ``/`` included (DDS Security, fnmatch without flags).
"""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase
from itertools import islice

from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: The attributes of a policy's lists, with the kind of end that each is about.
ENDS = {
    "publish": "publishers",
    "subscribe": "subscribers",
    "reply": "servers",
    "request": "clients",
    "execute": "action_servers",
    "call": "action_clients",
}
#: The lists of a profile, what they hold, and their attributes in the order of the schema.
LISTS = {
    "topics": ("topic", ("publish", "subscribe")),
    "services": ("service", ("reply", "request")),
    "actions": ("action", ("call", "execute")),
}
#: Patterns of one enclave that names are compared with.
MAX_PATTERNS = 300
_PARTS = ("cancel_goal", "get_result", "send_goal")
_NEWS = ("feedback", "status")


@dataclass(frozen=True, slots=True)
class PermissionNeed:
    """To ``publish`` or ``subscribe`` a topic of DDS."""

    verb: str
    topic: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Permission:
    """One entry of a list: *kind* of end, full *name*, allowed or denied. *is_included* if it stands in another file."""

    kind: str
    name: str
    allows: bool
    location: Location
    is_included: bool = False

    @property
    def is_pattern(self) -> bool:
        return any(sign in self.name for sign in "*?[")


def needs_of(kind: str, name: str) -> tuple[PermissionNeed, ...]:
    """What an end of this *kind* (as in the model) of the full *name* needs, or a rule about such ends is about."""
    if kind == "publishers":
        return (PermissionNeed("publish", f"rt{name}"),)
    if kind == "subscribers":
        return (PermissionNeed("subscribe", f"rt{name}"),)
    if kind in ("servers", "clients"):
        asks, answers = ("subscribe", "publish") if kind == "servers" else ("publish", "subscribe")
        return (PermissionNeed(asks, f"rq{name}Request"), PermissionNeed(answers, f"rr{name}Reply"))
    if kind in ("action_servers", "action_clients"):
        inner, news = ("servers", "publishers") if kind == "action_servers" else ("clients", "subscribers")
        services = [need for part in _PARTS for need in needs_of(inner, f"{name}/_action/{part}")]
        return (*services, *(need for part in _NEWS for need in needs_of(news, f"{name}/_action/{part}")))
    return ()


def verdict(kind: str, name: str, rules: Iterable[Permission]) -> str:
    """Whether *rules* of one enclave let a node have this end: ``allowed``, ``denied``, or ``missing`` if nothing says so.

    What a rule denies stays denied, whatever allows it; all that an end needs has to be allowed.
    """
    return Rules(rules).verdict(kind, name)


class Rules:
    """The rules of one enclave, put in order for many questions. Not *is_whole* if there are more patterns than are looked at."""

    def __init__(self, rules: Iterable[Permission]) -> None:
        self._plain: dict[PermissionNeed, bool] = {}
        self._patterns: dict[PermissionNeed, bool] = {}
        self._said: dict[tuple[str, str], str] = {}
        for rule in rules:
            found = self._patterns if rule.is_pattern else self._plain
            for need in needs_of(rule.kind, rule.name):
                found[need] = found.get(need, True) and rule.allows
        self.is_whole = len(self._patterns) <= MAX_PATTERNS

    def verdict(self, kind: str, name: str) -> str:
        """As ``verdict``."""
        key = (kind, name)
        if key not in self._said:
            self._said[key] = self._verdict(kind, name)
        return self._said[key]

    def _verdict(self, kind: str, name: str) -> str:
        found = "allowed"
        for need in needs_of(kind, name):
            verdicts = [self._plain[need]] if need in self._plain else []
            verdicts += (
                allows
                for part, allows in islice(self._patterns.items(), MAX_PATTERNS)
                if part.verb == need.verb and fnmatchcase(need.topic, part.topic)
            )
            if not all(verdicts):
                return "denied"
            if not verdicts:
                found = "missing"
        return found
