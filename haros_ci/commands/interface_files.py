# SPDX-License-Identifier: Apache-2.0
"""Where NoDL documents and README tables go: stdout, one file, or one file for each package in a directory."""

from __future__ import annotations

from pathlib import Path

import click

from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture
from haros_ci.regex import regex
from haros_ci.report import model_interface_table, model_nodl
from haros_ci.report.model_json import Places
from haros_ci.report.node_interface import interfaces
from haros_ci.report.readme_tables import rows
from haros_ci.writing import keep_inside, write

SUFFIXES = {"nodl": ".nodl.xml", "readme": ".md"}
_FILE_NAME = regex(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,200}")


def put(found: Architecture, format: str, path: Path | None, root: Path) -> None:
    """*found* as ``nodl`` or ``readme`` to stdout, or to *path*.

    Into a directory goes a file for each package with nodes, as NoDL for packages with a node that can be described. A file in a package of the workspace at *root* gets this
    package's interfaces only. In a Markdown file that is there, what stands between the two comments is replaced, and
    descriptions that people wrote into its tables are kept; UserError if it has no such comments.
    """
    if path is None:
        write(_rendered(found, format, None), None)
    elif path.is_dir():
        for package in sorted({item.package for item in interfaces(found)}):
            if not _FILE_NAME.fullmatch(package):
                raise UserError(f"package {package!r} cannot be the name of a file", help="rename it (REP 144)")
            if format == "nodl" and not model_nodl.is_valid(found, package):
                click.echo(f"note: no file for {package}: none of its nodes is known well enough for NoDL", err=True)
            else:
                _file(found, format, path / f"{package}{SUFFIXES[format]}", package)
    else:
        _file(found, format, path, _package(found, path, root))


def _file(found: Architecture, format: str, path: Path, package: str | None) -> None:
    keep_inside(path)
    if format != "readme" or not path.is_file() or not path.stat().st_size:
        write(_rendered(found, format, package), path)
        return
    try:
        with path.open(encoding="utf-8", newline="") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as err:
        raise UserError(f"{path}: cannot be read", help="it must be a UTF-8 text file") from err
    begin, end = model_interface_table.BEGIN, model_interface_table.END
    start = text.find(begin)
    kept = {
        (row.headings[-2], row.headings[-1], model_interface_table.code(row.names[0])): row.description.replace(
            "|", "\\|"
        )
        for row in rows(text[max(start, 0) :].partition(end)[0])
        if len(row.headings) > 1 and row.description
    }
    whole = model_interface_table.refreshed(text, model_interface_table.render(found, package, kept))
    if whole is None:
        raise UserError(f"{path} has no place for the tables", help=f"write {begin} and {end} where they shall stand")
    write(whole, path)


def _rendered(found: Architecture, format: str, package: str | None) -> str:
    return model_nodl.render(found, package) if format == "nodl" else model_interface_table.render(found, package)


def _package(found: Architecture, path: Path, root: Path) -> str | None:
    """The package of the workspace that *path* lies in, if it has nodes."""
    try:
        inside = path.resolve().relative_to(root).as_posix()
    except ValueError:
        return None
    name = Places(found.packages).split(inside)[0]
    return name if name in {item.package for item in interfaces(found)} else None
