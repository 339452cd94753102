# SPDX-License-Identifier: Apache-2.0
"""Targets of settings: the project file, HAROS's files, what a project declares, and settings of linters."""

from __future__ import annotations

import os

from fuzz.targets.kit import ROOT, Entry, parts, refused, ros_package, text_of, workspace

from haros_ci.analysis.api_rows import api_rows
from haros_ci.analysis.architecture import known_types
from haros_ci.analysis.requested import configurations
from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import Compared, excluded, follows
from haros_ci.behaviour.deciding import Predicate, is_always, is_never
from haros_ci.behaviour.declared import in_file, in_project
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.text import canonical
from haros_ci.config.describe import describe
from haros_ci.config.project import read_project
from haros_ci.config.settings import Settings
from haros_ci.config.yaml_lines import parse, plain
from haros_ci.declared.expectation import problems as expectation_problems
from haros_ci.errors import UserError
from haros_ci.linters import pylint_config, settings_files, yaml_settings
from haros_ci.model.workspace import Problem
from haros_ci.pipeline import selection_of
from haros_ci.query.declared import declared as declared_queries
from haros_ci.query.engine import Query
from haros_ci.query.fault import QueryError
from haros_ci.query.values import words
from haros_ci.registry import built_in
from haros_ci.report.readme_tables import rows
from haros_ci.report.readme_values import default_differs, is_value
from haros_ci.results.linear_regex import PatternError, compiled


def _refusal(err: UserError) -> str:
    assert err.message and "\n" not in err.message.strip()
    return err.message


def yaml_lines(data: bytes) -> object:
    try:
        document = parse(data, "p.yaml")
    except UserError as err:
        return _refusal(err)
    return plain(document.top) if document.top is not None else None


def _project(data: bytes, name: str) -> object:
    """Read as a run reads it, and everything that later looks into it looks."""
    try:
        found = read_project(data, name, trust_config=True)
    except UserError as err:
        return _refusal(err)
    settings = Settings(root=ROOT)
    for key, value in found.values.items():
        settings = _with(settings, key, value)
    said: list[Problem] = []
    project = settings.project
    known = built_in()
    try:
        _, notes = selection_of(settings, known)
    except UserError as err:
        notes = (_refusal(err),)
    space = workspace({"bot/package.xml": ros_package(), "bot/launch/a.launch": b"<launch/>"})
    made = (
        configurations(space, project, said, name),
        api_rows(project.get("apis"), name, said),
        known_types(project.get("known_nodes"), name, said, frozenset()),
        declared_queries(project),
    )
    return notes, describe(settings), said, made[:1], tuple(expectation_problems(project, name)), found.notes


def _with(settings: Settings, key: str, value: object) -> Settings:
    from dataclasses import replace

    return replace(settings, **{key: value})  # type: ignore[arg-type]


def project_file(data: bytes) -> object:
    return _project(data, ".haros-ci.yaml")


def haros_file(data: bytes) -> object:
    return _project(data, "haros.yaml")


def linter_settings(data: bytes) -> object:
    """INI, TOML and YAML of linters, and the part of each that may be used."""
    text = text_of(data, "setup")
    if text is None:
        return None
    found: list[object] = []
    for read in (settings_files.ini, settings_files.toml, yaml_settings.read):
        try:
            found.append(read(text))
        except ValueError as err:
            found.append(refused(err))
    for name in pylint_config.NAMES:
        try:
            options = pylint_config.inert_options(name, text)
        except ValueError as err:
            found.append(refused(err))
            continue
        assert set(options) <= pylint_config.INERT
        found.append(options)
        written = settings_files.ini_text("MAIN", options)
        assert sum(line.startswith("[") for line in written.splitlines()) == 1, written
    return found


def linter_plans(data: bytes) -> object:
    """What every adapter plans in a tree with such settings files, and the files it writes for its tool."""
    import tempfile
    from pathlib import Path

    from haros_ci.linters.linter import Batch, LintOptions, Program, Unread
    from haros_ci.registry import built_in
    from haros_ci.workspace.cache import MemoryCache

    files = {
        "bot/package.xml": ros_package(),
        "bot/a.py": b"import os\n",
        "bot/a.cpp": b"int a;\n",
        "bot/a.sh": b"#!/bin/sh\n",
    }
    files |= {"bot/CMakeLists.txt": b"project(bot)\n", "bot/a.yaml": b"a: 1\n", "bot/Dockerfile": b"FROM scratch\n"}
    space = workspace(files | parts(data, "setup.cfg"))
    said = []
    for adapter in built_in().linters:
        options = LintOptions()
        plan = getattr(adapter, "plan", None)
        try:
            units = tuple(plan(space, options, MemoryCache())) if plan is not None else ()
        except (Unread, ValueError) as err:
            said.append(refused(err))
            continue
        for unit in units[:3]:
            with tempfile.TemporaryDirectory() as scratch:
                batch = Batch(space, (unit.file,), options, Path(scratch), unit.group)
                try:
                    command = adapter.command(Program(("tool",), "1.0"), batch)
                except (Unread, ValueError) as err:
                    said.append(refused(err).replace(scratch, ""))
                    continue
                except OSError as err:  # root itself is nowhere
                    assert str(ROOT) in str(err), err
                    continue
                assert all("\0" not in word for word in command.argv), command.argv
                said.append(" ".join(command.argv).replace(scratch, ""))
                links = [os.path.join(place, name) for place, _, names in os.walk(scratch) for name in names]
                bad = [p for p in links if not os.path.realpath(p).startswith((os.path.realpath(scratch), str(ROOT)))]
                assert not bad, [os.path.realpath(path) for path in bad]
    return said


def patterns(data: bytes) -> object:
    pattern, _, text = data.decode("utf-8", "replace").partition("\n")
    try:
        return compiled(pattern).search(text)
    except PatternError as err:
        return str(err)


def queries(data: bytes) -> object:
    from query.query_worlds import scene

    variables = scene()
    text = data.decode("utf-8", "replace")
    try:
        return [words(match) for match in Query(text, variables).matches(variables)][:50]
    except QueryError as err:
        told = err.explained(text)
        assert told
        return told


def properties(data: bytes) -> object:
    """Texts of HPL, alone, in files and in project files; what follows of them; the canonical text is the same property again."""
    text = text_of(data, "hpl")
    if text is None:
        return None
    stated = (*in_file(text, "a.hpl"), *in_project(text, "haros.yaml", lambda name: ("a.hpl", text)))[:20]
    said: list[object] = []
    compared = []
    for each in stated:
        assert each.location.line is not None and each.location.line <= text.count("\n") + 1
        said.append((str(each.location), each.identity, str(each.fault)))
        if each.parsed is None:
            continue
        again = parse_property(canonical(each.parsed))
        assert canonical(again) == canonical(each.parsed)
        said += [wrong.message for wrong in mistakes(each.parsed)]
        read = {id(event): Predicate(event.predicate, Reader(None, event.alias)) for event in each.parsed.events}
        said += [(is_never(one), is_always(one)) for one in read.values()]
        compared.append(Compared(each.parsed, lambda event, read=read: read[id(event)]))  # type: ignore[misc]
    said += [(follows(one, other), excluded(one, other)) for one in compared[:6] for other in compared[:6]]
    return said


def readme_tables(data: bytes) -> object:
    text = text_of(data, "markdown")
    if text is None:
        return None
    found = rows(text)
    last = text.count("\n") + 1
    assert all(1 <= row.line <= last + 1 for row in found)
    return found, is_value(text[:200]), default_differs(text[:200], 1), default_differs(text[:200], "a")


_YAML = (
    b"&a ",
    b"*a",
    b"<<: *a",
    b"!!str ",
    b"? ",
    b"|\n  ",
    b">-\n  ",
    b"---\n",
    b"...\n",
    b"%YAML 1.1\n",
    b"~",
    b"!!map ",
)
_SECTIONS = (
    *(b"[flake8]", b"[tool:pytest]", b"[MASTER]", b"[tool.pylint.main]", b"[tool.ruff]", b"[isort]", b"[pycodestyle]"),
    *(
        b"extend-ignore = E501",
        b"disable=all",
        b"@@ .pylintrc\n",
        b"@@ pyproject.toml\n",
        b"@@ .flake8\n",
        b"@@ mypy.ini\n",
    ),
    *(
        b"@@ .yamllint\n",
        b"@@ ruff.toml\n",
        b"@@ CPPLINT.cfg\n",
        b"@@ .clang-format\n",
        b"@@ .codespellrc\n",
        b"%(a)s",
        b"[DEFAULT]",
    ),
)

_HPL = tuple(
    b"globally|after|until|some|no|causes|forbids|requires|within|as|or|and|not|implies|iff|forall|exists|in|to|True|PI|len|max|hz|ms|"
    b"# id:|properties:|files:|configurations:|nodes:|hpl:|![|]!|**|<=|@A".split(b"|")
)
TARGETS = {
    "yaml-lines": Entry(yaml_lines, "YAML with its lines", ("config.yaml_lines",), _YAML),
    "project-file": Entry(project_file, ".haros-ci.yaml", ("config", "query.declared", "analysis.requested"), _YAML),
    "haros-file": Entry(haros_file, "haros.yaml", ("config.haros", "analysis.requested"), _YAML),
    "linter-settings": Entry(
        linter_settings, "settings of linters", ("linters.settings_files", "linters.yaml_settings"), _SECTIONS
    ),
    "linter-plans": Entry(linter_plans, "what adapters make of settings of linters", ("linters",), _SECTIONS),
    "patterns": Entry(patterns, "regular expressions of the project file", ("results.linear_regex",)),
    "queries": Entry(queries, "queries", ("query",)),
    "properties": Entry(properties, "properties in HPL", ("behaviour",), _HPL),
    "readme-tables": Entry(readme_tables, "tables of READMEs", ("report.readme_tables", "report.readme_values")),
}
