# SPDX-License-Identifier: Apache-2.0
"""Where results go: ``--output`` read, a renderer chosen for each format, and the text written."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import click

from haros_ci.errors import UserError
from haros_ci.results.result import Report

FORMATS = ("text", "sarif", "github", "json")
#: What plug-ins make of a report, by the name of the format.
Renderers = Mapping[str, Callable[[Report], str]]
Outputs = tuple[tuple[str, Path | None], ...]


class RendererError(Exception):
    """A format of a plug-in could not be written."""


def parse_outputs(wanted: tuple[str, ...], renderers: Renderers = MappingProxyType({})) -> Outputs:
    """``FORMAT[=PATH]`` as pairs, formats of plug-ins (*renderers*) included; at most one may go to stdout beside none other."""
    known = (*FORMATS, *renderers)
    clash = next((format for format in renderers if format in FORMATS), None)
    if clash is not None:
        raise UserError(f"the format '{clash}' of a plug-in is one of haros-ci's own", help="give it another name")
    outputs = []
    for item in wanted or ("text",):
        format, _, path = item.partition("=")
        if format not in known:
            raise UserError(f"--output {item}: unknown format '{format}'", help=f"one of {', '.join(known)}")
        outputs.append((format, Path(path) if path else None))
    on_stdout = [format for format, path in outputs if path is None]
    if len(on_stdout) > 1 and set(on_stdout) - {"text", "github"}:
        raise UserError(
            f"--output: {' and '.join(on_stdout)} cannot share stdout", help="give all but one a path: sarif=FILE"
        )
    return tuple(outputs)


def rendered(
    report: Report,
    source: Callable[[str], str],
    format: str,
    flags: Mapping[str, Any],
    renderers: Renderers = MappingProxyType({}),
    *,
    to_file: bool,
) -> str:
    """The report in *format*; RendererError if a plug-in's could not be made."""
    match format:
        case _ if format in renderers:
            return of_plugin(report, renderers[format], to_file=to_file)
        case "sarif":
            from haros_ci.report.sarif import render as sarif

            return sarif(report, audience=flags["sarif_for"], source=source)
        case "json":
            from haros_ci.report.json_report import render as as_json

            return as_json(report)
        case "github":
            from haros_ci.report.github import annotations, summary

            page = os.environ.get("GITHUB_STEP_SUMMARY")
            if page:
                append(Path(page), summary(report))
            return annotations(report)
        case _:
            from haros_ci.report.text import render as text

            color = not to_file and sys.stdout.isatty() and "NO_COLOR" not in os.environ
            width = int(os.environ.get("COLUMNS") or 0) or 120
            return text(report, color=color, width=width, why=flags["why"], source=source)


def of_plugin(report: Report, render: Callable[[Report], str], *, to_file: bool) -> str:
    """What a plug-in makes of *report*; read by a person or a runner, it moves no cursor and gives no commands."""
    from haros_ci.report.escape import patch as shown

    try:
        text = render(report)
    except RuntimeError as err:
        raise RendererError(str(err)) from err
    read_here = not to_file and (sys.stdout.isatty() or os.environ.get("GITHUB_ACTIONS"))
    return shown(text) if read_here else text


def write(text: str, path: Path | None) -> None:
    """To stdout, or to a file that appears whole or not at all; into what is no plain file (``/dev/null``) as it is."""
    if path is None:
        sys.stdout.buffer.write(text.encode("utf-8", "backslashreplace"))
        return
    try:
        if path.is_symlink() or (path.exists() and not path.is_file()):
            path.write_text(text, encoding="utf-8", errors="backslashreplace", newline="")
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        draft = path.with_name(f".{path.name}.{os.getpid()}")
        draft.write_text(text, encoding="utf-8", errors="backslashreplace", newline="")
        draft.replace(path)
    except OSError as err:
        raise UserError(f"{path}: cannot be written: {err.strerror}", help="name another --output path") from err


def append(path: Path, text: str) -> None:
    try:
        with path.open("a", encoding="utf-8", errors="backslashreplace") as page:
            page.write(text)
    except OSError as err:
        click.echo(f"warning: {path}: the job summary cannot be written: {err.strerror}", err=True)
