# SPDX-License-Identifier: Apache-2.0
"""Names of Python that are bound somewhere in their scope, but never when the code runs that uses them: pylint and ruff take them for defined."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from haros_ci.linters.bindings import Scope
from haros_ci.linters.constant_tests import constants_of, is_empty, leaves, truth
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex

#: What may bind any name of a module: then nothing is said of its names.
_MAKES = regex(r"\b(?:globals|vars|locals)\(\)[ \t]*[\[.]|(?<![\w.])exec(?:file)?[ \t]*\(|\bimport[ \t]*\(?[ \t]*\*")
#: Longer files are not looked at.
MAX_TEXT = 300_000
_LATE = regex(r"^from __future__ import [^\n]*\bannotations\b", re.M)
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_LOOPS = (ast.For, ast.AsyncFor)
_OF_MODULES = frozenset({*dir(builtins), "__file__", "__path__", "__builtins__", "__annotations__"})
#: What catches the error of such a name; and functions that a framework calls by their names.
_NAME_ERROR = regex(r"\b(?:NameError|UnboundLocalError|Exception|BaseException)\b")
_CALLED_BY_NAME = regex(r"__|main$|test|setup|teardown|setUp|tearDown|pytest|generate_|on_")
#: Why a name has no value, in words.
_DEAD, _DELETED = "it is bound only where nothing runs", "it is deleted before"
_UNCALLED = "it is bound only in a function that nothing calls"
_HANDLED, _DECLARED = (
    "it is bound only by an except, which deletes it at its end",
    "it has a type, and is given no value",
)


class NeverBound(NamedTuple):
    """A *name* that has no value at *line*, where it is used, and *why*; the binding that it has is at *bound*."""

    name: str
    line: int
    why: str
    bound: int


class _Use(NamedTuple):
    name: str
    line: int
    scope: Scope


class _Place(NamedTuple):
    """What surrounds a node: whether it is never run, whether a ``NameError`` is awaited, and the names that handlers around it bind."""

    scope: Scope
    is_dead: bool = False
    handled: frozenset[str] = frozenset()


def never_bound(text: str, is_called: Callable[[str], bool] = lambda name: True) -> Iterator[NeverBound]:
    """Each such name of a file, where it is used first; *is_called* tells of a function whether other files have its name."""
    if len(text) > MAX_TEXT or _MAKES.search(text) is not None:
        return
    every = nodes(text)
    if not every or not isinstance(every[0], ast.Module):
        return
    names = _Names(every, is_late=_LATE.search(text) is not None, is_called=is_called)
    names.read(every[0])
    seen = set()
    for use in sorted(names.uses, key=lambda one: (one.line, one.name)):
        found = names.judged(use)
        if found is not None and (found.name, found.why) not in seen:
            seen.add((found.name, found.why))
            yield found


class _Names:
    """What the file binds and uses, scope by scope."""

    def __init__(self, every: Sequence[ast.AST], is_late: bool, is_called: Callable[[str], bool]) -> None:
        self.constants = constants_of(every)
        self.is_late = is_late
        self.is_called = is_called
        self.uses: list[_Use] = []
        self.first_uses: dict[str, int] = {}
        self.mentioned = {node.id for node in every if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
        self.mentioned |= {node.attr for node in every if isinstance(node, ast.Attribute)}
        self.mentioned |= {
            node.value for node in every if isinstance(node, ast.Constant) and isinstance(node.value, str)
        }
        self.module = Scope("module", None)
        self._todo: list[tuple[ast.AST, _Place]] = []
        self._outermost: set[int] = set()
        self._global: list[tuple[Scope, str, int, str]] = []

    def read(self, tree: ast.Module) -> None:
        self._outermost |= _deletions(tree.body)
        self._block(tree.body, _Place(self.module))
        while self._todo:
            self._node(*self._todo.pop())
        for use in self.uses:
            self.first_uses[use.name] = min(use.line, self.first_uses.get(use.name, use.line))
        for scope, name, line, why in self._global:
            owner = self.module if scope.outer[name] == "global" else self._around(scope, name)
            if owner is not None:
                owner.bind(name, line, why or self._uncalled(scope, owner))

    def judged(self, use: _Use) -> NeverBound | None:
        """Why the name has no value there; None if it may have one."""
        scope = self._owner(use)
        if scope is None or scope.kind not in ("module", "function"):
            return None
        if scope is self.module and use.name in _OF_MODULES:
            return None
        first, last, whys = scope.summary(use.name)
        if not last:
            why = next((one for one in (_UNCALLED, _HANDLED, _DEAD, _DECLARED) if one in whys), _DEAD)
            return None if whys == {_DECLARED} and scope is self.module else NeverBound(use.name, use.line, why, first)
        at = scope.deleted.get(use.name, 0)
        if last <= at and self._is_behind(use, scope, at):
            return NeverBound(use.name, use.line, _DELETED, at)
        return None

    def _is_behind(self, use: _Use, scope: Scope, at: int) -> bool:
        """Whether the code of *use* runs after *at*, a line of *scope*: behind it, or in a function that nothing calls before."""
        inner: Scope | None = use.scope
        while inner is not None and inner.parent is not scope and inner is not scope:
            inner = inner.parent
        if inner is None or inner is scope or inner.kind != "function":
            return use.line > at
        if inner.line > at:
            return True
        return inner.name not in scope.deleted and self.first_uses.get(inner.name, at + 1) > at

    def _owner(self, use: _Use) -> Scope | None:
        """The scope whose name that is, by the rules of Python; None for a built-in or unknown one."""
        scope: Scope | None = use.scope
        is_first = True
        while scope is not None:
            if use.name in scope.outer:
                return self.module if scope.outer[use.name] == "global" and use.name in self.module.bound else None
            if use.name in scope.bound and (scope.kind != "class" or is_first):
                return scope
            is_first = is_first and scope.kind == "comprehension"
            scope = scope.parent
        return None

    def _around(self, scope: Scope, name: str) -> Scope | None:
        """The function around *scope* that binds *name*."""
        outer = scope.parent
        while outer is not None and not (outer.kind == "function" and name in outer.bound):
            outer = outer.parent
        return outer

    def _uncalled(self, scope: Scope, owner: Scope) -> str:
        """Why what that function binds outside of it, in *owner*, does not count."""
        function: Scope | None = scope
        while function is not None and function is not owner:
            is_method = function.parent is not None and function.parent.kind == "class"
            if function.name and not is_method and _CALLED_BY_NAME.match(function.name) is None:
                if function.name not in self.mentioned and not self.is_called(function.name):
                    return _UNCALLED
            function = function.parent
        return ""

    def _block(self, block: list[ast.stmt], place: _Place) -> None:
        for statement in block:
            self._todo.append((statement, place))
            if not place.is_dead and leaves(statement, self.constants):
                place = place._replace(is_dead=True)

    def _bind(self, name: str, line: int, place: _Place, why: str = "") -> None:
        scope = place.scope
        while scope.kind == "comprehension" and scope.parent is not None and why == ":=":
            scope = scope.parent
        why = _DEAD if place.is_dead else "" if why == ":=" else why
        if name in scope.outer:
            self._global.append((scope, name, line, why))
        else:
            scope.bind(name, line, why)

    def _node(self, node: ast.AST, place: _Place) -> None:  # noqa: C901 - a branch for each kind of node
        scope = place.scope
        if isinstance(node, ast.Name):
            if isinstance(node.ctx, ast.Store):
                self._bind(node.id, node.lineno, place)
            elif isinstance(node.ctx, ast.Load) and not place.is_dead and node.id not in place.handled:
                self.uses.append(_Use(node.id, node.lineno, scope))
        elif isinstance(node, ast.alias):
            if node.name != "*":
                self._bind((node.asname or node.name).partition(".")[0], node.lineno, place)
        elif isinstance(node, (*_FUNCTIONS, ast.ClassDef)):
            self._inner(node, place)
        elif isinstance(node, _COMPREHENSIONS):
            inner = Scope("comprehension", scope)
            self._children(node, place._replace(scope=inner))
        elif isinstance(node, ast.NamedExpr):
            self._bind(node.target.id, node.lineno, place, ":=")
            self._todo.append((node.value, place))
        elif isinstance(node, ast.If | ast.IfExp | ast.While):
            self._todo.append((node.test, place))
            known = truth(node.test, self.constants)
            self._branch(node.body, place, known is False)
            self._branch(node.orelse, place, known is True)
        elif isinstance(node, ast.BoolOp):
            for value in node.values:
                self._todo.append((value, place))
                if truth(value, self.constants) is isinstance(node.op, ast.Or):
                    place = place._replace(is_dead=True)
        elif isinstance(node, _LOOPS):
            self._todo.append((node.iter, place))
            self._todo.append((node.target, place))
            self._branch(node.body, place, is_empty(node.iter, self.constants))
            self._block(node.orelse, place)
        elif isinstance(node, ast.Try) or type(node).__name__ == "TryStar":
            self._attempt(node, place)  # type: ignore[arg-type]  # TryStar has the same parts, from Python 3.11 on
        elif isinstance(node, ast.AnnAssign):
            self._declared(node, place)
        elif isinstance(node, ast.Delete):
            self._deleted(node, place)
        elif isinstance(node, ast.MatchAs | ast.MatchStar | ast.MatchMapping):
            name = node.rest if isinstance(node, ast.MatchMapping) else node.name
            if name:
                self._bind(name, node.lineno, place)
            self._children(node, place)
        else:
            self._children(node, place)

    def _children(self, node: ast.AST, place: _Place) -> None:
        for _, value in ast.iter_fields(node):
            if isinstance(value, list) and value and isinstance(value[0], ast.stmt):
                self._block(value, place)
            else:
                parts = value if isinstance(value, list) else [value]
                self._todo += [(part, place) for part in parts if isinstance(part, ast.AST)]

    def _branch(self, part: list[ast.stmt] | ast.expr, place: _Place, is_dead: bool) -> None:
        place = place._replace(is_dead=True) if is_dead else place
        if isinstance(part, list):
            self._block(part, place)
        else:
            self._todo.append((part, place))

    def _inner(self, node: ast.AST, place: _Place) -> None:
        """A function or class: its name, what is evaluated around it, and its body in a scope of its own."""
        if isinstance(node, ast.ClassDef):
            self._bind(node.name, node.lineno, place)
            self._todo += [(one, place) for one in (*node.bases, *node.keywords, *node.decorator_list)]
            self._block(node.body, place._replace(scope=Scope("class", place.scope, "", node.lineno)))
            return
        if not isinstance(node, _FUNCTIONS):
            return
        name = "" if isinstance(node, ast.Lambda) else node.name
        inner = Scope("function", place.scope, name, node.lineno)
        arguments = node.args
        every = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
        every += [one for one in (arguments.vararg, arguments.kwarg) if one is not None]
        for one in every:
            inner.bind(one.arg, node.lineno, "")
        self._todo += [(one, place) for one in (*arguments.defaults, *arguments.kw_defaults) if one is not None]
        body = place._replace(scope=inner)
        if isinstance(node, ast.Lambda):
            self._todo.append((node.body, body))
            return
        for other in _own_nodes(node.body):
            if isinstance(other, ast.Global | ast.Nonlocal):
                inner.outer.update(dict.fromkeys(other.names, type(other).__name__.lower()))
        if node.decorator_list:
            inner.name = ""
        self._bind(name, node.lineno, place)
        annotations = [] if self.is_late else [one.annotation for one in every] + [node.returns]
        self._todo += [(one, place) for one in (*node.decorator_list, *annotations) if one is not None]
        self._outermost |= _deletions(node.body)
        self._block(node.body, body)

    def _attempt(self, node: ast.Try, place: _Place) -> None:
        is_harmless = all(
            isinstance(one, ast.Pass) or (isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant))
            for one in node.body
        )
        is_awaited = any(one.type is None or _NAME_ERROR.search(ast.unparse(one.type)) for one in node.handlers)
        inside = place.handled | _names(node.body) if is_awaited else place.handled
        self._block(node.body, place._replace(handled=inside))
        for handler in node.handlers:
            here = place._replace(is_dead=place.is_dead or is_harmless)
            if handler.type is not None:
                self._todo.append((handler.type, here))
            if handler.name:
                self._bind(handler.name, handler.lineno, here, _HANDLED)
                here = here._replace(handled=here.handled | {handler.name})
            self._block(handler.body, here)
        self._block(node.orelse, place)
        self._block(node.finalbody, place)

    def _declared(self, node: ast.AnnAssign, place: _Place) -> None:
        if place.scope.kind != "function" and not self.is_late:
            self._todo.append((node.annotation, place))
        if node.value is not None:
            self._todo += [(node.value, place), (node.target, place)]
        elif isinstance(node.target, ast.Name) and place.scope.kind != "class":
            self._bind(node.target.id, node.lineno, place, _DECLARED)

    def _deleted(self, node: ast.Delete, place: _Place) -> None:
        for target in node.targets:
            if not isinstance(target, ast.Name):
                self._todo.append((target, place))
            elif id(node) in self._outermost and not place.is_dead:
                place.scope.deleted[target.id] = max(node.lineno, place.scope.deleted.get(target.id, 0))


def _deletions(body: list[ast.stmt]) -> set[int]:
    """Those among the outermost statements of a module or function: no branch or loop decides on them."""
    return {id(one) for one in body if isinstance(one, ast.Delete)}


def _own_nodes(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """All that a function is made of, but for what its inner functions and classes are."""
    todo: list[ast.AST] = list(body)
    while todo:
        node = todo.pop()
        yield node
        if not isinstance(node, (*_FUNCTIONS, ast.ClassDef)):
            todo += ast.iter_child_nodes(node)


def _names(body: list[ast.stmt]) -> frozenset[str]:
    return frozenset(node.id for one in body for node in ast.walk(one) if isinstance(node, ast.Name))
