# SPDX-License-Identifier: Apache-2.0
"""Finding tools: first beside this interpreter, then on PATH; never in the workspace."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryFile

from haros_ci.linters.linter import LintOptions, Program
from haros_ci.linters.process import environment, kill_group, search_path, small_files
from haros_ci.records import dataclass

#: How to get what does not come with haros-ci itself.
HOW = {
    **dict.fromkeys(
        (
            *("bandit", "black", "clang-format", "cmake-lint", "cmakelint", "codespell", "flake8", "flawfinder"),
            *("hadolint", "isort", "mypy", "shellcheck", "vulture", "yamllint"),
        ),
        "pip install 'haros-ci[linters]'",
    ),
    **{name: f"pip install {name}" for name in ("catkin_lint", "clang-tidy", "ruff")},
    "xmllint": "Debian's package libxml2-utils",
}


@dataclass(frozen=True, slots=True)
class InstalledDistribution:
    """An installed Python distribution: the directory that it lies in, and its version."""

    directory: Path
    version: str


def distribution(name: str) -> InstalledDistribution | None:
    """The distribution *name* for this interpreter, by its ``.dist-info`` directory.

    Reading the directory is much faster than importlib.metadata. Only absolute ``site-packages`` count: ``python -m``
    puts the current directory, which may be the workspace, at the head of sys.path.
    """
    for entry in sys.path:
        if not os.path.isabs(entry) or os.path.basename(entry) not in ("site-packages", "dist-packages"):
            continue
        for found in sorted(_listing(entry)):
            head, _, version = found.removesuffix(".dist-info").partition("-")
            if found.endswith(".dist-info") and head.lower() == name:
                return InstalledDistribution(Path(entry), version)
    return None


def python_tool(name: str, worker: str) -> Program | None:
    """The Python tool *name*, started through our script *worker* in isolated mode.

    The script's first argument is the directory that holds the tool, which isolated mode hides if it is the user's.
    """
    found = distribution(name)
    if found is None or not sys.executable:
        return None
    script = str(Path(__file__).with_name(worker))
    return Program((sys.executable, "-I", "-X", "utf8", script, str(found.directory)), found.version)


def python_module(name: str, options: LintOptions, module: str = "") -> Program | None:
    """The Python tool *name* as ``python -m module`` would start it, but isolated from the workspace unless it is trusted."""
    program = python_tool(name, "isolation.py")
    trusted = ("--trusted",) if options.trust_config else ()
    return program and Program((*program.argv, *trusted, module or name), program.version)


def providers(*groups: str) -> tuple[str, ...]:
    """The installed distributions with entry points of *groups*, as ``name-version``: the plug-ins of a tool, sorted."""
    found = set()
    for entry in sys.path:
        if os.path.isabs(entry) and os.path.basename(entry) in ("site-packages", "dist-packages"):
            for name in _listing(entry):
                if name.endswith(".dist-info") and _provides(os.path.join(entry, name, "entry_points.txt"), groups):
                    found.add(name.removesuffix(".dist-info"))
    return tuple(sorted(found))


def _provides(path: str, groups: tuple[str, ...]) -> bool:
    try:
        with open(path, encoding="utf-8", errors="replace") as stream:
            text = stream.read(100_000)
    except OSError:
        return False
    return any(f"[{group}]" in text for group in groups)


def binary(name: str, options: LintOptions, beside: str = "") -> Program | None:
    """The native program *name*: *beside* this interpreter's packages, among its scripts, or on PATH."""
    candidates = [os.path.join(sys.prefix, "bin", name)]
    if beside and (found := distribution(name)) is not None:
        candidates.insert(0, str(found.directory / beside))
    candidates += [os.path.join(directory, name) for directory in search_path(os.environ, options.root)]
    for path in candidates:
        if os.path.isfile(path) and os.access(path, os.X_OK):
            version = version_of(path)
            if version is not None:
                return Program((path,), version)
    return None


def on_path(name: str, options: LintOptions) -> str | None:
    """The program *name* among this interpreter's scripts or on PATH, whether or not it tells its version."""
    for directory in (os.path.join(sys.prefix, "bin"), *search_path(os.environ, options.root)):
        path = os.path.join(directory, name)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
    return None


def version_of(path: str) -> str | None:
    """The first number with a dot that ``--version`` prints, else (xmllint) the word after ``version``, "" if there is none.

    None if the program does not run.
    """
    with TemporaryFile() as stdout, TemporaryFile() as stderr:
        try:
            with small_files():  # it may take no notice of --version, and write for ever
                process = subprocess.Popen(
                    [path, "--version"],
                    stdin=subprocess.DEVNULL,
                    stdout=stdout,
                    stderr=stderr,
                    cwd="/",
                    env=environment(os.environ, Path("/nonexistent"), Path("/nonexistent")),
                    start_new_session=True,
                )
        except OSError:
            return None
        try:
            code = process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            return None
        finally:
            kill_group(process)
            process.wait()
        if code != 0:
            return None
        stdout.seek(0)
        stderr.seek(0)
        words = (stdout.read(4000) + b"\n" + stderr.read(4000)).decode("utf-8", "replace").split()
    for word in words:
        if word[:1].isdigit() and "." in word:
            return word.rstrip(",;")
    return next((word for before, word in zip(words, words[1:]) if before == "version" and word.isdigit()), "")


def _listing(directory: str) -> list[str]:
    try:
        return os.listdir(directory)
    except OSError:
        return []
