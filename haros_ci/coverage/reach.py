# SPDX-License-Identifier: Apache-2.0
"""Which functions anything in the workspace may run, by the names that code mentions: more than run, never less.

A function counts as run if code that runs mentions its name and, for a method, its class. It begins with programs, with the classes
that nodes of the model are made of, and with all code in which the model has seen an endpoint. What is left is run by nothing here.
C++ mentions what is C++ and Python what is Python: bindings name in their own C++ what they hand over.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Set

from haros_ci import syntax
from haros_ci.code.classes import base_names, class_named
from haros_ci.code.codebase import Codebase
from haros_ci.coverage.pieces import Piece, last_name
from haros_ci.records import dataclass, field

#: The bases that call no method but those that are theirs.
_NODES = frozenset(
    "rclcpp::Node rclcpp_lifecycle::LifecycleNode nodelet::Nodelet rclpy.node.Node rclpy.Node object".split()
)
#: How names of methods begin that nodes and components call by themselves.
_CALLED = ("on_", "onInit", "operator", "__")


@dataclass(slots=True)
class Half:
    """The code of one language: the pieces that run of it; *classes* has the last parts of the names of those of the workspace."""

    bases: Mapping[str, frozenset[str]]
    #: The methods, by class and name, that a base which is not seen may call.
    framework: frozenset[tuple[str, str]]
    by_name: dict[str, list[Piece]] = field(default_factory=lambda: defaultdict(list))
    by_class: dict[str, list[Piece]] = field(default_factory=lambda: defaultdict(list))
    running: set[Piece] = field(default_factory=set)
    made: set[str] = field(default_factory=set)
    mentioned: set[str] = field(default_factory=set)

    def is_free(self, piece: Piece) -> bool:
        """Whether it is of no class of the workspace."""
        return piece.owner not in self.bases

    def start(self, pieces: Iterable[Piece], names: Iterable[str]) -> None:
        """Let run *pieces*, and whatever is called one of *names*; and what these lead to."""
        waiting = [*pieces]
        for name in names:
            self._mention(name, waiting)
        while waiting:
            piece = waiting.pop()
            if piece in self.running:
                continue
            self.running.add(piece)
            if piece.owner:
                self._make(piece.owner, waiting)
            for word in piece.words - self.mentioned:
                self._mention(word, waiting)

    def _mention(self, word: str, waiting: list[Piece]) -> None:
        self.mentioned.add(word)
        self._make(word, waiting)
        for piece in self.by_name.get(word, ()):
            if self.is_free(piece) or piece.owner in self.made:
                waiting.append(piece)

    def _make(self, name: str, waiting: list[Piece]) -> None:
        """An object of a class is made: its bases are, too, and what runs by itself or is mentioned already."""
        names = [name]
        while names:
            name = names.pop()
            if name not in self.bases or name in self.made:
                continue
            self.made.add(name)
            names += self.bases.get(name, ())
            waiting += [
                piece for piece in self.by_class.get(name, ()) if piece.name in self.mentioned or self._is_alone(piece)
            ]

    def _is_alone(self, piece: Piece) -> bool:
        """Whether a method runs when its class is made: constructors, operators, and what bases may call."""
        if piece.function is None or piece.name.lstrip("~") == piece.owner or piece.name.startswith(_CALLED):
            return True
        return (piece.owner, piece.name) in self.framework


@dataclass(slots=True)
class Reach:
    """What runs of C++ and of Python."""

    halves: Mapping[bool, Half]

    @property
    def classes(self) -> frozenset[str]:
        """The last parts of the names of the workspace's classes."""
        return frozenset(name for half in self.halves.values() for name in half.bases)

    def half(self, piece: Piece) -> Half:
        """The code of a piece's language."""
        return self.halves[piece.is_python]

    def start(self, pieces: Iterable[Piece], names: Iterable[str]) -> None:
        """Let run *pieces*, and whatever is called one of *names* in either language; and what these lead to."""
        every, roots = list(pieces), list(names)
        for is_python, half in self.halves.items():
            half.start([piece for piece in every if piece.is_python == is_python], roots)

    def runs(self, piece: Piece) -> bool:
        """Whether anything may run a piece."""
        return piece in self.half(piece).running

    def bases(self, name: str) -> frozenset[str]:
        """The last parts of the names of the bases of the classes of that name."""
        return frozenset[str]().union(*(half.bases.get(name, ()) for half in self.halves.values()))


def reach_of(code: Codebase, pieces: dict[str, list[Piece]], modules: frozenset[str]) -> Reach:
    """What runs of the *pieces* of files that are built or started, to begin with the programs.

    *modules* are the Python files that run when something imports them.
    """
    found = Reach({is_python: Half(*_hierarchy(code, is_python)) for is_python in (False, True)})
    found.start(_filed(found, pieces, modules), ())
    return found


def _hierarchy(code: Codebase, is_python: bool) -> tuple[dict[str, frozenset[str]], frozenset[tuple[str, str]]]:
    """The bases of each class of one language, by last parts of names, and the methods that a base which is not seen may call."""
    classes: dict[str, set[str]] = {}
    unseen: set[str] = set()
    sources = [source for source in code.sources if (source.separator == ".") == is_python]
    for source in sources:
        for definition in source.program.classes:
            last = last_name(definition.name)
            classes.setdefault(last, set()).update(last_name(base.name) for base in definition.bases)
            names = base_names(code, (source, definition)) - _NODES
            if any(class_named(code, name, source) is None for name in names):
                unseen.add(last)
    framework = frozenset(
        (last_name(function.owner), last_name(function.name))
        for source in sources
        for function in source.program.functions
        if last_name(function.owner) in unseen
    )
    return {name: frozenset(found) for name, found in classes.items()}, framework


def _filed(found: Reach, pieces: Mapping[str, list[Piece]], modules: frozenset[str]) -> list[Piece]:
    """Enter all *pieces* by the names that make them run; what is returned runs by itself: programs."""
    roots = []
    own = {piece.name for every in pieces.values() for piece in every if piece.is_python and piece.function is not None}
    for path, every in pieces.items():
        for piece in every:
            half = found.half(piece)
            if piece.function is None and piece.definition is None:
                if path in modules:
                    half.by_name[stem(path)].append(piece)
                else:
                    roots.append(piece)
            elif piece.name == "main" and not piece.owner:
                roots.append(piece)
            else:
                if piece.function is not None:
                    half.by_name[piece.name].append(piece)
                if _is_given(piece, own):
                    half.by_name[stem(path)].append(piece)
                    roots += [piece] if path not in modules else []
                if not half.is_free(piece):
                    half.by_class[piece.owner].append(piece)
    return roots


def _is_given(piece: Piece, own: Set[str]) -> bool:
    """Whether a decorator, one of the functions *own*, is given the function when its file is run, and may call it there and then."""
    decorators = piece.function.decorators if piece.function is not None and piece.is_python else ()
    callees = (one.callee if isinstance(one, syntax.Call) else one for one in decorators)
    return any(last_name(syntax.name_of(callee)) in own for callee in callees)


def stem(path: str) -> str:
    """The name by which a Python module is imported: of a package, that of its directory."""
    head, _, name = path.removesuffix(".py").rpartition("/")
    return name if name != "__init__" else head.rpartition("/")[2]
