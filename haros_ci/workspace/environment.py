# SPDX-License-Identifier: Apache-2.0
"""The environment variables that a workspace sets by itself: environment hooks of its packages, and files that its project file names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice

from haros_ci.model.build import Build, CMakeCommand
from haros_ci.model.environment import Environment
from haros_ci.model.launch_actions import SHARE
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.workspace.dotenv import read_dotenv
from haros_ci.workspace.shell_values import names_set
from haros_ci.workspace.shell_variables import Variables, read_script
from haros_ci.workspace.shell_words import HOLE, MAX_SCRIPT

#: Hooks that are read.
MAX_HOOKS = 200

_SHELLS = ("sh", "bash")
_TEMPLATES = ("", ".em", ".in", ".develspace.em", ".develspace.in")
_HOOK = regex(r"\.(sh|bash|dsv)(?:\.develspace)?(\.em|\.in)?\Z")
#: What stands in brackets of a template on one line, up to their end; no other brackets begin in it.
_TO_END = r"(?:[^\]\n@]|@(?!\[))*\]"
_EM_BLOCK = regex(rf"@\[\s*(if|for|while|def|try|end|else|elif)\b{_TO_END}")
_EM = regex(rf"@@|@#[^\n]*|@\((?:[^()\n]|\([^()\n]*\))*\)|@\{{[^{{}}]*\}}|@\[{_TO_END}|@[A-Za-z_][\w.]*")
_IN = regex(r"@([A-Za-z_]\w*)@")
_WORD = regex(r"[A-Za-z_]\w*")
#: Names that are directories of every install prefix: what a .dsv file sets to one of them is a path.
_DIRECTORIES = frozenset(("", "bin", "etc", "include", "lib", "share", "src", "opt"))
#: The install prefix that ament's setup files set for hooks (ament_package, environment_hook), and what stands for it here.
PREFIX, _BELOW = "AMENT_CURRENT_PREFIX", "/@AMENT_CURRENT_PREFIX@"
#: A path of a package below it.
_SHARED = regex(r"share/([A-Za-z]\w*)((?:/(?!\.)[^/$@\s;:]+)+)/?")


@dataclass(frozen=True, slots=True)
class Hook:
    """An environment hook of *package* at the root-relative *path*; *is_certain* if it is always there."""

    path: str
    package: str
    is_certain: bool


def hooks_of(workspace: Workspace, builds: Mapping[str, Build]) -> Iterator[Hook]:
    """The environment hooks that CMake of packages names, and that are there."""
    there = workspace.names.union(file.path for file in workspace.files)
    for name, build in sorted(builds.items()):
        for command in build.commands:
            if command.is_test or command.name not in ("catkin_add_env_hooks", "ament_environment_hooks"):
                continue
            for path in _paths(command, there):
                yield Hook(path, name, not command.is_conditional)


def _paths(command: CMakeCommand, there: frozenset[str]) -> Iterator[str]:
    if command.name == "ament_environment_hooks":
        for word in command.arguments:
            path = command.place(word)
            if path is not None and path in there:
                yield path
        return
    if not command.arguments:
        return
    directory = command.after("DIRECTORY", "SHELLS", "SKIP_INSTALL")[:1] or ("${ROOT}/" + command.directory,)
    for shell in command.after("SHELLS", "DIRECTORY", "SKIP_INSTALL"):
        base = command.place(f"{directory[0]}/{command.arguments[0]}.{shell}") if shell in _SHELLS else None
        found = [f"{base}{ending}" for ending in _TEMPLATES if f"{base}{ending}" in there] if base else []
        yield from found[:1]


def environment_of(workspace: Workspace, builds: Mapping[str, Build]) -> Environment:
    """What the environment hooks of the packages set in a shell in which nothing else has been set.

    Where two hooks disagree, or a value cannot be read, the variable is lost.
    """
    hooks = list(dict.fromkeys(hooks_of(workspace, builds)))[:MAX_HOOKS]
    scripts = [_script(workspace, hook) for hook in hooks]
    alone = [script.read({}) for script in scripts]
    if not any(variables.values or variables.lost for variables in alone):
        return Environment()
    found: dict[str, set[str | None]] = {}
    where: dict[str, str] = {}
    setters: dict[str, Counter[str | None]] = {}  # by name: how many hooks set it to each value
    for hook, variables in zip(hooks, alone, strict=True):
        _note(found, where, hook, variables)
        for name, value in _outcome(hook, variables).items():
            setters.setdefault(name, Counter())[value] += 1
    for hook, script, variables in zip(hooks, scripts, alone, strict=True):  # again, with what the others set
        if inherited := _set_before(script, _outcome(hook, variables), setters):
            _note(found, where, hook, _own(script.read(inherited), variables))
    return _agreed(found, where)


def _outcome(hook: Hook, variables: Variables) -> dict[str, str | None]:
    """The value of each name that *hook* sets; None where it is not known or not certain."""
    lost: dict[str, str | None] = dict.fromkeys(sorted(variables.lost))
    return {name: value if hook.is_certain else None for name, value in variables.values.items()} | lost


def _set_before(
    script: _Script, own: Mapping[str, str | None], setters: Mapping[str, Counter[str | None]]
) -> dict[str, str | None]:
    """The variables named in *script* that hooks other than itself set; None where they disagree, or where it is not certain.

    *own* is what the hook of the script sets, and counted among the *setters*.
    """
    before: dict[str, str | None] = {}
    for name in own.keys() | _mentioned(script.text, setters):
        counts = setters[name]
        values = [
            value for value in islice(counts, 3) if name not in own or value != own[name] or counts[value] > 1
        ]  # three tell whether others than the own one disagree
        if values:
            before[name] = values[0] if len(values) == 1 else None
    return before


def _mentioned(text: str, names: Mapping[str, object]) -> set[str]:
    """Those of *names* that *text* has as words: it cannot refer to others."""
    return {word for word in _WORD.findall(text) if word in names}


def _agreed(found: Mapping[str, set[str | None]], where: Mapping[str, str]) -> Environment:
    """The variables with the one value that was *found* for each; the others are lost."""
    single = {name: next(iter(values)) for name, values in found.items() if len(values) == 1}
    known = {name: value for name, value in single.items() if value is not None}
    lost = {name: _reason(name, where[name]) for name in found if name not in known}
    return Environment(known, lost, frozenset(known))


def _reason(name: str, path: str) -> str:
    return f"environment variable '{name}' is set in {path}, to what is not known"


def _note(found: dict[str, set[str | None]], where: dict[str, str], hook: Hook, variables: Variables) -> None:
    for name, value in _outcome(hook, variables).items():
        found.setdefault(name, set()).add(value)
        where.setdefault(name, hook.path)


def _own(found: Variables, first: Variables) -> Variables:
    """Of what a hook leaves behind, the variables that it has set itself."""
    names = first.values.keys() | first.lost
    return Variables({name: v for name, v in found.values.items() if name in names}, found.lost & names)


@dataclass(frozen=True, slots=True)
class _Script:
    """The *text* of a hook without the markup of its template; *stuck* are names of which nothing is known, whatever it says."""

    text: str
    is_dsv: bool = False
    stuck: frozenset[str] = frozenset()

    def read(self, inherited: Mapping[str, str | None]) -> Variables:
        """What it sets, where *inherited* is set before it."""
        if self.is_dsv:
            return read_dsv(self.text, inherited)
        found = read_script(self.text, {**inherited, PREFIX: _BELOW}, self.stuck)
        placed = {name: _placed(value) for name, value in found.values.items() if name != PREFIX}
        values = {name: value for name, value in placed.items() if value is not None}
        return Variables(values, (found.lost | (placed.keys() - values.keys())) - {PREFIX})


def _script(workspace: Workspace, hook: Hook) -> _Script:
    kind = _HOOK.search(hook.path)
    text = workspace.text(hook.path)
    if kind is None or not text:
        return _Script("")
    if len(text) > MAX_SCRIPT:
        return _Script("", stuck=names_set(text[:MAX_SCRIPT]))
    stuck: frozenset[str] = frozenset()
    if kind[2] == ".em":
        text, stuck = _expanded(text)
    elif kind[2] == ".in":
        text = _IN.sub(lambda found: hook.package if found[1] == "PROJECT_NAME" else HOLE, text)
    return _Script(text, kind[1] == "dsv", stuck)


def _expanded(text: str) -> tuple[str, frozenset[str]]:
    """An empy template with holes for what is put in, and the names that are set under its conditions."""
    stuck: set[str] = set()
    depth, start = 0, 0
    for found in _EM_BLOCK.finditer(text):
        if depth:
            stuck |= names_set(text[start : found.start()])
        depth += {"end": -1, "else": 0, "elif": 0}.get(found[1], 1)
        start = found.end()
    if depth > 0:
        stuck |= names_set(text[start:])

    def hole(found: re.Match[str]) -> str:
        if found[0] == "@@":
            return "@"
        return "" if found[0].startswith(("@#", "@[", "@{")) else HOLE

    return _EM.sub(hole, text), frozenset(stuck)


def _placed(value: str) -> str | None:
    """A *value* in which the install prefix is written so that launch files find what it means; None where that is not known."""
    if _BELOW not in value:
        return value
    found = _SHARED.fullmatch(value.removeprefix(f"{_BELOW}/"))
    return None if found is None else f"{SHARE.format(found[1])}{found[2]}"


def _dsv_value(value: str) -> str | None:
    """The *value* of a line of a .dsv file; None for a path below the install prefix that is in no package's share, and for what a template puts in."""
    if HOLE in value:
        return None
    shared = _SHARED.fullmatch(value)
    if shared is not None:
        return f"{SHARE.format(shared[1])}{shared[2]}"
    return None if value in _DIRECTORIES or ("/" in value and not value.startswith("/")) else value


def read_dsv(text: str, inherited: Mapping[str, str | None]) -> Variables:
    """What a .dsv file sets (``type;name;value``, as colcon and ament read it); of paths below the install prefix those in a package's share are known."""
    values: dict[str, str | None] = {}
    for line in text.splitlines()[:2_000]:
        kind, _, rest = line.strip().partition(";")
        name, found, value = rest.partition(";")
        if kind in ("set", "set-if-unset") and name:
            made = _dsv_value(value) if found else None
            before = values.get(name, inherited.get(name)) if name in values or name in inherited else ""
            values[name] = made if kind == "set" or before == "" else before
        elif kind.startswith(("prepend", "append")) and name:
            values[name] = None
    known = {name: value for name, value in values.items() if value is not None}
    return Variables(known, frozenset(values.keys() - known.keys()))


def environment_files(workspace: Workspace, paths: Iterable[str]) -> Environment:
    """What the listed files at the root-relative *paths* set, the later before the earlier: shell scripts, or a ``NAME=value`` on each line."""
    values: dict[str, str | None] = {}
    where: dict[str, str] = {}
    for path in paths:
        text = workspace.text(path)
        inherited = {name: values[name] for name in _mentioned(text, values)}
        found = read_script(text, inherited) if path.endswith((".sh", ".bash")) else read_dotenv(text, inherited)
        values |= found.values
        values |= dict.fromkeys(found.lost)
        where |= dict.fromkeys(found.lost, path)
    known = {name: value for name, value in values.items() if value is not None}
    return Environment(known, {name: _reason(name, where[name]) for name in values if name not in known})
