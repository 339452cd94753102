# SPDX-License-Identifier: Apache-2.0
"""Substitution arguments, ``$(arg x)`` and the like (wiki roslaunch/XML, "substitution args")."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.model.environment import chosen_of, lost_of
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.substitutions.expression import ExpressionScopes, Undecided, Wrong, evaluate
from haros_ci.substitutions.names import Text, join_texts, literal, quoted, unknown

COMMANDS = ("find", "env", "optenv", "dirname", "anon", "arg")
_EVAL = "$(eval "
#: A text that names a file.
_FILE = regex(
    r"\$\(find [^()]*\)|\.(?:launch|test|xml|ya?ml|urdf|xacro|srdf|sdf|world|rviz|py|lua|csv|bt|perspective)\Z"
)
#: An environment variable without a default, in an expression.
_OPTIONAL = regex(
    r"\boptenv\s*\(\s*(?P<a>['\"])(?P<name>\w+)(?P=a)\s*(?:,\s*(?P<b>['\"])(?P<default>[^'\"]*)(?P=b)\s*)?\)"
)


@dataclass(frozen=True, slots=True)
class Substituted:
    """*errors* are what roslaunch would stop at; *missing* names args that are declared, but that nothing sets."""

    text: Text
    errors: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SubstitutionSources:
    """What substitutions see: args, those declared but not set, the environment and this file's directory.

    *compared* gets what an expression compares ``OTHER`` with.
    """

    args: Mapping[str, Text]
    missing: Mapping[str, int]
    environment: Mapping[str, str]
    directory: str
    compared: set[str] = field(default_factory=set)


def substitute(raw: str, sources: SubstitutionSources) -> Substituted:
    """*raw* with its substitution arguments replaced.

    ``$(find p)`` stays as it is, ``$(dirname)`` becomes such a text: paths are shown from packages on. What is not
    known is a part of the text with its reason. Substitution arguments do not nest, as in roslaunch. ``$(optenv NAME)`` without a
    default is empty where NAME is not given, but for a part of a file's name: the files are called after what NAME may be.
    """
    if "$" not in raw:
        return Substituted(literal(raw))
    if raw.startswith(_EVAL) and raw.endswith(")"):
        return _eval(raw[len(_EVAL) : -1], sources)
    parts: list[Text] = []
    errors: list[str] = []
    missing: list[str] = []
    try:
        for part, is_command in _parts(raw):
            if not is_command:
                parts.extend([literal(part)] if part else [])
                continue
            made = _command(part, sources)
            parts.append(made.text)
            errors.extend(made.errors)
            missing.extend(made.missing)
    except Wrong as err:
        return Substituted(unknown(str(err)), (str(err),))
    if len(parts) == 1:
        return Substituted(parts[0], tuple(errors), tuple(missing))
    if any(part.vacant for part in parts) and _FILE.search("".join(part.raw for part in parts)):
        parts = [unknown(part.vacant) if part.vacant else part for part in parts]
    return Substituted(join_texts(parts), tuple(errors), tuple(missing))


def _parts(raw: str) -> Iterator[tuple[str, bool]]:
    """*raw* cut into plain parts and insides of ``$(…)``; Wrong for what roslaunch refuses, nested ones above all."""
    position = 0
    for match in re.finditer(r"\$\(([^)])", raw):
        inside = match.start() + 2
        end = raw.find(")", inside)
        if end < 0:
            if re.search(r"[$(]", raw[inside:]):
                raise Wrong(f"substitution argument without its end: {quoted(raw)}; close it with ')'")
            break
        content = raw[inside:end]
        if "$" in content:
            raise Wrong(f"substitution arguments do not nest: {quoted(raw)}; set an arg first, and use that")
        if "(" in content:
            hint = "; $(eval ...) must be the whole of the text" if content.startswith("eval") else ""
            raise Wrong(f"parenthesis inside a substitution argument: {quoted(raw)}{hint}")
        yield raw[position : match.start()], False
        yield content, True
        position = end + 1
    yield raw[position:], False


def _command(content: str, sources: SubstitutionSources) -> Substituted:
    command, *words = [word for word in content.split(" ") if word] or [""]
    if command not in COMMANDS:
        if command == "eval":
            return _wrong("$(eval ...) must be the whole of the text; set an arg with it first, and use that")
        return _wrong(f"unknown substitution {quoted(f'$({content})')}; use one of {', '.join(COMMANDS)}, eval")
    if command == "dirname":
        return Substituted(Text(sources.directory))
    if command == "optenv":
        if not words:
            return _wrong("$(optenv NAME default) needs the name of an environment variable")
        value = _environment_value(words[0], sources)
        if value is not None:
            return Substituted(value)
        if len(words) == 1:
            return Substituted(Text("", vacant=_not_set(words[0])))
        default = " ".join(words[1:])
        return Substituted(replace(literal(default), chosen=f"{words[0]}={default}"))
    if len(words) != 1:
        return _wrong(f"{quoted(f'$({content})')} needs exactly one word after {command}")
    name = words[0]
    if command == "find":
        return Substituted(literal(f"$(find {name})"))
    if command == "env":
        return Substituted(environment_text(name, sources))
    if command == "anon":
        return Substituted(anonymous_text(name))
    if name in sources.args:
        return Substituted(sources.args[name])
    if name in sources.missing:
        return Substituted(unknown(f"argument {quoted(name)} is not set"), (), (name,))
    return _wrong(f"argument {quoted(name)} is not declared; declare it above, with <arg name=... default=.../>")


def environment_text(name: str, sources: SubstitutionSources) -> Text:
    value = _environment_value(name, sources)
    return unknown(_not_set(name)) if value is None else value


def _environment_value(name: str, sources: SubstitutionSources) -> Text | None:
    """The value of an environment variable; None if nothing sets it."""
    lost = lost_of(sources.environment).get(name)
    if lost is not None:
        return unknown(lost)
    value = sources.environment.get(name)
    if value is None:
        return None
    chosen = f"{name}={value}" if name in chosen_of(sources.environment) else ""
    return replace(literal(value), chosen=chosen)


def _not_set(name: str) -> str:
    return f"environment variable {quoted(name)} is not given"


def anonymous_text(name: str) -> Text:
    """``name_<host>_<process>_<number>``, as rosgraph makes it, where only the first part is known."""
    made = unknown(f"$(anon {name}) is chosen anew at each launch")
    return Text(literal(re.sub(r"[.:-]", "_", name)).raw + "_" + made.raw, made.reasons)


def _eval(expression: str, sources: SubstitutionSources) -> Substituted:
    try:
        scopes = ExpressionScopes(
            sources.args,
            lambda name: environment_text(name, sources),
            sources.environment,
            sources.directory,
            sources.compared,
        )
        made = literal(evaluate(expression, scopes))
        found = _OPTIONAL.finditer(expression) if "optenv" in expression else ()
        unset = [(match["name"], match["default"]) for match in found if match["name"] not in sources.environment]
        vacant = [name for name, default in unset if default is None]
        if vacant and _FILE.search(made.raw):
            return Substituted(unknown(_not_set(vacant[0])))
        return Substituted(replace(made, chosen="=".join(unset[0])) if unset and not vacant else made)
    except Undecided as err:
        return Substituted(unknown(str(err)))
    except Wrong as err:
        name = err.missing
        if name is not None and name in sources.missing:
            return Substituted(unknown(f"argument {quoted(name)} is not set"), (), (name,))
        return _wrong(f"$(eval {expression}): {err}" if len(expression) < 100 else f"$(eval ...): {err}")


def _wrong(message: str) -> Substituted:
    return Substituted(unknown(message), (message,))
