# SPDX-License-Identifier: Apache-2.0
"""Text that is parsed once more: macros used as statements, and initialisers that look like parameters."""

from __future__ import annotations

import re
from dataclasses import replace

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions, statements, types
from haros_ci.extract.cpp.grammar import field, kinds, parse
from haros_ci.extract.cpp.unit import Unit
from haros_ci.regex import regex

_DEEPEST = 3
_MOST = 500
_LONGEST = 8000
_HEAD = "void f(){"
_IDENTIFIER = kinds("identifier")
_CALL = kinds("call_expression")
_FUNCTION = field("function")
_ARGUMENTS = field("arguments")
_BODY = field("body")
_PARAMETER = kinds("parameter_declaration")
_NAMED = kinds("type_identifier qualified_identifier")
_ARRAY = kinds("abstract_array_declarator")
_NEVER = kinds("optional_parameter_declaration variadic_parameter_declaration type_qualifier ...")
_PRIMITIVE = kinds("primitive_type sized_type_specifier placeholder_type_specifier")
_CALLED = kinds("abstract_function_declarator")
_PARAMETERS = kinds("parameter_list")
_PLAIN = kinds("identifier")
#: Macros that register classes and nodes of behaviour trees: pluginlib/class_list_macros.hpp, rclcpp_components, class_loader, bt_factory.h.
REGISTERING = regex(
    r"\b(?:PLUGINLIB_\w+|RCLCPP_COMPONENTS_REGISTER_NODE|CLASS_LOADER_REGISTER_\w+|BT_REGISTER_NODES)\s*\("
)
_OPERATORS = frozenset(("new", "delete", "throw", "not", "sizeof", "co_await"))
_CALLS = regex(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'|\b([A-Za-z_]\w*)\s*\(', re.DOTALL)
_PARTS = regex(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'|[(){}\[\],]', re.DOTALL)
_WORD = regex(r"\b[A-Za-z_]\w*")
_TOKEN = regex(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'|##?\s*\w*|\w+', re.DOTALL)


def _block(text: str) -> Node | None:
    """The body of a function that consists of *text*, one character per byte; None if that is no C++."""
    root = parse(f"{_HEAD}{text}}}".encode("latin-1"))
    if root is None or root.has_error or root.child_count != 1:
        return None
    return root.children[0].child_by_field_id(_BODY)


def declared(unit: Unit, call: Node) -> tuple[Unit, list[Node]] | None:
    """What a use of a macro at namespace scope declares, where its text has a macro that registers a class: a unit of the text, at the use's position, and its nodes.

    None if the macro is none of these, or not simple.
    """
    text = _text(unit, call)
    root = parse(f"{text};".encode("latin-1")) if text is not None and REGISTERING.search(text) else None
    if text is None or root is None or root.has_error:
        return None
    return replace(unit, text=f"{text};", fixed=unit.position(call), level=unit.level + 1, shift=0), root.children


def expand(unit: Unit, call: Node, depth: int, out: list[syntax.Statement]) -> bool:
    """Lower a use of a macro of this file as its body, all of it at the use's position; False if it is not simple."""
    text = _text(unit, call)
    node = _block(text + ";") if text is not None else None
    if node is None:
        return False
    inner = replace(unit, text=f"{_HEAD}{text};}}", fixed=unit.position(call), level=unit.level + 1, shift=0)
    out.extend(statements.block(inner, node.children, depth))
    return True


def expression(unit: Unit, call: Node, depth: int) -> syntax.Expression | None:
    """The same of a use within an expression: what its body is if that is an expression; None if it is not simple."""
    text = _text(unit, call)
    return _lowered(unit, text, unit.position(call), depth) if text else None


def piece(unit: Unit, text: str, place: tuple[int, int], depth: int) -> syntax.Expression | None:
    """The expression *text*, which stands at *place* and is no part of the tree; None if it is no expression."""
    if unit.level >= _DEEPEST or unit.found.expansions >= _MOST:
        return None
    unit.found.expansions += 1
    return _lowered(unit, text.encode().decode("latin-1"), place, depth)


def _lowered(unit: Unit, text: str, place: tuple[int, int], depth: int) -> syntax.Expression | None:
    node = _block(f"x({text});")
    child = node.children[1] if node is not None and node.child_count == 3 else None
    inside = child.children[0] if child is not None and child.child_count else None
    argument = inside.child_by_field_id(_ARGUMENTS) if inside is not None and inside.kind_id in _CALL else None
    if argument is None:
        return None
    inner = replace(unit, text=f"{_HEAD}x({text});}}", fixed=place, level=unit.level + 1, shift=0)
    found = expressions.arguments(inner, argument, depth)
    return found[0] if len(found) == 1 else None


def _text(unit: Unit, call: Node) -> str | None:
    """The body of the macro of this file that *call* uses, with what it is given; None if it is not simple."""
    function, argument = call.child_by_field_id(_FUNCTION), call.child_by_field_id(_ARGUMENTS)
    if function is None or argument is None or function.kind_id not in _IDENTIFIER:
        return None
    macro = unit.found.callable_macros.get(unit.cut(function))
    if macro is None or unit.level >= _DEEPEST or unit.found.expansions >= _MOST:
        return None
    unit.found.expansions += 1
    parameters, body = macro
    texts = [unit.text[child.start_byte : child.end_byte] for child in argument.children if child.is_named]
    values = _arguments(unit, texts, frozenset())
    text = _substituted(body.encode().decode("latin-1"), parameters, texts, values)
    return None if text is None or len(text) > _LONGEST else _rescanned(unit, text, frozenset((unit.cut(function),)))


def _arguments(unit: Unit, texts: list[str], within: frozenset[str]) -> list[str]:
    """What a macro is given, with the macros that are written in it as their bodies: so it counts but for ``#`` and ``##`` ([cpp.subst])."""
    deeper = within | {f"({len(within)}"}
    return [(_rescanned(unit, text, deeper, is_written=True) or text) if "(" in text else text for text in texts]


def _rescanned(unit: Unit, text: str, within: frozenset[str], is_written: bool = False) -> str | None:
    """*text* with the macros that stand in it as their bodies, but for those that it is *within* ([cpp.rescan]); None if it becomes too long.

    A text that is not as it is written may stand for what a macro without parameters is, and is made no text of.
    """
    pieces, done = [], 0
    for match in _CALLS.finditer(text):
        macro = unit.found.callable_macros.get(match[1]) if match[1] and match[1] not in within else None
        if macro is None or match.start() < done or len(within) >= _DEEPEST:
            continue
        if unit.found.expansions >= _MOST:
            return None
        unit.found.expansions += 1
        texts, end = _given(text, match.end())
        if end and not is_written and _is_expanded_first(unit, macro, texts):
            pieces += [text[done : match.start()], f"{match[1]}<>(", text[match.end() : end]]
            done = end
            continue
        values = _arguments(unit, texts, within) if is_written else texts
        inside = _substituted(macro[1].encode().decode("latin-1"), macro[0], texts, values) if end else None
        inside = _rescanned(unit, inside, within | {match[1]}) if inside is not None else None
        if inside is None:
            return None
        pieces += [text[done : match.start()], inside]
        done = end
    found = "".join([*pieces, text[done:]])
    return found if len(found) <= _LONGEST else None


def _is_expanded_first(unit: Unit, macro: tuple[tuple[str, ...], str], texts: list[str]) -> bool:
    """Whether a macro inside of another makes a text of what may be a macro itself, which counts as what it stands for ([cpp.subst])."""
    words = {part[1:].strip() for part in _TOKEN.findall(macro[1]) if part[0] == "#" and part[:2] != "##"}
    made = [text for parameter, text in zip(macro[0], texts, strict=False) if parameter in words]
    names = {name for text in made for name in _WORD.findall(text)}
    return any(name == name.upper() for name in names) or any(
        name in names and parameters is None for name, parameters, _ in unit.found.macros
    )


def _given(text: str, start: int) -> tuple[list[str], int]:
    """What stands between the commas from *start* to the bracket that closes, and the place behind it; 0 where none does."""
    depth, begun, found = 0, start, list[str]()
    for match in _PARTS.finditer(text, start):
        mark = match.group()
        if not depth and mark in (",", ")"):
            found.append(text[begun : match.start()].strip())
            begun = match.end()
            if mark == ")":
                return ([] if found == [""] else found), begun
        elif mark in "([{":
            depth += 1
        elif mark in ")]}":
            depth -= 1
    return found, 0


def _substituted(body: str, parameters: tuple[str, ...], texts: list[str], expanded: list[str]) -> str | None:
    """*body* with what the parameters are given: *texts* beside ``#`` and ``##``, *expanded* elsewhere."""
    if sum(map(len, texts)) > _LONGEST or sum(map(len, expanded)) > _LONGEST:
        return None
    raw, values = (dict(zip(parameters, given, strict=False)) for given in (texts, expanded))
    if parameters and parameters[-1] in ("...", "__VA_ARGS__"):
        for given, of in ((texts, raw), (expanded, values)):
            of["__VA_ARGS__"] = ", ".join(given[len(parameters) - 1 :])
    elif len(parameters) != len(texts):
        return None

    def token(match: re.Match[str]) -> str:
        word = match.group()
        if word.startswith("##"):
            rest = word[2:].strip()
            return "\0" + raw.get(rest, rest)
        if word.startswith("#"):
            value = raw.get(word[1:].strip(), "")
            return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
        return values.get(word, word)

    if len(body) > _LONGEST or sum(len(token(match)) for match in _TOKEN.finditer(body)) > _LONGEST:
        return None
    return re.sub(r"\s*\0", "", _TOKEN.sub(token, body))


def constructed(unit: Unit, head: Node, depth: int) -> tuple[syntax.Expression, ...] | None:
    """The arguments of ``T x(a, b)`` where the tree has a function's declaration; None where it is one.

    Inside functions, a declaration of a function is rare and one of a variable is common: it is taken for a function
    only if it has no parameters or one that cannot be an expression (``int``, ``const T``, ``T name``).
    """
    children = head.children
    if children[-1].kind_id not in _PARAMETERS:
        return None
    listed = children[-1]
    names: list[syntax.Expression] | None = []
    named = 0
    for child in listed.children:
        kind = child.kind_id
        if kind in _NEVER:
            return None
        if kind not in _PARAMETER:
            if child.is_named:
                names = None
            continue
        named += 1
        parts = child.children
        if len(parts) == 1 and parts[0].kind_id in _NAMED:
            if names is not None:
                names.append(syntax.Name(types.path(unit, parts[0], depth)[0]))
            continue
        names = None
        if any(part.kind_id in _NEVER for part in parts):
            return None
        if parts[0].kind_id in _PRIMITIVE and not (len(parts) > 1 and parts[1].kind_id in _CALLED):
            return None
        if len(parts) > 1 and parts[1].kind_id in _PLAIN and unit.cut(parts[0]) not in _OPERATORS:
            return None
    if not named:
        return None
    if names is not None:
        return tuple(names)
    return _reread(unit, listed, depth)


def _reread(unit: Unit, listed: Node, depth: int) -> tuple[syntax.Expression, ...]:
    text = "x" + unit.text[listed.start_byte : listed.end_byte] + ";"
    node = _block(text)
    if node is not None:
        start = unit.shift + listed.start_byte
        unit.found.reread.append((start, unit.shift + listed.end_byte))
        inner = replace(unit, text=f"{_HEAD}{text}}}", shift=start - len(_HEAD) - 1)
        for child in node.children:
            argument = child.children[0].child_by_field_id(_ARGUMENTS) if child.child_count else None
            if argument is not None:
                return expressions.arguments(inner, argument, depth)
    return (unit.opaque(listed),)
