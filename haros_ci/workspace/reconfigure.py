# SPDX-License-Identifier: Apache-2.0
"""dynamic_reconfigure's .cfg: the parameters that its ParameterGenerator calls declare, read, never run."""

from __future__ import annotations

import ast
from typing import Any

from haros_ci.model.build import ConfigFile, ConfigParameter
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.workspace.python_values import MISSING, dotted, parse_python, value_of

MAX_PARAMETERS = 2_000
MAX_STEPS = 20_000
MAX_DEPTH = 20
_MISSED = "later parameters are missing"

#: Names of parameter_generator_catkin, and the keywords of ``add`` in their order.
_TYPES = {"bool_t": "bool", "int_t": "int", "double_t": "double", "str_t": "str"}
_METHODS = ("add", "add_group", "generate")
_GENERATORS = ("ParameterGenerator", "SensorLevels")
_ADD = ("name", "paramtype", "level", "description", "default", "min", "max", "edit_method")


def read_config(path: str, text: str, package: str) -> tuple[ConfigFile | None, list[Problem]]:
    """The configuration that *text* generates, None if it generates none; what is not understood is a problem."""
    module = parse_python(text)
    if isinstance(module, str):
        return None, [Problem(path, f"not Python that can be read ({module}); its parameters are missing")]
    reader = _CfgReader(path)
    try:
        reader.body(module.body, 0)
    except _CfgTooLarge:
        reader.problems.append(Problem(path, f"too long to follow; {_MISSED}"))
    except RecursionError:
        reader.problems.append(Problem(path, f"nested too deeply to follow; {_MISSED}"))
    if reader.name is None:
        if reader.parameters or reader.generators:
            message = "no generate(package, node, name) with a literal name; the file is left out"
            reader.problems.append(Problem(path, message))
        return None, reader.problems
    return ConfigFile(
        name=reader.name, package=package, path=path, parameters=tuple(reader.parameters)
    ), reader.problems


class _CfgTooLarge(Exception):
    pass


@dataclass(frozen=True, slots=True)
class _Inside:
    """Of a statement: how many nodes, whether parameters are declared or a loop is left in it, what it assigns."""

    size: int
    declares: bool
    leaves: bool
    stores: tuple[str, ...]


class _CfgReader:
    """Follows the statements of the file in order; ``generators`` maps variables to their group."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.names: dict[str, Any] = dict(_TYPES)
        self.generators: dict[str, str] = {}
        self.parameters: list[ConfigParameter] = []
        self.problems: list[Problem] = []
        self.name: str | None = None
        self.steps = 0
        self.seen: dict[int, _Inside] = {}

    def problem(self, node: ast.stmt | ast.expr, message: str) -> None:
        found = Problem(self.path, message, node.lineno)
        if found not in self.problems and len(self.problems) < 50:
            self.problems.append(found)

    def body(self, statements: list[ast.stmt], depth: int) -> None:
        for statement in statements:
            self.steps += 1 + self.look(statement).size // 20
            if self.steps > MAX_STEPS:
                raise _CfgTooLarge
            self.statement(statement, depth)

    def statement(self, node: ast.stmt, depth: int) -> None:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            self.imported(node)
        elif isinstance(node, ast.Assign):
            self.assign(node.targets, node.value)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            self.assign([node.target], node.value)
        elif isinstance(node, ast.AugAssign):
            self.forget(node)
        elif isinstance(node, ast.Expr):
            self.expression(node.value)
        elif isinstance(node, ast.For):
            self.loop(node, depth)
        elif isinstance(node, ast.If) and _is_main(node.test):
            self.body(node.body, depth + 1)
        elif isinstance(node, (ast.FunctionDef, ast.If, ast.While, ast.Try, ast.With)):
            if self.look(node).declares:
                self.problem(node, "parameters declared under a condition or in a function are not followed")
            if not isinstance(node, ast.FunctionDef):
                self.forget(node)

    def imported(self, node: ast.Import | ast.ImportFrom) -> None:
        """``import dynamic_reconfigure.parameter_generator_catkin as g``: the types are ``g.double_t`` and so on."""
        for alias in node.names:
            bound = alias.asname or alias.name
            if alias.name in _TYPES:
                self.names[bound] = _TYPES[alias.name]
            self.names.update({f"{bound}.{name}": kind for name, kind in _TYPES.items()})

    def look(self, node: ast.stmt) -> _Inside:
        """What is in a statement; looked up once, as loops come back to it."""
        seen = self.seen.get(id(node))
        if seen is None:
            inner = list(ast.walk(node))
            seen = self.seen[id(node)] = _Inside(
                size=len(inner),
                declares=any(isinstance(n, ast.Attribute) and n.attr in _METHODS for n in inner),
                leaves=any(isinstance(n, (ast.Break, ast.Continue)) for n in inner),
                stores=tuple({n.id: None for n in inner if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}),
            )
        return seen

    def forget(self, node: ast.stmt) -> None:
        """Names assigned in what is not followed have no known value any more."""
        self.names.update(dict.fromkeys(self.look(node).stores, MISSING))

    def assign(self, targets: list[ast.expr], value: ast.expr) -> None:
        if isinstance(value, ast.Call):
            made = self.call(value)
        else:
            made = value_of(value, self.names)
            if isinstance(value, ast.Name) and value.id in self.generators:
                made = _Generator(self.generators[value.id])
        for target in targets:
            name = dotted(target)
            if isinstance(target, (ast.Tuple, ast.List)) and isinstance(made, list) and len(made) == len(target.elts):
                for part, item in zip(target.elts, made, strict=True):
                    self.names[dotted(part)] = item
            elif isinstance(made, _Generator) and name:
                self.generators[name] = made.group
            elif name:
                self.generators.pop(name, None)
                self.names[name] = made

    def expression(self, node: ast.expr) -> None:
        if isinstance(node, ast.Call):
            if dotted(node.func) in ("exit", "sys.exit"):
                for argument in node.args:
                    self.expression(argument)
            else:
                self.call(node)

    def call(self, node: ast.Call) -> Any:
        """What a call gives: a generator, a constant, or MISSING; ``add`` and ``generate`` are noted."""
        func = node.func
        if dotted(func).rpartition(".")[2] in _GENERATORS:
            return _Generator("")
        if not isinstance(func, ast.Attribute):
            return value_of(node, self.names)
        owner = self.owner(func.value)
        if owner is None:
            return value_of(node, self.names)
        if func.attr == "add":
            self.add(node, owner)
        elif func.attr == "add_group":
            name = self.argument(node, 0, "name")
            if not isinstance(name, str):
                self.problem(node, "the group's name is not a literal; its parameters are listed without it")
                return _Generator(owner)
            return _Generator(f"{owner}.{name}" if owner else name)
        elif func.attr == "const":
            value = self.argument(node, 2, "value")
            return {"name": self.argument(node, 0, "name"), "value": None if value is MISSING else value}
        elif func.attr == "generate":
            name = self.argument(node, 2, "name")
            if isinstance(name, str) and self.name is None:
                self.name = name
        return MISSING

    def owner(self, node: ast.expr) -> str | None:
        """The group of a generator that stands before a dot; None otherwise."""
        if isinstance(node, ast.Call):
            made = self.call(node)
            return made.group if isinstance(made, _Generator) else None
        return self.generators.get(dotted(node))

    def argument(self, node: ast.Call, position: int, keyword: str) -> Any:
        for argument in node.keywords:
            if argument.arg == keyword:
                return value_of(argument.value, self.names)
        return value_of(node.args[position], self.names) if position < len(node.args) else MISSING

    def add(self, node: ast.Call, group: str) -> None:
        if len(self.parameters) >= MAX_PARAMETERS:
            raise _CfgTooLarge
        if any(isinstance(a, ast.Starred) for a in node.args) or any(k.arg is None for k in node.keywords):
            self.problem(node, "arguments unpacked with * or ** are not followed; the parameter is missing")
            return
        values = {word: self.argument(node, place, word) for place, word in enumerate(_ADD)}
        name, kind = values["name"], values["paramtype"]
        if not isinstance(name, str) or not name:
            self.problem(node, "the parameter's name is not known before it runs; it is missing")
            return
        if kind not in _TYPES.values():
            self.problem(node, f"the type of {name!r} is not bool_t, int_t, double_t or str_t; it is missing")
            return
        default, low, high = (_scalar(values[word]) for word in ("default", "min", "max"))
        where = Location(self.path, node.lineno, node.col_offset + 1)
        made = ConfigParameter(
            name=name, type=kind, default=default, minimum=low, maximum=high, location=where, group=group
        )
        self.parameters.append(made)

    def loop(self, node: ast.For, depth: int) -> None:
        """A loop over literal values; any other is not followed."""
        items = _items(node.iter, self.names)
        if depth >= MAX_DEPTH or items is None or self.look(node).leaves:
            if self.look(node).declares:
                self.problem(node, "parameters declared in this loop are not known before it runs; they are missing")
            self.forget(node)
            return
        for item in items:
            self.bind(node.target, item)
            self.body(node.body, depth + 1)

    def bind(self, target: ast.expr, item: Any) -> None:
        if isinstance(target, (ast.Tuple, ast.List)):
            parts = item if isinstance(item, list) and len(item) == len(target.elts) else [MISSING] * len(target.elts)
            for inner, part in zip(target.elts, parts, strict=True):
                self.names[dotted(inner)] = part
        else:
            self.names[dotted(target)] = item


class _Generator:
    """A ParameterGenerator, or a group of one."""

    def __init__(self, group: str) -> None:
        self.group = group


def _scalar(value: Any) -> Any:
    return value if isinstance(value, (bool, int, float, str)) else None


def _is_main(test: ast.expr) -> bool:
    return isinstance(test, ast.Compare) and dotted(test.left) == "__name__"


def _items(node: ast.expr, names: dict[str, Any]) -> list[Any] | None:
    """The values that a loop goes through: of a list, of range() or enumerate() of such."""
    if isinstance(node, ast.Call) and not node.keywords:
        arguments = [value_of(argument, names) for argument in node.args]
        name = dotted(node.func)
        if name in ("range", "xrange") and 1 <= len(arguments) <= 3 and all(type(a) is int for a in arguments):
            try:
                return list(range(*arguments)[:MAX_PARAMETERS])
            except ValueError:
                return None
        if name == "enumerate" and len(arguments) == 1 and isinstance(arguments[0], list):
            return [[number, item] for number, item in enumerate(arguments[0])]
        return None
    value = value_of(node, names)
    return value if isinstance(value, list) else None
