# SPDX-License-Identifier: Apache-2.0
"""cpplint: the Google C++ style guide, all categories; CPPLINT.cfg files inside the workspace are honoured."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from posixpath import dirname, join

from haros_ci.linters import installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.digits import whole_number
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.comments import comments
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "cpplint"
LANGUAGES = frozenset({"cpp"})
WHEN = When.ALWAYS
COST = 12.0

CONFIG = "CPPLINT.cfg"
#: ROS 1 allows 120 columns and ROS 2 asks for 100 (their C++ style guides); a CPPLINT.cfg may say otherwise.
LINE_LENGTH = {1: 120, 2: 100, None: 100}
HEADERS = "h,hh,hpp,hxx,h++,cuh"
SUFFIXES = frozenset("c cc cpp cxx c++ h hh hpp hxx h++ ipp tpp txx inl cu cuh".split())

#: What stands for a letter that could not be read.
LOST = "\ufffd"

#: Suffixes of files that exist to be included: templates outside of their header, tables, CUDA.
_PARTS = (".cu", ".cuh", ".ipp", ".tpp", ".txx", ".ixx", ".inl", ".impl", ".inc", ".def", ".icc")
#: The address of a member of what a cast pointer points to, and that of a cast.
_MEMBER = regex(r"&\s?\(\s?\([^()]{1,200}\*\s?\)[^()]{1,200}(?:\([^()]{0,200}\))?\s?\)\s?(?:->|\[)")
#: How far a member lies in a class, as macros without offsetof() find it: ``&(((T *)0)->member)``, ``&((T *)(1))->member``.
_OFFSET = regex(
    r"&\s?(?:\(\s?){1,4}[^()]{1,200}\*\s?\)\s?\(?\s?(?:0x[\da-fA-F]+|\d+|NULL|nullptr)[uUlL]{0,3}\s?\)[\s)]{0,8}->"
)
_CAST = regex(r"&\s?(?:\([\w:<>, ]{1,200}\)\s?\w|(?:static|dynamic|reinterpret|down)_cast\b)")
_ADDRESS = regex(r"&\s?\(")
_LINE = regex(r"(\d+|None):  (.*)  \[([\w/+]+)\] \[(\d)\]$", re.DOTALL)


def locate(options: LintOptions) -> Program | None:
    return installed.python_tool("cpplint", "cpplint_worker.py")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # its settings are all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Groups by configuration, for a CPPLINT.cfg would act on the files after it, and by root of header guards."""
    packages = {package.name: package for package in workspace.packages}
    configs: dict[str, tuple[str, ...]] = {}
    stems: dict[str, list[str]] = {}
    for file in workspace.files:
        if file.language in LANGUAGES:
            stems.setdefault(file.path.rpartition(".")[0], []).append(file.path)
    for file in workspace.files:
        if file.language not in LANGUAGES:
            continue
        directory = dirname(file.path)
        if directory not in configs:
            configs[directory] = tuple(_settings(workspace, directory))
        package = packages.get(file.package or "")
        root = _guard_root(package.path, file.path) if package is not None else ""
        length = LINE_LENGTH.get(package.ros if package is not None else None, 100)
        group = json.dumps([root, length, *configs[directory]])
        beside = "\0".join(
            stems[file.path.rpartition(".")[0]]
        )  # the header of a source is looked for, by its name alone
        yield Unit(file, group=group, salt=beside, settings=configs[directory])


def command(program: Program, batch: Batch) -> Command:
    """Names go in through stdin and begin with ``./``, so that none can be taken for an option; so do the settings."""
    root, length, *configs = json.loads(batch.group)
    suffixes = {file.path.rpartition(".")[2] for file in batch.files}
    options = [
        "--verbose=0",
        "--filter=+build/include_alpha",
        f"--linelength={length}",
        "--repository=.",
        f"--headers={HEADERS}",
        f"--extensions={','.join(sorted(SUFFIXES | suffixes))}",
        *([f"--root={root}"] if root else []),
    ]
    settings = {path: batch.workspace.setting(path) for path in configs}
    request = {"files": ["./" + file.path for file in batch.files], "settings": settings}
    return Command((*program.argv, *options), stdin=json.dumps(request).encode())


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """Lines ``./path:12:  message  [category] [confidence]``; cpplint also says when it is done with each file."""
    text = output.stdout.decode("utf-8", "replace") + "\n" + output.stderr.decode("utf-8", "replace")
    paths = {file.path for file in batch.files}
    done = set(re.findall(r"^Done processing \./(.*)$", text, re.MULTILINE))
    done.update(re.findall(r'^Ignoring "?\./(.*?)(?:": file excluded by|; not a valid file name)', text, re.MULTILINE))
    stopped = paths & set(re.findall(r"^Stopped processing \./(.*)$", text, re.MULTILINE))
    yield from (GaveUp(path, "it takes more time than other files of its size") for path in sorted(stopped))
    if not paths <= done | stopped:
        raise ValueError(f"no answer for {min(paths - done - stopped)}")
    for line in text.split("\n"):
        match = re.match(r"\./(.*?):(?=(?:\d+|None):  )", line)
        if match is None or match[1] not in paths:
            continue
        found_match = _LINE.fullmatch(line, match.end())
        if found_match is not None:
            place = Location(match[1], whole_number(found_match[1]) or None)
            if _is_part(match[1], found_match[3], found_match[2], batch.workspace, place.line):
                continue
            if found_match[3] == "runtime/casting" and _is_member(batch.workspace, place):
                continue
            if found_match[3] == "readability/utf8" and _is_lost_remark(batch.workspace, place):
                continue
            yield Finding(match[1], Result(NAME, found_match[3], Level.WARNING, found_match[2], place))


def _is_part(path: str, category: str, message: str, workspace: Workspace, line: int | None) -> bool:
    """Whether cpplint takes a part of a header (``.ipp``), a CUDA file, or a source beside the file for one "from other packages".

    It looks at the suffix alone. What is included by its bare name in quotes lies beside the file.
    """
    if category != "build/include" or "Do not include" not in message:
        return False
    if path.endswith((".cu", ".cuh")) or any(f"include {suffix} files" in message for suffix in _PARTS):
        return True
    lines = workspace.text(path).split("\n") if line else []
    text = lines[line - 1] if line and line <= len(lines) else ""
    return re.match(r'\s*#\s*include\s*"[^"/]+"', text) is not None


def _is_member(workspace: Workspace, at: Location) -> bool:
    """Whether "an address of a cast" is none: C has no such address (no compiler takes one), and ``&((T *)p)->x`` is that of a member.

    ``a &&(int)b`` takes no address at all.
    """
    if at.path.endswith(".c"):
        return True
    lines = workspace.text(at.path).split("\n")[(at.line or 1) - 1 :][:1]
    rest = [line.replace("&&", "  ") for line in lines]
    if any(_CAST.search(line) for line in rest):
        return False
    if any(_OFFSET.search(line) for line in rest):
        return True
    return any(_MEMBER.search(line) for line in rest) or (rest != lines and not any(_ADDRESS.search(r) for r in rest))


def _is_lost_remark(workspace: Workspace, at: Location) -> bool:
    """Whether the line is valid UTF-8 with replacement characters in comments alone: some editor has lost letters, which no compiler reads."""
    data = workspace.data(at.path)
    if data is None or not at.line:
        return False
    raw = data.split(b"\n")[at.line - 1 : at.line]
    try:
        lost = b"".join(raw).decode("utf-8").count(LOST)
    except UnicodeDecodeError:
        return False
    mentions = 0
    for comment in comments(data.decode("utf-8", "replace"), "c", LOST):
        lines = comment.text.split("\n")
        mentions += sum(
            line.count(LOST) for line in lines[max(at.line - comment.line, 0) :][:1] if at.line >= comment.line
        )
    return 0 < lost <= mentions


def _settings(workspace: Workspace, directory: str) -> Iterator[str]:
    """The CPPLINT.cfg of every directory from *directory* up to the root."""
    return (path for path in _configs(directory) if workspace.setting(path))


def _configs(directory: str) -> Iterator[str]:
    yield join(directory, CONFIG)
    if directory:
        yield from _configs(dirname(directory))


def _guard_root(package: str, path: str) -> str:
    """Where a header's guard begins: below ``include``, as ROS includes headers, else with the package's directory."""
    include = join("" if package == "." else package, "include")
    if path.startswith(include + "/"):
        return include
    return "" if package == "." else dirname(package)
