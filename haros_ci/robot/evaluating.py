# SPDX-License-Identifier: Apache-2.0
"""Texts and attributes of a xacro file evaluated at a place: expressions, substitutions, and faults where they cannot be."""

from __future__ import annotations

import ast
import posixpath
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Union

from haros_ci.bounded_python.limits import weight
from haros_ci.model.environment import lost_of
from haros_ci.model.robot import Fault, Way
from haros_ci.robot.expressions import Invalid, Undefined, evaluate, is_open, parsed
from haros_ci.robot.functions import LIMITS, Function, Module, NotFollowed, TooMuch, tokenize
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.scopes import XacroGlobals, XacroScope
from haros_ci.robot.sources import FIND, HERE, DescriptionSources
from haros_ci.robot.texts import parts_of
from haros_ci.robot.unknown import UNKNOWN, UnknownValue
from haros_ci.robot.yaml_values import YamlDict, yaml_value

MAX_STEPS = 500_000
#: What each expansion has even if others have used up what all have together.
LEAST_STEPS = 2_000
MAX_TEXT = 20_000
MAX_FAULTS = 300
#: Faults for which names are looked for that may be meant.
MAX_SIMILAR = 50


#: Names that may be meant, or what finds them.
Similar = Union[tuple[str, ...], Callable[[], tuple[str, ...]]]


class Evaluating:
    """What an expansion has for evaluation: the file and the way that led there, arguments, and steps that are left."""

    def __init__(self, sources: DescriptionSources, path: str, arguments: dict[str, str | UnknownValue]) -> None:
        self.sources = sources
        self.path = path
        self.file = path
        self.way: Way = ()
        self.arguments = arguments
        self.faults: dict[tuple[object, ...], Fault] = {}
        self.steps = min(MAX_STEPS, max(sources.steps, LEAST_STEPS))
        self.takes_any = False
        self.environment: Mapping[str, str] = {}
        self.world = XacroGlobals(self.text, self._offers())
        self._loaded: dict[str, Any] = {}
        #: Whether what is read changes lists: each load of a file gives lists of its own then.
        self.changes_lists = False

    def spend(self, steps: int) -> None:
        """TooMuch once the steps are used up."""
        self.steps -= steps
        self.sources.steps -= steps
        if self.steps < 0:
            raise TooMuch

    def fault(self, kind: str, name: str, node: XmlNode, *, of: str = "", similar: Similar = ()) -> None:
        """Note what is wrong at *node*; certain only where nothing unknown leads there. *similar* may be looked for then."""
        at = node.location
        certain = self.world.maybe == 0 and node.certain
        key = (kind, name, at, of)
        known = self.faults.get(key)
        if (known is None or (certain and not known.certain)) and len(self.faults) < MAX_FAULTS:
            found = similar if isinstance(similar, tuple) else similar() if len(self.faults) < MAX_SIMILAR else ()
            self.faults[key] = Fault(
                kind=kind, name=name, location=at, certain=certain, of=of, similar=found, way=self.way
            )

    def words(self, text: str | UnknownValue, scope: XacroScope, node: XmlNode) -> str | UnknownValue:
        """*text* evaluated, as a text."""
        if isinstance(text, str) and "$" not in text:
            return text
        value = self.value(text, scope, node)
        if isinstance(value, (list, tuple, dict)):
            self.spend(weight(value, LIMITS) // 8)
        if is_open(value) or isinstance(value, (XacroScope, Function, Module)):
            return UNKNOWN
        found = str(value)
        self.spend(len(found) // 64)
        return found

    def value(self, text: str | UnknownValue, scope: XacroScope, node: XmlNode) -> Any:
        """*text* evaluated at *node*; UNKNOWN where it is not known, with a fault where that is why."""
        if isinstance(text, UnknownValue):
            return UNKNOWN
        try:
            return self.text(text, scope)
        except Undefined as err:
            if not self.world.is_open:
                place = next((place for place in err.places if place is not None), None)
                self.fault(err.kind, err.name, node if place is None else replace(node, location=place))
        except Invalid as err:
            self.fault("expression", str(err), node)
        return UNKNOWN

    def text(self, text: str, scope: XacroScope) -> Any:
        """xacro's eval_text: one part alone keeps its type, several are joined."""
        self.spend(1)
        if "$" not in text:
            return text
        parts = parts_of(text)
        if parts is None:
            raise Invalid(f"a brace is not closed in {text[:80]!r}")
        found = []
        for kind, content in parts:
            if kind == "expression":
                found.append(self._expression(content, scope))
            elif kind == "substitution":
                found.append(self._substitution(content, scope))
            else:
                found.append(content)
        if len(found) == 1:
            return found[0]
        if is_open(found) or any(isinstance(item, (XacroScope, Function, Module)) for item in found):
            return UNKNOWN
        joined = "".join(map(str, found))
        if len(joined) > MAX_TEXT:
            raise TooMuch
        return joined

    def _expression(self, content: str, scope: XacroScope) -> Any:
        written = self.text(content, scope)
        if isinstance(written, UnknownValue):
            return UNKNOWN
        return evaluate(str(written), scope, self.spend)

    def _substitution(self, content: str, scope: XacroScope) -> Any:
        """``$(…)``: find, arg, env, optenv, eval, cwd and dirname of xacro's substitution_args."""
        written = self.text(content, scope)
        if not isinstance(written, str):
            return UNKNOWN
        kind, *provided = written.split() or [""]
        if kind == "find" and len(provided) == 1:
            return f"{FIND}{provided[0]}"
        if kind == "arg" and len(provided) == 1:
            return self.argument_value(provided[0])
        if kind in ("env", "optenv") and provided:
            return self._variable(kind, provided[0], provided[1:])
        if kind == "dirname":
            return (HERE + posixpath.dirname(self.file)).rstrip("/")
        if kind == "eval":
            return self._eval(written[len("eval ") :])
        return UNKNOWN

    def _variable(self, kind: str, name: str, default: list[str]) -> Any:
        if name in self.environment:
            return self.environment[name]
        if kind == "env" or not default or name in lost_of(self.environment):
            return UNKNOWN  # what a user's environment has
        return " ".join(default)

    def argument_value(self, name: str) -> str | UnknownValue:
        if name in self.arguments:
            return self.arguments[name]
        if self.world.is_open or self.takes_any:
            return UNKNOWN
        raise Undefined("argument", name)

    def _eval(self, text: str) -> Any:
        """``$(eval …)``: names are arguments, whose numbers and truth values are such."""
        tree = parsed(text)
        if tree is None:
            return UNKNOWN
        names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        if any(isinstance(node, ast.Call) for node in ast.walk(tree)):
            return UNKNOWN
        scope = XacroScope(self.world)
        for name in names & self.arguments.keys():
            value = self.arguments[name]
            scope.put(name, value, lazy=False, location=None)
        for name in names - self.arguments.keys():
            scope.put(name, UNKNOWN, lazy=False, location=None)
        try:
            value = evaluate(text, scope, self.spend)
        except (Undefined, Invalid):
            return UNKNOWN
        return UNKNOWN if is_open(value) else str(value)

    def _offers(self) -> Module:
        """The namespace ``xacro`` of expressions."""
        quiet = Function("message", lambda *_, **__: "")
        return Module(
            load_yaml=Function("load_yaml", self._load_yaml),
            arg=Function("arg", self.argument_value),
            abs_filename=Function("abs_filename", self._abs_filename),
            dotify=Function("dotify", YamlDict),
            tokenize=Function("tokenize", tokenize),
            message=quiet,
            warning=quiet,
            error=quiet,
            print_location=quiet,
        )

    def _abs_filename(self, name: str) -> str:
        return name if name.startswith("/") else HERE + posixpath.join(posixpath.dirname(self.file), name)

    def _load_yaml(self, name: str) -> Any:
        located = self.sources.locate(name, self.file)
        if located.path is None:
            raise NotFollowed
        if located.path not in self._loaded or self.changes_lists:
            text = self.sources.text(located.path)
            self.spend(len(text) // 4)
            self._loaded[located.path] = yaml_value(text, self._number) if text else UNKNOWN
        return self._loaded[located.path]

    def _number(self, text: str) -> object:
        try:
            return evaluate(text, XacroScope(self.world), self.spend)
        except (Undefined, Invalid):
            return UNKNOWN
