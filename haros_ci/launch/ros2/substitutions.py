# SPDX-License-Identifier: Apache-2.0
"""Substitutions performed in a launch context: what each ``$(...)`` gives, or why that is not known."""

from __future__ import annotations

import math
import posixpath
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from haros_ci.launch.facts import ros2
from haros_ci.launch.ros2.command_words import word
from haros_ci.launch.ros2.expression import expression_value
from haros_ci.model.launch_actions import PREFIX, SHARE, WORKSPACE, Phrase, Substitution
from haros_ci.substitutions.names import MARK, Text, join_texts, literal, quoted, unknown
from haros_ci.substitutions.presence import OTHER, compared_with

if TYPE_CHECKING:
    from haros_ci.launch.ros2.context import Context

MAX_DEPTH = 50
#: What performing a RewrittenYaml gives: a path that only this evaluation knows.
REWRITTEN = "$(rewritten {})"

_TRUE = frozenset(("1", "true", "yes", "on"))
_FALSE = frozenset(("0", "false", "no", "off"))


def perform(context: Context, phrase: Phrase, depth: int) -> Text:
    """*phrase* in *context*."""
    if depth > MAX_DEPTH:
        return unknown("substitutions are nested too deeply")
    context.spend(1 + len(phrase))
    if len(phrase) == 1 and isinstance(phrase[0], str):
        return literal(phrase[0])
    made = join_texts(
        [literal(part) if isinstance(part, str) else _substitution(context, part, depth + 1) for part in phrase]
    )
    context.spend(len(made.raw) // 200)
    return made


def truth_of(text: Text) -> bool | None:
    """A text as launch coerces it to a boolean (YAML 1.1, 1 and 0); None if it is not known or none."""
    word = text.raw.lower()
    if not text.known or word not in _TRUE | _FALSE:
        return None
    return word in _TRUE


def _substitution(context: Context, part: Substitution, depth: int) -> Text:
    if part.kind == "?":
        return unknown(part.reason or "it is not known")
    maker = _KINDS.get(part.kind)
    if maker is None:
        return unknown(f"$({part.kind}) is not followed")
    if part.kind == "rewritten":
        return _rewritten(context, part, depth)
    if part.kind == "var":
        ros2.read(context, part)
    elif part.kind == "command" and part.arguments and part.location is not None:
        ros2.command(context, line := perform(context, part.arguments[0], depth), part.location)
        ros2.program(context, line, part.location)
    elif part.kind == "find-exec" and part.arguments and part.location is not None:
        ros2.program(context, perform(context, part.arguments[0], depth), part.location)
    elif part.kind == "xacro":
        return _xacro(context, part, depth)
    return maker(context, tuple(perform(context, argument, depth) for argument in part.arguments))


_Arguments = tuple[Text, ...]


def _var(context: Context, arguments: _Arguments) -> Text:
    if not arguments or not arguments[0].known:
        return unknown(arguments[0].reasons[0] if arguments else "a launch configuration without a name")
    found = context.get(arguments[0].raw)
    if found is not None:
        return found
    if len(arguments) > 1:
        return arguments[1]
    return unknown(f"launch configuration {quoted(arguments[0].raw)} is not set")


def _env(context: Context, arguments: _Arguments) -> Text:
    if not arguments or not arguments[0].known:
        return unknown(arguments[0].reasons[0] if arguments else "an environment variable without a name")
    found = context.scope.environment.get(arguments[0].raw)
    if found is not None:
        return found
    if len(arguments) > 1:
        return arguments[1]
    return unknown(f"environment variable {quoted(arguments[0].raw)} is not set")


def _package(pattern: str) -> Callable[[Context, _Arguments], Text]:
    def make(context: Context, arguments: _Arguments) -> Text:
        if not arguments:
            return unknown("a package without a name")
        if not arguments[0].known:
            return Text(pattern.format(arguments[0].raw), arguments[0].reasons)
        return literal(pattern.format(arguments[0].raw))

    return make


def _executable(context: Context, arguments: _Arguments) -> Text:
    if len(arguments) != 2:
        return unknown("exec-in-pkg needs an executable and a package")
    executable, package = arguments
    start = PREFIX.format(package.raw)
    return Text(f"{start}/lib/{package.raw}/{executable.raw}", (*package.reasons * 2, *executable.reasons))


def _eval(context: Context, arguments: _Arguments) -> Text:
    context.spend(20)
    if arguments and OTHER in arguments[0].raw:
        context.compared.update(compared_with(arguments[0].raw) or (None,))
    return expression_value(arguments[0]) if arguments else unknown("eval without an expression")


def _anon(context: Context, arguments: _Arguments) -> Text:
    if not arguments:
        return unknown("anon without a name")
    reason = "an anonymous name ends in the host's name, the process's number and a random one"
    return Text(f"{arguments[0].raw}_{MARK}", (*arguments[0].reasons, reason))


def _directory(context: Context, arguments: _Arguments) -> Text:
    return literal(WORKSPACE.format(posixpath.dirname(context.path) or "."))


def _filename(context: Context, arguments: _Arguments) -> Text:
    directory, name = posixpath.split(context.path)
    return literal(f"{WORKSPACE.format(directory or '.')}/{name}")


def _content(context: Context, arguments: _Arguments) -> Text:
    if not arguments or not arguments[0].known:
        return unknown(arguments[0].reasons[0] if arguments else "file-content without a path")
    path, content, reason = context.places.read(arguments[0].raw)
    if path is None:
        return unknown(f"content of {quoted(arguments[0].raw)}: {reason}")
    context.files.add(path)
    context.spend(len(content) // 20)
    return literal(content)


def _command(context: Context, arguments: _Arguments) -> Text:
    return unknown(f"printed by the command {quoted(arguments[0].shown)}" if arguments else "printed by a command")


def _xacro(context: Context, part: Substitution, depth: int) -> Text:
    """What xacro makes of a file with arguments, as if its command printed it."""
    words = [literal("xacro")]
    for argument in part.arguments:
        words += [literal(" "), word(perform(context, argument, depth))]
    line = join_texts(words)
    if part.location is not None:
        ros2.command(context, line, part.location)
    return _command(context, (line,))


def _param(context: Context, arguments: _Arguments) -> Text:
    """The first parameter of that name that is set for all nodes."""
    if context.is_again:
        return unknown("parameters that are set for all nodes are not followed under other launch arguments")
    if not arguments or not arguments[0].known:
        return unknown(arguments[0].reasons[0] if arguments else "param without a name")
    for parameter in context.scope.parameters or ():
        for name, value in parameter.values:
            if name.raw == arguments[0].raw:
                return value if isinstance(value, Text) else literal(str(value))
    if len(arguments) > 1:
        return arguments[1]
    return unknown(f"parameter {quoted(arguments[0].raw)} is set by no set_parameter before")


def _truth(decide: Callable[[list[bool | None]], bool | None]) -> Callable[[Context, _Arguments], Text]:
    def make(context: Context, arguments: _Arguments) -> Text:
        values = [truth_of(argument) for argument in arguments]
        for argument, value in zip(arguments, values, strict=True):
            if value is None and argument.known:
                return unknown(f"{quoted(argument.raw)} is neither true nor false")
        made = decide(values)
        if made is None:
            reasons = dict.fromkeys(reason for text in arguments for reason in text.reasons)
            return unknown("; ".join(reasons) or "no value")
        return literal("true" if made else "false")

    return make


def _not(values: list[bool | None]) -> bool | None:
    return None if not values or values[0] is None else not values[0]


def _all(values: list[bool | None]) -> bool | None:
    return False if False in values else None if None in values else True


def _any(values: list[bool | None]) -> bool | None:
    return True if True in values else None if None in values else False


def _equal(one: Text, other: Text) -> bool | None:
    """As texts, but for two booleans and for two numbers."""
    if not one.known or not other.known:
        return None
    left, right = one.raw, other.raw
    truths = ("true", "false", "1", "0")
    if left.lower() in truths and right.lower() in truths:
        return (left.lower() in ("true", "1")) == (right.lower() in ("true", "1"))
    try:
        return math.isclose(float(left), float(right))
    except ValueError:
        return left == right


def _equals(expected: bool) -> Callable[[Context, _Arguments], Text]:
    def make(context: Context, arguments: _Arguments) -> Text:
        if len(arguments) != 2:
            return unknown("two values are needed to compare them")
        made = _equal(*arguments)
        if OTHER in (arguments[0].raw, arguments[1].raw):
            context.compared.update(text.raw for text in arguments if text.raw != OTHER)
        if made is None:
            return unknown("; ".join(dict.fromkeys(arguments[0].reasons + arguments[1].reasons)))
        return literal("true" if made == expected else "false")

    return make


def _if(context: Context, arguments: _Arguments) -> Text:
    if len(arguments) < 2:
        return unknown("$(if) without values")
    test = truth_of(arguments[0])
    other = arguments[2] if len(arguments) > 2 else literal("")
    if test is not None:
        return arguments[1] if test else other
    if arguments[1] == other:
        return other
    return unknown("; ".join(arguments[0].reasons) or f"{quoted(arguments[0].raw)} is neither true nor false")


def _join(context: Context, arguments: _Arguments) -> Text:
    """Parts of a path; an absolute one begins anew."""
    parts: list[Text] = []
    for argument in arguments:
        if argument.raw.startswith(("/", "$(")):
            parts = []
        elif parts and parts[-1].raw and not parts[-1].raw.endswith("/"):
            parts.append(literal("/"))
        parts.append(argument)
    return join_texts(parts)


def _log(context: Context, arguments: _Arguments) -> Text:
    return unknown("the directory of logs is made when launch runs")


def _find(context: Context, arguments: _Arguments) -> Text:
    return unknown(f"the path of the program {quoted(arguments[0].shown) if arguments else ''} on the machine")


def _moveit(context: Context, arguments: _Arguments) -> Text:
    return unknown("made by MoveItConfigsBuilder")


def _rewritten(context: Context, part: Substitution, depth: int) -> Text:
    """A path that stands for the file as it is rewritten; equal ones share it."""
    data = part.data if isinstance(part.data, Mapping) else {}

    def pairs(name: str) -> tuple[tuple[Text, Text], ...]:
        found = data.get(name) or ()
        items = found.items() if isinstance(found, Mapping) else found
        return tuple((_data(context, key, depth), _data(context, value, depth)) for key, value in items)

    root = data.get("root_key")
    made = {
        "source": _data(context, data.get("source", ()), depth),
        "rewrites": pairs("rewrites"),
        "key_rewrites": pairs("key_rewrites"),
        "value_rewrites": pairs("value_rewrites"),
        "root_key": None if root is None else _data(context, root, depth),
        "convert_types": bool(data.get("convert_types", False)),
    }
    for known, other in context.rewritten.items():
        if other == made:
            return literal(known)
    name = REWRITTEN.format(len(context.rewritten) + 1)
    context.rewritten[name] = made
    return literal(name)


def _data(context: Context, value: object, depth: int) -> Text:
    return perform(context, value, depth) if isinstance(value, tuple) else literal(str(value))


def _nothing(context: Context, arguments: _Arguments) -> Text:
    return unknown("it is not known")


_KINDS: Mapping[str, Callable[[Context, _Arguments], Text]] = {
    "var": _var,
    "env": _env,
    "find-pkg-share": _package(SHARE),
    "find-pkg-prefix": _package(PREFIX),
    "exec-in-pkg": _executable,
    "find-exec": _find,
    "eval": _eval,
    "command": _command,
    "xacro": _command,
    "anon": _anon,
    "dirname": _directory,
    "filename": _filename,
    "file-content": _content,
    "log_dir": _log,
    "launch_log_dir": _log,
    "param": _param,
    "not": _truth(_not),
    "and": _truth(_all),
    "or": _truth(_any),
    "any": _truth(_any),
    "all": _truth(_all),
    "equals": _equals(True),
    "not-equals": _equals(False),
    "if": _if,
    "join": _join,
    "rewritten": _nothing,
    "moveit": _moveit,
}
