# SPDX-License-Identifier: Apache-2.0
"""Metrics of classes over the whole workspace: Chidamber and Kemerer's (IEEE TSE 20(6), 1994) and the methods available.

Every count is a lower bound where the workspace is incomplete: a base class outside of it counts as one level, which it has at
least; a name of no class of the workspace is no coupling.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.code.classes import Owner, class_named, dotted_name, resolved
from haros_ci.code.codebase import Codebase
from haros_ci.index.index import Source
from haros_ci.measuring.facts import ClassFacts, FileFacts, FunctionFacts
from haros_ci.records import dataclass, field
from haros_ci.syntax import Type

NOWHERE: frozenset[str] = frozenset()
#: What types end in that stand for a class under another name (rclcpp/macros.hpp; element_type and type of the standard library).
ENDS = ("Ptr", "type")


@dataclass(slots=True, eq=False)
class Measured:
    """A class and its metrics. *functions* are its methods that have a body, each with its file."""

    source: Source
    facts: ClassFacts
    owner: Owner
    bases: tuple[Measured | None, ...] = ()
    functions: list[tuple[Source, FunctionFacts]] = field(default_factory=list)
    coupled: set[int] = field(default_factory=set)
    children: int = 0
    depth: int = 0

    @property
    def weighted_methods(self) -> int:
        return sum(function.complexity for _, function in self.functions)


@dataclass(slots=True)
class Classes:
    """All classes of the workspace; *of_function* is the class of a method by its file and place."""

    every: list[Measured]
    of_function: dict[tuple[str, int, int], Measured]


def measure_classes(code: Codebase, facts: Mapping[str, FileFacts]) -> Classes:
    """Measure the classes of *facts*, by file, whose names *code* resolves."""
    return _Measuring(code, facts).all()


class _Measuring:
    def __init__(self, code: Codebase, facts: Mapping[str, FileFacts]) -> None:
        self.code = code
        self.facts = facts
        self.every: list[Measured] = []
        self.by_place: dict[tuple[str, str, int], Measured] = {}
        self.meant: dict[tuple[str, str, str], Measured | None] = {}
        self.mentioned: dict[tuple[str, str, str], tuple[Measured, ...]] = {}
        #: What names of classes and aliases in C++ end in.
        every = (name for names in (code.cpp.classes, code.cpp.aliases) for name in names)
        self.names = {name.rpartition("::")[2] for name in every}

    def all(self) -> Classes:
        for source in self.code.sources:
            self.every += self._of_file(source)
        for measured in self.every:
            measured.bases = tuple(self._bases(measured))
            for base in {id(base): base for base in measured.bases if base is not None}.values():
                base.children += 1
        of_function = {}
        for source, function in self._functions():
            owner = self._owner(source, function)
            if owner is not None:
                owner.functions.append((source, function))
                of_function[source.path, function.line, function.column] = owner
        for measured in self.every:
            self._set_depth(measured)
            self._couple(measured)
        return Classes(self.every, of_function)

    def _of_file(self, source: Source) -> Iterator[Measured]:
        """Classes are paired by name, and those of one name in a file by line."""
        facts = self.facts.get(source.path)
        places = {(class_.name, class_.line): class_ for class_ in source.program.classes}
        for class_ in facts.classes if facts is not None else ():
            definition = places.get((class_.name, class_.line))
            if definition is not None:
                found = Measured(source, class_, (source, definition))
                self.by_place[source.path, class_.name, class_.line] = found
                yield found

    def _functions(self) -> Iterator[tuple[Source, FunctionFacts]]:
        for source in self.code.sources:
            facts = self.facts.get(source.path)
            for function in facts.functions if facts is not None else ():
                if function.class_name:
                    yield source, function

    def _bases(self, measured: Measured) -> Iterator[Measured | None]:
        """The direct bases, None for one outside of the workspace."""
        source, definition = measured.owner
        scope = definition.name.rpartition(source.separator)[0]
        for base in definition.bases:
            if source.separator == "." and base.name == "object":
                continue
            found = self.named(source, scope, base.name)
            yield None if found is measured else found

    def _owner(self, source: Source, function: FunctionFacts) -> Measured | None:
        """The class of a method: in this file, else the one that its name means here."""
        name = function.class_name
        own = [class_ for class_ in source.program.classes if class_.name == name]
        if len(own) == 1:
            return self._at((source, own[0]))
        if own:  # specialisations: the last one that begins before
            before = [class_ for class_ in own if class_.line <= function.line]
            return self._at((source, before[-1])) if before else None
        if source.separator == ".":
            return None
        found = self._class(name, source)
        for space in self.code.cpp.opened(source) if found is None else ():
            found = found or self._class(f"{space}::{name}", source)
        return found

    def _at(self, owner: Owner) -> Measured | None:
        """The index may have another object for a class than its file."""
        return self.by_place.get((owner[0].path, owner[1].name, owner[1].line))

    def _class(self, name: str, source: Source) -> Measured | None:
        """The class of a resolved name, if *source* can see it."""
        owner = class_named(self.code, name, source)
        if owner is None:
            return None
        if source.separator != "." and not self.code.cpp.sees(source, owner[0], NOWHERE):
            return None
        return self._at(owner)

    def named(self, source: Source, scope: str, name: str) -> Measured | None:
        """The class that *name* means in *scope* of a file, None if it is no class of the workspace."""
        key = (source.path, scope, name)
        if key not in self.meant:
            if source.separator == ".":
                self.meant[key] = self._class(dotted_name(source, name), source)
            else:
                self.meant[key] = self._class(self._type(source, scope, name).name, source)
        return self.meant[key]

    def _set_depth(self, measured: Measured) -> None:
        """Classes on the longest way to a root, itself included; a base outside of the workspace is one."""
        way, on_it = ([measured], {id(measured)}) if not measured.depth else ([], set())
        while way:
            here = way[-1]
            above = next((b for b in here.bases if b is not None and not b.depth and id(b) not in on_it), None)
            if above is not None:
                way.append(above)
                on_it.add(id(above))
                continue
            here.depth = 1 + max((1 if b is None else b.depth for b in here.bases), default=0)
            on_it.discard(id(way.pop()))

    def _couple(self, measured: Measured) -> None:
        """Add the classes that its definition and its methods name."""
        places = [
            (measured.source, measured.facts.mentions),
            *((source, f.mentions) for source, f in measured.functions),
        ]
        for source, names in places:
            for name in names:
                found = self._mentioned(source, measured.facts.name, name)
                measured.coupled.update(id(other) for other in found if other is not measured)

    def _mentioned(self, source: Source, scope: str, name: str) -> tuple[Measured, ...]:
        """The classes that a name stands for, or what it is qualified by: ``A::B::make`` may be of ``A::B`` or of ``A``.

        An alias stands for all classes of its type: ``using Graph = std::vector<Node>`` for ``Node``.
        """
        key = (source.path, scope, name)
        if key not in self.mentioned:
            can_be = source.separator == "." or self._can_be_class(name)
            found = self.named(source, scope, name) if can_be else None
            every = [] if found is None else [found]
            if found is None and can_be and source.separator == "::":
                every = [
                    e
                    for e in map(self._seen_by(source), _parts(self._type(source, scope, name).arguments))
                    if e is not None
                ]
            head = name.rpartition(source.separator)[0]
            self.mentioned[key] = tuple(every) or (self._mentioned(source, scope, head) if head else ())
        return self.mentioned[key]

    def _can_be_class(self, name: str) -> bool:
        """Whether a name of C++ can be resolved to a class of the workspace, by its end: most of what is mentioned cannot, and resolving is dear.

        Pointers that macros declare beside a class, and types within library templates, have ends of their own.
        """
        end = name.rpartition("::")[2]
        return end in self.names or end.endswith(ENDS)

    def _type(self, source: Source, scope: str, name: str) -> Type:
        return resolved(self.code, syntax.Type(name), scope, source)

    def _seen_by(self, source: Source) -> Callable[[str], Measured | None]:
        return lambda name: self._class(name, source)


def _parts(arguments: Iterable[syntax.Argument]) -> Iterator[str]:
    """The names of the types among template arguments, and in theirs."""
    waiting = list(arguments)
    while waiting:
        type_ = waiting.pop()
        if isinstance(type_, syntax.Type):
            yield type_.name
            waiting.extend(type_.arguments)
