# SPDX-License-Identifier: Apache-2.0
"""Parameter files rewritten before they are read, as nav2_common's RewrittenYaml does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any

from haros_ci.launch.ros2.parameter_yaml import REMEMBERED, Items, Map, Scalar, Tree, dumped, python_value
from haros_ci.model.digits import whole_number
from haros_ci.substitutions.names import Text

_NO_TEXT = ("int", "float", "bool", "null")


def rewritten_names(how: Mapping[str, Any]) -> tuple[Text, ...]:
    """What decides which values and sections are rewritten: all keys, and the root."""
    keys = tuple(key for name in ("rewrites", "key_rewrites", "value_rewrites") for key, _ in how[name])
    news = tuple(value for _, value in how["key_rewrites"])
    return keys + news + (() if how["root_key"] is None else (how["root_key"],))


def rewrite(trees: tuple[Tree, ...], how: Mapping[str, Any]) -> tuple[Tree, ...]:
    """The first document of *trees* rewritten as *how* says; *trees* stay as they are.

    *how* has ``rewrites``, ``key_rewrites``, ``value_rewrites`` (pairs of texts), ``root_key`` and ``convert_types``.
    Values are replaced by the last part of their key, then by the whole dotted path; paths with ``ros__parameters``
    that are not there are added; then keys, then equal values; at last all is put below the root key. All texts of
    ``rewritten_names`` are known.
    """
    top: Tree = trees[0] if trees else Map({}, 1)
    if not isinstance(top, Map):
        return trees
    top = _written(top)
    assert isinstance(top, Map)
    convert = bool(how["convert_types"])
    rewrites = {key.raw: value for key, value in how["rewrites"]}
    for holder, key in list(_keys(top)):
        if key in rewrites:
            holder.entries[key] = _converted(rewrites[key], holder.entries[key].line, convert)
    paths = dict(_paths(top, ""))
    for path, line in paths.items():
        if path in rewrites:
            _put(top, path.split("."), _converted(rewrites[path], line, convert))
    for path, value in rewrites.items():
        if path not in paths and "ros__parameters" in path.split("."):
            _put(top, path.split("."), _converted(value, top.line, convert))
    names = {key.raw: value for key, value in how["key_rewrites"]}
    if names:
        _rename(top, names)
    values = {key.raw: value for key, value in how["value_rewrites"]}
    if values:
        top = _replace(top, values, convert)
    root = how["root_key"]
    if root is not None and root.raw:
        top = Map({root.shown: top}, 1)
    return (top,)


def _written(tree: Tree) -> Tree:
    """A copy as PyYAML reads and writes it again: numbers and truths in its own notation."""
    if isinstance(tree, Map):
        return Map({key: _written(value) for key, value in tree.entries.items()}, tree.line)
    if isinstance(tree, Items):
        return Items([_written(item) for item in tree.items], tree.line)
    return _again(tree) if tree.is_plain and not tree.reasons and tree.tag in _NO_TEXT else tree


@lru_cache(maxsize=REMEMBERED)
def _again(scalar: Scalar) -> Scalar:
    _, value, reason = python_value(scalar)
    return dumped(value, scalar.line) if not reason or scalar.tag == "null" else scalar


def _keys(top: Map) -> Iterator[tuple[Map, str]]:
    """Every key with the map that holds it, inner ones first."""
    for key, value in list(top.entries.items()):
        if isinstance(value, Map):
            yield from _keys(value)
        yield top, key


def _paths(tree: Tree, path: str) -> Iterator[tuple[str, int]]:
    start = path + "." if path else ""
    if isinstance(tree, Map):
        for key, value in tree.entries.items():
            yield from _paths(value, start + key)
    elif isinstance(tree, Items):
        for index, item in enumerate(tree.items):
            yield from _paths(item, f"{start}{index}")
    else:
        yield path, tree.line


def _put(tree: Tree, keys: list[str], value: Scalar) -> None:
    """Set what is at *keys*, maps on the way are made; a way through a scalar is left alone."""
    for key in keys[:-1]:
        if isinstance(tree, Map):
            tree = tree.entries.setdefault(key, Map({}, tree.line))
        elif isinstance(tree, Items) and (index := whole_number(key)) is not None and index < len(tree.items):
            tree = tree.items[index]
        else:
            return
    last = keys[-1]
    if isinstance(tree, Map):
        tree.entries[last] = value
    elif isinstance(tree, Items) and (index := whole_number(last)) is not None and index < len(tree.items):
        tree.items[index] = value


def _rename(top: Map, names: Mapping[str, Text]) -> None:
    for key, value in list(top.entries.items()):
        if key in names:
            top.entries[names[key].shown] = top.entries.pop(key)
        if isinstance(value, Map):
            _rename(value, names)


def _replace(tree: Any, values: Mapping[str, Text], convert: bool) -> Any:
    if isinstance(tree, Map):
        return Map({key: _replace(value, values, convert) for key, value in tree.entries.items()}, tree.line)
    if isinstance(tree, Items):
        return Items([_replace(item, values, convert) for item in tree.items], tree.line)
    shown = {"true": "True", "false": "False"}.get(tree.text, tree.text) if tree.is_plain else tree.text
    return _converted(values[shown], tree.line, convert) if shown in values and not tree.reasons else tree


def _converted(text: Text, line: int, convert: bool) -> Scalar:
    """The text that a value is replaced by: a number where types are converted, true and false always."""
    if not text.known:
        return Scalar(text.raw, line, reasons=text.reasons)
    raw = text.raw
    if convert and len(raw) < 100:
        try:
            return dumped(float(raw) if "." in raw else int(raw), line)
        except ValueError:
            pass
    if raw.lower() in ("true", "false"):
        return dumped(raw.lower() == "true", line)
    return dumped(raw, line)
