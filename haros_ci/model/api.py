# SPDX-License-Identifier: Apache-2.0
"""Rows that say what a call to a ROS library means: the tables in ``extract/apis`` and ``apis:`` of a project file.

A row is a mapping, the same in Python tables and in YAML (docs/adding-an-api.md)::

    {"call": "ros::NodeHandle::advertise", "args": [2, 3, 4],
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": "{2?false}"}],
     "returns": "ros::Publisher"}

``call`` is the qualified name of a function, method (``Class::method``) or, for a constructor, class; Python's is
dotted (``rospy.Publisher``). Of several rows for one call the first whose conditions hold is taken: ``args`` (numbers
of arguments that fit, Python keywords counted) and ``when`` (argument selector -> type name it must have, pointers
and const ignored; ``string``, ``bool``, ``int``, ``double``, ``function``, ``list`` for the built-in ones, ``true`` and ``false`` for what is
known to be so; a method, a lambda, a bind and a function object are a ``function``). A condition on an argument whose type is not known does
not hold.

Values are templates: text with selectors in braces; a template that is one selector is the value itself. A selector
is alternatives joined by ``|``, the first that is there counts, and ``?literal`` for none (``true``, ``12``,
``text``). Alternatives:

    0  1 …          positional argument                        latch      keyword argument (Python)
    0.topic         member of an argument                      this       the receiver
    <0>             template argument of the call (its type's name)       this<0>    the receiver's template argument
    callback(2)     message type of the callback's parameter; callback(2,1) its second
    typeof(1)       parameter type of an argument: bool, int, double, str, yaml; typeof(<0>|1|2): the first known one
    typename(1)     the name of its C++ or Python type
    parent(0)       the namespace of a name as it is resolved and remapped, with its last slash: ``/left/``
    resolve(0)      the full name that a name is resolved and remapped to, from the receiver's or the node's namespace;
                    resolve(0,1): argument 1 says whether it is remapped, in ROS 2 that it is not
    remap(0)        what a name is remapped to, else the name itself
    canonical(0)    a name without doubled and trailing slashes
    above(0)        the text of a name up to its last slash, as an absolute name: ``/left/``
    expand(0,1,2)   a name as it is expanded for a node's name and namespace
    search(0)       the full name of a parameter as searchParam finds it, from the entry's namespace upwards; unknown
                    where nothing sets it; searched(0): the same, or none where nothing sets it
    item.name       in an entry with ``each``: the item's name, type, default, group
    parameter       the value that the row's getter reads
    declared(0)     ROS 2: whether the node has declared the parameter of that name
    parameters(0,1)  ROS 2: the names of the node's parameters below the prefixes 0, to depth 1; prefixes(0,1): the
                    parts of these names before their last dots
    this.namespace  of a node handle: its full namespace       handle()  handle(~)    a node handle, for ``fills``
    node.name  node.namespace  process.name  process.namespace    full names of the node, and of the process that it
                    runs in: the same but for a nodelet, whose process is its manager's

``makes`` lists entries: ``kind`` is one of ``KINDS``, or

    handle          the object is a node handle: ``parent`` (a handle) and ``namespace`` (text, ``~``: private) combined
    node            the process registers as node ``name`` (ros::init, rospy.init_node); ``anonymous`` is true, or flags
                    that name ``AnonymousName``
    rate, timer     ``period`` in seconds or ``frequency`` in hertz; not endpoints, kept as ``paces`` of the node
    parameters      ROS 2: a parameter is declared; ``value`` is its default, ``descriptor`` a ParameterDescriptor

In rows of ROS 2 a ``node`` is an object: the one constructed, else the one returned, becomes a node of the process by
``name``, ``namespace`` and ``options`` (a NodeOptions), or with ``parent`` (a node) and ``namespace`` a sub-node.
``lifecycle`` is true for a managed node. Names are relative to the node that is the receiver, or that ``namespace``
selects: an object that is a node, or has one as its ``node`` field (``fills: {"node": "{0}"}``).

Other keys of an entry: ``name``, ``type``, ``queue_size``, ``latched``, ``qos`` (a number or a profile), ``value``, ``namespace`` (a handle or text;
default: the receiver if it is a handle, else the node's own namespace), ``implicit``, ``unsure`` (in words, why it may not
be made at all), ``strict`` (the call fails for a declaration without a value, or where nothing of that name is declared), ``each: "config(<0>)"`` (one
endpoint for every parameter of the dynamic_reconfigure file of that class), ``each: "keys(0)"`` (of a dict or map
argument). A ``type`` is ``pkg/Name``, or a C++ or Python type that stands for it: pointers, const, ``::Request`` and
``::Response``, and an action's ``Action`` are taken off.

``returns`` is a type's name or a template; ``"{parameter}"`` is the value that the row's getter reads, or the parameters that
it reads of a list (``each: "items(0)"``). ``sets`` maps
an argument to a template that is stored through it (``{"1": "{parameter}"}``); where the getter has no ``value``,
that is no default, the argument may also keep what it had. ``fills`` maps members of the receiver (or, for a
constructor or static factory, of the returned object) to templates. ``calls`` lists selectors of arguments that are
called back later; those that are not there or are no functions are passed over. ``transparent: "{0}"`` returns the
argument itself. ``unseen`` says in words what the call makes besides, which no row can tell: the node is then known
not to have all its endpoints in the model. ``bases`` (with ``class`` in place of ``call``) gives a library class its bases;
``entry`` the methods of it that a framework calls (onInit), ``alias`` the type that it is another name of.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from haros_ci.records import dataclass
from haros_ci.regex import regex

ENTRY_KINDS = (
    "publishers",
    "subscribers",
    "servers",
    "clients",
    "action_servers",
    "action_clients",
    "getters",
    "setters",
    "parameters",
    "handle",
    "node",
    "rate",
    "timer",
)
ROW_KEYS = (
    "call",
    "class",
    "args",
    "when",
    "makes",
    "returns",
    "sets",
    "fills",
    "calls",
    "transparent",
    "bases",
    "entry",
    "alias",
    "unseen",
)
ENTRY_KEYS = (
    "kind",
    "name",
    "type",
    "queue_size",
    "latched",
    "qos",
    "value",
    "descriptor",
    "options",
    "lifecycle",
    "namespace",
    "parent",
    "implicit",
    "unsure",
    "strict",
    "each",
    "anonymous",
    "period",
    "frequency",
)
#: Keys of an entry that are no templates.
UNTOLD = ("kind", "each", "implicit", "unsure", "strict")
#: Without ``{`` outside a selector; ``{{`` is not needed, as no ROS name has a brace.
SELECTOR = regex(r"\{([^{}]*)\}")
ALTERNATIVE = regex(
    r"\d+(\.\w+)*|<\d+>|this(<\d+>|(\.\w+)+)?|item\.(name|type|default|group)|parameter|[A-Za-z_]\w*(\.\w+)*"
    r"|callback\([\w|]+(,\d+)?\)|expand\(\d+,\d+,\d+\)|(parameters|prefixes)\(\w+,\w+\)"
    r"|(typeof|typename|parent|search|searched|remap|canonical|above|declared)\([\w.|<>]+\)"
    r"|resolve\([\w.|]+(,\d+)?\)|handle\(~?\)"
)


class RowError(ValueError):
    """A row that cannot be read; the message says which key and what to write."""


@dataclass(frozen=True, slots=True)
class Template:
    """Parsed text: literals and selectors in turn. A selector is (alternatives, default or None)."""

    parts: tuple[str | tuple[tuple[str, ...], str | None], ...]


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that a call makes; *values* maps keys of ``ENTRY_KEYS`` to templates."""

    kind: str
    values: Mapping[str, Template]
    each: str | None = None
    implicit: bool = False
    unsure: str = ""
    strict: bool = False


@dataclass(frozen=True, slots=True)
class Row:
    """What a call means; see the module's text for each part."""

    call: str
    args: tuple[int, ...] = ()
    when: tuple[tuple[str, str], ...] = ()
    makes: tuple[Entry, ...] = ()
    returns: Template | None = None
    sets: tuple[tuple[str, Template], ...] = ()
    fills: tuple[tuple[str, Template], ...] = ()
    calls: tuple[str, ...] = ()
    transparent: Template | None = None
    bases: tuple[str, ...] = ()
    entry: tuple[str, ...] = ()
    is_class: bool = False
    alias: str = ""
    unseen: str = ""


def load_row(data: Mapping[str, Any]) -> Row:
    """Check and parse one row; RowError says what is wrong with it."""
    unknown = sorted(set(data) - set(ROW_KEYS))
    if unknown:
        raise RowError(f"unknown key {unknown[0]!r}; a row has {', '.join(ROW_KEYS)}")
    name = data.get("call", data.get("class"))
    if not isinstance(name, str) or not name or ("call" in data) == ("class" in data):
        raise RowError("a row names either a 'call' (function, method or constructor) or a 'class'")
    return Row(
        call=name,
        args=tuple(_integer(n) for n in _sequence(data, "args")),
        when=tuple((_selector(str(k)), _text(v, "when")) for k, v in _mapping(data, "when").items()),
        makes=tuple(_entry(item) for item in _sequence(data, "makes")),
        returns=template(_text(data["returns"], "returns")) if "returns" in data else None,
        sets=tuple((str(k), template(_text(v, "sets"))) for k, v in _mapping(data, "sets").items()),
        fills=tuple((str(k), template(_text(v, "fills"))) for k, v in _mapping(data, "fills").items()),
        calls=tuple(_selector(_text(c, "calls")) for c in _sequence(data, "calls")),
        transparent=template(_text(data["transparent"], "transparent")) if "transparent" in data else None,
        bases=tuple(_text(b, "bases") for b in _sequence(data, "bases")),
        entry=tuple(_text(e, "entry") for e in _sequence(data, "entry")),
        is_class="class" in data,
        alias=_text(data["alias"], "alias") if "alias" in data else "",
        unseen=_text(data["unseen"], "unseen") if "unseen" in data else "",
    )


@lru_cache(maxsize=4096)
def template(text: str) -> Template:
    """Parse a template: ``{0}/camera_info`` has the selector ``0`` and the literal ``/camera_info``."""
    parts: list[str | tuple[tuple[str, ...], str | None]] = []
    end = 0
    for found in SELECTOR.finditer(text):
        if found.start() > end:
            parts.append(text[end : found.start()])
        body, mark, default = found[1].partition("?")
        alternatives = _alternatives(body)
        parts.append((alternatives, default if mark else None))
        end = found.end()
    if end < len(text):
        parts.append(text[end:])
    return Template(tuple(parts))


def _alternatives(body: str) -> tuple[str, ...]:
    found = tuple(re.split(r"\|(?![^(]*\))", body))
    for alternative in found:
        _selector(alternative)
    return found


def _selector(text: str) -> str:
    if not ALTERNATIVE.fullmatch(text):
        raise RowError(f"{text!r} selects nothing; write for example {{0}}, {{<0>}}, {{latch?false}}, {{callback(2)}}")
    return text


def _entry(data: Any) -> Entry:
    if not isinstance(data, Mapping):
        raise RowError("an entry of 'makes' is a mapping with a 'kind'")
    unknown = sorted(set(data) - set(ENTRY_KEYS))
    if unknown:
        raise RowError(f"unknown key {unknown[0]!r}; an entry has {', '.join(ENTRY_KEYS)}")
    if data.get("kind") not in ENTRY_KINDS:
        raise RowError(f"'kind' is one of {', '.join(ENTRY_KINDS)}")
    return Entry(
        kind=data["kind"],
        values={k: template(_text(v, k)) for k, v in data.items() if k not in UNTOLD},
        each=_text(data["each"], "each") if "each" in data else None,
        implicit=data.get("implicit") is True,
        unsure=_text(data["unsure"], "unsure") if "unsure" in data else "",
        strict=data.get("strict") is True,
    )


def _sequence(data: Mapping[str, Any], key: str) -> tuple[Any, ...]:
    value = data.get(key, ())
    if not isinstance(value, (list, tuple)):
        raise RowError(f"{key!r} is a list")
    return tuple(value)


def _mapping(data: Mapping[str, Any], key: str) -> Mapping[Any, Any]:
    value = data.get(key, {})
    if not isinstance(value, Mapping):
        raise RowError(f"{key!r} is a mapping")
    return value


def _integer(value: Any) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise RowError("'args' is a list of numbers of arguments")
    return value


def _text(value: Any, key: str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if not isinstance(value, str):
        raise RowError(f"{key!r} is text")
    return value
