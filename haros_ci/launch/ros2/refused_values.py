# SPDX-License-Identifier: Apache-2.0
"""What rcl_yaml_param_parser refuses in a parameter file that is valid YAML: the node that is given it does not start.

The states are those of its ``parse_file_events`` (rcl, parse.c). Where it goes on with something else than the file says (a map in a
list, a map without keys), nothing more is looked at.
"""

from __future__ import annotations

from itertools import islice
from typing import Any

from haros_ci.bounded_yaml import YamlFault, events
from haros_ci.launch.ros2.parameter_yaml import LIMITS, MAX_VALUES, Scalar, rcl_value
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_facts import RefusedValue
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

SECTION = "ros__parameters"
#: Text that something else fills in, or an escape of launch: what rcl gets is another text.
_FILLED_IN = regex(r"\{\{|\{%|<%|@\(|\$\(")
#: Numbers of which strtod says otherwise than the model: hexadecimal ones with an exponent, payloads, exponents without end.
_ODD_NUMBER = regex(r"[+-]?(?:0[xX]|nan\(|[0-9.]+[eE][+-]?[0-9]{3})")
_LONGEST = 100


def refused_in(places: Places, file: str) -> RefusedValue | None:
    """``refused_value`` of a file of the workspace; it is looked at once."""
    key = ("refused", file)
    if key not in places.remembered:
        places.remembered[key] = refused_value(places.workspace.text(file), file)
    found: RefusedValue | None = places.remembered[key]
    return found


def refused_value(text: str, path: str) -> RefusedValue | None:
    """The first place of the parameter file *path* with *text* at which rcl stops; None if it takes it, or nobody can tell."""
    if _FILLED_IN.search(text):
        return None
    try:
        reader = _Reader()
        for event in islice(events(text, LIMITS), MAX_VALUES):
            if reader.is_done:
                break
            reader.take(event)
    except YamlFault:
        return None  # no YAML: said elsewhere
    except _Refused as err:
        return RefusedValue(path, err.line, err.problem, err.advice)
    return None


class _Refused(Exception):
    def __init__(self, event: Any, problem: str, advice: str) -> None:
        super().__init__(problem)
        self.line = event.start_mark.line + 1
        self.problem = problem
        self.advice = advice


@dataclass(slots=True)
class _Reader:
    """The state of rcl between two events; *opened* are the maps that are open, each with whether a key of it was read."""

    is_done: bool = False
    is_key: bool = True
    is_list: bool = False
    kind: str | None = None
    name: str = ""
    opened: list[bool] = field(default_factory=list)
    #: The depth of the map below ``ros__parameters``, 0 outside of one.
    section: int = 0
    _steps: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        self._steps = {
            "ScalarEvent": self._scalar,
            "AliasEvent": self._alias,
            "SequenceStartEvent": self._list,
            "SequenceEndEvent": self._list_end,
            "MappingStartEvent": self._map,
            "MappingEndEvent": self._map_end,
        }

    def take(self, event: Any) -> None:
        step = self._steps.get(type(event).__name__)
        if step is not None:
            step(event)

    def _scalar(self, event: Any) -> None:
        if self.is_key:
            self._key(event)
        else:
            self._value(event)

    def _key(self, event: Any) -> None:
        if not self.opened:
            self.is_done = True  # a document that is a scalar
            return
        if not event.value:
            raise _Refused(event, "a key is empty", "give it a name")
        if not self.section and event.value.startswith(SECTION):
            if len(self.opened) == 1:
                raise _Refused(
                    event, f"{SECTION} stands below no name of a node", "put the name of the node above it, or /**"
                )
            self.section = len(self.opened) + 1
        self.opened[-1] = True
        self.name = event.value
        self.is_key = False

    def _value(self, event: Any) -> None:
        if len(self.opened) < self.section or not self.section:
            raise self._too_early(event)
        if event.style not in ("'", '"') and not event.value:
            raise _Refused(event, f"{_shown(self.name)} has no value", "write one, or remove the key")
        if not self.is_list:
            self.is_key = True
            return
        kind = _kind(event)
        if kind is None:
            self.is_done = True
            return
        if self.kind is not None and kind != self.kind:
            raise _Refused(
                event, f"the list {_shown(self.name)} mixes {self.kind} and {kind}", _one_type(self.kind, kind)
            )
        self.kind = kind

    def _too_early(self, event: Any) -> _Refused:
        if self.name.startswith(SECTION):
            return _Refused(event, f"{SECTION} has no parameters", "write one, or remove the section")
        return _Refused(event, f"{_shown(self.name)} has a value outside of {SECTION}", f"put it below {SECTION}")

    def _alias(self, event: Any) -> None:
        raise _Refused(event, f"*{_shown(event.anchor)} is an alias", "write out what it stands for")

    def _list(self, event: Any) -> None:
        if self.is_key:
            inner = (
                f"the list {_shown(self.name)} has lists in it" if self.section else "a list stands in place of a name"
            )
            raise _Refused(event, inner, "write one list of values below a name")
        if not self.section:
            raise self._too_early(event)
        self.is_done = len(self.opened) < self.section
        self.is_list, self.kind = True, None

    def _list_end(self, event: Any) -> None:
        self.is_list, self.is_key = False, True

    def _map(self, event: Any) -> None:
        self.opened.append(False)
        self.is_done = self.is_list or (self.is_key and len(self.opened) > 1)
        self.is_key = True

    def _map_end(self, event: Any) -> None:
        has_keys = self.opened.pop()
        self.is_done = not has_keys
        if len(self.opened) + 1 == self.section:
            self.section = 0
        self.is_key = True


def _kind(event: Any) -> str | None:
    """The type that rcl gives an item of a list; None where that is another one by the version or the platform."""
    if event.style in ("|", ">") or (event.tag is not None and event.tag != "!") or len(event.value) > _LONGEST:
        return None
    is_plain = event.style not in ("'", '"')
    if is_plain and _ODD_NUMBER.match(event.value):
        return None
    return rcl_value(Scalar(event.value, 1, is_plain))[0]


def _one_type(first: str, second: str) -> str:
    if {first, second} == {"int", "double"}:
        return "write a decimal point in each number"
    if "str" in (first, second):
        return "put each item in quotes, or none"
    return "give all items one type"


def _shown(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
