# SPDX-License-Identifier: Apache-2.0
"""Under which launch arguments a launch condition holds, and which nearest ones would make it hold.

Launch conditions are taken as the feature expressions of a product line (Thüm et al., "A Classification and Survey of Analysis
Strategies for Software Product Lines"): what is done under one has a presence condition over launch arguments. A question is put
to the condition itself with some arguments assumed otherwise; only arguments with finite domains are ever varied, one after the
other and then in few pairs, so that nothing is enumerated.

Expressions of Python are not evaluated here (``bounded_python`` does that): their syntax alone says which literals they compare.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import combinations, product

from haros_ci.model.presence import Choice, Presence, choice, together
from haros_ci.records import dataclass, field
from haros_ci.substitutions.names import MARK, Origin, Text, derived, literal, unknown

#: Arguments by name with the values that they are assumed to have.
Assumed = Mapping[str, Text]
#: Whether a condition holds where arguments are as assumed; None if that is not known.
Ask = Callable[[Assumed], "bool | None"]

#: Stands for a value that no launch file speaks of.
OTHER = "\ue0a7other\ue0a7"
#: How many arguments of one condition are looked at, how many are varied, how many values of one, and how many pairs of values.
MOST_NAMED = 80
MOST_ARGUMENTS = 10
MOST_VALUES = 8
MOST_PAIRS = 40
#: How many values an argument may be said not to have.
MOST_EXCLUDED = 4
TRUE, FALSE = ("true", "1"), ("false", "0")
_PAIRS = {"true": "false", "True": "False", "TRUE": "FALSE", "1": "0"}
_OPPOSITE = {**_PAIRS, **{value: key for key, value in _PAIRS.items()}}
_ANY = unknown("it is not assumed")
_ELSEWHERE = ("it is set with other launch arguments only",)


def elsewhere(origin: Origin) -> Text:
    """What stands for something that is set with other launch arguments only."""
    return Text("", _ELSEWHERE, origin)


def is_elsewhere(text: Text) -> bool:
    return text.reasons is _ELSEWHERE


@dataclass(slots=True)
class LaunchArgument:
    """A launch argument of the configuration's own files: its value, and its choices where it declares any."""

    text: Text
    choices: tuple[str, ...] = ()
    #: Whether something uses it as a condition.
    is_tested: bool = False

    @property
    def is_boolean(self) -> bool:
        """By its choices, its value or its use."""
        if self.choices:
            return all(value.lower() in ("true", "false") for value in self.choices)
        return self.is_tested or (self.text.known and self.text.raw.strip().lower() in ("true", "false"))


@dataclass(slots=True)
class LaunchArguments:
    """The launch arguments of a configuration, in the order of their declarations."""

    known: dict[str, LaunchArgument] = field(default_factory=dict)
    #: What texts are where arguments are assumed; with their origins, for these to stay.
    again: dict[tuple[object, ...], tuple[Origin, Text | None]] = field(default_factory=dict)

    def resolved(self, text: Text, assumed: Assumed) -> Text | None:
        """*text* as it is where arguments are as *assumed*; None if nothing sets it then."""
        origin = text.origin
        if origin is None or origin.arguments.isdisjoint(assumed):
            return text
        values = sorted((name, value.raw) for name, value in assumed.items() if name in origin.arguments)
        key = (id(origin), tuple(values))
        if key not in self.again:
            self.again[key] = (origin, text)  # against one that depends on itself
            made: Text | None = unknown("it comes from launch arguments in too many steps")
            try:
                made = origin.again(assumed)
            except RecursionError:
                pass
            except Exception:  # the budget is spent
                del self.again[key]
                raise
            self.again[key] = (origin, None if made is None else replace(made, origin=origin))
        return self.again[key][1]

    def declare(self, name: str, text: Text, choices: Iterable[str] = ()) -> Text:
        """*text* as the value of argument *name*, from now on; the first declaration counts."""
        before = derived((text.origin,), text.origin.again) if text.origin is not None else None
        allowed = tuple(dict.fromkeys(choices))
        made = self.known.setdefault(name, LaunchArgument(text, allowed if MARK not in "".join(allowed) else ()))

        def again(assumed: Assumed) -> Text | None:
            found = assumed.get(name)
            if found is None:
                found = before.again(assumed) if before is not None else text
            return None if found is None else replace(found, origin=origin)

        depends = frozenset((name,)) | (before.arguments if before is not None else frozenset())
        origin = Origin(depends, again, name, before.steps if before is not None else 0)
        made.text = replace(text, origin=origin)
        return made.text

    def tested(self, text: Text) -> None:
        """*text* is used as a condition."""
        argument = text.origin.argument if text.origin is not None else None
        if argument is not None:
            self.known[argument].is_tested = True

    def order(self, names: Iterable[str], first: Iterable[str]) -> list[str]:
        """*names*, beginning with those in *first*, the others in the order of their declarations."""
        needed, ahead = set(names), [name for name in dict.fromkeys(first) if name in self.known]
        ordered = [name for name in ahead if name in needed]
        return ordered + [name for name in self.known if name in needed and name not in ordered]

    def current(self, name: str, assumed: Assumed) -> Text:
        """The value that argument *name* has now."""
        text = self.known[name].text
        found = text.origin.again(assumed) if text.origin is not None else text
        return found if found is not None else _ANY


@dataclass(frozen=True, slots=True)
class Question:
    """A condition: *ask* it, with the names of the *arguments* that it depends on and their values *now*.

    *literals* gives the values that it compares an argument with; None where it does something else with it.
    """

    ask: Ask
    arguments: LaunchArguments
    names: list[str]
    now: Mapping[str, Text]
    literals: Callable[[str], frozenset[str] | None]

    def values(self, name: str, now: Text) -> list[str]:
        """Other values than *now* that argument *name* may have, the likeliest first."""
        known = self.arguments.known[name]
        if known.choices:
            values = list(known.choices)
        elif known.is_boolean:
            here = _OPPOSITE.get(now.raw.strip(), "") if now.known else ""
            values = [*([here] if here else []), "true", "false", "True", "False"]
            if now.known:
                values = [value for value in values if (value.lower() in TRUE) != (now.raw.strip().lower() in TRUE)]
        else:
            values = sorted(self.literals(name) or ())
        return [value for value in dict.fromkeys(values) if not now.known or value != now.raw][:MOST_VALUES]

    def because(self, assumed: Assumed) -> tuple[Presence, dict[str, Text]]:
        """Why it holds with *assumed*: a conjunction of choices that suffices, none of which can be left out; their values."""
        now = {**self.now, **assumed}
        kept = {name: text for name, text in now.items() if text.known}
        if len(self.names) <= MOST_NAMED:
            for name in reversed(self.names):
                if name in kept and self.ask({**now, **kept, name: _ANY}) is True:
                    now[name] = _ANY
                    del kept[name]
        presence = together(*((item,) for name in kept for item in self._choices(name, now, name in assumed)))
        return presence or (), kept

    def _choices(self, name: str, now: Mapping[str, Text], is_given: bool) -> tuple[Choice, ...]:
        """What the value of *name* must be, or must not be, for it to hold, all else being as *now*.

        One that *is_given* is said as it is, for its assignment to be known.
        """
        here = now[name].raw
        known = self.arguments.known[name]
        if known.is_boolean or is_given:
            return (choice(name, here, boolean=known.is_boolean),)
        compared = self.literals(name)
        if known.choices:
            others = [value for value in known.choices if value != here]
        else:
            others = sorted((compared or frozenset()) - {here})
        failing = [value for value in others if self.ask({**now, name: literal(value)}) is not True]
        if known.choices:
            excludes = len(failing) < len(others)
        else:
            excludes = compared is not None and self.ask({**now, name: literal(OTHER)}) is True
        if excludes and len(failing) <= MOST_EXCLUDED:
            return tuple(Choice(name, value, equal=False) for value in failing)
        return (Choice(name, here),)

    def nearest(self, presence: Presence) -> tuple[dict[str, Text], Presence] | None:
        """The arguments to set, as few as can be, for it to hold together with *presence*, and the presence that it has then."""
        names = self.names[:MOST_ARGUMENTS]
        values = {name: [literal(value) for value in self.values(name, self.now[name])] for name in names}
        for name in names:
            for value in values[name]:
                found = self._found({name: value}, presence)
                if found is not None:
                    return found
        tries = 0
        for one, other in combinations(names, 2):
            for pair in product(values[one], values[other]):
                tries += 1
                if tries > MOST_PAIRS:
                    return None
                found = self._found({one: pair[0], other: pair[1]}, presence)
                if found is not None:
                    return found
        return None

    def _found(self, assumed: dict[str, Text], presence: Presence) -> tuple[dict[str, Text], Presence] | None:
        if self.ask(assumed) is not True:
            return None
        own, kept = self.because(assumed)
        both = together(presence, own)
        if both is None or not own:
            return None
        return {name: text for name, text in kept.items() if text != self.now[name] or name in assumed}, both

    def needed(self) -> Presence:
        """What must be for it to be able to hold, where it is not known whether it does."""
        found: list[Presence] = []
        for name in self.names[:MOST_ARGUMENTS]:
            known, now = self.arguments.known[name], self.now[name]
            others = self.values(name, now)
            if len(known.choices) > MOST_VALUES:
                continue
            if not (known.is_boolean or known.choices):
                is_told = self.literals(name) is not None and len(others) < MOST_VALUES
                if not is_told or self.ask({name: literal(OTHER)}) is not False:
                    continue
            possible = [value for value in others if self.ask({name: literal(value)}) is not False]
            made = {choice(name, value, boolean=known.is_boolean) for value in possible}
            if now.known and not made:
                found.append((choice(name, now.raw, boolean=known.is_boolean),))
            elif not now.known and len(made) == 1:
                found.append(tuple(made))
        return together(*found) or ()


def compared_with(expression: str) -> frozenset[str] | None:
    """The literals that the Python *expression* compares ``OTHER`` with, for being equal or in a list of them.

    None where it does something else with it.
    """
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None if OTHER in expression else frozenset()
    found: set[str] = set()
    outside = 0
    for node in ast.walk(tree):
        if not isinstance(node, ast.Compare):
            continue
        sides = [node.left, *node.comparators]
        if not all(isinstance(op, (ast.Eq, ast.NotEq, ast.In, ast.NotIn)) for op in node.ops):
            continue
        outside += sum(1 for side in sides if _text(side) == OTHER)
        if any(_text(side) == OTHER for side in sides):
            for side in sides:
                items = side.elts if isinstance(side, (ast.List, ast.Tuple, ast.Set)) else [side]
                found.update(text for item in items if (text := _text(item)) is not None and text != OTHER)
    return frozenset(found) if outside == expression.count(OTHER) else None


def _text(node: ast.expr) -> str | None:
    """A literal as the text that stands for it in a launch file."""
    if isinstance(node, ast.Constant) and isinstance(node.value, (str, int, float)):
        return str(node.value)
    return None
