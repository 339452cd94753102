# SPDX-License-Identifier: Apache-2.0
"""What little text becomes much for a tool: how many ways lead up from a class through its bases, to how many tokens a macro expands.

A tool that walks each way, or makes each token, does not end on a text of a kilobyte; so it is not asked about one. What is counted here is what is
written: names are taken for what they are called, wherever they are defined. Nothing is executed, and counting takes time in proportion to the text.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import islice

from haros_ci.linters.linter import Unit
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import SPLICE

#: Ways through bases above which no class is looked at: pylint takes two seconds for so many, and the square for twice.
MOST_WAYS = 10_000
#: Tokens above which an expansion is not made: cppcheck takes five seconds for so many.
MOST_TOKENS = 400_000
#: The same for all invocations of a file that become more than is written.
MOST_TOGETHER = 4_000_000
#: How often all definitions are looked at: what uses another one so many times over is beyond each bound.
_ROUNDS = 60
#: Tokens of definitions that are read for one file, in all rounds.
_MOST_READ = 2_000_000
#: Tokens of one invocation that are read, and parentheses that are open at once.
_LONGEST, _DEEPEST = 20_000, 60

#: Why a tool is not asked.
MANY_WAYS = f"its classes have more than {MOST_WAYS:,} ways up through their bases"
LARGE_EXPANSION = f"its macros expand to more than {MOST_TOKENS:,} tokens"

_CLASS = regex(r"\b(?:class|struct)\s+([^;{}()=]{1,300}?)(?<!:):(?!:)([^;{}]{1,1000})\{")
_ARGUMENTS = regex(r"<[^<>]*>")
_WORD = regex(r"[A-Za-z_]\w*")
_DEFINE = regex(
    r"^[ \t]*(?:#|%:)(?:[ \t]|/\*[^*\n]{0,80}\*/)*define[ \t]+([A-Za-z_]\w*)(\([^()\n]*\))?(.*)$", re.MULTILINE
)
_TOKEN = regex(r'"(?:[^"\\\n]|\\.)*"|[A-Za-z_]\w*|\S')

#: What a file has where its classes can have many ways: several bases in one line, or classes that a call makes.
_SEVERAL = regex(r"^[ \t]*class\b[^\n]*,|\btype[ \t]*\(", re.MULTILINE)
#: So often, with two bases each, in less than MOST_WAYS ways.
_FEW = 6

#: A class with the names of its bases.
Bases = tuple[str, tuple[str, ...]]


def cpp_bases(text: str) -> Iterator[Bases]:
    """The classes of C++ that *text* derives from others, each with the last words of its bases' names."""
    for match in _CLASS.finditer(text):
        names = _WORD.findall(_ARGUMENTS.sub("", match[1]))
        names = [name for name in names if name != "final"]
        listed = match[2]
        for _ in range(_DEEPEST):
            shorter = _ARGUMENTS.sub("", listed)
            if shorter == listed:
                break
            listed = shorter
        bases = [words[-1] for words in map(_WORD.findall, listed.split(",")) if words]
        if names and bases:
            yield names[-1], tuple(bases)


def python_bases(text: str) -> Iterator[Bases]:
    """The classes of Python in *text* with the last words of their bases' names; ``B = A`` and ``B = type("B", (A,), {})`` count."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return  # pylint cannot read it, either
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            yield node.name, tuple(_last_words(node.bases))
        elif isinstance(node, ast.Assign):
            yield from (
                (target.id, tuple(_made_of(node.value))) for target in node.targets if isinstance(target, ast.Name)
            )


def _made_of(value: ast.expr) -> Iterator[str]:
    if (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "type"
        and len(value.args) > 1
    ):
        bases = value.args[1]
        yield from _last_words(bases.elts if isinstance(bases, ast.Tuple) else [bases])
    elif isinstance(value, (ast.Name, ast.Attribute)):
        yield from _last_words([value])


def _last_words(nodes: Iterable[ast.expr]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.Subscript):
            node = node.value
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr


def has_many_ways(classes: Iterable[Bases]) -> bool:
    """Whether more than MOST_WAYS ways lead up from the *classes* of one name through their bases."""
    return next(_with_many_ways(classes), None) is not None


def _with_many_ways(classes: Iterable[Bases]) -> Iterator[str]:
    """The names of *classes* from which more than MOST_WAYS ways lead up, some more than once."""
    several = [(name, [base for base in bases if base != name]) for name, bases in classes]
    ways: dict[str, int] = {}
    for _ in range(min(len(several), _ROUNDS)):
        grown = False
        for name, bases in several:
            found = min(1 + sum(ways.get(base, 1) for base in bases), 2 * MOST_WAYS)
            if found > ways.get(name, 1):
                ways[name], grown = found, True
                if found > MOST_WAYS:
                    yield name
        if not grown:
            break


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


#: How many tokens a text becomes: a number of its own, under "", and for each parameter how often what it stands for is in it.
Form = dict[str, int]


class Expansions:
    """How far *defined* macros expand. Those with a name have the larger one of their definitions' sizes."""

    def __init__(self, defined: Collection[Macro]) -> None:
        self._parameters = {macro.name: macro.parameters for macro in defined}
        self._tails = {m.name: m.body[-1] for m in defined if m.parameters is None and m.body and m.body[-1] != m.name}
        self._forms: dict[str, Form] = {}
        self.is_large = self._grows(defined)
        #: Macros whose arguments, or whose own tokens, become more of them.
        self._growing = {
            name
            for name, form in self._forms.items()
            if any(n > 1 for key, n in form.items() if key) or form.get("", 0) > 1_000
        }
        names = sorted(name for name in self._parameters if self._callee(name) in self._growing)
        self._calls = re.compile(rf"\b(?:{'|'.join(names)})\b(?=\s*\()") if names else None

    def _grows(self, defined: Collection[Macro]) -> bool:
        known = self._parameters.keys()
        nested = [macro for macro in defined if macro.parameters or not known.isdisjoint(macro.body)]
        tokens = 1 + sum(len(macro.body) for macro in nested)
        for _ in range(min(len(nested), _ROUNDS, max(3, _MOST_READ // tokens))):
            grown = False
            for macro in nested:
                form = self._forms.setdefault(macro.name, {})
                for key, count in self._size(macro).items():
                    if count > form.get(key, 0):
                        form[key], grown = count, True
                        if count > MOST_TOKENS:
                            return True
            if not grown:
                break
        return False

    def _size(self, macro: Macro) -> Form:
        of_parameters = {name.removesuffix("...") or "__VA_ARGS__": name for name in macro.parameters or ()}
        return _Reading(self, macro.body, of_parameters, macro.name).rest()

    def is_exceeded_in(self, text: str) -> bool:
        """Whether an invocation in *text* becomes more than MOST_TOKENS, or all become more than MOST_TOGETHER."""
        if self._calls is None:
            return False
        at, total = 0, 0
        while match := self._calls.search(text, at):
            tokens, at = _invocation(text, match.start())
            size = _Reading(self, tokens, {}, "").item().get("", 0)
            total += size
            if size > MOST_TOKENS or total > MOST_TOGETHER:
                return True
        return False

    def _callee(self, name: str) -> str:
        """What is called where *name* stands before a parenthesis: a macro without arguments may end with the name of another."""
        for _ in range(_ROUNDS):
            if self._parameters.get(name, ()) is not None or name not in self._tails:
                break
            name = self._tails[name]
        return name

    def of(self, name: str) -> Form | None:
        """The size of what *name* alone becomes; None if it is no macro."""
        return self._forms.get(name, {"": 1}) if name in self._parameters else None

    def call(self, name: str) -> tuple[tuple[str, ...], Form] | None:
        """Parameters and size of the macro that is called by *name*; None if none is."""
        name = self._callee(name)
        parameters = self._parameters.get(name)
        return None if parameters is None else (parameters, self._forms.get(name, {"": 1}))


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
        self, expansions: Expansions, tokens: tuple[str, ...], parameters: Mapping[str, str], own: str
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
            return {"": 1}
        called = self._expansions.call(token) if self._next() == "(" and depth < _DEEPEST else None
        if called is None:
            return self._expansions.of(token) or {"": 1}
        parameters, form = called
        self.at += 1
        size, arguments = {"": form.get("", 0)}, self._arguments(depth + 1)
        for number, name in enumerate(parameters):
            given = arguments[number:] if name.endswith("...") else arguments[number : number + 1]
            for argument in given:
                _add(size, argument, form.get(name, 0))
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


def why_not_cpp(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* that a tool for C++ is not asked about the reason, by path."""
    units = list(units)
    texts = {path: workspace.text(path) for unit in units for path in (unit.file.path, *unit.dependencies)}
    found = dict.fromkeys(_expanding(units, texts), LARGE_EXPANSION)
    beyond = _beyond(units, {path: list(cpp_bases(text)) for path, text in texts.items()})
    return found | dict.fromkeys(beyond, MANY_WAYS)


def _expanding(units: Iterable[Unit], texts: Mapping[str, str]) -> Iterator[str]:
    """The paths of *units* in which macros, their own or those of their dependencies, expand too far."""
    defined = {path: list(macros(text)) for path, text in texts.items()}
    tables: dict[tuple[str, ...], Expansions] = {}
    exceeded: dict[tuple[tuple[str, ...], str], bool] = {}
    for unit in units:
        paths = (unit.file.path, *unit.dependencies)
        defining = tuple(path for path in paths if defined[path])
        if defining not in tables:
            tables[defining] = Expansions([macro for path in defining for macro in defined[path]])
        for path in paths:
            if (defining, path) not in exceeded:
                exceeded[defining, path] = tables[defining].is_large or tables[defining].is_exceeded_in(texts[path])
            if exceeded[defining, path]:
                yield unit.file.path
                break


def why_not_python(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* that a tool which follows the bases of classes is not asked about the reason, by path."""
    units = list(units)
    every = dict.fromkeys(path for unit in units for path in (unit.file.path, *unit.dependencies))
    if sum(len(_SEVERAL.findall(workspace.text(path))) for path in every) <= _FEW:
        return {}
    classes = {path: list(python_bases(workspace.text(path))) for path in every}
    return dict.fromkeys(_beyond(units, classes), MANY_WAYS)


def _beyond(units: Collection[Unit], classes: Mapping[str, Collection[Bases]]) -> Iterator[str]:
    """The paths of *units* whose own *classes* and those of their dependencies have too many ways.

    All are looked at together first: a name that has few ways then has few in each unit, and most often there is no other.
    """
    many = frozenset(_with_many_ways(entry for found in classes.values() for entry in found))
    places = {path for path, found in classes.items() if any(name in many for name, _ in found)}
    for unit in units if places else ():
        paths = (unit.file.path, *unit.dependencies)
        if not places.isdisjoint(paths) and has_many_ways(entry for path in paths for entry in classes[path]):
            yield unit.file.path
