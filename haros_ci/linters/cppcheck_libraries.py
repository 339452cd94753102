# SPDX-License-Identifier: Apache-2.0
"""Which of cppcheck's libraries a file is read with: those whose headers or macros it has, or a header that it includes.

A library gives names a meaning: that of Qt makes nothing of ``slots``, ``signals``, ``emit`` and ``foreach``, so that
a file without Qt that
calls a member ``slots`` cannot be read with it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from haros_ci.linters.includes import name_of
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_LINTERS, digest
from haros_ci.regex import regex

#: Stands beside the libraries of a text that switches Qt's plain words off (doc.qt.io, "Signals & Slots", "Using Qt
#: with 3rd Party Signals
#: and Slots"): then only its macros in capitals count, which ros_macros.py has.
NO_KEYWORDS = "!qt"

#: By library, as cppcheck calls it (those of Catch2 and GoogleTest are ours, in ros_macros.py): its headers; and
#: macros that mean nothing else, for what comes with headers of other packages.
_HEADERS = {
    "boost": regex(r"boost/"),
    "catch2": regex(r"(?:.*/)?catch(?:2/.*|_test_macros|_all)?(?:\.hpp)?$|catch2/"),
    "googletest": regex(r"(?:gtest|gmock)/|(?:gtest|gmock)\b"),
    "python": regex(r"Python\.h$|boost/python|pybind11/"),
    # Qt's own are named QWidget, QtWidgets/QWidget or qwidget.h; those of RViz and rqt bring them along.
    "qt": regex(
        r"Q[A-Z]\w*$|Qt\w*(?:/|$)|(?:.*/)?ui_\w+\.h|rviz(?:_common|_rendering|_default_plugins)?/|rqt_\w+/|qwt[/_]"
        r"|q(?:action|application|color|dialog|event|image|label|layout|mainwindow|object|painter|pixmap|pushbutton|string|thread"
        r"|timer|variant|widget)\.h$"
    ),
}
_MACROS = {
    "boost": regex(r"\bBOOST_[A-Z_]+\b"),
    "catch2": regex(r"^(?:SCENARIO|TEST_CASE)(?:_METHOD)?[ \t]*\([^)\n]*\"", re.MULTILINE),
    "googletest": regex(r"^(?:TYPED_)?TEST(?:_[FP])?[ \t]*\(", re.MULTILINE),
    "python": regex(r"\bPyObject\b"),
    "qt": regex(
        r"\bQ_OBJECT\b|\b(?:public|protected|private)[ \t]+(?:slots|Q_SLOTS)[ \t]*:|^[ \t]*(?:signals|Q_SIGNALS)[ \t]*:",
        re.MULTILINE,
    ),
}
_SWITCHED_OFF = regex(r"QT_NO_KEYWORDS\b")


def by_file(
    workspace: Workspace, files: Iterable[SourceFile], directives: Mapping[str, Iterable[str]], store: Store
) -> dict[str, frozenset[str]]:
    """The libraries that each of *files* itself asks for; *directives* are the names that it includes, by path.

    What the text tells comes from the store, by its digest.
    """
    files = tuple(files)
    stored = store.get("libraries", "", digest(OF_LINTERS))
    known = stored if isinstance(stored, dict) else {}
    found: dict[str, list[str]] = {}
    libraries: dict[str, frozenset[str]] = {}
    for file in files:
        marks = known.get(file.digest)
        if not isinstance(marks, list) or not all(isinstance(mark, str) for mark in marks):
            marks = _by_macros(workspace.text(file.path))
        found[file.digest] = marks
        headers = tuple(map(name_of, directives.get(file.path, ())))
        included = {name for name, pattern in _HEADERS.items() if any(pattern.match(header) for header in headers)}
        libraries[file.path] = frozenset(included.union(marks) & {*_HEADERS, NO_KEYWORDS})
    if found.keys() - known.keys():
        store.put("libraries", "", digest(OF_LINTERS), found)
    return libraries


def switched_off(workspace: Workspace) -> frozenset[str | None]:
    """The packages whose CMake files switch Qt's plain words off."""
    return frozenset(
        file.package
        for file in workspace.files
        if file.language == "cmake" and _SWITCHED_OFF.search(workspace.text(file.path))
    )


def together(libraries: Iterable[Iterable[str]], *, no_keywords: bool = False) -> tuple[str, ...]:
    """The libraries for a file, sorted, from what it and all that it includes ask for.

    NO_KEYWORDS among them says that Qt's plain words have no meaning.
    """
    every = {library for item in libraries for library in item}
    if no_keywords or NO_KEYWORDS in every:
        every = every | {NO_KEYWORDS} if "qt" in every else every - {NO_KEYWORDS}
    return tuple(sorted(every))


def _by_macros(text: str) -> list[str]:
    found = [name for name, pattern in _MACROS.items() if pattern.search(text)]
    return sorted((*found, *([NO_KEYWORDS] if _SWITCHED_OFF.search(text) else ())))
