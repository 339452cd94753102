# SPDX-License-Identifier: Apache-2.0
"""Programs whose types, expressions and statements are tuples that are short to write: the tag and the fields; of a type its fields alone."""

from __future__ import annotations

from typing import Any

from haros_ci import syntax
from haros_ci.extract.cpp.read import read_cpp as typed_cpp
from haros_ci.extract.python.read import read_python as typed_python

_KEPT = (syntax.Program, syntax.Function, syntax.Class, syntax.Field, syntax.Alias, syntax.Parameter)


def shown(part: Any) -> Any:
    """*part* with nested tuples for what is in its functions, classes and variables."""
    if isinstance(part, tuple):
        return tuple(shown(each) for each in part)
    if not isinstance(part, syntax.Record):
        return part
    values = {name: shown(getattr(part, name)) for name in part.__struct_fields__}
    if isinstance(part, _KEPT):
        return syntax.replace(part, **values)
    tag = part.__struct_config__.tag
    inner = tuple(values.values())
    return inner if tag is None or isinstance(part, syntax.Type) else (tag, *inner)


def read_cpp(text: str) -> Any:
    """The Program of C++, with tuples."""
    return shown(typed_cpp(text))


def read_python(text: str) -> Any:
    """The Program of Python, with tuples."""
    return shown(typed_python(text))
