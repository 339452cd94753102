# SPDX-License-Identifier: Apache-2.0
"""Quality of service: from a value in the code to the policies of a ROS 2 topic or service end."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from haros_ci.follow.ros.qos_profiles import ALIASES, CLASSES, CONSTANTS, DEFAULT, NUMBERS, PROFILES, UNITS, WORDS
from haros_ci.model.architecture import Qos
from haros_ci.model.digits import whole_number
from haros_ci.model.location import Location
from haros_ci.values.abstract import (
    Cell,
    Choice,
    Known,
    Library,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    opaque_of,
)

Why = tuple[str, Location | None]
POLICIES = tuple(field.name for field in fields(Qos))
DURATIONS = frozenset(("deadline", "lifespan", "lease"))
#: Times that are no limit: those of rmw's ``RMW_DURATION_INFINITE`` and beyond, in seconds.
ENDLESS = 9_223_372_036.0
UNKNOWN = Qos(history="?", depth="?", reliability="?", durability="?")
SEVERAL = "it may be one of several qualities of service"


def qos_of(value: Value) -> tuple[Qos, Why | None]:
    """The quality of service that *value* stands for: a number, a profile, a constant, or an object of a QoS class.

    A policy that is not known is ``?``, and the reason of the first such one is returned (rclcpp/qos.hpp, rclpy/qos.py,
    rmw/qos_profiles.h). Of a value of which nothing is known the policies with defaults are ``?``.
    """
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Known):
        return _of_data(value.value)
    if isinstance(value, Text):
        return _of_text(value)
    if isinstance(value, Choice):
        return _of_several(tuple(qos_of(option) for option in value.options))
    if isinstance(value, Library):
        profile = _profile(value.name)
        number = _enumerator(value.name)
        if number is not None:
            return replace(DEFAULT, depth=number), None
        return (profile, _blank(profile)) if profile is not None else (UNKNOWN, _why(value))
    if isinstance(value, Object):
        return _of_object(value)
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple) and len(value.content.value) == 1:
        return qos_of(value.content.value[0].value)  # {10}: what the QoS is made of
    return UNKNOWN, _why(value)


def preset(name: str) -> Object | None:
    """A fresh object for the struct of that *name* (``rmw_qos_profile_sensor_data``); None if none is known.

    The code may copy it and change its members.
    """
    short = name.rpartition("::")[2]
    if not short.startswith(("rmw_qos_profile_", "rcl_qos_profile_")):
        return None
    profile = PROFILES.get(ALIASES.get(short, short))
    if profile is None:
        return None
    named = {"liveliness_lease_duration" if policy == "lease" else policy: policy for policy in POLICIES}
    cells: dict[str, Cell] = {}
    for field, policy in named.items():
        value = getattr(profile, policy)
        if isinstance(value, float):
            value = int(value * 1_000_000_000)
        cells[field] = Cell(Known("default" if value is None else value))
    return Object("rmw_qos_profile_t", fields=cells)


def overridden(qos: Qos, rules: Mapping[str, object]) -> Qos:
    """*qos* after the parameters ``qos_overrides.<topic>.<publisher or subscription>.<policy>``, by policy.

    Values are ``Value`` or plain data: words for policies, times in nanoseconds (rclcpp/detail/qos_parameters.hpp).
    """
    changed: dict[str, Any] = {}
    for name, provided in rules.items():
        policy = "lease" if name in ("liveliness_lease_duration", "lease") else name
        if policy in POLICIES:
            value = provided if isinstance(provided, (Known, Opaque, Text, Choice, Object)) else Known(provided)
            changed[policy] = _policy(policy, value)[0]
    return _sane(replace(qos, **changed))


def override_policies(options: Value | None) -> tuple[str, ...] | None:
    """The policies that parameters may override, as the options of a publisher or subscription say; None if not known.

    *options* are a PublisherOptions or SubscriptionOptions with ``qos_overriding_options``, those themselves, or the
    names of policies with commas between them.
    """
    if isinstance(options, Pointer):
        options = options.cell.value
    if options is None or options == Known(None):
        return ()
    if isinstance(options, Known) and issubclass(options.kind, str):
        return tuple(word for word in options.of(str).split(",") if word in (*POLICIES, "liveliness_lease_duration"))
    if isinstance(options, Sequence):  # {policies}, or {{policies}, callback, id}
        inner = _braced(options, 0)
        return _kinds(inner if isinstance(inner, Sequence) else options)
    if not isinstance(options, Object):
        return None
    if "qos_overriding_options" in options.fields:
        return override_policies(options.fields["qos_overriding_options"].value)
    if "policies" not in options.fields:
        return () if options.name.endswith(("Options", "OptionsWithAllocator")) else None
    named = options.fields["policies"].value
    return override_policies(named) if isinstance(named, Known) else _kinds(named)


def _kinds(named: Value) -> tuple[str, ...] | None:
    """The policies of a list of QosPolicyKind."""
    content = named.content.value if isinstance(named, Sequence) else None
    libraries = (
        [cell.value for cell in content if isinstance(cell.value, Library)] if isinstance(content, tuple) else []
    )
    if not isinstance(content, tuple) or len(libraries) < len(content):
        return None
    words = (_snake(re.split(r"::|\.", library.name)[-1]) for library in libraries)
    return tuple(word.removeprefix("rmw_qos_policy_") for word in words)


def _braced(value: Sequence, at: int) -> Value | None:
    """One of the values that stand in braces."""
    content = value.content.value
    return content[at].value if isinstance(content, tuple) and at < len(content) else None


def override_id(options: Value | None) -> str | None:
    """The ``id`` of overriding options, empty where there is none; None if it is not known."""
    if isinstance(options, Pointer):
        options = options.cell.value
    if isinstance(options, Sequence) and isinstance(_braced(options, 0), Sequence):
        options = Object("", fields={"id": Cell(_braced(options, 2) or Known(""))})
    if not isinstance(options, Object):
        return ""
    inner = options.fields.get("qos_overriding_options")
    if inner is not None:
        return override_id(inner.value)
    held = options.fields["id"].value if "id" in options.fields else Known("")
    return held.of(str) if isinstance(held, Known) and issubclass(held.kind, str) else None


def _of_data(data: object) -> tuple[Qos, Why | None]:
    if isinstance(data, (int, float)) and not isinstance(data, bool):
        return replace(DEFAULT, depth=int(data)), None
    if isinstance(data, str):
        name, colon, depth = data.partition(":") if "::" not in data else (data, "", "")
        profile = _profile(name)
        if profile is not None:
            kept = whole_number(depth) if colon else None
            profile = replace(profile, depth=kept) if kept is not None else profile
            return profile, _blank(profile)
    return UNKNOWN, ("it is no quality of service", None)


def _of_text(value: Text) -> tuple[Qos, Why | None]:
    """``profile:depth`` of which the depth is not known."""
    first = value.parts[0]
    profile = _profile(first.removesuffix(":")) if isinstance(first, str) and first.endswith(":") else None
    return (replace(profile, depth="?") if profile is not None else UNKNOWN), _why(value)


def _of_several(found: tuple[tuple[Qos, Why | None], ...]) -> tuple[Qos, Why | None]:
    whole, why = found[0]
    for other, reason in found[1:]:
        differing = [policy for policy in POLICIES if getattr(other, policy) != getattr(whole, policy)]
        why = why or reason or ((SEVERAL, None) if differing else None)
        whole = replace(whole, **dict.fromkeys(differing, "?"))
    return whole, why


def _of_object(value: Object) -> tuple[Qos, Why | None]:
    held = {**value.fields}
    if "liveliness_lease_duration" in held:
        held["lease"] = held["liveliness_lease_duration"]
    start = CLASSES.get(value.name)
    if start is None and not any(policy in held for policy in POLICIES):
        return UNKNOWN, (f"what quality of service a {value.name or 'value'} is, is not known", value.location)
    known: dict[str, Any] = {}
    why: Why | None = None
    for policy in POLICIES:
        if policy not in held:
            known[policy] = getattr(start, policy) if start is not None else "?" if policy in WORDS_NEEDED else None
            continue
        known[policy], reason = _policy(policy, held[policy].value)
        why = why or reason
    found = _sane(Qos(**known))
    return found, why if why is not None or "?" not in known.values() else ("the code does not tell it", value.location)


#: Policies that a middleware has no default for that everyone shares.
WORDS_NEEDED = frozenset(("history", "depth", "reliability", "durability"))


def _sane(qos: Qos) -> Qos:
    return replace(qos, depth=None) if qos.history == "keep_all" else qos


#: A word, a number of messages, or seconds; None for the default.
Policy = str | int | float | None


def _policy(policy: str, value: Value) -> tuple[Policy, Why | None]:
    """One policy: a word, a number of messages, or seconds; None for the default, ``?`` with its reason."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Choice):
        found = [_policy(policy, option) for option in value.options]
        same = all(item[0] == found[0][0] for item in found)
        return found[0] if same else ("?", (SEVERAL, None))
    if isinstance(value, Library) and (profile := _profile(value.name)) is not None:
        return getattr(profile, policy), None
    if isinstance(value, Object) and value.name in CLASSES:
        whole, why = _of_object(value)
        return getattr(whole, policy), why
    found_value = _duration(value) if policy in DURATIONS else _word(policy, value)
    if found_value == "?":
        return "?", _why(value)
    return found_value, None


def _word(policy: str, value: Value) -> Policy:
    if policy == "depth":
        return _depth(value)
    if isinstance(value, Known) and issubclass(value.kind, int) and not isinstance(value.value, bool):
        return NUMBERS[policy].get(value.of(int), "?")
    if isinstance(value, Known) and issubclass(value.kind, str):
        return WORDS[policy].get(value.of(str).lower(), "?")
    if isinstance(value, Library):
        name = value.name.removesuffix(".value")
        short = _snake(re.split(r"::|\.", name)[-1])
        return WORDS[policy].get(
            re.sub(r"^rmw_qos_policy_(history|reliability|durability|liveliness)_", "", short), "?"
        )
    return "?"


def _depth(value: Value) -> int | str | None:
    if isinstance(value, Known) and issubclass(value.kind, (int, float)) and not isinstance(value.value, bool):
        return int(value.value) if isinstance(value.value, (int, float)) else "?"
    if isinstance(value, Known) and value.value in ("default", "system_default"):
        return None
    if isinstance(value, Library) and value.name.endswith("RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT"):
        return None
    number = _enumerator(value.name) if isinstance(value, Library) else None
    return number if number is not None else "?"


def _enumerator(name: str) -> int | None:
    """The number that an enumerator of rmw's C headers is where it stands for a depth (rmw/types.h)."""
    found = re.fullmatch(r"(?:::)?RMW_QOS_POLICY_(HISTORY|RELIABILITY|DURABILITY|LIVELINESS)_(\w+)", name)
    policy, word = (found[1].lower(), found[2].lower()) if found is not None else ("", "")
    if word not in WORDS.get(policy, ()):
        return None
    return next((number for number, item in NUMBERS[policy].items() if item == WORDS[policy][word]), None)


def _duration(value: Value) -> float | str | None:
    """Seconds; None for no limit. A number by itself is nanoseconds."""
    if isinstance(value, Library):
        return None if CONSTANTS.search(value.name) else "?"
    if isinstance(value, Known):
        if value.value is None or value.value in ("default", "infinite"):
            return None
        if value.value == "best_available":
            return "best_available"
        number = value.value if isinstance(value.value, (int, float)) and not isinstance(value.value, bool) else None
        return _limited(number * 1e-9) if number is not None else "?"
    parts: dict[str, Value] = {}
    if isinstance(value, Object):
        parts = {name: cell.value for name, cell in value.fields.items() if name in UNITS or name == "infinite"}
    elif isinstance(value, Sequence) and isinstance(value.content.value, tuple) and len(value.content.value) == 2:
        parts = dict(zip(("sec", "nsec"), (cell.value for cell in value.content.value), strict=True))
    if parts.pop("infinite", None) == Known(True):
        return None
    total = 0.0
    for name, part in parts.items():
        part = part.cell.value if isinstance(part, Pointer) else part
        if isinstance(part, Object):  # a duration made of another one
            inner = _duration(part)
            if not isinstance(inner, float):
                return inner
            total += inner
        elif isinstance(part, Known) and issubclass(part.kind, (int, float)) and not issubclass(part.kind, bool):
            total += part.of(float if part.kind is float else int) * UNITS[name]
        else:
            return "?"
    return _limited(total) if parts else "?"


def _limited(seconds: float) -> float | None:
    """A time as a limit: zero is what is not said, and stands for the default as an endless one does."""
    return None if seconds <= 0 or seconds >= ENDLESS else round(seconds, 9)


def _profile(name: str) -> Qos | None:
    """The profile of that name in C++ or Python."""
    name = name.removeprefix("::").removesuffix(".value")
    if name in CLASSES:
        return CLASSES[name]
    last = re.split(r"::|\.", name)[-1]
    if "QoSPresetProfiles" in name:
        last = f"rmw_qos_profile_{last.lower()}"
    elif last.startswith("qos_profile_"):
        last = f"rmw_{last}"
    return PROFILES.get(ALIASES.get(last, last))


def _blank(profile: Qos) -> Why | None:
    unknown = any(getattr(profile, policy) == "?" for policy in POLICIES)
    return ("the profile leaves it unknown", None) if unknown else None


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


def _why(value: Value) -> Why:
    found = opaque_of(value)
    return (found.reason, found.location) if found is not None else ("it is no quality of service that is known", None)
