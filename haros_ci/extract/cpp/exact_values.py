# SPDX-License-Identifier: Apache-2.0
"""How libclang's types are spelled and what its constant expressions come to, for ``exact_clang``."""

from __future__ import annotations

import ctypes
import math
import re
from typing import Any

from clang.cindex import Cursor, CursorKind, SourceLocation, conf
from clang.cindex import Type as ClangType
from clang.cindex import TypeKind as K

from haros_ci.regex import regex

#: How deep types are read and constants followed.
DEEPEST = 24
TYPE_NAMES = {CursorKind.TYPE_REF, CursorKind.TEMPLATE_REF, CursorKind.NAMESPACE_REF}
INTEGERS = {
    K.CHAR_S, K.CHAR_U, K.SCHAR, K.UCHAR, K.WCHAR, K.CHAR16, K.CHAR32, K.SHORT, K.USHORT, K.INT, K.UINT, K.LONG,
    K.ULONG, K.LONGLONG, K.ULONGLONG, K.ENUM,
}  # fmt: skip
_SCOPES = {
    CursorKind.NAMESPACE, CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.CLASS_TEMPLATE,
    CursorKind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION, CursorKind.LINKAGE_SPEC,
}  # fmt: skip
_FLOATS = {K.FLOAT, K.DOUBLE}
_SCALARS = INTEGERS | _FLOATS | {K.BOOL}
_REFERENCES = {K.LVALUEREFERENCE, K.RVALUEREFERENCE}
_NAMELESS = {K.INVALID, K.DEPENDENT, K.OVERLOAD, K.UNEXPOSED, K.AUTO, K.FUNCTIONPROTO, K.MEMBERPOINTER}
_TOKEN = regex(r"::|\w+|\S")
_DEFAULTS = {"std::less", "std::hash", "std::equal_to", "std::char_traits", "std::default_delete"}
_ESCAPE = regex(rb"\\(?:([0-7]{1,3})|x([0-9A-Fa-f]{2})|(.))", re.DOTALL)
_ESCAPED = {b"n": b"\n", b"t": b"\t", b"r": b"\r", b"a": b"\a", b"b": b"\b", b"f": b"\f", b"v": b"\v", b"e": b"\x1b"}


def _bind() -> Any:
    """Functions of the C interface that the Python binding leaves out."""
    library = conf.lib
    pointer = ctypes.c_void_p
    rest = [ctypes.POINTER(pointer), *[ctypes.POINTER(ctypes.c_uint)] * 3]
    for name, arguments, returned in (
        ("clang_getFileLocation", [SourceLocation, *rest], None),
        ("clang_isInvalidDeclaration", [Cursor], ctypes.c_uint),
        ("clang_Cursor_Evaluate", [Cursor], pointer),
        ("clang_EvalResult_getKind", [pointer], ctypes.c_int),
        ("clang_EvalResult_isUnsignedInt", [pointer], ctypes.c_uint),
        ("clang_EvalResult_getAsLongLong", [pointer], ctypes.c_longlong),
        ("clang_EvalResult_getAsUnsigned", [pointer], ctypes.c_ulonglong),
        ("clang_EvalResult_getAsDouble", [pointer], ctypes.c_double),
        ("clang_EvalResult_dispose", [pointer], None),
    ):
        function = getattr(library, name)
        function.argtypes, function.restype = arguments, returned
    return library


LIB = _bind()


def constant(cursor: Cursor) -> str | bool | int | float | None:
    """The value of a constant expression."""
    kind = cursor.type.get_canonical().kind
    if kind not in _SCALARS:
        text = _text(cursor, 0)
        return text if text is None or "\0" not in text else None
    result = LIB.clang_Cursor_Evaluate(cursor)
    if not result:
        return None
    try:
        verdict = LIB.clang_EvalResult_getKind(result)
        if verdict == 1 and kind not in _FLOATS:
            is_unsigned = LIB.clang_EvalResult_isUnsignedInt(result)
            number: int = getattr(LIB, f"clang_EvalResult_getAs{'Unsigned' if is_unsigned else 'LongLong'}")(result)
            return bool(number) if kind == K.BOOL else number
        if verdict == 2 and kind in _FLOATS:
            real: float = LIB.clang_EvalResult_getAsDouble(result)
            return real if math.isfinite(real) else None
        return None
    finally:
        LIB.clang_EvalResult_dispose(result)


def _text(cursor: Cursor, depth: int) -> str | None:
    """The text of a constant string: literals, constants initialised by them, and sums of them."""
    if depth > DEEPEST or spell(cursor.type) not in ("char*", "std::string"):
        return None
    kind = cursor.kind
    if kind == CursorKind.STRING_LITERAL:
        return _unquoted(cursor)
    if kind in (CursorKind.DECL_REF_EXPR, CursorKind.MEMBER_REF_EXPR):
        return _initial_text(cursor.referenced, depth)
    below = [c for c in cursor.get_children() if c.kind.is_expression() and c.kind not in TYPE_NAMES]
    if kind in (CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR, CursorKind.CXX_FUNCTIONAL_CAST_EXPR):
        return _text(below[0], depth + 1) if len(below) == 1 else None
    if kind == CursorKind.CALL_EXPR and cursor.referenced is not None:
        callee = cursor.referenced
        provided = [a for a in cursor.get_arguments() if a is not None and a.extent.start.file is not None]
        if callee.kind == CursorKind.CONSTRUCTOR and len(provided) == 1:
            return _text(provided[0], depth + 1)
        if callee.spelling == "operator+" and len(provided) == 2 and qualified(callee) == "std::operator+":
            left, right = _text(provided[0], depth + 1), _text(provided[1], depth + 1)
            return None if left is None or right is None else left + right
    return None


def _initial_text(variable: Cursor | None, depth: int) -> str | None:
    if variable is None or variable.kind != CursorKind.VAR_DECL:
        return None
    variable = variable.get_definition() or variable
    type_ = variable.type.get_canonical()
    is_const = type_.spelling.startswith("const ") if type_.kind == K.CONSTANTARRAY else type_.is_const_qualified()
    if not is_const or (type_.kind == K.POINTER and not type_.get_pointee().is_const_qualified()):
        return None
    below = [c for c in variable.get_children() if c.kind.is_expression() and c.kind not in TYPE_NAMES]
    return _text(below[-1], depth + 1) if below and below[-1].type.kind not in INTEGERS else None


def _unquoted(literal: Cursor) -> str | None:
    text = literal.spelling
    if len(text) < 2 or text[0] != '"' or text[-1] != '"':
        return None

    def character(match: re.Match[bytes]) -> bytes:
        if match[1] or match[2]:
            return bytes([int(match[1], 8) & 255 if match[1] else int(match[2], 16)])
        return _ESCAPED.get(match[3], match[3])

    data = _ESCAPE.sub(character, text[1:-1].encode("utf-8", "surrogateescape"))
    if literal.type.get_canonical().element_count != len(data) + 1:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def spell(type_: ClangType) -> str | None:
    """A type as a project writes it: no const, reference, pointer or allocator; None for one without a name."""
    inner = outer = type_.get_canonical()
    for _ in range(DEEPEST):
        if inner.kind in {K.POINTER} | _REFERENCES:
            outer, inner = inner, inner.get_pointee()
        elif inner.kind in (K.CONSTANTARRAY, K.INCOMPLETEARRAY):
            outer, inner = inner, inner.element_type
        else:
            break
        if inner.kind in (K.CHAR_S, K.CHAR_U) and outer.kind not in _REFERENCES:
            return "char*"
    if inner.kind in _NAMELESS:
        return None
    return tidy(inner.spelling)


def qualified(cursor: Cursor) -> str | None:
    """The name of a function or class in its namespaces and classes; None inside a function."""
    parts = [cursor.spelling.partition("<")[0]]
    parent = cursor.semantic_parent
    while parent is not None and not parent.kind.is_translation_unit():
        if parent.kind not in _SCOPES:
            return None
        if parent.spelling and not parent.spelling.startswith(("__", "(")):
            parts.append(parent.spelling)
        parent = parent.semantic_parent
    return "::".join(reversed(parts))


def tidy(text: str) -> str | None:
    """clang's spelling of a type in the project's; None where it has a part without a name."""
    tokens = _TOKEN.findall(text.replace("(anonymous namespace)::", "")) if len(text) <= 4000 else []
    tokens.reverse()
    try:
        found = _type(tokens, 0)
    except ValueError:
        return None
    return None if tokens else found


def _type(tokens: list[str], depth: int) -> str:
    """The type that *tokens* end with (the next one is the last), up to a comma or bracket. Raises ValueError."""
    name = ""
    while tokens and tokens[-1] not in (",", ">"):
        token = tokens.pop()
        if token == "<":
            arguments: list[str] = []
            while not arguments or tokens.pop() == ",":
                arguments.append(_type(tokens, depth + 1))
                if not tokens or depth > DEEPEST:
                    raise ValueError(name)
            name = _with_arguments(name, arguments)
        elif token in ("__cxx11", "__1"):  # inline namespaces of the standard libraries
            name = name.removesuffix("::")
        elif token == "::" or (token == "-" and not name):
            name += token
        elif token.replace("_", "a").isalnum():
            if token not in ("const", "volatile", "struct", "class", "enum"):
                name += token if not name or name.endswith(("::", "-")) else f" {token}"
        elif token not in ("&", "*"):
            raise ValueError(token)
    if not name:
        raise ValueError(name)
    return name


def _with_arguments(name: str, arguments: list[str]) -> str:
    is_standard = name.startswith("std::")
    while arguments:
        last = arguments[-1].partition("<")[0]
        if last != "std::allocator" and not (is_standard and last in _DEFAULTS):
            break
        arguments.pop()
    if name == "std::basic_string" and arguments == ["char"]:
        return "std::string"
    if not arguments:  # the generators of messages call the template std_msgs::String_
        return name.removesuffix("_")
    return f"{name}<{', '.join(arguments)}>"


def template_arguments(text: str) -> list[str | None]:
    """The outermost template arguments in a spelling by ``tidy``."""
    found: list[str | None] = []
    depth, part = 0, ""
    for character in text.partition("<")[2][:-1] if text.endswith(">") else "":
        depth += (character == "<") - (character == ">")
        if character == "," and not depth:
            found.append(part.strip())
            part = ""
        else:
            part += character
    return [*found, part.strip()] if part else found
