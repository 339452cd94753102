# SPDX-License-Identifier: Apache-2.0
"""Files of tests and of other projects that a change begins to use in code of its own: on them little or nothing is reported.

What a test does on purpose, and what another project has, is nobody's finding; compiled into a node it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from posixpath import dirname, join, normpath

from haros_ci.linters.changed_code import Place, notes
from haros_ci.linters.dead_text import dead, is_in, joined
from haros_ci.linters.in_default import is_test
from haros_ci.model.package import SourceFile
from haros_ci.model.python_names import as_python_reads
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Notification

#: Files that are named; the rest is counted.
MOST = 10
_INCLUDE = regex(r"^[ \t]*(?:#|%:)[ \t]*(?:include(?:_next)?|import)[ \t]*[\"<]([^\">\n]{1,300})", re.M)
_IMPORT = regex(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+\(?[ \t]*([\w, \t]+)|import[ \t]+([\w.]+))", re.M)
#: Commands that have sources compiled into what is no test; the name of a target tells of others.
_COMPILES = regex(
    r"\b(?:add_executable|add_library|target_sources|\w*_add_executable|\w*_add_library)\s*\(([^()]{1,20000})\)", re.I
)
_OF_TEST = regex(r"test", re.I)
_SOURCE = regex(r"[\w./+-]{1,200}\.(?:c|cc|cpp|cxx|c\+\+|cu)\b")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each file of *head* that uses such a file, and did not in *base*; none without a base."""
    if base is None:
        return ()
    old = {file.path: file.digest for file in base.files}
    known = frozenset(old.values())
    aside: dict[str, list[str]] = {}
    for file in head.files:
        if file.language in ("cpp", "python") and (file.third_party or is_test(file.path)):
            aside.setdefault(file.path.rpartition("/")[2], []).append(file.path)
    usual: dict[str, list[str]] = {}
    for file in head.files if aside else ():
        if not file.third_party and not is_test(file.path):
            usual.setdefault(file.path.rpartition("/")[2], []).append(file.path)
    found: list[Place] = []
    for file in head.files if aside else ():
        if file.digest in known or file.third_party or is_test(file.path) or not head.reports_on(file.path):
            continue
        new = set(_named(file, head.text(file.path))) - set(
            _named(file, base.text(file.path) if file.path in old else "")
        )
        used = sorted({path for name in new for path in _meant(name, file, aside, usual)})
        if used:
            more = f" and {len(used) - 1} more" if len(used) > 1 else ""
            what = f"since this change it uses {used[0]}{more}, a file of tests or of another project, on which little is reported"
            found.append((file.path, None, what))
    return notes(found, MOST, "files use files of tests or of other projects since this change")


def _named(file: SourceFile, text: str) -> Iterator[str]:
    """The paths, or the ends of paths, of what *text* has compiled or imported."""
    if file.language == "cpp":
        text = joined(text)
        hidden = dead(text)
        yield from (match[1] for match in _INCLUDE.finditer(text) if not is_in(match.start(), hidden))
    elif file.language == "python":
        for module, names, whole in _IMPORT.findall(code_alone(as_python_reads(text), "python")):
            path = (module or whole).lstrip(".").replace(".", "/")
            yield f"{path}.py"
            yield from (f"{path}/{name.split()[0]}.py" for name in names.split(",") if name.strip())
    elif file.language == "cmake":
        for words in _COMPILES.findall(code_alone(text, "cmake")):
            if not _OF_TEST.search(words.split()[0] if words.split() else ""):
                yield from (normpath(join(dirname(file.path), word)) for word in _SOURCE.findall(words))


def _meant(name: str, file: SourceFile, aside: dict[str, list[str]], usual: dict[str, list[str]]) -> list[str]:
    """The files of *aside* that *name* in *file* means, where it means none of the *usual* ones."""
    called_so = aside.get(name.rpartition("/")[2], ())
    beside = normpath(join(dirname(file.path), name)) if called_so else ""
    if beside in called_so:
        return [beside]
    found = [path for path in called_so if f"/{path}".endswith(f"/{name}")]
    is_own = any(path == beside or f"/{path}".endswith(f"/{name}") for path in usual.get(name.rpartition("/")[2], ()))
    return [] if is_own else found
