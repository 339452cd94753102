# SPDX-License-Identifier: Apache-2.0
"""Holds our reader of HPL against hpl-specs 1.4: the same verdict, and the same tree where both accept.

    python -m venv ORACLE && ORACLE/bin/pip install 'hpl-specs==1.4.*'
    python tests/bench/hpl_oracle.py --oracle ORACLE/bin/python [--count 10000] [--seed 1] [FILE.yaml | FILE.hpl …]

hpl-specs wants attrs 23, so it runs in an environment of its own: this script, under its Python, answers one line of JSON for each line
that it is given. The texts are those of the ``hpl:`` lists in the files, and generated ones: valid ones, valid ones with kinds of values drawn at
random, and ones that a change of one or two words has broken. Where only we accept, the text must have what hpl-specs has no grammar for.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

TOPICS = ("/a", "/b", "/scan", "/ns/cmd_vel", "state", "~private", "x/y", "/c1")
FIELDS = ("data", "x", "linear", "y_1", "to", "in", "as", "values")
ALIASES = ("A", "B", "M", "within")
WORDS = (
    "globally after until : some no causes forbids requires within as or ( ) { } [ ] ![ ]! and not implies iff forall exists in to + - * / ** = "
    '!= < <= > >= . , @A @i 1 2.5 1e3 "t" True False PI data x /a /b s ms 100 abs len max i || && $V == \''
).split()


class Generator:
    """Texts of properties, drawn by *seed*."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        #: Whether kinds of values fit, and aliases are bound once.
        self.careful = True

    def texts(self, count: int) -> Iterator[str]:
        for number in range(count):
            self.careful = number % 4 != 3
            text = self.property()
            yield self.broken(text) if number % 4 == 2 else text

    def broken(self, text: str) -> str:
        words = text.split(" ")
        for _ in range(self.random.choice((1, 1, 2))):
            at = self.random.randrange(len(words))
            match self.random.randrange(4):
                case 0:
                    words[at : at + 1] = []
                case 1:
                    words.insert(at, self.random.choice(WORDS))
                case 2:
                    words[at] = self.random.choice(WORDS)
                case _:
                    other = self.random.randrange(len(words))
                    words[at], words[other] = words[other], words[at]
            words = words or ["x"]
        return " ".join(words)

    def pick(self, *choices: Any) -> Any:
        return self.random.choice(choices)

    def property(self) -> str:
        known: list[str] = []
        scope = self.pick("globally", "after", "until", "both")
        activator = self.events(known, bind=known) if scope in ("after", "both") else ""
        terminator = self.events(list(known)) if scope in ("until", "both") else ""
        said = {"globally": "globally", "after": f"after {activator}", "until": f"until {terminator}"}
        said["both"] = f"after {activator} until {terminator}"
        inner = list(known)
        kind = self.pick("some", "no", "causes", "forbids", "requires")
        first = self.events(inner, bind=inner)
        pattern = f"{kind} {first}" if kind in ("some", "no") else f"{first} {kind} {self.events(inner)}"
        bound = self.pick("", "", " within 100 ms", " within 2 s", " within 0.5 s", " within 0 s", " within 1e3 ms")
        metadata = self.pick("", "", "", '# id : p1 # title : "a title" ', '# description : "d" ', "# id : p # id : q ")
        return f"{metadata}{said[scope]} : {pattern}{bound}"

    def events(self, known: list[str], bind: list[str] | None = None) -> str:
        count = self.pick(1, 1, 1, 2, 3)
        texts = []
        bound: list[str] = []
        topics = self.random.sample(TOPICS, count) if self.careful else self.random.choices(TOPICS, k=count)
        for text in topics:
            own = None
            free = [each for each in ALIASES if each not in known and each not in bound] if self.careful else ALIASES
            if free and self.random.random() < 0.4:
                own = self.pick(*free)
                text += f" as {own}"
                bound.append(own)
            if self.random.random() < 0.7:
                mentioned = [*known, *([own] if own else [])]
                text += (
                    " { "
                    + self.condition(
                        3, mentioned or ["A"] if not self.careful and self.random.random() < 0.1 else mentioned
                    )
                    + " }"
                )
            texts.append(text)
        if bind is not None:
            bind += bound
        return texts[0] if count == 1 else "( " + " or ".join(texts) + " )"

    def condition(self, depth: int, known: list[str]) -> str:
        if depth == 0 or self.random.random() < 0.4:
            return self.comparison(known, depth)
        match self.random.randrange(6):
            case 0:
                return f"not {self.condition(depth - 1, known)}"
            case 1:
                return f"( {self.condition(depth - 1, known)} )"
            case 2:
                name = self.pick("i", "j")
                domain = self.pick(
                    "[ 0 to 3 ]", "{ 1 , 2 }", "values", "linear . values", *([] if self.careful else ['{ "a" }'])
                )
                body = (
                    self.condition(depth - 1, [*known, name])
                    if self.random.random() < 0.3
                    else f"values [ @{name} ] > 0"
                )
                return f"{self.pick('forall', 'exists')} {name} in {domain} : {body}"
            case _:
                operator = self.pick("and", "or", "implies", "iff")
                return f"{self.condition(depth - 1, known)} {operator} {self.condition(depth - 1, known)}"

    def comparison(self, known: list[str], depth: int) -> str:
        drawn = self.random.randrange(10)
        if self.careful and drawn == 2:
            return str(self.pick("flag", "ok . data", "True"))
        match drawn + 5 if self.careful and drawn == 4 else drawn:
            case 0:
                return f"{self.reference(known)} in {self.domain(known)}"
            case 1:
                return f"not {self.reference(known)} in {self.domain(known)}"
            case 2:
                return self.reference(known)
            case 3:
                return self.pick("True", "False", "flag = True", 'name != "a b"', 'name = "say \\"no\\""')
            case 4:
                return f"{self.any_value(known)} {self.pick('=', '!=', '<', 'in')} {self.any_value(known)}"
            case _:
                operator = self.pick("=", "!=", "<", "<=", ">", ">=")
                return f"{self.number(2, known)} {operator} {self.number(1, known)}"

    def any_value(self, known: list[str]) -> str:
        return str(self.pick("1", '"t"', "True", "{ 1 }", self.reference(known), f"( {self.reference(known)} = 1 )"))

    def domain(self, known: list[str]) -> str:
        low, high = self.number(1, known), self.number(1, known)
        opened, closed = self.pick("[", "[", "!["), self.pick("]", "]", "]!")
        return str(
            self.pick(
                f"{opened} {low} to {high} {closed}",
                f"{{ {low} , {high} }}",
                "values",
                *([] if self.careful else ["{ True }", '{ "a" , "b" }']),
            )
        )

    def number(self, depth: int, known: list[str]) -> str:
        if depth == 0 or self.random.random() < 0.4:
            return str(
                self.pick(
                    "0", "1", "2.5", ".5", "1.", "1e3", "10", "PI", "E", "INF", "NAN", *[self.reference(known)] * 4
                )
            )
        match self.random.randrange(5):
            case 0:
                return f"- {self.number(depth - 1, known)}"
            case 1:
                return f"( {self.number(depth - 1, known)} )"
            case 2:
                names = (
                    ("abs", "sqrt", "floor", "int", "rad")
                    if self.careful
                    else ("len", "max", "min", "roll", "log", "nothing", "sum")
                )
                function = self.pick(*names)
                return f"{function} ( {self.number(depth - 1, known)} )"
            case _:
                return f"{self.number(depth - 1, known)} {self.pick('+', '-', '*', '/', '**')} {self.number(depth - 1, known)}"

    def reference(self, known: list[str]) -> str:
        if self.careful:
            text = str(
                self.pick(
                    "x",
                    "to",
                    "in",
                    "linear . x",
                    "a . b . c",
                    "items [ 0 ] . x",
                    "items [ 1 ] . x",
                    "values [ x ]",
                    "grid [ 0 ] [ 1 ]",
                )
            )
            names = [name for name in known if name not in ("i", "j")]
            return f"@{self.pick(*names)} . {text}" if names and self.random.random() < 0.4 else text
        text = str(self.pick(*FIELDS))
        if known and self.random.random() < 0.4:
            text = f"@{self.pick(*known)}" + (f" . {text}" if self.random.random() < 0.8 else "")
        for _ in range(self.random.randrange(3)):
            text += self.pick(" . x", " . data", " [ 0 ]", " [ x ]", " [ x + 1 ]")
        return text


def oracle() -> None:  # noqa: C901 - one branch for each pattern
    """Answers as hpl-specs does; runs in its environment."""
    import hpl.ast as ast  # type: ignore[import-not-found]
    from hpl.errors import HplSyntaxError  # type: ignore[import-not-found]
    from hpl.parser import property_parser  # type: ignore[import-not-found]

    def expression(e: Any) -> Any:
        if e.is_value and e.is_literal:
            return ["literal", e.token]
        if e.is_value and e.is_set:
            return ["set", *map(expression, e.values)]
        if e.is_value and e.is_range:
            return ["range", expression(e.min_value), expression(e.max_value), e.exclude_min, e.exclude_max]
        if e.is_value and e.is_this_msg:
            return ["this"]
        if e.is_value:
            return ["variable", e.name]
        if e.is_quantifier:
            return [str(e.quantifier), e.variable, expression(e.domain), expression(e.condition)]
        if e.is_function_call:
            return ["call", e.function.name, *map(expression, e.arguments)]
        if e.is_accessor and e.is_indexed:
            return ["item", expression(e.array), expression(e.index)]
        if e.is_accessor:
            return ["field", expression(e.message), e.field]
        return [e.operator.token, *map(expression, e.children())]

    def event(e: Any) -> Any:
        phi = e.predicate
        said = (
            None
            if phi.is_vacuous and phi.is_true
            else ["literal", "False"]
            if phi.is_vacuous
            else expression(phi.expression)
        )
        return [str(e.name), None if e.alias is None else str(e.alias), said]

    def events(e: Any) -> Any:
        return [] if e is None else [event(each) for each in e.simple_events()]

    parser = property_parser()
    for line in sys.stdin:
        try:
            found = parser.parse(json.loads(line))
        except HplSyntaxError:
            print(json.dumps(["syntax"]))
            continue
        except Exception as err:
            print(json.dumps(["meaning", type(err).__name__]))
            continue
        pattern, scope = found.pattern, found.scope
        bound = None if pattern.max_time == float("inf") else round(pattern.max_time, 12)
        said = {key: str(value).strip('"') for key, value in found.metadata.items()}
        tree = [
            ast.ScopeType(scope.scope_type).name, events(scope.activator), events(scope.terminator), pattern.pattern_type.name,
            events(pattern.trigger), events(pattern.behaviour), bound, said,
        ]  # fmt: skip
        print(json.dumps(["accepts", tree]))


def own(text: str) -> tuple[Any, str]:
    """What we say of *text*, and the extension that it uses, if it does."""
    from haros_ci.behaviour import tree
    from haros_ci.behaviour.fault import HplFault
    from haros_ci.behaviour.meaning import mistakes
    from haros_ci.behaviour.parser import KNOWN_METADATA, parse_property

    scopes = {"globally": "GLOBAL", "after": "AFTER", "until": "UNTIL", "after-until": "AFTER_UNTIL"}
    patterns = {
        "some": "EXISTENCE",
        "no": "ABSENCE",
        "causes": "RESPONSE",
        "forbids": "PREVENTION",
        "requires": "REQUIREMENT",
    }

    def expression(e: Any, alias: str | None) -> Any:
        inner = [expression(each, alias) for each in tree.children(e)]
        match e:
            case tree.Literal():
                return ["literal", e.written]
            case tree.SetOf():
                return ["set", *inner]
            case tree.Range():
                return ["range", *inner, e.open_low, e.open_high]
            case tree.Variable():
                return ["this"] if e.name == alias else ["variable", e.name]
            case tree.Field():
                return ["field", *(inner or [["this"]]), e.name]
            case tree.Item():
                return ["item", *inner]
            case tree.Call():
                return ["call", e.name, *inner]
            case tree.Quantifier():
                return [e.word, e.variable, *inner]
            case _:
                return [e.operator, *inner]

    def event(e: Any) -> Any:
        phi = None if e.predicate is None else expression(e.predicate, e.alias)
        return [e.topic, e.alias, None if phi == ["literal", "True"] else phi]

    try:
        found = parse_property(text)
    except HplFault:
        return ["syntax"], ""
    calls = (each for one in found.events for each in tree.parts(one.predicate) if isinstance(each, tree.Call))
    extension = "functions of several arguments" if any(len(each.arguments) > 1 for each in calls) else ""
    if any(each.key not in KNOWN_METADATA for each in found.metadata):
        extension = "metadata of another key"
    if mistakes(found):
        return ["meaning"], extension
    pattern, scope = found.pattern, found.scope
    bound = None if pattern.bound is None else round(pattern.bound.seconds, 12)
    ours = [
        scopes[scope.kind.value], [*map(event, scope.activator)], [*map(event, scope.terminator)], patterns[pattern.kind.value],
        [*map(event, pattern.trigger)], [*map(event, pattern.behaviour)], bound, {each.key: each.value for each in found.metadata},
    ]  # fmt: skip
    return ["accepts", ours], extension


def listed(value: Any) -> Iterator[str]:
    """The properties in the ``hpl:`` maps of a project file."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key == "hpl" and isinstance(item, dict):
                yield from (text for texts in item.values() for text in texts or ())
            else:
                yield from listed(item)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--oracle", help="the Python that has hpl-specs")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--answer", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.answer:
        oracle()
        return 0
    import yaml

    corpus = [text for file in options.files for text in listed(yaml.safe_load(file.read_text()))]
    texts = [*corpus, *Generator(options.seed).texts(options.count)]
    asked = "".join(json.dumps(text) + "\n" for text in texts)
    said = subprocess.run(
        [options.oracle, __file__, "--answer"], input=asked, capture_output=True, text=True, check=True
    )
    counts: Counter[str] = Counter()
    differ = 0
    for number, (text, line) in enumerate(zip(texts, said.stdout.splitlines(), strict=True)):
        theirs = json.loads(line)
        ours, extension = own(text)
        where = "corpus" if number < len(corpus) else "generated"
        counts[f"{where}: {theirs[0]}"] += 1
        same = json.loads(json.dumps(ours)) == theirs if theirs[0] == "accepts" else ours[0] != "accepts"
        if not same and theirs[0] == "syntax" and extension:
            counts[f"{where}: only ours accepts: {extension}"] += 1
        elif not same:
            differ += 1
            if differ <= 20:
                print(f"DIFFERS {text!r}\n  hpl-specs: {theirs}\n  ours: {ours}")
    for name in sorted(counts):
        print(f"{counts[name]:7} {name}")
    print(f"{differ:7} differences")
    return 1 if differ else 0


if __name__ == "__main__":
    raise SystemExit(main())
