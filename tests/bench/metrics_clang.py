# SPDX-License-Identifier: Apache-2.0
"""Our metrics beside those of libclang's syntax trees, on a C++ project that needs no headers but its own and the system's.

    haros-ci metrics ROOT --format json --output metrics.json
    python tests/bench/metrics_clang.py metrics.json ROOT --include ROOT/include \\
        --clang '-isystem /usr/lib/gcc/…/include'

It counts by the definitions of docs/metrics.md, from declarations that clang has resolved; no code is shared with ours.
"""

from __future__ import annotations

import argparse
import json
import shlex
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from clang.cindex import (  # type: ignore[import-not-found,import-untyped,unused-ignore]
    AccessSpecifier,
    Index,
    conf,
)
from clang.cindex import CursorKind as K
from metrics_agreement import Ours, Said, compare, last

CLASSES = (K.CLASS_DECL, K.STRUCT_DECL, K.CLASS_TEMPLATE, K.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION)
METHODS = (K.CXX_METHOD, K.CONVERSION_FUNCTION, K.CONSTRUCTOR, K.DESTRUCTOR, K.FUNCTION_TEMPLATE)
FUNCTIONS = (*METHODS, K.FUNCTION_DECL)
LOOPS = (K.FOR_STMT, K.CXX_FOR_RANGE_STMT, K.WHILE_STMT, K.DO_STMT)


class Function:
    """A definition measured: what Nejmeh and the others count, by recursion over cursors."""

    def __init__(self, cursor: Any) -> None:
        self.complexity, self.nesting, self.calls, self.apart = 1, 0, 0, 0
        self.names: set[str] = set()
        self.paths = 1
        for child in cursor.get_children():
            if child.kind in (K.COMPOUND_STMT, K.CXX_TRY_STMT):
                self.paths *= self.statement(child, 0)
            elif cursor.kind in (K.CONSTRUCTOR, K.FUNCTION_TEMPLATE) and child.kind.is_expression():
                self.paths *= max(1, self.expression(child, 0))
        self.paths += self.apart

    def statement(self, cursor: Any, depth: int) -> int:
        children = list(cursor.get_children())
        kind = cursor.kind
        if kind == K.COMPOUND_STMT:
            paths = 1
            for child in children:
                paths *= self.statement(child, depth)
            return paths
        if kind == K.IF_STMT:
            return self.branch(children, depth)
        if kind in LOOPS:
            self.complexity += 1
            self.nesting = max(self.nesting, depth + 1)
            body = children.pop(0 if kind == K.DO_STMT else -1)
            return self.statement(body, depth + 1) + 1 + sum(self.expression(each, depth) for each in children)
        if kind == K.SWITCH_STMT:
            return self.switch(children, depth)
        if kind == K.CXX_TRY_STMT:
            self.nesting = max(self.nesting, depth + 1)
            return sum(self.statement(child, depth + 1) for child in children)
        if kind == K.CXX_CATCH_STMT:
            self.complexity += 1
            return self.statement(children[-1], depth)
        if kind == K.LABEL_STMT:
            return self.statement(children[-1], depth)
        return max(1, self.expression(cursor, depth))

    def branch(self, children: list[Any], depth: int) -> int:
        self.complexity += 1
        self.nesting = max(self.nesting, depth + 1)
        paths = 0
        while children and children[0].kind in (K.DECL_STMT, K.VAR_DECL):
            paths += self.expression(children.pop(0), depth)
        if len(children) > 1 and not children[0].kind.is_statement():
            paths += self.expression(children.pop(0), depth)
        paths += self.statement(children[0], depth + 1)
        if len(children) == 1:
            return paths + 1
        if children[1].kind == K.IF_STMT:
            return paths + self.branch(list(children[1].get_children()), depth)
        return paths + self.statement(children[1], depth + 1)

    def switch(self, children: list[Any], depth: int) -> int:
        self.nesting = max(self.nesting, depth + 1)
        paths = self.expression(children[-2], depth)
        ranges, has_default = 0, False
        product = 1
        for child in children[-1].get_children():
            is_label = False
            while child.kind in (K.CASE_STMT, K.DEFAULT_STMT):
                is_label = True
                self.complexity += child.kind == K.CASE_STMT
                has_default = has_default or child.kind == K.DEFAULT_STMT
                child = list(child.get_children())[-1]
            if is_label:
                paths += product if ranges else 0
                ranges, product = ranges + 1, 1
            product *= self.statement(child, depth + 1)
        return paths + (product if ranges else 0) + (not has_default)

    def expression(self, cursor: Any, depth: int) -> int:
        kind = cursor.kind
        if kind in CLASSES:
            return 0
        if kind == K.COMPOUND_STMT:  # of a lambda
            self.apart += self.statement(cursor, depth) - 1
            return 0
        paths = 0
        if kind == K.BINARY_OPERATOR and operator(cursor) in ("&&", "||", "and", "or"):
            self.complexity += 1
            paths += 1
        elif kind == K.CONDITIONAL_OPERATOR:
            self.complexity += 1
            paths += 2
        elif kind == K.CALL_EXPR:
            self.call(cursor)
        return paths + sum(self.expression(child, depth) for child in cursor.get_children())

    def call(self, cursor: Any) -> None:
        """A call as it is written: neither an operator nor a declaration that constructs."""
        tokens = [token.spelling for token in cursor.get_tokens()]
        target = cursor.referenced
        name = cursor.spelling or (target.spelling if target is not None else "")
        if name.startswith("operator") and name not in tokens or not tokens or tokens[-1] != ")":
            return
        if target is not None and target.kind == K.CONSTRUCTOR and (tokens[0] == "(" or name not in tokens[:12]):
            return
        if (
            target is not None
            and target.kind == K.CONSTRUCTOR
            and tokens[:1] == [name]
            and tokens[1:2] not in (["("], ["<"])
        ):
            return
        if name and name not in tokens and target is not None:
            return
        self.calls += 1
        self.names.add(name or " ".join(tokens))


def operator(cursor: Any) -> str:
    left = next(cursor.get_children(), None)
    if left is None:
        return ""
    end = left.extent.end.offset
    return next((t.spelling for t in cursor.get_tokens() if t.extent.start.offset >= end and t.spelling != ")"), "")


class Tree:
    """What all translation units say of the files below *root*."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.functions: dict[tuple[str, int, str], Function] = {}
        self.weights: dict[str, dict[tuple[str, int], int]] = defaultdict(dict)
        self.classes: dict[str, Any] = {}
        self.named: dict[str, set[str]] = defaultdict(set)

    def path(self, cursor: Any) -> str:
        """The file of a cursor relative to the root; "" outside."""
        file = cursor.location.file
        try:
            return str(Path(file.name).resolve().relative_to(self.root)) if file else ""
        except ValueError:
            return ""

    def add(self, cursor: Any) -> None:
        for child in cursor.get_children():
            path = self.path(child)
            if not path:
                continue
            if child.kind in CLASSES and child.is_definition():
                self.classes.setdefault(child.get_usr(), child)
                self.mention(child.get_usr(), child, is_class=True)
            if child.kind in FUNCTIONS and child.is_definition():
                self.function(child, path)
            elif child.kind in (*CLASSES, K.NAMESPACE, K.LINKAGE_SPEC, K.UNEXPOSED_DECL):
                self.add(child)

    def function(self, cursor: Any, path: str) -> None:
        key = (path, cursor.location.line, last(cursor.spelling))
        if any(child.kind in (K.COMPOUND_STMT, K.CXX_TRY_STMT) for child in cursor.get_children()):
            found = self.functions.setdefault(key, Function(cursor))
            owner = cursor.semantic_parent
            if owner is not None and owner.kind in CLASSES:
                self.weights[owner.get_usr()][path, cursor.location.line] = found.complexity
                self.mention(owner.get_usr(), cursor)

    def mention(self, usr: str, cursor: Any, is_class: bool = False) -> None:
        """The classes that are named under *cursor*: types, qualifiers, templates, what a typedef of them stands for."""
        for child in cursor.get_children():
            if child.kind in CLASSES or (
                is_class and child.kind in (*FUNCTIONS, K.FRIEND_DECL) and child.is_definition()
            ):
                continue
            if is_class and child.kind == K.FRIEND_DECL:
                continue
            if child.kind in (K.TYPE_REF, K.TEMPLATE_REF):
                self.named[usr].update(self.meant(child.referenced))
            self.mention(usr, child)

    def meant(self, cursor: Any) -> set[str]:
        """The class that a declaration stands for; for an alias also those among its template arguments."""
        found = {self.definition(cursor)}
        if cursor is not None and cursor.kind in (K.TYPEDEF_DECL, K.TYPE_ALIAS_DECL):
            waiting = [cursor.underlying_typedef_type]
            while waiting:
                kind = waiting.pop()
                inner = [kind.get_template_argument_type(i) for i in range(max(kind.get_num_template_arguments(), 0))]
                waiting += inner
                found |= {self.definition(each.get_declaration()) for each in inner}
        return found - {""}

    def definition(self, cursor: Any) -> str:
        """The class that a declaration stands for, "" if it is none."""
        if cursor is None:
            return ""
        if cursor.kind in (K.TYPEDEF_DECL, K.TYPE_ALIAS_DECL, K.TYPE_ALIAS_TEMPLATE_DECL):
            declared = cursor.underlying_typedef_type.get_canonical().get_declaration()
            return self.definition(declared) if declared.kind in CLASSES else ""
        template = conf.lib.clang_getSpecializedCursorTemplate(cursor)
        if template is not None and template.kind in CLASSES and not self.path(cursor) == "":
            cursor = cursor if cursor.get_usr() in self.classes else template
        return cursor.get_usr() if cursor.kind in CLASSES else ""

    def bases(self, cursor: Any) -> list[str]:
        return [self.definition(c.referenced) or "?" for c in cursor.get_children() if c.kind == K.CXX_BASE_SPECIFIER]

    def depth(self, usr: str) -> int:
        known = self.classes.get(usr)
        return 1 if known is None else 1 + max((self.depth(base) for base in self.bases(known)), default=0)

    def said(self) -> Iterator[Said]:
        for (path, line, name), function in sorted(self.functions.items()):
            values = {
                "cyclomatic-complexity": function.complexity,
                "nested-control": function.nesting,
                "static-path-count": function.paths,
                "function-calls": function.calls,
                "unique-function-calls": len(function.names),
            }
            for metric, value in values.items():
                yield metric, path, line, name, value
        children: dict[str, int] = defaultdict(int)
        for cursor in self.classes.values():
            for base in set(self.bases(cursor)):
                children[base] += 1
        for usr, cursor in sorted(self.classes.items()):
            path, line, name = self.path(cursor), cursor.location.line, last(cursor.spelling)
            if not path or not name or "(" in cursor.spelling:
                continue
            own = [c for c in cursor.get_children() if c.kind in METHODS]
            open_ones = [c for c in own if is_available(c, name)]
            yield "depth-in-tree", path, line, name, self.depth(usr)
            yield "number-of-children", path, line, name, children[usr]
            yield "coupling", path, line, name, len((self.named[usr] & self.classes.keys()) - {usr})
            if own:
                yield "methods-available", path, line, name, len(open_ones)
                yield "weighted-methods", path, line, name, sum(self.weights[usr].values())


def is_available(method: Any, name: str) -> bool:
    is_made = method.kind in (K.CONSTRUCTOR, K.DESTRUCTOR) or last(method.spelling) == name
    return method.access_specifier == AccessSpecifier.PUBLIC and not is_made and not method.is_deleted_method()


def units(root: Path, sources: Iterable[Path], arguments: list[str]) -> Tree:
    tree = Tree(root.resolve())
    index = Index.create()
    for source in sources:
        unit = index.parse(str(source.resolve()), args=["-x", "c++", "-std=c++17", *arguments])
        wrong = [each.spelling for each in unit.diagnostics if each.severity >= 3]
        print(f"{source.name}: {len(wrong)} errors {wrong[:1]}" if wrong else "", end="\n" if wrong else "")
        tree.add(unit.cursor)
    return tree


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("metrics", type=Path)
    parser.add_argument("root", type=Path)
    parser.add_argument("--include", action="append", default=[])
    parser.add_argument("--show", type=int, default=0)
    parser.add_argument("--clang", default="", help="further arguments of clang, in one")
    given = parser.parse_args()
    options = [f"-I{Path(each).resolve()}" for each in given.include] + shlex.split(given.clang)
    tree = units(given.root, sorted(given.root.rglob("*.cpp")), options)
    ours = Ours(json.loads(given.metrics.read_text(encoding="utf-8")))
    compare(ours, tree.said(), "libclang", given.show)


if __name__ == "__main__":
    main()
