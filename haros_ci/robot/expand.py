# SPDX-License-Identifier: Apache-2.0
"""A xacro file expanded, as xacro does it (eval_all of xacro 2), in document order.

What is not known goes both ways: both branches of an unknown condition are expanded and may be there. Nothing of it is run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from haros_ci.model.robot import Fault
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.robot.calling import Calling
from haros_ci.robot.functions import CHANGING, TooMuch
from haros_ci.robot.legacy import LEGACY, fits, is_call
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.scopes import Macros, XacroMacro, XacroScope
from haros_ci.robot.sources import DescriptionSources, as_written
from haros_ci.robot.texts import is_read, parameters_of, truth
from haros_ci.robot.unknown import UNKNOWN, UnknownValue

MAX_DEPTH = 180
GIVEN_UP = "not expanded to its end: it takes more steps than a description needs. Look for macros, lists or includes that repeat without end"

_CHANGES = regex(rf"\.(?:{'|'.join(sorted(CHANGING))})[ \t]*\(")


@dataclass(frozen=True, slots=True)
class Expanded:
    """The document that came out, and what was found on the way."""

    root: XmlNode | None
    faults: tuple[Fault, ...]
    files: tuple[str, ...]
    macros: tuple[str, ...]
    is_whole: bool


def expand(
    sources: DescriptionSources,
    path: str,
    arguments: Mapping[str, str | UnknownValue] | None = None,
    *,
    legacy: bool = False,
    is_open: bool = False,
    environment: Mapping[str, str] | None = None,
    is_before_noetic: Callable[[], bool | None] | None = None,
) -> Expanded:
    """Expand the file at *path* with *arguments*, where the *environment* has such variables.

    *legacy* takes tags without ``xacro:``, too, as xacro did before ROS Noetic. With *is_open* any argument may be given besides.
    With *legacy*, *is_before_noetic* tells whether every tag that is called as a macro calls it, None if it may; without it, those do
    that stand where links do.
    """
    made = Expansion(sources, path, dict(arguments or {}), legacy)
    made.is_before_noetic = is_before_noetic
    made.takes_any = is_open
    made.environment = environment or {}
    return made.run()


class Expansion(Calling):
    """One run over one file."""

    def __init__(
        self, sources: DescriptionSources, path: str, arguments: dict[str, str | UnknownValue], legacy: bool
    ) -> None:
        super().__init__(sources, path, arguments)
        self.legacy = legacy
        self.is_before_noetic: Callable[[], bool | None] | None = None
        self.unprefixed: list[str] = []  # the macros around that were called without ``xacro:``
        self.depth = 0
        self.defined: dict[str, None] = {}
        self.files: dict[str, None] = {path: None}

    def run(self) -> Expanded:
        source = self.sources.read(self.path)
        if source is None:
            return Expanded(None, (), (self.path,), (), False)
        self.looked_at(self.path)
        if self.path.endswith(".urdf") and "xmlns:xacro" not in source.attributes:
            return Expanded(source, (), (self.path,), (), True)  # none that xacro is run on
        root = replace(source, children=[], attributes={})
        try:
            self.content(source, Macros(self.world), XacroScope(self.world), root)
        except (TooMuch, RecursionError):
            self.give_up()
        whole = self.is_whole and not self.world.is_open
        return Expanded(root, self._told(), tuple(self.files), tuple(self.defined), whole)

    def looked_at(self, path: str) -> None:
        """Note whether the file at *path* changes lists."""
        self.changes_lists = self.changes_lists or _CHANGES.search(self.sources.text(path)) is not None

    def give_up(self) -> None:
        """What was found stands, but nothing is certain any more."""
        self.sources.problems[self.path] = Problem(self.path, GIVEN_UP)
        self.world.is_open = True
        self.faults = {key: replace(fault, certain=False) for key, fault in self.faults.items()}

    def _told(self) -> tuple[Fault, ...]:
        ever = self.world.ever | set(self.defined)
        return tuple(
            replace(fault, defined_later=True) if fault.name in ever else fault for fault in self.faults.values()
        )

    def content(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """Evaluate the attributes and the text of *node*, and what is in it, *into* an element that comes out."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise TooMuch
        for name, value in node.attributes.items():
            if not name.startswith("xacro:"):
                into.attributes[name] = self.words(value, scope, node)
        if isinstance(node.text, UnknownValue) or "$" in node.text:
            into.text = self.words(node.text, scope, node)
        else:
            into.text = node.text
        for child in node.children:
            self.spend(10)
            self.child(child, macros, scope, into)
        self.depth -= 1

    def child(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        tag = node.tag
        if self.legacy and tag in LEGACY:
            tag = f"xacro:{tag}"
        handle = _HANDLERS.get(tag)
        if handle is not None:
            handle(self, node, macros, scope, into)
        elif tag.startswith("xacro:"):
            self.call(node, tag.removeprefix("xacro:"), macros, scope, into)
        else:
            macro = macros.get(tag)
            if macro is not None and is_call(node, macro, into):
                self.fault("unprefixed", tag, node, of=macro.name)
                if self.legacy and self.is_before_noetic is None:
                    self.call(node, tag, macros, scope, into)
                    return
            if macro is None or not self.call_unprefixed(node, macro, macros, scope, into):
                self.element(node, node.tag, macros, scope, into)

    def call_unprefixed(
        self, node: XmlNode, macro: XacroMacro, macros: Macros, scope: XacroScope, into: XmlNode
    ) -> bool:
        """Call *macro* as *node* did it before ROS Noetic, if it may; under an unknown condition where the distribution is not known."""
        if not self.legacy or self.is_before_noetic is None or node.tag in self.unprefixed or not fits(node, macro):
            return False
        is_certain = self.is_before_noetic()
        if is_certain is False:
            return False
        self.unprefixed.append(node.tag)
        self.world.maybe += is_certain is None
        self.is_whole = self.is_whole and is_certain is True
        self.call(node, node.tag, macros, scope, into)
        self.world.maybe -= is_certain is None
        self.unprefixed.pop()
        return True

    def element(self, node: XmlNode, tag: str, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """Expand a tag that does not belong to xacro."""
        maybe = self.world.maybe
        certain = maybe == 0 and node.certain
        made = XmlNode(tag, {}, node.location, certain=certain, way=node.way or self.way, doubts=maybe)
        self.content(node, macros, scope, made)
        into.children.append(made)

    def named_element(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """``xacro:element``: a tag whose name is evaluated."""
        name = self.words(node.attributes.get("xacro:name", ""), scope, node)
        if isinstance(name, UnknownValue) or not name:
            self.is_whole = False
            return
        self.child(replace(node, tag=name), macros, scope, into)

    def attribute(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        name = self.words(node.attributes.get("name", ""), scope, node)
        value = self.words(node.attributes.get("value", ""), scope, node)
        if isinstance(name, str) and name:
            into.attributes[name] = value if self.world.maybe == 0 else UNKNOWN

    def insert_block(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        name = str(node.attributes.get("name", ""))
        for key, whole in (("**" + name, False), ("*" + name, True)):
            if not scope.is_set(key):
                continue
            block = scope.find(key)
            if not isinstance(block, XmlNode):
                self.is_whole = False
            elif whole:
                self.element(block, block.tag, macros, scope, into)
            else:
                self.inside(block, macros, scope, into)
            return
        is_parameter = name in scope.entries and scope.parent is not None  # meant, but without its ``*``
        if self.world.is_open and not is_parameter:
            self.is_whole = False
        else:
            self.fault("block", name, node, of=name if is_parameter else "")

    def condition(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        value = self.value(node.attributes.get("value", ""), scope, node)
        known = None if isinstance(value, UnknownValue) else truth(value)
        if known is None:
            self.world.maybe += 1
            self.is_whole = False
            self.inside(node, macros, scope, into)
            self.world.maybe -= 1
        elif known is not node.tag.endswith("unless"):
            self.inside(replace(node, attributes={}), macros, scope, into)

    def argument(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        name = str(node.attributes.get("name", ""))
        if self.takes_any:
            return
        if "default" not in node.attributes and name not in self.arguments:
            self.fault("default", name, node)
            self.arguments[name] = UNKNOWN
        elif name not in self.arguments:
            value = self.words(node.attributes["default"], scope, node)
            self.arguments[name] = value if self.world.maybe == 0 else UNKNOWN

    def property(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """xacro's grab_property."""
        attributes = node.attributes
        name = self.words(attributes.get("name", ""), scope, node)
        if isinstance(name, UnknownValue):
            self.world.is_open = True
            return
        if "remove" in attributes and truth(self.value(attributes["remove"], scope, node)):
            scope.remove(name)
            return
        value: Any = attributes.get("value")
        if "default" in attributes:
            if scope.has(name):
                return
            value = attributes["default"]
        if value is None:
            name, value = f"**{name}", node
        where = {"global": scope.top(), "parent": scope.around()}.get(str(attributes.get("scope", "")), scope)
        if where is None:
            return
        lazy = truth(self.value(attributes.get("lazy_eval", "true"), scope, node)) is not False and where is scope
        if not lazy and isinstance(value, str):
            value = self.value(value, scope, node)
        where.put(name, value, lazy=lazy, location=node.location)

    def macro(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """xacro's grab_macro."""
        name = str(node.attributes.get("name", "")).removeprefix("xacro:")
        params = str(node.attributes.get("params", ""))
        self.spend(len(params))
        found = list(parameters_of(params))
        defaults = {key: (forward, default) for key, forward, default in found if forward or default is not None}
        certain = self.world.maybe <= macros.maybe or macros.get(name) is None
        certain = certain and is_read(key for key, _, _ in found)
        macros.found[name] = XacroMacro(name, node, tuple(key for key, _, _ in found), defaults, certain)
        self.defined[name] = None

    def include(self, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        """xacro's process_include."""
        if "ns" in node.attributes:
            space = self.words(node.attributes["ns"], scope, node)
            if isinstance(space, UnknownValue):
                self.world.is_open = True
                return
            around = scope
            macros.namespaces[space] = macros = Macros(self.world)
            scope.namespaces[space] = scope = XacroScope(self.world, around, is_namespace=True)
        name = self.words(node.attributes.get("filename", ""), scope, node)
        if isinstance(name, UnknownValue):
            self.world.is_open = True
            return
        self.spend(100)
        several = self.sources.matching(name, self.file, self.spend)
        if several is not None:
            self.world.is_open = self.world.is_open or not several
            for path in several:
                self.included(path, node, macros, scope, into)
            return
        located = self.sources.locate(name, self.file)
        if located.path is not None:
            self.included(located.path, node, macros, scope, into)
            return
        if located.is_missing and truth(str(node.attributes.get("optional", "false"))) is not True:
            self.fault("include", as_written(name), node, similar=located.similar)
        elif not located.is_missing:
            self.world.is_open = True

    def included(self, path: str, node: XmlNode, macros: Macros, scope: XacroScope, into: XmlNode) -> None:
        source = self.sources.read(path)
        if source is None:
            self.world.is_open = True
            return
        self.files[path] = None
        self.looked_at(path)
        before = self.file, self.way
        self.file, self.way = path, (*self.way, (node.location, f"includes {path}"))
        self.inside(source, macros, scope, into)
        self.file, self.way = before


_HANDLERS = {
    "xacro:insert_block": Expansion.insert_block,
    "xacro:include": Expansion.include,
    "xacro:property": Expansion.property,
    "xacro:macro": Expansion.macro,
    "xacro:arg": Expansion.argument,
    "xacro:element": Expansion.named_element,
    "xacro:attribute": Expansion.attribute,
    "xacro:if": Expansion.condition,
    "xacro:unless": Expansion.condition,
    "xacro:call": Expansion.dynamic_call,
}
