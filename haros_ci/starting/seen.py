# SPDX-License-Identifier: Apache-2.0
"""What of a workspace decides how haros-ci is set up in it."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection

from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass

#: Directories that hold other people's code, by the names that have only that meaning.
VENDORED = frozenset(("third_party", "thirdparty", "third-party", "3rdparty", "3rd_party", "vendor", "vendored"))

#: Files that a generator writes and that are committed all the same.
GENERATED = ("*_pb2.py", "*_pb2_grpc.py", "*.pb.h", "*.pb.cc", "*_generated.h", "*_generated.hpp", "ui_*.h")

#: The settings of a tool that runs only if asked for: (tool, file name, what the file must hold).
CONFIGURED = (
    ("bandit", ".bandit", ""),
    ("bandit", "pyproject.toml", "[tool.bandit"),
    ("black", "pyproject.toml", "[tool.black"),
    ("clang-format", ".clang-format", ""),
    ("clang-format", "_clang-format", ""),
    ("cmakelint", ".cmakelintrc", ""),
    ("codespell", ".codespellrc", ""),
    ("codespell", "pyproject.toml", "[tool.codespell"),
    ("codespell", "setup.cfg", "[codespell"),
    ("flake8", ".flake8", ""),
    ("flake8", "setup.cfg", "[flake8"),
    ("flake8", "tox.ini", "[flake8"),
    ("hadolint", ".hadolint.yaml", ""),
    ("isort", ".isort.cfg", ""),
    ("isort", "pyproject.toml", "[tool.isort"),
    ("mypy", "mypy.ini", ""),
    ("mypy", ".mypy.ini", ""),
    ("mypy", "pyproject.toml", "[tool.mypy"),
    ("mypy", "setup.cfg", "[mypy"),
    ("shellcheck", ".shellcheckrc", ""),
    ("vulture", "pyproject.toml", "[tool.vulture"),
    ("yamllint", ".yamllint", ""),
    ("yamllint", ".yamllint.yaml", ""),
    ("yamllint", ".yamllint.yml", ""),
)


@dataclass(frozen=True, slots=True)
class Seen:
    """*packages* by the ROS version they are for (1, 2, None), *lines* of C++ and Python, *vendored* directories and
    *generated* globs to leave out, *tools* whose settings are there: (tool, path).
    """

    packages: tuple[tuple[int | None, int], ...]
    lines: tuple[tuple[str, int], ...]
    vendored: tuple[str, ...] = ()
    generated: tuple[str, ...] = ()
    tools: tuple[tuple[str, str], ...] = ()

    def in_words(self) -> str:
        """``3 packages (2 of ROS 2, 1 of ROS 1), 400 lines of C++, 200 lines of Python``; ``2 packages of ROS 1``."""
        total = sum(count for _, count in self.packages)
        kinds = [f"{count} of ROS {ros}" for ros, count in self.packages if ros is not None]
        packages = f"{total} package{'s' * (total != 1)}" + (f" ({', '.join(kinds)})" if kinds else "")
        if len(self.packages) == 1 and kinds:
            packages = f"{total} package{'s' * (total != 1)} of ROS {self.packages[0][0]}"
        names = {"cpp": "C++", "python": "Python"}
        code = [f"{count} lines of {names[language]}" for language, count in self.lines if count]
        return ", ".join((packages if total else "no package.xml", *code))


def look(workspace: Workspace, names: Collection[str], text: Callable[[str], str]) -> Seen:
    """What there is in *workspace*; *names* are the paths of its files, those of hidden ones at its root included."""
    from fnmatch import fnmatchcase

    counts: dict[int | None, int] = {}
    for package in workspace.packages:
        counts[package.ros] = counts.get(package.ros, 0) + 1
    code = [file for file in workspace.files if file.language in ("cpp", "python")]
    vendored = sorted({found for file in code if (found := _vendored(file.path))})
    own = [file.path.rpartition("/")[2] for file in code if _vendored(file.path) is None]
    generated = [glob for glob in GENERATED if any(fnmatchcase(name, glob) for name in own)]
    tools: dict[str, str] = {}
    for tool, name, section in CONFIGURED:
        if tool not in tools and name in names and section in text(name):
            tools[tool] = name
    return Seen(
        packages=tuple(sorted(counts.items(), key=lambda item: -(item[0] or 0))),
        lines=tuple((name, sum(f.lines for f in code if f.language == name)) for name in ("cpp", "python")),
        vendored=tuple(vendored),
        generated=tuple(generated),
        tools=tuple(sorted(tools.items())),
    )


def _vendored(path: str) -> str | None:
    """The outermost directory of *path* that holds other people's code."""
    parts = path.split("/")[:-1]
    for number, name in enumerate(parts):
        if name.lower() in VENDORED:
            return "/".join(parts[: number + 1])
    return None


def is_plain(text: str) -> bool:
    """Whether *text* can stand in YAML without quotes."""
    words = ("true", "false", "yes", "no", "on", "off", "null", "y", "n")
    return re.fullmatch(r"[A-Za-z][\w./-]*", text, re.ASCII) is not None and text.lower() not in words
