# SPDX-License-Identifier: Apache-2.0
"""What is installed for tests: packages of test support, and files that only tests use."""

from __future__ import annotations

import re
from posixpath import basename, splitext

from haros_ci.checking.project import Project, ProjectPackage

#: Names and descriptions of packages that are there for tests.
_NAMED = re.compile(
    r"(?:.*_)?(?:tests?|testing)(?:_(?:utils?|utilities|support|fixtures|helpers|tools|nodes|msgs|common))?"
)
_DESCRIBED = re.compile(
    r"\b(?:tests|(?:test|testing) (?:support|utilit(?:y|ies)|helpers?|fixtures?|tools?|nodes?)|(?:integration|system|end-to-end) tests?) "
    r"(?:for|of|and|to)\b|\b(?:used|needed|only) (?:for|by|in) (?:the )?(?:[\w-]+ )?tests\b",
    re.IGNORECASE,
)
#: Files that hold tests or what makes them, and those that only say something about files.
_TEST = re.compile(r"(?:^|/)tests?/|(?:^|/)(?:test_[^/]*|[^/]*_test|conftest|[^/]*[._]test)\.\w+$")
_MACROS = re.compile(r"(?:^|/)[^/]*test[^/]*\.cmake(?:\.in)?$", re.IGNORECASE)
_ABOUT = re.compile(r"(?:^|/)(?:package\.xml|setup\.(?:py|cfg)|pyproject\.toml|[^/]*\.(?:md|rst))$")
#: How people are told to start a program.
_STARTED = re.compile(r"\b(?:ros2 run|ros2 launch|rosrun|roslaunch|python3?)\b")
#: What may name a program or a module.
_NAMING: tuple[str, ...] = (
    ".py",
    ".launch",
    ".test",
    ".xml",
    ".md",
    ".rst",
    ".txt",
    ".sh",
    ".bash",
    ".service",
    ".yml",
    ".yaml",
    ".cfg",
    ".toml",
    ".cmake",
)
_NAMING += (".in", ".cpp", ".hpp", ".h", ".c", ".cc", ".json", ".desktop", ".ini")
_LARGEST = 300_000
_MOST_FILES = 20_000


def is_for_tests(package: ProjectPackage) -> bool:
    """Whether the name or the description of *package* says that it is there for tests."""
    texts = (
        (child.text for child in package.manifest.children if child.tag == "description") if package.manifest else ()
    )
    return _NAMED.fullmatch(package.name) is not None or any(_DESCRIBED.search(text[:500]) for text in texts)


def only_tests_use(package: ProjectPackage, path: str) -> bool:
    """Whether tests, or CMake macros for tests, name the Python file at *path* of *package*, and nothing else of the workspace does.

    What installs it, and text about it, does not count, unless the text says how to start it.
    """
    project = package.project
    stem = splitext(basename(path))[0]
    entries = {each.path for each in package.build.entry_points}
    if not stem or path in entries or len(project.workspace.names) > _MOST_FILES:
        return False
    word = re.compile(rf"(?<![\w-]){re.escape(stem)}(?![\w-])")
    found = [_is_by_tests(name, package, project, word) for name in project.workspace.names if name != path]
    return True in found and False not in found


def _is_by_tests(name: str, package: ProjectPackage, project: Project, word: re.Pattern[str]) -> bool | None:
    """Whether the file called *name* uses what *word* names for tests; None if it does not use it."""
    if not name.lower().endswith(_NAMING) and "." in basename(name):
        return None
    text = project.text(name)
    if len(text) > _LARGEST:
        return None
    lines = [text[text.rfind("\n", 0, at.start()) + 1 : at.end()] for at in word.finditer(text)]
    if not lines:
        return None
    if _TEST.search(name) or _MACROS.search(name):
        return True
    if _ABOUT.search(name) or name == package.inside("CMakeLists.txt"):
        return False if any(_STARTED.search(line[-300:]) for line in lines) else None
    return False
