# SPDX-License-Identifier: Apache-2.0
"""The Python classes that are made of interfaces: what can be asked of an object of one."""

from __future__ import annotations

import re

from haros_ci.interfaces.definitions import Definitions, field_type
from haros_ci.model.build import Interface, InterfaceField
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Methods and such of all generated classes: rosidl_generator_py, genpy.
OF_ALL = frozenset(
    ("get_fields_and_field_types", "SLOT_TYPES", "serialize", "deserialize", "serialize_numpy", "deserialize_numpy", "check_fields")
)  # fmt: skip
_PARTS = {
    "Request": ("srv", 0),
    "Response": ("srv", 1),
    "Goal": ("action", 0),
    "Result": ("action", 1),
    "Feedback": ("action", 2),
}
_NEW = regex(
    r"(?P<package>[a-z]\w*)\.(?P<kind>msg|srv|action)\.(?P<name>[A-Z]\w*)(?:\.(?P<part>[A-Z]\w*))?\Z", re.ASCII
)


@dataclass(frozen=True, slots=True)
class Struct:
    """A generated class: *name* as code has it (``pkg.srv.T.Request``), its *fields* with their types, its *constants*."""

    name: str
    fields: dict[str, str]
    constants: frozenset[str]

    def has(self, name: str) -> bool:
        """Whether an object has this attribute, or may have it."""
        return (
            name in self.fields
            or name in self.constants
            or name in OF_ALL
            or name.startswith("_")
            or name.endswith("__DEFAULT")
        )


class Structs:
    """The generated classes that code of one ROS version sees; only those that are known for certain, and not of packages *hidden*."""

    def __init__(self, known: Definitions, hidden: frozenset[str] = frozenset()) -> None:
        self.known = known
        self.hidden = hidden
        self._made: dict[str, Struct | None] = {}

    def named(self, dotted: str) -> Struct | None:
        """The class with this name in Python; None if there is no such class, or it is not known."""
        if dotted not in self._made:
            self._made[dotted] = self._find(dotted)
        return self._made[dotted]

    def of_field(self, struct: Struct, name: str) -> Struct | None:
        """The class of the objects in a field; None for numbers, texts, lists and what is not known."""
        kind = field_type(struct.fields.get(name, ""))
        if kind is None or not kind.is_nested or kind.form:
            return None
        package, _, short = kind.base.partition("/")
        return self.named(f"{package}.msg.{short}")

    def _find(self, dotted: str) -> Struct | None:
        match = _NEW.match(dotted)
        if match is None or match["package"] in self.hidden:
            return None
        package, kind, name, part = match["package"], match["kind"], match["name"], match["part"] or ""
        if kind == "msg" and not part:
            found = self._section(dotted, kind, f"{package}/{name}", 0)
            return found or (self._of_old_action(dotted, package, name) if self.known.ros == 1 else None)
        if self.known.ros == 1:
            return self._of_old_service(dotted, package, name) if kind == "srv" and not part else None
        if part not in _PARTS or _PARTS[part][0] != kind:
            return None
        return self._section(dotted, kind, f"{package}/{name}", _PARTS[part][1])

    def _of_old_service(self, dotted: str, package: str, name: str) -> Struct | None:
        for ending in ("Request", "Response"):
            if name.endswith(ending):
                return self._section(dotted, "srv", f"{package}/{name.removesuffix(ending)}", _PARTS[ending][1])
        return None

    def _of_old_action(self, dotted: str, package: str, name: str) -> Struct | None:
        for ending in ("Goal", "Result", "Feedback"):
            short = name.removesuffix(ending)
            if short != name and not short.endswith("Action"):
                return self._section(dotted, "action", f"{package}/{short}", _PARTS[ending][1])
        return None

    def _section(self, dotted: str, kind: str, name: str, number: int) -> Struct | None:
        found = self.known.find(kind, name)
        if found is None or number >= len(found.sections):
            return None
        constants = (
            f.name for variant in self.known.variants(kind, name) for s in variant.sections for f in s if f.is_constant
        )
        fields = {f.name: _own(f, found, self.known.ros) for f in found.sections[number] if not f.is_constant}
        return Struct(dotted, fields, frozenset(constants))


def _own(field: InterfaceField, interface: Interface, ros: int) -> str:
    """Its type; ``Header`` alone is the package's own in ROS 2."""
    if ros == 2 and field.written == "Header":
        return f"{interface.name.partition('/')[0]}/Header"
    return field.type
