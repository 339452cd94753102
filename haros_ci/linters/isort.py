# SPDX-License-Identifier: Apache-2.0
"""isort, dry: files whose imports are not in its order, with the workspace's settings of that order."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import replace
from posixpath import dirname

from haros_ci.linters import diffs, installed, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "isort"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 6.0

RULE = "unsorted-imports"
MESSAGE = "From here on the imports are not in isort's order: run `isort` on this file."
#: In isort's order, without .editorconfig.
MARKS = {
    ".isort.cfg": ("[settings]", "[isort]"),
    "pyproject.toml": ("[tool.isort",),
    "setup.cfg": ("[isort]", "[tool:isort]"),
    "tox.ini": ("[isort]", "[tool:isort]"),
}
SECTIONS = ("settings", "isort", "tool:isort")
#: Left out are src-paths and directory, which we set, what reads elsewhere (virtual-env, conda-env, skip-gitignore), what
#: loads plug-ins (formatter, sort-order) and what changes the output.
INERT = frozenset(
    """
    py-version force-to-top skip extend-skip skip-glob extend-skip-glob line-length wrap-length line-ending sections
    no-sections known-future-library known-third-party known-first-party known-local-folder known-standard-library
    extra-standard-library multi-line-output forced-separate indent comment-prefix length-sort length-sort-straight
    length-sort-sections add-imports remove-imports append-only reverse-relative force-single-line
    single-line-exclusions default-section balanced-wrapping use-parentheses order-by-type lines-before-imports
    lines-after-imports lines-between-sections lines-between-types combine-as-imports combine-star
    include-trailing-comma from-first force-adds force-alphabetical-sort-within-sections force-alphabetical-sort
    force-grid-wrap force-sort-within-sections lexicographical group-by-package separate-packages ignore-whitespace
    no-lines-before no-inline-sort ignore-comments case-sensitive ensure-newline-before-comments profile honor-noqa
    remove-redundant-aliases float-to-top treat-comments-as-code treat-all-comments-as-code constants classes variables
    dedup-headings only-sections only-modified combine-straight-imports auto-identify-namespace-packages
    namespace-packages indented-import-headings honor-case-in-force-sorted-sections
    sort-relative-in-force-sorted-sections reverse-sort star-first sort-reexports split-on-trailing-comma
    """.split()
)
#: Sections of the project's own, and their headings.
PREFIXES = ("known-", "import-heading-", "import-footer-")

_UNREAD = regex(r"Encoding not supported for (.+)$|Unable to parse file (.+?) due to ")


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """isort knows the standard library of the Python that runs it, and first-party modules by the files that there are."""
    import sys

    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    return json.dumps([sys.version_info[:2], own])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Whose an import is depends on which modules there are; that a package is a namespace stands in its __init__.py."""
    modules = (
        f"{f.path} {f.digest if f.path.endswith('__init__.py') else ''}"
        for f in workspace.files
        if f.language in LANGUAGES
    )
    salt = hashlib.sha256("\0".join(modules).encode("utf-8", "surrogatepass")).hexdigest()
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        yield replace(unit, salt=salt)


def command(program: Program, batch: Batch) -> Command:
    """First-party are, as where isort runs by itself, the modules beside its settings and those in ``src`` there."""
    sections = settings_files.read(batch.workspace, batch.group)
    declared = {key: value for name in SECTIONS for key, value in sections.get(name, {}).items()}
    named = {key.replace("_", "-") for key in declared if key.replace("_", "-").startswith(PREFIXES)}
    settings = {k.replace("-", "_"): v for k, v in settings_files.inert(declared, INERT | named).items()}
    home = os.path.join(batch.workspace.root, dirname(batch.group))
    own = batch.scratch / "isort.toml"
    own.write_text(
        settings_files.toml_text(NAME, {**settings, "directory": home, "src_paths": [f"{home}/src", home]}),
        encoding="utf-8",
    )
    more = batch.options.arguments.get(NAME, ()) if batch.options.trust_config else ()
    options = (f"--settings-file={own}", "--check-only", "--diff", "--filter-files", "--quiet", *more)
    return Command((*program.argv, *options, "--", *("./" + file.path for file in batch.files)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """A diff of each file on stdout, its name absolute; exit code 1 says that there is one."""
    stderr = output.stderr.decode("utf-8", "replace")
    roots = {os.path.abspath(batch.workspace.root), os.path.realpath(batch.workspace.root)}
    names = {os.path.join(root, file.path): file.path for root in roots for file in batch.files}
    names |= {"./" + file.path: file.path for file in batch.files} | {file.path: file.path for file in batch.files}
    unread = set()
    for line in stderr.split("\n"):
        match = _UNREAD.search(line)
        if match and (path := names.get(match[1] or match[2])):
            unread.add(path)
    if output.code not in (0, 1) or (output.code and not output.stdout and not unread):
        raise ValueError(f"exit code {output.code}")
    for path in sorted(unread):
        yield GaveUp(path, "its text cannot be decoded")
    headings = {f"{name}:before": path for name, path in names.items()}
    for path, line_number in diffs.first_changes(output.stdout.decode("utf-8", "replace"), headings):
        yield Finding(path, Result(NAME, RULE, Level.NOTE, MESSAGE, Location(path, line_number)))
