# SPDX-License-Identifier: Apache-2.0
"""The files that descriptions are made of: where a file name leads, and what stands there, each file read once."""

from __future__ import annotations

import fnmatch
import posixpath
from collections.abc import Callable, Mapping

from haros_ci.model.build import NOT_KNOWN, WrittenFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.robot.nodes import XmlNode, nodes_of
from haros_ci.robot.unknown import UNKNOWN
from haros_ci.workspace.xml import XmlError, parse_xml

#: What ``$(find pkg)`` and the directory of a file become inside texts, so that they can be recognised again.
FIND = "/find:/"
HERE = "/here:/"
_PATTERN = regex(r"[*[?]")
MAX_STEPS = 3_000_000
MAX_PATTERN = 300


@dataclass(frozen=True, slots=True)
class Located:
    """Where a file name leads: *path* in the workspace, None if it is not there or not known; *is_missing* if it certainly is not."""

    path: str | None = None
    is_missing: bool = False
    similar: tuple[str, ...] = ()


#: Looks up ``package``, path inside its share directory.
Look = Callable[[str, str], Located]


def why_unread(text: str) -> tuple[str, int | None]:
    """Why *text* is no XML that is read here, and in which line."""
    try:
        nodes_of(parse_xml(text.encode("utf-8")), "")
    except XmlError as err:
        return err.message, err.line
    except RecursionError:
        return "its tags are nested too deeply", None
    except UnicodeEncodeError:
        pass
    return "it is no text in UTF-8", None


@dataclass(slots=True)
class DescriptionSources:
    """Reads for expansions. *packages* are the directories of the workspace's packages by name."""

    workspace: Workspace
    look: Look
    #: Files that builds write, by their paths.
    written: Mapping[str, WrittenFile] = field(default_factory=dict)
    packages: Mapping[str, str] = field(init=False)
    names: frozenset[str] = field(init=False)
    #: What is left for all expansions together.
    steps: int = field(default=MAX_STEPS, init=False)
    problems: dict[str, Problem] = field(default_factory=dict, init=False)
    _nodes: dict[str, XmlNode | None] = field(default_factory=dict, init=False)
    _inside: dict[str, list[str]] = field(default_factory=dict, init=False)
    _owners: dict[str, tuple[str, str] | None] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        self.packages = {package.name: package.path for package in self.workspace.packages}
        self.names = self.workspace.names | {file.path for file in self.workspace.files} | set(self.written)

    def read(self, path: str) -> XmlNode | None:
        """The root element of an XML file; None if it cannot be read, or is not for us."""
        if path not in self._nodes:
            text = self.text(path)
            made = self.written.get(path)
            root = self.parsed(text, path if made is None else made.template)
            self._nodes[path] = root if made is None or root is None else _with_unknowns(root)
            if made is None and self._nodes[path] is None and "<robot" in text:
                message, line = why_unread(text)
                self.problems[path] = Problem(path, f"not read as a description of a robot: {message}", line)
        return self._nodes[path]

    def parsed(self, text: str, path: str) -> XmlNode | None:
        """The root element of *text*, whose places are given in the file *path*; None if it is no XML."""
        try:
            return nodes_of(parse_xml(text.encode("utf-8")), path) if text else None
        except (XmlError, RecursionError, UnicodeEncodeError):
            return None

    def text(self, path: str) -> str:
        """The text of a file as it is once the packages are built."""
        return self.written[path].text if path in self.written else self.workspace.text(path)

    def locate(self, name: str, base: str) -> Located:
        """Where the file name *name*, as evaluated in the file *base*, leads."""
        if name.startswith("file://"):
            name = name.removeprefix("file://")
        if name.startswith(FIND):
            package, _, inner = name[len(FIND) :].partition("/")
            if package not in self.packages or not inner.strip("/") or "?" in inner:
                return Located()
            return self.look(package, posixpath.normpath(inner))
        if name.startswith(HERE.rstrip("/")):
            name = name[len(HERE) :].lstrip("/")
        elif name.startswith("/"):
            return Located()
        else:
            name = posixpath.join(posixpath.dirname(base), name)
        path = posixpath.normpath(name)
        if path.startswith(".."):
            return Located()
        if path in self.names:
            return Located(path)
        owner = self._owner(path)
        if owner is None:
            return Located()
        inner = path if owner[1] == "." else path[len(owner[1]) + 1 :]
        return self.look(owner[0], inner)

    def _owner(self, path: str) -> tuple[str, str] | None:
        """Name and path of the package around *path*."""
        folder = path.rpartition("/")[0]
        if folder not in self._owners:
            around = (p for p in self.packages.items() if p[1] == "." or f"{folder}/".startswith(p[1] + "/"))
            self._owners[folder] = max(around, key=lambda p: len(p[1]), default=None)
        return self._owners[folder]

    def mesh(self, name: str, base: str) -> Located:
        """Where the file name of a mesh leads: ``package://pkg/…`` or ``file://…``; others depend on who reads them."""
        if name.startswith("package://"):
            return self.locate(FIND + name.removeprefix("package://"), base)
        if name.startswith("file://"):
            return self.locate(name, base)
        return Located()

    def matching(self, name: str, base: str, spend: Callable[[int], None]) -> tuple[str, ...] | None:
        """The files that the pattern *name* stands for, sorted; None if that is not known, or *name* is no pattern."""
        if not _PATTERN.search(name):
            return None
        folder, _, pattern = name.rpartition("/")
        if _PATTERN.search(folder) or len(pattern) > MAX_PATTERN:
            return ()
        start = self._directory(folder, base)
        if start is None:
            return ()
        start = "" if start == "." else start
        if not self._inside:
            for path in sorted(self.names):
                self._inside.setdefault(path.rpartition("/")[0], []).append(path)
        inside = self._inside.get(start, [])
        spend(len(inside))
        return tuple(path for path in inside if fnmatch.fnmatchcase(posixpath.basename(path), pattern))

    def _directory(self, folder: str, base: str) -> str | None:
        if folder.startswith(FIND):
            package, _, inner = folder[len(FIND) :].partition("/")
            start = self.packages.get(package)
            return None if start is None else posixpath.normpath(posixpath.join(start, inner))
        if folder.startswith("/"):
            return None
        return posixpath.normpath(posixpath.join(posixpath.dirname(base), folder))


def _with_unknowns(root: XmlNode) -> XmlNode:
    """*root* with what is not known in a written file as what it is."""
    for node in (root, *root.walk()):
        for name, value in node.attributes.items():
            if isinstance(value, str) and NOT_KNOWN in value:
                node.attributes[name] = UNKNOWN
        if isinstance(node.text, str) and NOT_KNOWN in node.text:
            node.text = UNKNOWN
    return root


def by_names(workspace: Workspace) -> Look:
    """Looks for files in the source directories of packages alone; what is not there may be made by a build."""
    packages = {package.name: package.path for package in workspace.packages}
    names = workspace.names | {file.path for file in workspace.files}

    def look(package: str, inner: str) -> Located:
        path = posixpath.normpath(posixpath.join(packages[package], inner))
        return Located(path) if path in names else Located()

    return look


def as_written(name: str) -> str:
    """A file name as a person writes it."""
    start, mark, rest = name.partition(FIND)
    if mark:
        package, _, inner = rest.partition("/")
        return f"{start}$(find {package})/{inner}"
    return name.replace(HERE, "")
