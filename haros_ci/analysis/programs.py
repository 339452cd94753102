# SPDX-License-Identifier: Apache-2.0
"""The C++ and Python files of a workspace as programs, from the cache where their bytes are known there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from hashlib import sha256

from haros_ci.analysis import foreign_code, header_macros
from haros_ci.extract.cpp.read import Macro
from haros_ci.extract.parameter_library import read_parameter_library
from haros_ci.forks import shared
from haros_ci.index.index import Source
from haros_ci.model.build import Build
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.own_sources import OF_FACTS, digest
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded, encoded
from haros_ci.timing import timed

TOO_DEEP = "nested too deeply to be read; split the statements"


@timed("parse")
def programs(
    workspace: Workspace,
    built: Mapping[str, Build],
    store: Store,
    problems: list[Problem],
    processes: int = 1,
    *,
    in_full: bool = False,
) -> tuple[Source, ...]:
    """Every C++ and Python file as a program, from *store* where its bytes are known there.

    Of large copies of libraries that name nothing of ROS there is only what they include (``foreign_code``), but for metrics (*in_full*).
    """
    roots = [(directory, name) for build in built.values() for name, directory in build.python_roots]
    sources = []
    files = [file for file in workspace.files if file.language in ("cpp", "python")]
    kept = _facts(workspace, files, store, processes) if in_full else _read(workspace, files, store, processes)
    for file in files:
        program = kept[file.path] or Program(file.language or "", problems=((1, TOO_DEEP),))
        problems += [Problem(file.path, message, line) for line, message in program.problems]
        module = module_name(file.path, roots) if file.language == "python" else ""
        sources.append(Source(file.path, file.package, program, module))
    return (*sources, *parameter_libraries(workspace, built, problems))


def _read(workspace: Workspace, files: Iterable[SourceFile], store: Store, processes: int) -> dict[str, Program | None]:
    """The programs of *files* by path, those of large copies of libraries last: what they include is enough where ``foreign_code`` says so."""
    copies = foreign_code.foreign(workspace)
    foreign = {file.path: file for of_one in copies.values() for file in of_one}
    kept = _facts(workspace, (file for file in files if file.path not in foreign), store, processes)
    if foreign:
        left = foreign_code.without_bases(workspace, copies, kept.values())
        kept |= _facts(workspace, (file for path, file in foreign.items() if path not in left), store, processes)
        kept |= {path: foreign_code.head(workspace.text(path)) for path in sorted(left)}
    return kept | _with_macros(workspace, files, kept, store)


def _with_macros(
    workspace: Workspace, files: Iterable[SourceFile], kept: Mapping[str, Program | None], store: Store
) -> dict[str, Program | None]:
    """The programs of C++ files that use macros with parameters of headers, read again with these (``header_macros``)."""
    cpp = {file.path: file for file in files if file.language == "cpp"}
    known = {path: program for path in cpp if (program := kept[path]) is not None}
    names = frozenset(header_macros.calling(known))
    if not names:
        return {}
    mentions = {path: words for path in known if (words := header_macros.words_of(workspace.text(path), names))}
    found: dict[str, Program | None] = {}
    for path, macros in header_macros.given(known, mentions).items():
        group, _, key = facts_at(cpp[path])
        key = f"{key} {sha256(repr(macros).encode('utf-8', 'surrogatepass')).hexdigest()}"
        text = store.get_text(group, path, key)
        program = decoded(text)
        if program is None:
            text = read_facts(workspace, path, "cpp", macros)
            program = decoded(text)
            if text:
                store.put_text(group, path, key, text)
        found[path] = program or known[path]
    return found


def _facts(
    workspace: Workspace, files: Iterable[SourceFile], store: Store, processes: int
) -> dict[str, Program | None]:
    """The same of files that are read in full, None for what is nested too deeply."""
    kept = {file.path: (file, decoded(store.get_text(*facts_at(file)))) for file in files}
    new = [file for file, program in kept.values() if program is None]
    ones: dict[tuple[str | None, str], SourceFile] = {}
    for file in new:
        ones.setdefault((file.language, file.digest or file.path), file)  # copies are read once
    jobs = [partial(read_facts, workspace, file.path, file.language or "") for file in ones.values()]
    texts = dict(zip(ones, shared(jobs, [file.path for file in ones.values()], processes), strict=True))
    for file in new:
        text = texts[file.language, file.digest or file.path]
        if text:
            store.put_text(*facts_at(file), text)
        kept[file.path] = file, decoded(text)
    return {path: program for path, (_, program) in kept.items()}


def parameter_libraries(workspace: Workspace, built: Mapping[str, Build], problems: list[Problem]) -> Iterator[Source]:
    """The code that generate_parameter_library makes of YAML, as programs."""
    seen = set()
    for build in built.values():
        for library in build.parameter_libraries:
            if library.path in seen:
                continue
            seen.add(library.path)
            program = read_parameter_library(library.path, workspace.text(library.path), library.language)
            problems += [Problem(library.path, message, line) for line, message in program.problems]
            module = f"{library.package}.{library.name}" if library.language == "python" else ""
            yield Source(library.path, library.package, program, module)


def facts_at(file: SourceFile) -> tuple[str, str, str]:
    """Where the facts of a file are kept: their kind, the path, and all that they depend on."""
    return f"facts-{file.language}", file.path, f"{digest(OF_FACTS)} {file.digest}"


def read_facts(workspace: Workspace, path: str, language: str, macros: Mapping[str, Macro] | None = None) -> str:
    """A file's facts as JSON has them; whoever asks for them decodes it, whether they are just read or come from the cache."""
    read: Callable[[str], Program]
    if language == "cpp":
        from haros_ci.extract.cpp.read import read_cpp

        read = partial(read_cpp, macros=macros)
    else:
        from haros_ci.extract.python.read import read_python as read
    try:
        program = read(workspace.text(path))
    except FAULTS as err:
        program = Program(language, problems=((1, fault("the file could not be read into the model", err)),))
    return encoded(program) or ""


def module_name(path: str, roots: Iterable[tuple[str, str]]) -> str:
    """The dotted name under which a Python file is imported, "" if it lies below no import root.

    *roots* are pairs of a directory and the top-level package that it is, "" for all that is in it (setup.py, package_dir).
    """
    best = ""
    for directory, name in roots:
        if directory == "." or path.startswith(f"{directory}/"):
            inner = path if directory == "." else path[len(directory) + 1 :]
            found = f"{name}/{inner}" if name else inner
            if not best or len(found) < len(best):
                best = found
    return best.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
