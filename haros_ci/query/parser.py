# SPDX-License-Identifier: Apache-2.0
"""From the text of a query to its tree, by recursive descent (grammar: docs/queries.md).

The grammar is that of pyflwor-ext 1.2, ``parser.py``; what is accepted besides does no harm: a condition in parentheses
is a value, ``not`` may be repeated, ``let`` and ``where`` need no ``for``.
"""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.query.fault import QueryError, short
from haros_ci.query.syntax import (
    And,
    Arithmetic,
    Attribute,
    Chain,
    Compare,
    DictOf,
    ListOf,
    Literal,
    Membership,
    Negative,
    Not,
    Or,
    Path,
    PathStep,
    Quantified,
    QueryCall,
    QueryFunction,
    QueryIf,
    QuerySubscript,
    SetCompare,
    SetOperation,
    Tree,
)
from haros_ci.query.tokens import WORDS, QueryToken, tokens

#: Brackets, functions and queries within each other.
DEEPEST = 30
COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
#: What a query in braces begins with; any other brace begins a map.
FLWR = ("for", "let", "return", "collect", "where", "order")


def parse(query: str) -> Tree:
    """The tree of *query*; QueryError says what is wrong and where."""
    from haros_ci.query.parser_flwr import flwr

    reader = QueryReader(tokens(query))
    try:
        tree = flwr(reader) if reader.kind in FLWR else reader.set()
    except RecursionError:
        raise QueryError("the query is nested too deeply", reader.token.at) from None
    if reader.kind != "end":
        raise reader.unexpected("the end of the query")
    return tree


class QueryReader:
    """The words still to be read, and the rules for expressions."""

    def __init__(self, words: tuple[QueryToken, ...]) -> None:
        self.words = words
        self.number = 0
        self.depth = 0

    @property
    def token(self) -> QueryToken:
        return self.words[self.number]

    @property
    def kind(self) -> str:
        return self.words[self.number].kind

    def next_kind(self) -> str:
        return self.words[min(self.number + 1, len(self.words) - 1)].kind

    def take(self, kind: str, what: str = "") -> QueryToken:
        """The next word, which must be of this *kind*."""
        token = self.token
        if token.kind != kind:
            raise self.unexpected(what or repr(kind))
        self.number += 1
        return token

    def skip(self, kind: str) -> bool:
        """Whether the next word is of this *kind*; it is read then."""
        if self.kind != kind:
            return False
        self.number += 1
        return True

    def unexpected(self, expected: str) -> QueryError:
        token = self.token
        found = "the query ends here" if token.kind == "end" else f"{short(token.text)} stands here"
        return QueryError(f"{found} instead of {expected}", token.at)

    def nested(self, read: Callable[[], Tree]) -> Tree:
        """What *read* reads, one level deeper."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise QueryError(f"more than {DEEPEST} levels of brackets", self.token.at, "use let to name the parts")
        tree = read()
        self.depth -= 1
        return tree

    # Sets of paths: | & - , where & binds tightest and - loosest.

    def set(self) -> Tree:
        return self._operation("-", lambda: self._operation("|", lambda: self._operation("&", self._collection)))

    def _operation(self, sign: str, read: Callable[[], Tree]) -> Tree:
        items, at = [read()], -1
        while self.kind == sign:
            at = self.token.at if at < 0 else at
            self.number += 1
            items.append(read())
        return items[0] if len(items) == 1 else SetOperation(sign, tuple(items), at)

    def _collection(self) -> Tree:
        if self.skip("("):
            tree = self.nested(self.set)
            self.take(")")
            return tree
        at = self.token.at
        steps = [self._step(self.take("name", "a variable"))]
        while self.skip("/"):
            steps.append(self._step(self.member_name()))
        return Path(tuple(steps), at)

    def _step(self, name: QueryToken) -> PathStep:
        condition = None
        if self.skip("["):
            condition = self.nested(self.condition)
            self.take("]")
        return PathStep(name.text, condition, name.at)

    def member_name(self) -> QueryToken:
        token = self.token
        if token.kind != "name" and token.kind not in WORDS:
            raise self.unexpected("the name of an attribute")
        self.number += 1
        return token

    # Conditions.

    def condition(self) -> Tree:
        at = self.token.at
        items = [self._all()]
        while self.skip("or"):
            items.append(self._all())
        return items[0] if len(items) == 1 else Or(tuple(items), at)

    def _all(self) -> Tree:
        at = self.token.at
        items = [self._negation()]
        while self.skip("and"):
            items.append(self._negation())
        return items[0] if len(items) == 1 else And(tuple(items), at)

    def _negation(self) -> Tree:
        at, count = self.token.at, 0
        while self.skip("not"):
            count += 1
        tree = self._truth()
        for _ in range(count if count < 2 else 2 - count % 2):
            tree = Not(tree, at)
        return tree

    def _truth(self) -> Tree:
        at = self.token.at
        if self.kind in ("some", "every"):
            return self._quantified()
        if self.kind == "<":
            return self._set_comparison()
        left = self.arithmetic()
        token = self.token
        if token.kind in COMPARISONS:
            self.number += 1
            return Compare(token.kind, left, self.arithmetic(), token.at)
        negated = token.kind == "not" and self.next_kind() == "in"
        if negated or token.kind == "in":
            self.number += 1 + negated
            return Membership(left, self.value_or_query(), negated, at)
        return left

    def _quantified(self) -> Tree:
        token = self.token
        self.number += 1
        name = self.take("name", "the name of a variable")
        self.take("in")
        source = self.value_or_query()
        self.take("satisfies")
        self.take("(")
        condition = self.nested(self.condition)
        self.take(")")
        return Quantified(token.kind == "every", name.text, source, condition, token.at)

    def _set_comparison(self) -> Tree:
        left, token = self.angled(), self.token
        if self.skip("is"):
            sign = "is not" if self.skip("not") else "is"
        else:
            sign = "proper " if self.skip("proper") else ""
            if self.kind not in ("subset", "superset"):
                raise self.unexpected("subset, superset, proper, is or is not")
            sign += self.kind
            self.number += 1
        return SetCompare(sign, left, self.angled(), token.at)

    # Values.

    def angled(self) -> Tree:
        """``<path>``."""
        self.take("<", "a path, as <topics/publishers>")
        tree = self.nested(self.set)
        self.take(">")
        return tree

    def value_or_query(self) -> Tree:
        """``<path>``, ``{for ... return ...}`` or an arithmetic expression."""
        from haros_ci.query.parser_flwr import braced

        if self.kind == "<":
            return self.angled()
        if self.kind == "{" and self.next_kind() in FLWR:
            return braced(self)
        return self.arithmetic()

    def arithmetic(self) -> Tree:
        return self._operators(("+", "-"), lambda: self._operators(("*", "/"), self._unary))

    def _operators(self, signs: tuple[str, ...], read: Callable[[], Tree]) -> Tree:
        at, first = self.token.at, read()
        rest = []
        while self.kind in signs:
            sign = self.token
            self.number += 1
            rest.append((sign.kind, read(), sign.at))
        return Arithmetic(first, tuple(rest), at) if rest else first

    def _unary(self) -> Tree:
        at = self.token.at
        return Negative(self.atom(), at) if self.skip("-") else self.atom()

    def atom(self) -> Tree:
        token = self.token
        if token.kind in ("number", "text"):
            self.number += 1
            assert token.value is not None
            return Literal(token.value, token.at)
        if token.kind == "name":
            return self.chain()
        if token.kind in ("(", "[", "{", "if"):
            return self.nested(getattr(self, _ATOMS[token.kind]))
        if token.kind == "function":
            raise QueryError("a function stands only after 'let name =' and 'with'", token.at)
        if token.kind == "<":
            help = "compare sets with subset, superset or is; name one with let"
            raise QueryError("a path in <> does not stand here", token.at, help)
        raise self.unexpected("a value")

    def _in_parentheses(self) -> Tree:
        self.take("(")
        tree = self.condition()
        self.take(")")
        return tree

    def _list(self) -> Tree:
        at = self.take("[").at
        items = []
        while self.kind != "]":
            items.append(self.arithmetic())
            if not self.skip(","):
                break
        self.take("]")
        return ListOf(tuple(items), at)

    def _dict(self) -> Tree:
        at = self.take("{").at
        pairs = []
        while self.kind != "}":
            key = self.arithmetic()
            self.take(":")
            pairs.append((key, self.arithmetic()))
            if not self.skip(","):
                break
        self.take("}")
        return DictOf(tuple(pairs), at)

    def _choice(self) -> Tree:
        at = self.take("if").at
        condition = self.condition()
        self.take("then")
        then = self.value_or_query()
        self.take("else")
        return QueryIf(condition, then, self.value_or_query(), at)

    def chain(self) -> Chain:
        """``name(arguments)[key].attribute``."""
        head = self.take("name", "a name")
        links: list[Attribute | QueryCall | QuerySubscript] = []
        while self.kind in (".", "(", "["):
            at = self.token.at
            if self.skip("."):
                name = self.member_name()
                links.append(Attribute(name.text, name.at))
            elif self.skip("("):
                self.depth += 1
                links.append(QueryCall(self._arguments(), at))
                self.depth -= 1
            else:
                self.take("[")
                links.append(QuerySubscript(self.nested(self.arithmetic), at))
                self.take("]")
        return Chain(head.text, tuple(links), head.at)

    def _arguments(self) -> tuple[Tree, ...]:
        found = []
        while self.kind != ")":
            found.append(self.nested(self.value_or_query))
            if not self.skip(","):
                break
        self.take(")")
        return tuple(found)

    def function(self) -> QueryFunction:
        """``function(a, b) { body }``."""
        from haros_ci.query.parser_flwr import flwr

        at = self.take("function").at
        self.take("(")
        names = []
        while self.kind != ")":
            names.append(self.take("name", "the name of a parameter").text)
            if not self.skip(","):
                break
        self.take(")")
        self.take("{")
        body = self.nested((lambda: flwr(self)) if self.kind in FLWR else self.arithmetic)
        self.take("}")
        return QueryFunction(tuple(names), body, at)


_ATOMS = {"(": "_in_parentheses", "[": "_list", "{": "_dict", "if": "_choice"}
