# SPDX-License-Identifier: Apache-2.0
"""What the template parameters of a C++ function stand for in a call that does not say all of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.syntax import Function

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.follow.walk import Walk
    from haros_ci.index.index import Source


def deduced(definition: Function, args: tuple[PassedArgument, ...]) -> dict[str, syntax.Argument]:
    """The template parameters of a function that the types of its arguments say."""
    found: dict[str, syntax.Argument] = {}
    for parameter, argument in zip(definition.parameters, args, strict=False):
        kind = argument.type
        if kind is None:
            continue
        if parameter.type.name in definition.templates:
            found.setdefault(parameter.type.name, kind.bare())
        elif parameter.type.arguments:
            for inner, actual in zip(parameter.type.arguments, kind.arguments, strict=False):
                if type(inner) is syntax.Type and inner.name in definition.templates and type(actual) is syntax.Type:
                    found.setdefault(inner.name, actual)
    return found


def defaulted(
    walk: Walk,
    source: Source,
    scope: str,
    definition: Function,
    templates: Mapping[str, syntax.Argument],
    args: tuple[PassedArgument, ...],
) -> Mapping[str, syntax.Argument]:
    """*templates* with the default types of those that neither the call nor an argument can tell."""
    if not definition.template_defaults:
        return templates
    named = {argument.keyword for argument in args}
    provided = [
        parameter.type
        for number, parameter in enumerate(definition.parameters)
        if number < len(args) or parameter.name in named
    ]
    found = dict(templates)
    for name, kind in definition.template_defaults:
        if name not in found and not any(_mentions(type_, name) for type_ in provided):
            found[name] = walk.resolved(kind, scope, source, found)
    return found


def _mentions(kind: syntax.Type, name: str) -> bool:
    return kind.name.partition("::")[0] == name or any(
        type(argument) is syntax.Type and _mentions(argument, name) for argument in kind.arguments
    )
