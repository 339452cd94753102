# SPDX-License-Identifier: Apache-2.0
"""What libclang knows of calls in one file. Only ``exact_worker`` imports this, in a process that may die.

clang goes on after an error and then takes an unknown type in a typedef for int, forgets overloads whose parameters it
does not know, and forgets unknown bases. What such a declaration takes part in is left out.
"""

from __future__ import annotations

import ctypes
import os
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from clang.cindex import (
    Cursor,
    CursorKind,
    File,
    Index,
    SourceLocation,
    TranslationUnit,
    TranslationUnitLoadError,
)
from clang.cindex import TypeKind as K

from haros_ci.extract.cpp.exact_values import DEEPEST, LIB, TYPE_NAMES, constant, qualified, spell, template_arguments
from haros_ci.regex import regex

_POINTERS = {K.POINTER, K.MEMBERPOINTER, K.NULLPTR}
_LITERALS = {CursorKind.INTEGER_LITERAL}
_INT = regex(r"\bint\b")
#: Calls reported for one place (macros make many), arguments of one, errors in a unit.
CALLS, ARGUMENTS, ERRORS = 64, 64, 2000
_KEEP_GOING = 0x200
#: The bit in which clang keeps that a location is in a macro's expansion.
_IN_MACRO = 1 << 31
_CALLABLE = {
    CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD, CursorKind.CONSTRUCTOR, CursorKind.CONVERSION_FUNCTION,
    CursorKind.FUNCTION_TEMPLATE,
}  # fmt: skip
_CLASSES = {CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.CLASS_TEMPLATE}
_HEAD = {
    CursorKind.CXX_BASE_SPECIFIER, CursorKind.TEMPLATE_TYPE_PARAMETER, CursorKind.TEMPLATE_NON_TYPE_PARAMETER,
    CursorKind.TEMPLATE_TEMPLATE_PARAMETER,
}  # fmt: skip
_ALIASES = {CursorKind.TYPEDEF_DECL, CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPE_ALIAS_TEMPLATE_DECL}
_INITIALISED = {CursorKind.MEMBER_REF, CursorKind.TYPE_REF}
_VALUES = {CursorKind.VAR_DECL, CursorKind.FIELD_DECL, CursorKind.PARM_DECL}


class Unreadable(Exception):
    """libclang gave up on a file."""


def read(path: str, flags: Sequence[str], unsaved: Sequence[tuple[str, str]]) -> TranslationUnit:
    """Parse *path*. Raises Unreadable."""
    try:
        return Index.create().parse(path, args=list(flags), unsaved_files=list(unsaved), options=_KEEP_GOING)
    except TranslationUnitLoadError as err:
        raise Unreadable("libclang could not parse it") from err


def included(unit: TranslationUnit) -> set[str]:
    """The real paths of all files that were included."""
    return {os.path.realpath(include.include.name) for include in unit.get_includes()}


def calls(unit: TranslationUnit, path: str, requested: set[tuple[int, int]]) -> dict[str, list[dict[str, Any]]]:
    """``line:column`` of what is *requested* -> the calls that begin there, outermost first."""
    with open(path, "rb") as stream:
        source = _Source(unit, path, stream.read())
    lines = {line for line, _ in requested}
    found: dict[str, list[dict[str, Any]]] = {}
    doubts = _Doubts(unit)
    pending = [(c, False) for c in reversed(list(unit.cursor.get_children())) if source.is_main(c)]
    while pending:
        cursor, is_rootless = pending.pop()
        if cursor.kind.is_declaration():
            start, end = cursor.extent.start.line, cursor.extent.end.line
            if not any(start <= line <= end for line in lines):
                continue
            is_rootless = is_rootless or doubts.lacks_a_base(cursor)
        below = list(cursor.get_children())
        for call, location, kind in _made(cursor, below):
            line, column, is_macro = source.place(location)
            if (line, column) in requested:
                result = found.setdefault(f"{line}:{column}", [])
                entry = _describe(call, kind, doubts, is_rootless) if len(result) < CALLS else None
                if entry is not None:
                    result.append({**entry, "macro": is_macro})
        pending += [(child, is_rootless) for child in reversed(below)]
    return {place: result for place, result in found.items() if result}


class _Source:
    """The main file: where in it, as it is written, something stands."""

    def __init__(self, unit: TranslationUnit, path: str, data: bytes) -> None:
        self.file = ctypes.cast(File.from_name(unit, path).from_param(), ctypes.c_void_p).value
        self.name, self.data = path, data

    def is_main(self, cursor: Cursor) -> bool:
        file = cursor.location.file
        return file is not None and file.name == self.name

    def place(self, location: SourceLocation) -> tuple[int, int, bool]:
        """Line and column in code points, and whether a macro's body put it there; (0, 0) in another file."""
        file, line, column, offset = ctypes.c_void_p(), ctypes.c_uint(), ctypes.c_uint(), ctypes.c_uint()
        LIB.clang_getFileLocation(location, *map(ctypes.byref, (file, line, column, offset)))
        if file.value != self.file:
            return 0, 0, False
        at: int = offset.value
        begin = max(self.data.rfind(b"\n", 0, at), self.data.rfind(b"\r", 0, at)) + 1
        text = self.data[begin:at].removeprefix(b"\xef\xbb\xbf" if begin == 0 else b"")
        # What stands in a macro's argument is where it is written; only a body is moved to where the macro begins.
        is_macro = bool(location.int_data & _IN_MACRO) and location.offset == at
        return line.value, len(text.decode("utf-8", "replace")) + 1, is_macro


class _Doubts:
    """What the errors in a unit make doubtful."""

    def __init__(self, unit: TranslationUnit) -> None:
        self._broken_names: set[str] = set()
        self._rootless: set[str] = set()
        self._told: dict[str, bool] = {}
        #: An alias of an unknown type is int to clang, and so is what comes of it on ways that are not followed here.
        self._is_int_doubtful = False
        if len(unit.diagnostics) > ERRORS:
            raise Unreadable(f"more than {ERRORS} errors; are all its headers installed?")
        for diagnostic in unit.diagnostics:
            if diagnostic.severity >= diagnostic.Error and diagnostic.location.file is not None:
                self._learn(Cursor.from_location(unit, diagnostic.location), diagnostic.location.offset)

    def _learn(self, cursor: Cursor | None, offset: int) -> None:
        for _ in range(DEEPEST):
            if cursor is None or cursor.kind.is_translation_unit():
                return
            if cursor.kind in _CALLABLE and LIB.clang_isInvalidDeclaration(cursor):
                self._broken_names.add(cursor.spelling)
                return
            if cursor.kind in _ALIASES:
                self._is_int_doubtful = True
                return
            if cursor.kind in _CLASSES:
                members = [c for c in cursor.get_children() if c.kind not in _HEAD]
                if not members or offset < members[0].extent.start.offset:
                    self._rootless.add(cursor.get_usr())
                return
            cursor = cursor.lexical_parent or cursor.semantic_parent

    def lacks_a_base(self, cursor: Cursor, depth: int = 0) -> bool:
        """Whether *cursor* is, or is a member of, a class with an error in its head: an unknown base."""
        if cursor.kind not in _CLASSES:
            parent = cursor.semantic_parent
            if cursor.kind not in _CALLABLE or parent is None or parent.kind not in _CLASSES:
                return False
            cursor = parent
        cursor = cursor.get_definition() or cursor
        if cursor.get_usr() in self._rootless:
            return True
        bases = [c for c in cursor.get_children() if c.kind == CursorKind.CXX_BASE_SPECIFIER] if self._rootless else []
        found = [b.type.get_declaration() for b in bases]
        return depth < DEEPEST and any(self.lacks_a_base(b, depth + 1) for b in found if b.kind in _CLASSES)

    def overloads(self, callee: Cursor) -> bool:
        """Whether the choice of *callee* among its overloads is in doubt."""
        return callee.spelling in self._broken_names or self.declaration(callee)

    def type(self, expression: Cursor) -> str | None:
        """The spelled type of *expression*, unless in doubt."""
        text = None if self.expression(expression) else spell(expression.type)
        return text if expression.kind in _LITERALS else self.spelling(text)

    def spelling(self, text: str | None) -> str | None:
        """A spelled type, unless in doubt."""
        return None if text and self._is_int_doubtful and _INT.search(text) else text

    def expression(self, cursor: Cursor, depth: int = 0) -> bool:
        """Whether a declaration in doubt has a part in *cursor*."""
        pending, seen = [cursor], 0
        while pending:
            item = pending.pop()
            seen += 1
            if seen > 4000:
                return True
            if item.kind.is_statement() and item.kind != CursorKind.DECL_STMT:
                continue  # a lambda's body
            target = item.referenced
            if target is not None and target != item and self.declaration(target, depth + 1):
                return True
            pending += item.get_children()
        return False

    def declaration(self, cursor: Cursor, depth: int = 0) -> bool:
        """Whether *cursor* declares, or what it is declared with is, something that clang did not understand."""
        if cursor.kind not in _CALLABLE | _ALIASES | _VALUES:
            return False
        key = cursor.get_usr() or f"{cursor.hash}"
        if cursor.kind in _VALUES and not cursor.linkage.value > 1:
            key = f"{key} {cursor.hash}"
        if key not in self._told:
            self._told[key] = False  # a declaration may refer to itself
            self._told[key] = depth > DEEPEST or self._is_doubtful(cursor, depth)
        return self._told[key]

    def _is_doubtful(self, cursor: Cursor, depth: int) -> bool:
        if LIB.clang_isInvalidDeclaration(cursor):
            return True
        for child in cursor.get_children():
            if child.kind in (CursorKind.TYPE_REF, CursorKind.PARM_DECL):
                target = child.referenced if child.kind == CursorKind.TYPE_REF else child
                if target is not None and self.declaration(target, depth + 1):
                    return True
            elif cursor.kind in _VALUES and child.kind.is_expression() and self.expression(child, depth + 1):
                return True
        return False


def _made(cursor: Cursor, below: Sequence[Cursor]) -> list[tuple[Cursor, SourceLocation, str]]:
    """The calls, constructions and news that *cursor* itself writes: the call, where it stands, and which it is."""
    kind, start = cursor.kind, cursor.extent.start
    if kind == CursorKind.CXX_NEW_EXPR:
        return [(cursor, start, "new")]
    if kind == CursorKind.CALL_EXPR:
        callee = cursor.referenced
        if callee is None or callee.kind != CursorKind.CONSTRUCTOR:
            is_operator = cursor.spelling.startswith("operator") and not cursor.spelling[8:9].isidentifier()
            return [] if is_operator else [(cursor, start, "call")]
        is_written = any(child.kind in TYPE_NAMES for child in below)  # T(x, y), and not a conversion
        return [(cursor, start, "construct")] if is_written else []
    if kind == CursorKind.CONSTRUCTOR:
        pairs = [(a, _construction(b)) for a, b in pairwise(below) if a.kind in _INITIALISED]
        return [(built, name.extent.start, "construct") for name, built in pairs if built is not None]
    if kind in (CursorKind.VAR_DECL, CursorKind.CXX_FUNCTIONAL_CAST_EXPR):
        found = [_construction(c) for c in below if c.kind.is_expression()][:1]
        at = cursor.location if kind == CursorKind.VAR_DECL else start
        return [(built, at, "construct") for built in found if built is not None]
    return []


def _construction(cursor: Cursor) -> Cursor | None:
    """The constructor's call that *cursor* is, below what clang wraps around it."""
    for _ in range(DEEPEST):
        if cursor.kind == CursorKind.CALL_EXPR:
            callee = cursor.referenced
            return cursor if callee is not None and callee.kind == CursorKind.CONSTRUCTOR else None
        below = list(cursor.get_children())
        if cursor.kind != CursorKind.UNEXPOSED_EXPR or len(below) != 1:
            return None
        cursor = below[0]
    return None


def _describe(cursor: Cursor, kind: str, doubts: _Doubts, is_rootless: bool) -> dict[str, Any] | None:
    built = cursor
    if kind == "new":
        constructions = [_construction(c) for c in cursor.get_children() if c.kind.is_expression()]
        built = next((c for c in reversed(constructions) if c is not None), cursor)
    callee = built.referenced if built.kind == CursorKind.CALL_EXPR else None
    if callee is not None and callee.kind not in _CALLABLE:
        callee = None
    result = doubts.type(cursor)
    provided = [a for a in built.get_arguments() if a is not None and a.extent.start.file is not None] if callee else []
    if callee is None and built.kind == CursorKind.CALL_EXPR:
        provided = _unresolved(built)
    is_chosen = callee is not None and not doubts.overloads(callee)
    arguments = [_argument(a, is_chosen, doubts) for a in provided[:ARGUMENTS]]
    name, templates = None, []
    if kind != "call":
        name = result.partition("<")[0] if result else None
        templates = template_arguments(result) if result else []
    elif callee is not None:
        by_name = is_rootless and _is_unqualified(built)
        name = None if by_name else qualified(callee)
        templates = [] if by_name or not is_chosen or doubts.expression(built) else _templates(callee, doubts)
    if result is None and name is None and not any(v is not None for a in arguments for v in a.values()):
        return None
    return {"kind": kind, "callee": name, "type": result, "arguments": arguments, "templates": templates}


def _is_unqualified(call: Cursor) -> bool:
    """Whether a call names a function alone, so that a member of a base would come first."""
    below = list(call.get_children())[:1]
    for _ in range(DEEPEST):
        if len(below) != 1 or below[0].kind not in (CursorKind.UNEXPOSED_EXPR, CursorKind.DECL_REF_EXPR):
            break
        below = list(below[0].get_children())
    return not any(c.kind in (CursorKind.MEMBER_REF_EXPR, CursorKind.NAMESPACE_REF) for c in below)


def _unresolved(call: Cursor) -> list[Cursor]:
    """The arguments of a call whose callee clang could not tell: all but its first child."""
    below = list(call.get_children())
    return below[1:] if below and call.type.kind == K.DEPENDENT else []


def _argument(cursor: Cursor, is_chosen: bool, doubts: _Doubts) -> dict[str, Any]:
    written = _strip(cursor)
    if doubts.expression(cursor):
        return {"type": None, "written": None, "value": None}
    value = constant(cursor) if is_chosen else None
    if value is None and cursor.type.get_canonical().kind not in _POINTERS:
        value = constant(written)
    return {
        "type": doubts.type(cursor) if is_chosen else None,
        "written": doubts.type(written),
        "value": value,
    }


def _strip(cursor: Cursor) -> Cursor:
    """The expression as written, below conversions that are not."""
    for _ in range(DEEPEST):
        if cursor.kind == CursorKind.CALL_EXPR:
            callee = cursor.referenced
            if callee is None or callee.kind not in (CursorKind.CONSTRUCTOR, CursorKind.CONVERSION_FUNCTION):
                return cursor
        elif cursor.kind != CursorKind.UNEXPOSED_EXPR:
            return cursor
        below = [c for c in cursor.get_children() if c.extent.start.file is not None]
        if len(below) != 1 or below[0].extent != cursor.extent or not below[0].kind.is_expression():
            return cursor
        if below[0].kind == CursorKind.MEMBER_REF_EXPR and cursor.kind == CursorKind.CALL_EXPR:
            below = [c for c in below[0].get_children() if c.extent == cursor.extent] or [cursor]  # a.operator T()
        if below[0] == cursor:
            return cursor
        cursor = below[0]
    return cursor


def _templates(callee: Cursor, doubts: _Doubts) -> list[str | None]:
    """A function's template arguments. The C interface tells them for functions but refuses methods by their kind."""
    function = Cursor.from_buffer_copy(callee)
    function._kind_id = CursorKind.FUNCTION_DECL.value
    function._tu = callee._tu
    count = function.get_num_template_arguments()
    found = [spell(function.get_template_argument_type(i)) for i in range(min(max(count, 0), ARGUMENTS))]
    return [doubts.spelling(text) for text in found]
