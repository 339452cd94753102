# SPDX-License-Identifier: Apache-2.0
"""To how many tokens macros of C and C++ expand, as they are written: names are taken for what they are called, wherever they are defined."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from graphlib import TopologicalSorter
from itertools import islice

from haros_ci.linters.linter import Unit
from haros_ci.model.cycles import circles
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import SPLICE

#: Tokens above which an expansion is not made: cppcheck takes five seconds for so many.
MOST_TOKENS = 400_000
#: The same for all invocations of a file that become more than is written.
MOST_TOGETHER = 4_000_000
#: Names that a word before a parenthesis may stand for, one after the other.
_MOST_NAMES = 60
#: Tokens of definitions that are read for one file, in all rounds.
_MOST_READ = 2_000_000
#: Tokens of one invocation that are read, and parentheses that are open at once.
_LONGEST, _DEEPEST = 20_000, 60

_DEFINE = regex(
    r"^[ \t]*(?:#|%:)(?:[ \t]|/\*[^*\n]{0,80}\*/)*define[ \t]+([A-Za-z_]\w*)(\([^()\n]*\))?(.*)$", re.MULTILINE
)
#: A word that stands before a parenthesis.
_CALLED = regex(r"\b([A-Za-z_]\w*)(?=\s*\()")
_TOKEN = regex(r'"(?:[^"\\\n]|\\.)*"|[A-Za-z_]\w*|\S')


@dataclass(frozen=True, slots=True)
class Macro:
    """A definition: *parameters* is None if it has no arguments. *body* are its tokens."""

    name: str
    parameters: tuple[str, ...] | None
    body: tuple[str, ...]


def macros(text: str) -> Iterator[Macro]:
    """The macros that *text* defines, those under conditions of the preprocessor, too."""
    if "define" not in text:
        return
    for match in _DEFINE.finditer(SPLICE.sub(" ", text) if "\\" in text else text):
        names = None if match[2] is None else tuple(word.strip() for word in match[2][1:-1].split(","))
        body = tuple(islice((token[0] for token in _TOKEN.finditer(match[3])), _LONGEST))
        yield Macro(match[1], names, body)


#: How many tokens a text becomes: a number of its own, under OWN, and for each parameter, by its place, how often what stands for it is in it.
Form = dict[int, int]
OWN = -1
_NOTHING: Form = {OWN: 1}


def _rest(place: int) -> int:
    """What stands for a parameter of any number of arguments, the first of which has this *place*."""
    return OWN - 1 - place


class Expansions:
    """How far *defined* macros expand. Of those with one name, each part has the largest size that a definition gives it.

    As a *bound*, arguments count at least once, though a macro may drop them: then no macro, and no text, expands further where some of the
    definitions are all that there are, unless reading *is_cut*.
    """

    def __init__(self, defined: Collection[Macro], *, bound: bool = False) -> None:
        #: How often an argument counts at least.
        self.least = int(bound)
        #: Whether something was not read, as it is too long or nested too deeply.
        self.is_cut = False
        self._names = {macro.name for macro in defined}
        self._functions = {macro.name for macro in defined if macro.parameters is not None}
        self._tails: dict[str, list[str]] = {}
        for macro in defined:
            tail = macro.body[-1] if macro.parameters is None and macro.body else ""
            if tail in self._names and tail != macro.name:
                self._tails.setdefault(macro.name, []).append(tail)
        self._callees: dict[str, tuple[str, ...]] = {}
        self._forms: dict[str, Form] = {}
        #: Whether the sizes are as large as they become, and not only as far as they were counted.
        self.is_settled = False
        self.is_large = self._grows(defined)
        #: Macros whose arguments, or whose own tokens, become more of them.
        growing = {
            name
            for name, form in self._forms.items()
            if any(n > 1 for key, n in form.items() if key != OWN) or form.get(OWN, 0) > 1_000
        }
        self._growing = {name for name in self._names if not growing.isdisjoint(self._called_by(name))}
        self._calls: re.Pattern[str] | None = None

    def _grows(self, defined: Collection[Macro]) -> bool:
        """Whether a macro becomes too large; what needs itself through others is expanded as often as there are macros on the way, and no further."""
        nested = [macro for macro in defined if macro.parameters or not self._names.isdisjoint(macro.body)]
        users: dict[str, dict[Macro, None]] = {}
        graph: dict[str, set[str]] = {macro.name: set() for macro in nested}
        for macro in nested:
            used = self._names.intersection(macro.body)
            graph[macro.name] |= used - {macro.name}
            for name in used:
                users.setdefault(name, {})[macro] = None
        left = max(_MOST_READ, 3 * sum(len(macro.body) for macro in nested))
        todo: Iterable[Macro] = nested
        for _ in range(_longest_way(graph)):
            changed: dict[str, None] = {}
            for macro in todo:
                left -= 1 + len(macro.body)
                if left < 0:
                    return False
                form = self._forms.setdefault(macro.name, {})
                for key, count in self._size(macro).items():
                    if count > form.get(key, 0):
                        form[key], changed[macro.name] = count, None
                        if count > MOST_TOKENS:
                            return True
            todo = dict.fromkeys(macro for name in changed for macro in users.get(name, ()))
            if not todo:
                break
        self.is_settled = True
        return False

    def _size(self, macro: Macro) -> Form:
        places: dict[str, int] = {}
        for place, name in enumerate(macro.parameters or ()):
            is_rest = name.endswith("...")
            places[name.removesuffix("...") or "__VA_ARGS__"] = _rest(place) if is_rest else place
        return _Reading(self, macro.body, places, macro.name).rest()

    def is_exceeded_in(self, text: str, called: Collection[str]) -> bool:
        """Whether an invocation in *text* becomes more than MOST_TOKENS, or all become more than MOST_TOGETHER; *called* are the words before its parentheses."""
        if self._growing.isdisjoint(called):
            return False
        if self._calls is None:
            self._calls = re.compile(rf"\b(?:{'|'.join(sorted(self._growing))})\b(?=\s*\()")
        at, total = 0, 0
        while match := self._calls.search(text, at):
            tokens, at = _invocation(text, match.start())
            self.is_cut = self.is_cut or len(tokens) == _LONGEST
            size = _Reading(self, tokens, {}, "").item().get(OWN, 0)
            total += size
            if size > MOST_TOKENS or total > MOST_TOGETHER:
                return True
        return False

    def _called_by(self, name: str) -> tuple[str, ...]:
        """The macros that may be called where *name* stands before a parenthesis: one without arguments may end with the name of another."""
        known = self._callees.get(name)
        if known is None:
            seen, todo = {name: None}, [name]
            while todo:
                if len(seen) > _MOST_NAMES:
                    self.is_cut = True
                    break
                for tail in self._tails.get(todo.pop(), ()):
                    if tail not in seen:
                        seen[tail] = None
                        todo.append(tail)
            known = self._callees[name] = tuple(one for one in seen if one in self._functions)
        return known

    def of(self, name: str) -> Form | None:
        """The size of what *name* alone becomes; None if it is no macro."""
        return self._forms.get(name, _NOTHING) if name in self._names else None

    def call(self, name: str) -> Form | None:
        """The size of what the macros that are called by *name* become; None if none is."""
        called = self._called_by(name)
        if len(called) < 2:
            return self._forms.get(called[0], _NOTHING) if called else None
        together: Form = {}
        for one in called:
            for key, count in self._forms.get(one, _NOTHING).items():
                together[key] = max(count, together.get(key, 0))
        return together


def _longest_way(graph: Mapping[str, Collection[str]]) -> int:
    """The most names that can follow one another, each in what the one before it stands for, without any twice."""
    groups: dict[str, int] = {}
    sizes: dict[int, int] = {}
    for group in circles(graph):
        sizes[len(sizes)] = len(group)
        groups.update(dict.fromkeys(group, len(sizes) - 1))
    for name in graph:
        if name not in groups:
            groups[name] = len(sizes)
            sizes[len(sizes)] = 1
    below: dict[int, set[int]] = {number: set() for number in sizes}
    for name, used in graph.items():
        below[groups[name]] |= {groups[other] for other in used if other in groups} - {groups[name]}
    ways: dict[int, int] = {}
    for number in TopologicalSorter(below).static_order():
        ways[number] = sizes[number] + max((ways[other] for other in below[number]), default=0)
    return max(ways.values(), default=0)


def _invocation(text: str, start: int) -> tuple[tuple[str, ...], int]:
    """The tokens of the invocation that begins at *start*, up to _LONGEST, and where it ends."""
    tokens, at, opened = [], start, 0
    for match in islice(_TOKEN.finditer(text, start), _LONGEST):
        tokens.append(match[0])
        at = match.end()
        opened += (match[0] == "(") - (match[0] == ")")
        if match[0] == ")" and opened <= 0:
            break
    return tuple(tokens), at


class _Reading:
    """Reads *tokens* once; what stands for a *parameter* is counted under its name."""

    def __init__(
        self, expansions: Expansions, tokens: tuple[str, ...], parameters: Mapping[str, int], own: str
    ) -> None:
        self._expansions, self._tokens, self._parameters, self._own = expansions, tokens, parameters, own
        self.at = 0

    def rest(self) -> Form:
        total: Form = {}
        while self.at < len(self._tokens):
            _add(total, self.item())
        return total

    def item(self, depth: int = 0) -> Form:
        """The size of the next token, or of the next invocation."""
        token = self._tokens[self.at]
        self.at += 1
        if token in self._parameters:
            return {self._parameters[token]: 1}
        if token == self._own:
            return _NOTHING
        form = self._expansions.call(token) if self._next() == "(" else None
        if depth >= _DEEPEST and form is not None:
            self._expansions.is_cut, form = True, None
        if form is None:
            return self._expansions.of(token) or _NOTHING
        self.at += 1
        size, arguments = {OWN: form.get(OWN, 0)}, self._arguments(depth + 1)
        for argument in arguments if self._expansions.least else ():
            _add(size, argument)
        for key, count in form.items():
            if key != OWN:
                given = arguments[key : key + 1] if key >= 0 else arguments[_rest(key) :]
                for argument in given:
                    _add(size, argument, count - min(count, self._expansions.least))
        return size

    def _next(self) -> str:
        return self._tokens[self.at] if self.at < len(self._tokens) else ""

    def _arguments(self, depth: int) -> list[Form]:
        found: list[Form] = [{}]
        opened = 1
        while self.at < len(self._tokens):
            token = self._next()
            opened += (token == "(") - (token == ")")
            if opened == 0:
                self.at += 1
                break
            if token == "," and opened == 1:
                self.at += 1
                found.append({})
            else:
                _add(found[-1], self.item(depth))
        return found


def _add(total: Form, more: Form, times: int = 1) -> None:
    """Adds *more* so many *times* to *total*; numbers stay below what can be compared quickly."""
    for key, count in more.items():
        total[key] = min(total.get(key, 0) + count * times, 10 * MOST_TOKENS)


def expanding(units: Sequence[Unit], texts: Mapping[str, str]) -> Iterator[str]:
    """The paths of *units* in which macros, their own or those of their dependencies, expand too far.

    All definitions are looked at together first: what stays small then is small in each unit, and most often there is nothing else.
    """
    defined = {path: list(macros(text)) for path, text in texts.items()}
    called = {path: frozenset(_CALLED.findall(text)) for path, text in texts.items()}
    together = Expansions([macro for found in defined.values() for macro in found], bound=True)
    if together.is_settled and not together.is_large:
        is_small = not any(together.is_exceeded_in(text, called[path]) for path, text in texts.items())
        if is_small and not together.is_cut:
            return
    tables: dict[tuple[str, ...], Expansions] = {}
    exceeded: dict[tuple[tuple[str, ...], str], bool] = {}
    for unit in units:
        paths = (unit.file.path, *unit.dependencies)
        defining = tuple(path for path in paths if defined[path])
        if defining not in tables:
            tables[defining] = Expansions([macro for path in defining for macro in defined[path]])
        table = tables[defining]
        for path in paths:
            if (defining, path) not in exceeded:
                exceeded[defining, path] = table.is_large or table.is_exceeded_in(texts[path], called[path])
            if exceeded[defining, path]:
                yield unit.file.path
                break
