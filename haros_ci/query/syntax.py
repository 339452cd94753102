# SPDX-License-Identifier: Apache-2.0
"""A query as a tree. ``at`` is the offset in its text that messages point at."""

from __future__ import annotations

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Literal:
    value: int | float | str
    at: int


@dataclass(frozen=True, slots=True)
class ListOf:
    items: tuple[Tree, ...]
    at: int


@dataclass(frozen=True, slots=True)
class DictOf:
    pairs: tuple[tuple[Tree, Tree], ...]
    at: int


@dataclass(frozen=True, slots=True)
class Attribute:
    name: str
    at: int


@dataclass(frozen=True, slots=True)
class QueryCall:
    arguments: tuple[Tree, ...]
    at: int


@dataclass(frozen=True, slots=True)
class QuerySubscript:
    key: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Chain:
    """``name``, and what follows it: ``.attribute``, ``(arguments)``, ``[key]``."""

    name: str
    links: tuple[Attribute | QueryCall | QuerySubscript, ...]
    at: int


@dataclass(frozen=True, slots=True)
class QueryIf:
    condition: Tree
    then: Tree
    otherwise: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """*first*, then operators (``+ -`` or ``* /``) with what is at their right, from left to right."""

    first: Tree
    rest: tuple[tuple[str, Tree, int], ...]
    at: int


@dataclass(frozen=True, slots=True)
class Negative:
    item: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Not:
    item: Tree
    at: int


@dataclass(frozen=True, slots=True)
class And:
    items: tuple[Tree, ...]
    at: int


@dataclass(frozen=True, slots=True)
class Or:
    items: tuple[Tree, ...]
    at: int


@dataclass(frozen=True, slots=True)
class Compare:
    """*sign* is one of ``== != < <= > >=``."""

    sign: str
    left: Tree
    right: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Membership:
    item: Tree
    container: Tree
    negated: bool
    at: int


@dataclass(frozen=True, slots=True)
class SetCompare:
    """*sign* is ``subset``, ``superset``, ``proper subset``, ``proper superset``, ``is`` or ``is not``."""

    sign: str
    left: Tree
    right: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Quantified:
    every: bool
    name: str
    source: Tree
    condition: Tree
    at: int


@dataclass(frozen=True, slots=True)
class PathStep:
    name: str
    condition: Tree | None
    at: int


@dataclass(frozen=True, slots=True)
class Path:
    """``a/b[condition]/c``; the first step is a variable."""

    steps: tuple[PathStep, ...]
    at: int


@dataclass(frozen=True, slots=True)
class SetOperation:
    """*sign* (``|``, ``&`` or ``-``) between *items*, from left to right."""

    sign: str
    items: tuple[Tree, ...]
    at: int


@dataclass(frozen=True, slots=True)
class QueryFunction:
    parameters: tuple[str, ...]
    body: Tree
    at: int


@dataclass(frozen=True, slots=True)
class For:
    name: str
    source: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Let:
    name: str
    value: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Order:
    key: int | str
    descending: bool
    at: int


@dataclass(frozen=True, slots=True)
class ReturnedValue:
    """What a row gives: one value, several (a tuple), or several with *names* (a map)."""

    values: tuple[Tree, ...]
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Collect:
    output: ReturnedValue
    key: Tree
    reducer: Tree
    at: int


@dataclass(frozen=True, slots=True)
class Flwr:
    """for, let, where, order by, then one of: *output* (flattened or not), *collects*."""

    fors: tuple[For, ...]
    lets: tuple[Let, ...]
    where: Tree | None
    order: Order | None
    output: ReturnedValue | None
    flatten: bool
    collects: tuple[Collect, ...]
    at: int


Tree = (
    Literal | ListOf | DictOf | Chain | QueryIf | Arithmetic | Negative | Not | And | Or | Compare | Membership | SetCompare
    | Quantified | Path | SetOperation | QueryFunction | Flwr
)  # fmt: skip
