# SPDX-License-Identifier: Apache-2.0
"""What is installed for tests: packages of test support, and files that only tests use."""

from __future__ import annotations

import re
from collections.abc import Iterable
from posixpath import basename, splitext

from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.regex import regex

#: Names and descriptions of packages that are there for tests.
_NAMED = regex(r"(?:.*_)?(?:tests?|testing)(?:_(?:utils?|utilities|support|fixtures|helpers|tools|nodes|msgs|common))?")
_DESCRIBED = regex(
    r"\b(?:tests|(?:test|testing) (?:support|utilit(?:y|ies)|helpers?|fixtures?|tools?|nodes?)|(?:integration|system|end-to-end) tests?) "
    r"(?:for|of|and|to)\b|\b(?:used|needed|only) (?:for|by|in) (?:the )?(?:[\w-]+ )?tests\b",
    re.IGNORECASE,
)
#: Files that hold tests or what makes them, and those that only say something about files.
_TEST = regex(r"(?:^|/)tests?/|(?:^|/)(?:test_[^/]*|[^/]*_test|conftest|[^/]*[._]test)\.\w+$")
_MACROS = regex(r"(?:^|/)[^/]*test[^/]*\.cmake(?:\.in)?$", re.IGNORECASE)
_ABOUT = regex(r"(?:^|/)(?:package\.xml|setup\.(?:py|cfg)|pyproject\.toml|[^/]*\.(?:md|rst))$")
#: Commands by which documentation starts a program.
_STARTED = regex(r"\b(?:ros2 run|ros2 launch|rosrun|roslaunch|python3?)\b")
#: What may name a program or a module.
_NAMING = tuple(
    f".{ending}"
    for ending in (
        "py launch test xml md rst txt sh bash service yml yaml cfg toml cmake in cpp hpp h c cc json desktop ini".split()
    )
)
_LARGEST = 300_000
_MOST_FILES = 20_000


def is_for_tests(package: ProjectPackage) -> bool:
    """Whether the name or the description of *package* says that it is there for tests."""
    texts = (
        (child.text for child in package.manifest.children if child.tag == "description") if package.manifest else ()
    )
    return _NAMED.fullmatch(package.name) is not None or any(_DESCRIBED.search(text[:500]) for text in texts)


def only_for_tests(package: ProjectPackage, paths: Iterable[str]) -> frozenset[str]:
    """Those of *paths*, Python files of *package*, that tests or CMake macros for tests name, and nothing else of the workspace does.

    What installs them, and text about them, does not count, unless the text says how to start them. Every file is read once.
    """
    project = package.project
    words = _words(package, paths)
    if not words or len(project.workspace.names) > _MOST_FILES:
        return frozenset()
    found: dict[str, set[bool | None]] = {path: set() for path in words}
    for name in sorted(project.workspace.names):
        text = _naming(project, name)
        for path, by_tests in found.items() if text else ():
            by_tests.add(_is_by_tests(name, text, package, words[path]) if name != path else None)
    return frozenset(path for path, by_tests in found.items() if by_tests - {None} == {True})


def _words(package: ProjectPackage, paths: Iterable[str]) -> dict[str, re.Pattern[str]]:
    """What names each of *paths* in a text: its stem as a word. Entry points are left out: they are installed by their own name."""
    entries = {entry_point.path for entry_point in package.build.entry_points}
    stems = {path: splitext(basename(path))[0] for path in paths if path not in entries}
    return {path: re.compile(rf"(?<![\w-]){re.escape(stem)}(?![\w-])") for path, stem in stems.items() if stem}


def _naming(project: Project, name: str) -> str:
    """The text of a file that may name a program or a module; "" for others, and for large ones."""
    if not name.lower().endswith(_NAMING) and "." in basename(name):
        return ""
    text = project.text(name)
    return text if len(text) <= _LARGEST else ""


def _is_by_tests(name: str, text: str, package: ProjectPackage, word: re.Pattern[str]) -> bool | None:
    """Whether the file called *name* uses what *word* names for tests; None if it does not use it."""
    lines = [text[text.rfind("\n", 0, at.start()) + 1 : at.end()] for at in word.finditer(text)]
    if not lines:
        return None
    if _TEST.search(name) or _MACROS.search(name):
        return True
    if _ABOUT.search(name) or name == package.inside("CMakeLists.txt"):
        return False if any(_STARTED.search(line[-300:]) for line in lines) else None
    return False
