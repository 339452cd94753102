# SPDX-License-Identifier: Apache-2.0
"""Classes that a loader of plug-ins can give: which class, and what its template parameters stand for."""

from __future__ import annotations

from typing import NamedTuple

from haros_ci import syntax
from haros_ci.index.index import Source
from haros_ci.syntax import Class

#: Characters of a type in a description, and brackets inside brackets, up to which its template arguments are read.
LONGEST, DEEPEST = 500, 8


class PluginDescription(NamedTuple):
    """A class that a plug-in description names: where it is defined, and the arguments of the template that it is one of."""

    source: Source
    definition: Class
    arguments: tuple[syntax.Argument, ...] = ()

    @property
    def key(self) -> tuple[str, str]:
        """What tells it from others: the class, and the template's arguments."""
        return self.definition.name, repr(self.arguments) if self.arguments else ""


def written_type(text: str) -> syntax.Type:
    """The type that a description writes as ``a::Factory<b::C>``; without arguments where they cannot be read."""
    text = text.strip()
    name, bracket, rest = text.partition("<")
    name = name.strip().removeprefix("::")
    if not bracket or not rest.rstrip().endswith(">") or len(text) > LONGEST or text.count("<") > DEEPEST:
        return syntax.Type(name)
    arguments = []
    depth, piece = 0, ""
    for letter in f"{rest.rstrip()[:-1]},":
        depth += (letter == "<") - (letter == ">")
        if letter == "," and not depth:
            if not piece.strip():
                return syntax.Type(name)
            arguments.append(_argument(piece))
            piece = ""
        else:
            piece += letter
    return syntax.Type(name, tuple(arguments)) if not depth else syntax.Type(name)


def _argument(text: str) -> syntax.Type:
    """One template argument, with the marks of pointers, references and constants behind its name."""
    text = text.strip()
    is_constant = text.startswith("const ")
    found = written_type(text.removeprefix("const ").rstrip("*& "))
    marks = "".join(letter for letter in text[len(text.rstrip("*& ")) :] if letter in "*&")
    return found.marked("c" * is_constant + marks) if is_constant or marks else found
