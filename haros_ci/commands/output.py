# SPDX-License-Identifier: Apache-2.0
"""Where results go: ``--output`` read, and a renderer chosen for each format; writing.py writes what they make."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import click

from haros_ci.errors import RunFailure, UserError
from haros_ci.records import dataclass
from haros_ci.results.result import Report
from haros_ci.writing import append

#: What plug-ins make of a report, by the name of the format.
Renderers = Mapping[str, Callable[[Report], str]]
Outputs = tuple[tuple[str, Path | None], ...]


class RendererError(Exception):
    """A format of a plug-in could not be written."""


@dataclass(frozen=True, slots=True)
class Extras:
    """What a renderer may ask for beside the report.

    *source* gives the text of a file and *package* the name of its package, both "" where there is none. *flags* are those of
    ``haros-ci check``; *to_file* is whether the text goes to a file, not to a terminal.
    """

    source: Callable[[str], str]
    flags: Mapping[str, Any]
    to_file: bool
    package: Callable[[str], str] = lambda path: ""

    def joined(self, report: Report) -> Report:
        """*report* with the same finding in copies of one text as one, for who reads it and does not match it place by place."""
        from haros_ci.results.copied import together

        return together(report, self.source, self.package)


def text_style(*, to_file: bool) -> tuple[bool, int]:
    """Whether text is coloured, and how many columns it has."""
    color = not to_file and sys.stdout.isatty() and "NO_COLOR" not in os.environ
    columns = os.environ.get("COLUMNS", "")
    is_number = columns.isascii() and columns.isdecimal() and len(columns) <= 5
    return color, min(int(columns), WIDEST) if is_number and int(columns) else USUAL_WIDTH


def _text(report: Report, view: Extras) -> str:
    from haros_ci.report.text import findings, render

    color, width = text_style(to_file=view.to_file)
    if view.flags.get("quiet"):
        why = view.flags["why"]
        return findings(view.joined(report).shown(), color=color, width=width, why=why, source=view.source)
    return render(view.joined(report), color=color, width=width, why=view.flags["why"], source=view.source)


def _sarif(report: Report, view: Extras) -> str:
    from haros_ci.report.sarif import render

    return render(report, audience=view.flags["sarif_for"], source=view.source)


def _github(report: Report, view: Extras) -> str:
    from haros_ci.report.github import annotations, blob_address, summary

    page = os.environ.get("GITHUB_STEP_SUMMARY")
    blob = blob_address(*(os.environ.get(f"GITHUB_{name}", "") for name in ("SERVER_URL", "REPOSITORY", "SHA")))
    if page:
        try:
            append(Path(page), summary(view.joined(report), blob=blob))
        except (RunFailure, UserError) as err:
            from haros_ci.report.escape import terminal

            click.echo(f"warning: the job summary cannot be written: {terminal(err.message)}", err=True)
    return annotations(report)


def _json(report: Report, view: Extras) -> str:
    from haros_ci.report.json_report import render
    from haros_ci.results.copied import copy_of, standing_for_others

    joined = view.joined(report)
    return render(report, copy_of(joined), standing_for_others(joined))


def _junit(report: Report, view: Extras) -> str:
    from haros_ci.report.junit import render

    return render(report)


def _gitlab(report: Report, view: Extras) -> str:
    from haros_ci.report.gitlab import render

    return render(report)


def _rdjson(report: Report, view: Extras) -> str:
    from haros_ci.report.rdjson import render

    return render(report, source=view.source)


def _checkstyle(report: Report, view: Extras) -> str:
    from haros_ci.report.checkstyle import render

    return render(report)


def _csv(report: Report, view: Extras) -> str:
    from haros_ci.report.csv_table import render

    return render(report, package=view.package)


def _markdown(report: Report, view: Extras) -> str:
    from haros_ci.report.markdown import render

    return render(view.joined(report))


FORMATS: dict[str, Callable[[Report, Extras], str]] = {
    "text": _text,
    "sarif": _sarif,
    "github": _github,
    "json": _json,
    "junit": _junit,
    "gitlab": _gitlab,
    "rdjson": _rdjson,
    "checkstyle": _checkstyle,
    "csv": _csv,
    "markdown": _markdown,
}
#: Formats of more than one file, each written into a directory (commands/folders.py).
FOLDERS = ("haros-json",)
#: Formats of one file that are made of more than the report (commands/report.py).
PAGES = ("html",)
#: Bytes of a file of an earlier run that a new one adds to.
LARGEST_READ = 50_000_000
#: Columns of text where COLUMNS says nothing sensible, and the most that it can say.
USUAL_WIDTH, WIDEST = 120, 1_000
#: Formats that a person reads as they are; all others are read by programs, which nothing else on stdout may disturb.
FOR_PEOPLE = frozenset({"text", "github"})
#: Formats that have no place for trouble with tools: stderr says it.
SILENT = frozenset({"gitlab", "rdjson", "checkstyle", "csv"})
#: Formats in which a bracket may be written as an escape.
IN_JSON = frozenset({"sarif", "json", "gitlab", "rdjson"})


def parse_outputs(outputs_given: tuple[str, ...], renderers: Renderers = MappingProxyType({})) -> Outputs:
    """``FORMAT[=PATH]`` as pairs, formats of plug-ins (*renderers*) included; at most one may go to stdout beside none other."""
    own = (*FORMATS, *PAGES, *FOLDERS)
    known = (*own, *renderers)
    clash = next((format for format in renderers if format in own), None)
    if clash is not None:
        raise UserError(f"the format '{clash}' of a plug-in is one of haros-ci's own", help="give it another name")
    outputs = []
    for item in outputs_given or ("text",):
        format, _, path = item.partition("=")
        if format not in known:
            raise UserError(f"--output {item}: unknown format '{format}'", help=f"one of {', '.join(known)}")
        if format in FOLDERS and not path:
            raise UserError(f"--output {item}: {format} is several files", help=f"name a directory: {format}=DIR")
        if format in FOLDERS and Path(path).exists() and not Path(path).is_dir():
            raise UserError(f"--output {item}: {path} is no directory", help="name another one")
        outputs.append((format, Path(path) if path else None))
    on_stdout = [format for format, path in outputs if path is None]
    if len(on_stdout) > 1 and set(on_stdout) - FOR_PEOPLE:
        raise UserError(
            f"--output: {' and '.join(on_stdout)} cannot share stdout", help="give all but one a path: sarif=FILE"
        )
    return tuple(outputs)


def rendered(report: Report, format: str, view: Extras, renderers: Renderers = MappingProxyType({})) -> str:
    """*report* in one of ``FORMATS`` or of *renderers*, as it goes to a file or to stdout; RendererError if a plug-in's could not be made."""
    if format in renderers:
        return of_plugin(report, renderers[format], to_file=view.to_file)
    text = FORMATS[format](report, view)
    if not view.to_file and format in IN_JSON:
        from haros_ci.report.escape import no_command

        return no_command(text)
    return text


def of_plugin(report: Report, render: Callable[[Report], str], *, to_file: bool) -> str:
    """What a plug-in makes of *report*; read by a person or a runner, it moves no cursor and gives no commands."""
    from haros_ci.plugins.stdout import kept_clean
    from haros_ci.report.escape import patch as shown

    try:
        with kept_clean():
            text = render(report)
    except RuntimeError as err:
        raise RendererError(str(err)) from err
    read_here = not to_file and (sys.stdout.isatty() or os.environ.get("GITHUB_ACTIONS"))
    return shown(text) if read_here else text


def text_in(folder: Path, name: str) -> str | None:
    """The text of the file *name* of *folder*, None if there is none; UserError for what cannot be read as one."""
    path = folder / name
    try:
        if not os.path.lexists(path):
            return None
        is_linked = path.is_symlink() or (path.parent != folder and path.parent.is_symlink())
        if is_linked or not path.is_file() or path.stat().st_size > LARGEST_READ:
            raise UserError(f"{path}: is no file of ours", help="remove it, or name another --output directory")
        return path.read_text(encoding="utf-8")
    except (OSError, ValueError) as err:
        raise UserError(f"{path}: cannot be read", help="remove it, or name another --output directory") from err
