# SPDX-License-Identifier: Apache-2.0
"""What can make something of interest: code from which an API call is reachable. The rest is followed less closely."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from copy import copy
from sys import intern

from haros_ci.index.api_names import api_names, called_back
from haros_ci.index.changed_names import ChangedNames, NameSets
from haros_ci.index.index import Index, Source
from haros_ci.index.mentions import (
    CALL,
    CALLED,
    COLLECTING,
    CONTAINERS,
    EDITING,
    ELEMENT,
    LOADERS,
    THEIRS,
    callable_variables,
    called_in,
    commands,
    function_types,
    functors,
    holding,
    last,
    may_be_called,
    members_of,
    overriding,
    properties,
    shared,
    type_names,
)
from haros_ci.model.api import Row
from haros_ci.syntax import Block, Class, Function, Parameter, Statement
from haros_ci.syntax.walk import Part, without

#: Stands for the call of a parameter: whether what it holds may make something is seen where an argument is given.
GIVEN = "(given)"

#: Stands for the view for which loading plug-ins matters.
_LOADING = frozenset((0,))

#: Names that matter and names that do not, and the same where loading plug-ins is what matters.
Answers = tuple[tuple[str, ...], ...]


class Relevance:
    """For each block of code, whether an API call may be reached from it. Names stand for all functions so called."""

    def __init__(self, index: Index, rows: Iterable[Row]) -> None:
        rows = tuple(rows)
        self._api = api_names(index, rows) | {CALLED}
        self._registering = called_back(rows) - self._api
        self._index = index
        self._by_name: dict[str, list[tuple[Source, Function | Class]]] = {}
        for table in (index.functions, index.classes):
            for name, found in table.items():
                self._by_name.setdefault(last(name), []).extend(found)
        for group, name in commands(index):
            self._by_name.setdefault(group, []).extend(self._by_name.get(name, ()) if name != group else ())
        self._blocks: dict[tuple[int, int], tuple[Part, frozenset[str]]] = {}
        self._known: dict[str, bool] = {}
        #: The files whose functions and classes count; None for all.
        self._visible: frozenset[str] | None = None
        self._meant: dict[str, tuple[tuple[Source, Function | Class], ...]] = {}
        self._sets = NameSets()
        self._changed = ChangedNames(index, self._sets, self._named, self.names)
        self._variables: dict[int, tuple[Function, frozenset[str]]] = {}
        self._makes: dict[int, tuple[Function, bool]] = {}
        self._within: dict[frozenset[str], Relevance] = {}
        #: Functions and classes, by identity, from which no API call is reached, whatever counts.
        self._barren: set[int] = set()
        #: Static variables that are made already, by identity; bodies without them, by the identity of the whole body.
        self.made: frozenset[int] = frozenset()
        self._rest: dict[int, tuple[Block | None, Block | None]] = {}
        self._views: dict[frozenset[int], Relevance] = {}
        self.shared = shared(index)
        #: The names of members that hold, or may hold, a function; and how calls of them look.
        self.holding = holding(index)
        self._function_types = function_types(index)
        self._functors = functors(index)
        self._properties = properties(index)
        self._functor_members = members_of(index, self._functors)
        self._held = self.holding | {f".{name}" for name in self.holding}

    def within(self, visible: frozenset[str]) -> Relevance:
        """The same for code that can only reach functions and classes of these files."""
        view = self._within.get(visible)
        if view is None:
            view = self._within[visible] = copy(self)
            view._known, view._makes, view._meant, view._views = {}, {}, {}, {}
            view._visible, view._within, view._barren = visible, {}, set()
            view._changed = ChangedNames(self._index, self._sets, view._named, view.names)
        return view

    def after(self, statement: Statement, function: Function) -> Relevance:
        """The same once a static variable of *function* is made: it is not made again."""
        made = self.made | {id(statement)}
        if made not in self._views:
            view = self._views[made] = copy(self)
            view._known, view._makes, view.made = {}, {}, made
            view._within, view._barren = {}, set()
            rest = without(self._without_made(function.body), statement)
            view._rest = {**self._rest, id(function.body): (function.body, rest)}
        return self._views[made]

    def _without_made(self, body: Block | None) -> Block | None:
        found = self._rest.get(id(body)) if self._rest else None
        return body if found is None else found[1]

    def answers(self) -> Answers | None:
        """What was answered so far; None where that depends on static variables that were made."""
        if self._views.keys() - {_LOADING}:
            return None
        loading = self._views.get(_LOADING)
        return tuple(
            tuple(sorted(name for name, answer in known.items() if answer is matters))
            for known in (self._known, loading._known if loading is not None else {})
            for matters in (True, False)
        )

    def agrees(self, answers: Answers) -> bool:
        """Whether the answers are the same now."""
        makes, makes_nothing, loads, loads_nothing = answers
        loading = self._loading()
        return (
            all(map(self._name_matters, makes))
            and not any(map(self._name_matters, makes_nothing))
            and all(map(loading._name_matters, loads))
            and not any(map(loading._name_matters, loads_nothing))
        )

    def asked(self) -> Iterable[str]:
        """The names of which it was asked so far whether they matter, before and after static variables were made."""
        return self._known.keys() | {name for view in self._views.values() for name in view._known}

    def matters(self, block: Part, source: Source, function: Function | None = None) -> bool:
        """Whether *block* (of a function in *source*) may make something, whatever its arguments are."""
        return any(name == GIVEN or self._name_matters(name) for name in self.names(block, source, function))

    def collects(self, block: Part, source: Source) -> bool:
        """Whether *block* puts together a list or map."""
        names = self.names(block, source)
        return ELEMENT in names or not COLLECTING.isdisjoint(names)

    def loads(self, block: Part, source: Source) -> bool:
        """Whether a plug-in may be loaded by *block*."""
        return any(map(self._loading()._name_matters, self.names(block, source)))

    def _loading(self) -> Relevance:
        view = self._views.get(_LOADING)
        if view is None:
            view = self._views[_LOADING] = copy(self)
            view._known, view._makes, view._api = {}, {}, frozenset(f".{name}" for name in LOADERS)
        return view

    def edits(self, block: Part, source: Source) -> bool:
        """Whether *block* may change a text by positions."""
        return not EDITING.isdisjoint(self.names(block, source))

    def names(self, block: Part, source: Source, function: Function | None = None) -> frozenset[str]:
        """The last parts of all names that are called or constructed in *block* (of *function*), lambdas included."""
        key = (id(block), id(function))
        known = self._blocks.get(key)
        if known is None:
            found, mentioned, given = set[str](), set[str](), set[str]()
            called_in(block, found, mentioned, given, source)
            if function is not None:
                if not found.isdisjoint(self._variables_of(function, source)):
                    found.add(CALLED)
                if not found.isdisjoint(self._templates_of(function)):
                    found.add(CALLED)  # what is made depends on what a template is used for
                if any(p.name in found and self._is_open(p, function, source) for p in function.parameters):
                    found.add(GIVEN)
                if any(p.name in found and last(p.type.name) in self._functors for p in function.parameters):
                    found.add(CALL)
            if not self._held.isdisjoint(found):
                found.add(CALLED)
            if not self._functor_members.isdisjoint(found):
                found.add(CALL)
            found.update(self._read(found, mentioned, source), given)
            if not self._registering.isdisjoint(found):
                found |= mentioned  # any of them may be what is called back
            known = self._blocks[key] = (block, self._sets.one(map(intern, found)))
        return known[1]

    def _read(self, found: set[str], mentioned: set[str], source: Source) -> Iterable[str]:
        """The properties of Python that are read where these names are called and mentioned."""
        read = self._properties if "getattr" in found else mentioned & self._properties
        return read if source.separator == "." else ()

    def _variables_of(self, function: Function, source: Source) -> frozenset[str]:
        """The names of a function's variables that hold, or may hold, a function or class."""
        known = self._variables.get(id(function))
        if known is None:
            names = set[str]()
            callable_variables(function.body, names, source, self._function_types | self._functors)
            known = self._variables[id(function)] = (function, frozenset(names))
        return known[1]

    def _templates_of(self, function: Function) -> frozenset[str]:
        """The template parameters of a function and of its class."""
        owners = dict.get(self._index.classes, function.owner, ()) if function.owner else ()
        return frozenset(function.templates).union(*(owner.templates for _, owner in owners))

    def _is_open(self, parameter: Parameter, function: Function, source: Source) -> bool:
        return may_be_called(parameter.type, source, self._function_types) or parameter.type.name in function.templates

    def named(self, name: str) -> bool:
        """Whether a function or class of this name, of an API or of the workspace, may make something."""
        return self._name_matters(last(name))

    def makes(self, function: Function, source: Source) -> bool:
        """Whether a function may make something by itself; one without a body is not known to."""
        known = self._makes.get(id(function))
        if known is None:
            block = (self._without_made(function.body), function.inits)
            found = function.body is not None and any(map(self._name_matters, self.names(block, source, function)))
            known = self._makes[id(function)] = (function, found)
        return known[1]

    def changes(self, function: Function, source: Source) -> frozenset[str]:
        """The names that a function, or anything that it calls, assigns to."""
        return self._changed.of(function, source)

    def calls_of(self, function: Function, source: Source) -> frozenset[str]:
        """The names of all that a function of *source* calls, its initialisers included."""
        found = self.names(function.body, source, function) if function.body is not None else frozenset[str]()
        return found | self.names(function.inits, source) if function.inits else found

    def assigned_in(self, function: Function) -> frozenset[str]:
        """The names that a function assigns to by itself."""
        return self._sets.assigned(function.body) if function.body is not None else frozenset()

    def called(self, name: str) -> bool:
        """Whether a call of this spelling, as ``calls_of`` has it, may make something."""
        return name == GIVEN or self._name_matters(name)

    def reaches(self, function: Function, source: Source, counts: Callable[[Function, Source], bool]) -> bool:
        """Whether an API call stands in *function* or in anything that it calls, in a function that *counts*."""
        waiting: list[tuple[Source, Function | Class]] = [(source, function)]
        seen: set[int] = set()
        is_barren = True
        while waiting:
            where, item = waiting.pop()
            if id(item) in seen or id(item) in self._barren:
                continue
            seen.add(id(item))
            names = self._of(where, item)
            if isinstance(item, Function) and any(n in self._api and n != CALLED for n in names):
                is_barren = False
                if counts(item, where):
                    return True
            waiting += [found for name in names for found in self._named(name, THEIRS)]
        if is_barren:  # and so is all that it reaches
            self._barren |= seen
        return False

    def rules(self) -> tuple[tuple[str, ...], ...]:
        """What is relevant by itself, whatever is called: a change of it voids all that was followed."""
        sets = (self._api, self._registering, self.shared, self.holding, self._function_types, self._functors)
        return tuple(tuple(sorted(group)) for group in (*sets, self._functor_members, self._properties))

    def _name_matters(self, name: str) -> bool:
        known = self._known.get(name)
        if known is not None:
            return known
        if name in self._api:
            self._known[name] = True
            return True
        # All names that are reachable from this one, without recursion.
        reached = {name}
        waiting = [name]
        result = False
        while waiting and not result:
            for source, item in self._named(waiting.pop(), THEIRS):
                for inner in self._of(source, item):
                    if inner in self._api or self._known.get(inner):
                        result = True
                    elif inner not in reached and self._known.get(inner) is None:
                        reached.add(inner)
                        waiting.append(inner)
        if result:
            self._known[name] = True
        else:
            self._known.update(dict.fromkeys(reached, False))
        return result

    def _named(self, name: str, theirs: frozenset[str] = CONTAINERS) -> Sequence[tuple[Source, Function | Class]]:
        """What a name may mean; a method of containers and pointers (``.size``) that is one of *theirs* means that, and in C++ any of these."""
        if name.startswith(".") and name[1:] in CONTAINERS:
            return () if name[1:] in theirs else [item for item in self._named(name[1:]) if item[0].separator == "."]
        found = self._by_name.get(name.removeprefix("."), [])
        if self._visible is None or not found:
            return found
        known = self._meant.get(name)
        if known is None:
            known = self._meant[name] = tuple(item for item in found if item[0].path in self._visible)
        return known

    def _of(self, source: Source, item: Function | Class) -> Iterable[str]:
        if isinstance(item, Class):
            found = [last(kind) for f in item.fields for kind in type_names(f.type)] + [
                last(b.name) for b in item.bases
            ]
            if dict.get(self._index.functions, f"{item.name}::{CALL}"):  # untraced: kept.py compares what is called
                found.append(CALL)
            for where, function in dict.get(self._index.functions, f"{item.name}.__init__", ()):
                if where.path == source.path and function.body is not None:
                    found += self.names(function.body, where)
            return found + overriding(source, item, self._by_name)
        body = self._without_made(item.body)
        names = self.names(body, source, item) if body is not None else frozenset[str]()
        return names | self.names(item.inits, source) if item.inits else names
