# SPDX-License-Identifier: Apache-2.0
"""What a Python file binds and uses, scope by scope."""

from __future__ import annotations

import ast
from bisect import bisect_right
from collections.abc import Callable, Sequence
from typing import NamedTuple

from haros_ci.linters.bodies import FUNCTIONS, deletions, names_in, own_nodes, starts, sure_lines
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.constant_tests import cases, constants_of, is_empty, leaves, truth
from haros_ci.results.python_nodes import mentions

_COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_LOOPS = (ast.For, ast.AsyncFor)
#: What catches the error of a name without a value; and functions that a framework calls by their names.
_NAME_ERROR = regex(r"\b(?:NameError|UnboundLocalError|Exception|BaseException)\b")
_CALLED_BY_NAME = regex(r"__|main$|test|setup|teardown|setUp|tearDown|pytest|generate_|on_")
#: Why a binding does not count, in words.
DEAD = "it is bound only where nothing runs"
UNCALLED = "it is bound only in a function that nothing calls"
HANDLED, DECLARED = (
    "it is bound only by an except, which deletes it at its end",
    "it has a type, and is given no value",
)
LATER = "it is bound only behind it"
CALLED = "it is bound only behind a call of the function that uses it"


@dataclass(eq=False, slots=True)
class Scope:
    """A module, class, function or comprehension; *name* is that of the function, "" for others."""

    kind: str
    parent: Scope | None
    name: str = ""
    line: int = 0
    #: Lines at which a name is bound, with "" or why that does not count.
    bound: dict[str, list[tuple[int, str]]] = field(default_factory=dict)
    deleted: dict[str, int] = field(default_factory=dict)
    outer: dict[str, str] = field(default_factory=dict)
    #: The first lines of the statements that a module or function is made of, in their order.
    starts: tuple[int, ...] = ()
    #: Those of a function that run whenever it is called.
    sure: frozenset[int] = frozenset()
    _summaries: dict[str, tuple[int, int, frozenset[str]]] = field(default_factory=dict)

    def start(self, line: int) -> int:
        """The first line of its own statement around *line*; 0 if that is none of its body."""
        at = bisect_right(self.starts, line)
        return self.starts[at - 1] if at else 0

    def bind(self, name: str, line: int, why: str) -> None:
        self.bound.setdefault(name, []).append((line, why))

    def summary(self, name: str) -> tuple[int, int, frozenset[str]]:
        """The first line that binds *name*, the last one that counts (0: none), and why others do not; asked when all is read."""
        if name not in self._summaries:
            lines = self.bound[name]
            last = max((line for line, why in lines if not why), default=0)
            self._summaries[name] = (min(lines)[0], last, frozenset(why for _, why in lines if why))
        return self._summaries[name]


class Use(NamedTuple):
    """A *name* that is read in a *scope*."""

    name: str
    line: int
    scope: Scope


class _Place(NamedTuple):
    """What surrounds a node: whether it is never run, whether a ``NameError`` is awaited, and the names that handlers around it bind."""

    scope: Scope
    is_dead: bool = False
    handled: frozenset[str] = frozenset()


class Names:
    """What the file binds and uses, scope by scope."""

    def __init__(self, every: Sequence[ast.AST], is_late: bool, is_called: Callable[[str], bool]) -> None:
        self.constants = constants_of(every)
        self.is_late = is_late
        self.is_called = is_called
        self.uses: list[Use] = []
        self.first_uses: dict[str, int] = {}
        self.calls: dict[str, list[Use]] = {}
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
        self._outermost |= deletions(tree.body)
        self.module.starts = starts(tree.body)
        self._block(tree.body, _Place(self.module))
        while self._todo:
            self._node(*self._todo.pop())
        for use in self.uses:
            self.first_uses[use.name] = min(use.line, self.first_uses.get(use.name, use.line))
        for scope, name, line, why in self._global:
            owner = self.module if scope.outer[name] == "global" else self._around(scope, name)
            if owner is not None:
                owner.bind(name, line, why or self._uncalled(scope, owner))

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
                    return UNCALLED
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
        why = DEAD if place.is_dead else "" if why == ":=" else why
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
                self.uses.append(Use(node.id, node.lineno, scope))
        elif isinstance(node, ast.alias):
            if node.name != "*":
                self._bind((node.asname or node.name).partition(".")[0], node.lineno, place)
        elif isinstance(node, (*FUNCTIONS, ast.ClassDef)):
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
        elif isinstance(node, ast.Match):
            self._todo.append((node.subject, place))
            for case, is_run in cases(node, self.constants):
                self._children(case, place if is_run else place._replace(is_dead=True))
        elif isinstance(node, ast.MatchAs | ast.MatchStar | ast.MatchMapping):
            name = node.rest if isinstance(node, ast.MatchMapping) else node.name
            if name:
                self._bind(name, node.lineno, place)
            self._children(node, place)
        else:
            if isinstance(node, ast.Call):
                self._called(node, place)
            self._children(node, place)

    def _called(self, node: ast.Call, place: _Place) -> None:
        if isinstance(node.func, ast.Name) and not place.is_dead and node.func.id not in place.handled:
            self.calls.setdefault(node.func.id, []).append(Use(node.func.id, node.lineno, place.scope))

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
        if not isinstance(node, FUNCTIONS):
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
        for other in own_nodes(node.body):
            if isinstance(other, ast.Global | ast.Nonlocal):
                inner.outer.update(dict.fromkeys(other.names, type(other).__name__.lower()))
        if node.decorator_list:
            inner.name = ""
        self._bind(name, node.lineno, place)
        annotations = [] if self.is_late else [one.annotation for one in every] + [node.returns]
        self._todo += [(one, place) for one in (*node.decorator_list, *annotations) if one is not None]
        self._outermost |= deletions(node.body)
        inner.starts = starts(node.body)
        inner.sure = sure_lines(node)
        self._block(node.body, body)

    def _attempt(self, node: ast.Try, place: _Place) -> None:
        is_harmless = all(
            isinstance(one, ast.Pass) or (isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant))
            for one in node.body
        )
        is_awaited = any(one.type is None or mentions(one.type, _NAME_ERROR) for one in node.handlers)
        inside = place.handled | names_in(node.body) if is_awaited else place.handled
        self._block(node.body, place._replace(handled=inside))
        for handler in node.handlers:
            here = place._replace(is_dead=place.is_dead or is_harmless)
            if handler.type is not None:
                self._todo.append((handler.type, here))
            if handler.name:
                self._bind(handler.name, handler.lineno, here, HANDLED)
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
            self._bind(node.target.id, node.lineno, place, DECLARED)

    def _deleted(self, node: ast.Delete, place: _Place) -> None:
        targets = list(node.targets)
        for target in targets:
            if isinstance(target, ast.Tuple | ast.List):
                targets += target.elts
            elif not isinstance(target, ast.Name):
                self._todo.append((target, place))
            elif id(node) in self._outermost and not place.is_dead:
                place.scope.deleted[target.id] = max(node.lineno, place.scope.deleted.get(target.id, 0))
