# SPDX-License-Identifier: Apache-2.0
"""Calls of macros (xacro's handle_macro_call): what is given to their parameters and blocks, and what is missing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from itertools import islice
from typing import Any

from haros_ci.model.slips import equally_near
from haros_ci.model.workspace import Problem
from haros_ci.robot.evaluating import Evaluating
from haros_ci.robot.expressions import Invalid, Undefined
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.scopes import Macros, XacroMacro, XacroScope
from haros_ci.robot.sources import DescriptionSources
from haros_ci.robot.unknown import UNKNOWN, UnknownValue

#: Of so many names those are looked for that a name may be meant for, and of so many characters.
MAX_KNOWN = 1_000
MAX_NAME = 100
#: Calls of a macro in itself that are followed although it is not known whether they are made.
MAX_OPEN = 3


class Calling(Evaluating):
    """The part of an expansion that calls macros."""

    def __init__(self, sources: DescriptionSources, path: str, arguments: dict[str, str | UnknownValue]) -> None:
        super().__init__(sources, path, arguments)
        self.is_whole = True
        #: The macros that are called around what is expanded, with how many unknown conditions are around each call.
        self.active: list[tuple[XacroMacro, int]] = []

    def content(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """Evaluate the attributes and the text of *node*, and what is in it, *into* an element that comes out."""
        raise NotImplementedError

    def inside(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """What is in *node*, without *node*; attributes that it sets are lost with it."""
        holder = XmlNode(node.tag, {}, node.location)
        self.content(node, macros, scope, holder)
        into.children += holder.children

    def dynamic_call(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """``xacro:call``: the macro's name is evaluated."""
        name = self.words(node.attributes.get("macro", ""), scope, node)
        if isinstance(name, UnknownValue):
            self.world.is_open = True
            return
        left = {key: value for key, value in node.attributes.items() if key != "macro"}
        self.call(replace(node, attributes=left), name, macros, scope, into)

    def call(self, node: XmlNode, name: str, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """xacro's handle_macro_call."""
        found = _resolved(name, macros, scope)
        if found is None or not found[2].certain:
            if found is None and not self.world.is_open:
                self.fault("macro", name, node, similar=lambda: _similar(name, macros.every()))
            self.is_whole = False
            self.world.is_open = self.world.is_open or found is not None
            return
        around, outer, macro = found
        inner = XacroScope(self.world, outer)
        left = list(macro.parameters)
        self.spend(len(left) * (len(node.attributes) + 1) // 64)
        for key, value in node.attributes.items():
            if key not in left:
                self.fault("extra", key, node, of=macro.name, similar=partial(_similar, key, tuple(left), 0.6))
                continue
            left.remove(key)
            inner.put(key, self.value(value, scope, node), lazy=False, location=node.location)
        holder = XmlNode(node.tag, {}, node.location)
        self.content(replace(node, attributes={}), macros, scope, holder)
        left = self._blocks(node, holder.children, left, macro, inner)
        missing = []
        for key in left:
            if key not in macro.defaults:
                missing.append(key)
            inner.put(key, self._default(key, macro, scope, node), lazy=False, location=node.location)
        if missing:
            self.fault("parameter", " ".join(missing), node, of=macro.name)
        if self._is_open_recursion(macro):
            message = f"the macro {macro.name} calls itself, and how often is not known; what it makes then is missing"
            self.sources.problems.setdefault(self.path, Problem(self.path, message))
            self.is_whole = False
            self.world.is_open = True
            return
        before = self.way
        self.way = (*self.way, (node.location, f"calls the macro {macro.name}"))
        self.active.append((macro, self.world.maybe))
        self.inside(macro.body, Macros(self.world, around), inner, into)
        self.active.pop()
        self.way = before

    def _is_open_recursion(self, macro: XacroMacro) -> bool:
        """Whether *macro* has called itself some times, each under one more condition that is not known."""
        doubts = {maybe for other, maybe in self.active if other.body is macro.body}
        return len(doubts) > MAX_OPEN and self.world.maybe > max(doubts)

    def _blocks(
        self, node: XmlNode, blocks: list[XmlNode], left: list[str], macro: XacroMacro, inner: XacroScope
    ) -> list[str]:
        """Give the elements in a call to the block parameters, in order; the parameters that are left."""
        certain = [block for block in blocks if block.certain]
        for key in [item for item in left if item.startswith("*")]:
            left = [item for item in left if item != key]
            if len(certain) != len(blocks):
                inner.put(key, UNKNOWN, lazy=False, location=node.location)
                continue
            if not blocks:
                self.fault("parameter", key, node, of=macro.name)
                inner.put(key, UNKNOWN, lazy=False, location=node.location)
                continue
            inner.put(key, blocks[0], lazy=False, location=node.location)
            blocks = certain = blocks[1:]
        return left

    def _default(self, key: str, macro: XacroMacro, scope: XacroScope, node: XmlNode) -> Any:
        if key not in macro.defaults:
            return UNKNOWN
        forward, default = macro.defaults[key]
        if forward:
            try:
                return scope.find(key)
            except Undefined as err:
                if default is None:
                    if not self.world.is_open:
                        self.fault(err.kind, err.name, node, of=macro.name)
                    return UNKNOWN
            except Invalid:
                return UNKNOWN
        return UNKNOWN if default is None else self.value(default, scope, node)


def _similar(name: str, known: Iterable[str], cutoff: float = 0.7) -> tuple[str, ...]:
    """The names that *name* may be meant for."""
    near = [item for item in islice(known, MAX_KNOWN) if len(item) <= MAX_NAME]
    return equally_near(name, near, cutoff) if len(name) <= MAX_NAME else ()


def _resolved(name: str, macros: Macros, scope: XacroScope) -> tuple[Macros, XacroScope, XacroMacro] | None:
    """The macro *name*, with the macros and properties that it sees; ``ns.name`` is looked up in the namespace."""
    found = macros.get(name)
    if found is not None:
        return macros, scope, found
    *spaces, last = name.split(".")
    for space in spaces:
        next_macros, next_scope = macros.namespace(space), scope.namespace(space)
        if next_macros is None or next_scope is None:
            return None
        macros, scope = next_macros, next_scope
    found = macros.get(last)
    return None if found is None else (macros, scope, found)
