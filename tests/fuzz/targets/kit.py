# SPDX-License-Identifier: Apache-2.0
"""What the targets share: how bytes become texts as in a run, workspaces of several files, and promises of results."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.content import examine
from haros_ci.workspace.files import decode
from haros_ci.workspace.language import language_of, script_language
from haros_ci.workspace.package_xml import parse_package

MANIFEST = """<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">a</maintainer><license>MIT</license><buildtool_depend>{tool}</buildtool_depend>
<depend>{client}</depend><depend>std_msgs</depend><export>{export}</export></package>"""
ROOT = Path("/nowhere")

#: Where a file begins in an input of several: ``@@ path``.
_FILE = re.compile(rb"^@@ ([\w./-]{1,80})[^\n]*\n", re.MULTILINE)


@dataclass(frozen=True)
class Entry:
    """A target. *what* says what is read, *modules* which of the program's modules are what is meant to be reached."""

    run: Callable[[bytes], object]
    what: str
    modules: tuple[str, ...]
    words: tuple[bytes, ...] = ()


@dataclass(frozen=True)
class Texts:
    """Reads what is in a dictionary."""

    texts: Mapping[str, bytes]

    def data(self, path: str) -> bytes | None:
        return self.texts.get(path)

    def head(self, path: str, length: int) -> bytes:
        return self.texts.get(path, b"")[:length]

    def text(self, path: str) -> str:
        data = self.texts.get(path, b"")
        return "" if b"\0" in data else decode(data)


def text_of(data: bytes, language: str = "yaml") -> str | None:
    """The text that a run would read of a file with these bytes; None for one that it passes over."""
    usable, _ = examine("file", language, data)
    return decode(data) if usable else None


def parts(data: bytes, default: str) -> dict[str, bytes]:
    """The files of an input: each after a line ``@@ path``, all of it under the name *default* without such lines."""
    found = list(_FILE.finditer(data))
    if not found:
        return {default: data}
    ends = [match.start() for match in found[1:]] + [len(data)]
    return {
        match[1].decode().strip("/"): data[match.end() : end]
        for match, end in zip(found, ends, strict=True)
        if not {"", ".", ".."} & set(match[1].decode().strip("/").split("/"))
    }


def ros_package(name: str = "bot", ros: int = 2) -> bytes:
    """The manifest of a package with C++ and Python."""
    tool, client = ("ament_cmake", "rclcpp") if ros == 2 else ("catkin", "roscpp")
    export = "<build_type>ament_cmake</build_type>" if ros == 2 else ""
    return MANIFEST.format(name=name, tool=tool, client=client, export=export).encode()


def workspace(files: Mapping[str, bytes]) -> Workspace:
    """A workspace of *files* as discovery would list them, nowhere on disk."""
    packages = []
    for path, data in sorted(files.items()):
        if path.rpartition("/")[2] == "package.xml":
            package = parse_package(path, data)
            if isinstance(package, Package) and package.name not in {other.name for other in packages}:
                packages.append(package)
    listed = []
    for path, data in sorted(files.items()):
        language = language_of(path.rpartition("/")[2]) or script_language(data[:200])
        if language is None or not examine(path, language, data)[0]:
            continue
        owners = [p for p in packages if p.path == "." or path.startswith(f"{p.path}/")]
        owner = max(owners, key=lambda p: len(p.path)).name if owners else None
        listed.append(SourceFile(path, language, len(data), hashlib.sha256(data).hexdigest(), owner))
    return Workspace(ROOT, tuple(packages), tuple(listed), Texts(files))


def sound(*problems: object) -> None:
    """Each problem has a message of one line, and a line of 1 or more if any."""
    for problem in problems:
        message, line = getattr(problem, "message"), getattr(problem, "line", None)  # noqa: B009
        assert isinstance(message, str) and message, problem
        assert "\n" not in message, problem
        assert line is None or line >= 1, problem


def refused(error: BaseException) -> str:
    """What a documented exception says: something."""
    assert str(error), repr(error)
    return str(error)
