# SPDX-License-Identifier: Apache-2.0
"""XML files as C++ programs read them with tinyxml2 (tinyxml2.h), and the files of a directory (std::filesystem)."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.trace import XML_FILES
from haros_ci.model.launch import LaunchElement
from haros_ci.values.abstract import NONE, Cell, Known, Library, Object, Opaque, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

DOCUMENT, ELEMENT = "tinyxml2::XMLDocument", "tinyxml2::XMLElement"
CLASSES = frozenset((DOCUMENT, ELEMENT))
SUCCESS = Library("tinyxml2::XML_SUCCESS")
#: Fields of a document and of an element: its root; itself, the elements beside it and its place among them.
ROOT, SELF, BESIDE, PLACE = "(root)", "(self)", "(beside)", "(place)"
#: Longer directories are not gone through.
MOST = 64


def method(
    walk: Walk,
    frame: Frame,
    receiver: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...] = (),
) -> Value | None:
    """A method of a document or element; None if there is no model of it."""
    texts = [argument.value.value if isinstance(argument.value, Known) else None for argument in args]
    if receiver.name == DOCUMENT:
        return _document(walk, frame, receiver, name, texts)
    if SELF not in receiver.fields:
        return None
    element = _held(receiver, SELF)
    if not isinstance(element, LaunchElement):
        return None
    if name in ("Name", "Value") and not args:
        return Known(element.tag)
    if name == "GetText" and not args:
        return Known(element.text) if element.text else NONE
    if name == "Attribute" and len(args) == 1:
        return _text(element.get(texts[0])) if isinstance(texts[0], str) else walk.opaque("an attribute", frame)
    if name == "FirstChildElement" and all(isinstance(text, str) for text in texts):
        return _first(element.children, 0, texts[0] if texts else "")
    if name == "NextSiblingElement" and all(isinstance(text, str) for text in texts):
        beside, place = _held(receiver, BESIDE), _held(receiver, PLACE)
        if isinstance(beside, tuple) and isinstance(place, int):
            return _first(beside, place + 1, texts[0] if texts else "")
    return None


def _document(walk: Walk, frame: Frame, document: Object, name: str, texts: list[object]) -> Value | None:
    if name == "LoadFile" and len(texts) == 1:
        reader, path = walk.context.xml, texts[0]
        if walk.index.trace is not None:
            walk.index.trace.paths.add(XML_FILES)
        root = reader.root(path) if reader is not None and isinstance(path, str) else None
        unknown = walk.opaque("the XML file is not in the workspace", frame, None, syntax.Type(ELEMENT, (), "*"))
        value = unknown if root is None else _element((root,), 0)
        cell = document.fields.setdefault(ROOT, Cell(NONE))
        walk.state.write(cell, value)
        return SUCCESS if root is not None else walk.opaque("whether an XML file is read", frame)
    if name == "RootElement" and ROOT in document.fields:
        return document.fields[ROOT].value
    if name == "FirstChildElement" and ROOT in document.fields:
        root_value = document.fields[ROOT].value
        first = _held(root_value, SELF)
        is_named = isinstance(first, LaunchElement) and texts in ([], [first.tag])
        return root_value if is_named or isinstance(root_value, Opaque) else None
    return None


def _held(element: Value, name: str) -> object:
    """What a member of an element stands for; None where that is not known."""
    value = element.fields[name].value if isinstance(element, Object) else None
    return value.value if isinstance(value, Known) else None


def _text(value: str | None) -> Value:
    return Known(value) if value is not None else NONE


def _element(beside: tuple[LaunchElement, ...], place: int) -> Object:
    fields: dict[str, Cell] = {
        SELF: Cell(Known(beside[place])),
        BESIDE: Cell(Known(beside)),
        PLACE: Cell(Known(place)),
    }
    return Object(ELEMENT, fields=fields)


def _first(elements: tuple[LaunchElement, ...], start: int, tag: object) -> Value:
    """The first of *elements* from *start* on, of that *tag* unless it is empty; null if there is none."""
    for place in range(start, len(elements)):
        if tag in ("", elements[place].tag):
            return _element(elements, place)
    return NONE


def directory(walk: Walk, value: Value) -> Value | None:
    """``directory_iterator(path)`` as a list of paths; None where these are not known, or too many."""
    reader = walk.context.xml
    if reader is None or not isinstance(value, Known) or not issubclass(value.kind, str):
        return None
    if walk.index.trace is not None:
        walk.index.trace.paths.add(XML_FILES)
    found = reader.directory(value.of(str))
    if not found or len(found) > MOST:
        return None
    return Sequence(Cell(tuple(Cell(Known(path), syntax.Type("std::filesystem::path")) for path in found)))


def part(path: str, name: str) -> str | None:
    """A part of a path by the method of ``std::filesystem::path``, or of a directory's entry, that gives it."""
    base = posixpath.basename(path)
    stem, dot, extension = base.rpartition(".")
    has_extension = bool(dot and stem)
    return {
        "path": path,
        "string": path,
        "filename": base,
        "extension": f".{extension}" if has_extension else "",
        "stem": stem if has_extension else base,
        "parent_path": posixpath.dirname(path),
    }.get(name)
