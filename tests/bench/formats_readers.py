# SPDX-License-Identifier: Apache-2.0
"""Reads each output format with programs that are not ours, and compares the number of findings with the JSON report's.

    python tests/bench/formats_readers.py REPORTS [--schema FORMAT=FILE ...]

REPORTS is a directory with the files json, junit, gitlab, rdjson, checkstyle, csv and markdown of one run
(``haros-ci check --output json=REPORTS/json --output junit=REPORTS/junit ...``). Needs junitparser, junit2html, xmlschema, jsonschema,
pandas, cmarkgfm and markdown-it-py, and sqlite3 and reviewdog where they are installed. Schemas are not ours and not here:
junit-10.xsd is of Jenkins' xunit-plugin, codeclimate.json of GitLab (app/validators/json_schemas), DiagnosticResult.json of
reviewdog (proto/rdf/jsonschema).
"""

from __future__ import annotations

import argparse
import csv
import html
import json
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("reports", type=Path)
    parser.add_argument("--schema", action="append", default=[], metavar="FORMAT=FILE")
    given = parser.parse_args()
    schemas = {format: Path(file) for format, _, file in (item.partition("=") for item in given.schema)}
    report = json.loads((given.reports / "json").read_text())
    open_ones = sum(result["open"] for result in report["results"])
    print(f"in: {len(report['results'])} results, {open_ones} of them open\n")
    print("| format | reader | out |\n|---|---|---|")
    for format, read in READERS.items():
        for reader, count in read(given.reports / format, schemas.get(format)):
            print(f"| {format} | {reader} | {count} |")


def junit(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    import junitparser

    xml = junitparser.JUnitXml.fromfile(str(path))
    cases = [case for suite in xml for case in suite]
    kinds = [type(entry).__name__ for case in cases for entry in case.result]
    texts = [entry.text for case in cases for entry in case.result if isinstance(entry, junitparser.Failure)]
    findings = sum(not line.startswith("  ") for text in texts for line in text.splitlines())
    told = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))
    yield "junitparser", f"{findings} findings in {len(cases)} cases ({told})"
    with tempfile.TemporaryDirectory() as scratch:
        page = Path(scratch, "page.html")
        subprocess.run(["junit2html", str(path), str(page)], check=True, capture_output=True)
        yield "junit2html", f"a page of {page.stat().st_size:,} bytes"
    if schema:
        import xmlschema

        xmlschema.XMLSchema(str(schema)).validate(str(path))
        yield f"xmlschema, {schema.name}", "valid"


def gitlab(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    entries = json.loads(path.read_text())
    yield "json", f"{len(entries)} findings, {len({e['fingerprint'] for e in entries})} fingerprints"
    if schema:
        yield f"jsonschema, {schema.name}", f"{validated(entries, schema)} findings are valid"


def rdjson(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    document = json.loads(path.read_text())
    yield "json", f"{len(document['diagnostics'])} findings"
    if schema:
        yield f"jsonschema, {schema.name}", f"{validated([document], schema)} document is valid"
    yield from reviewdog(path, "rdjson")


def checkstyle(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    import lxml.etree

    yield "lxml", f"{int(lxml.etree.parse(str(path)).xpath('count(/checkstyle/file/error)'))} findings"
    yield from reviewdog(path, "checkstyle")


def reviewdog(path: Path, format: str) -> Iterator[tuple[str, object]]:
    if shutil.which("reviewdog"):
        command = ["reviewdog", f"-f={format}", "-reporter=local", "-filter-mode=nofilter", "-diff=git diff"]
        done = subprocess.run(command, stdin=path.open("rb"), capture_output=True, text=True)
        yield "reviewdog -reporter=local", f"{len(done.stdout.splitlines())} lines, exit code {done.returncode}"


def csv_table(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    import pandas

    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, strict=True))
    yield "Python's csv, strict", f"{len(rows)} rows, {sum(row['open'] == 'yes' for row in rows)} of them open"
    table = pandas.read_csv(path, keep_default_na=False)
    yield "pandas", f"{len(table)} rows, {(table.open == 'yes').sum()} of them open"
    if shutil.which("sqlite3"):
        script = f".import --csv '{path}' r\nselect count(*), sum(open = 'yes') from r;\n"
        done = subprocess.run(["sqlite3", ":memory:"], input=script, capture_output=True, text=True, check=True)
        yield "sqlite3 .import --csv", "{} rows, {} of them open".format(*done.stdout.strip().split("|"))


def markdown(path: Path, schema: Path | None) -> Iterator[tuple[str, object]]:
    import cmarkgfm
    from markdown_it import MarkdownIt

    text = path.read_text()
    more = re.search(r"\n([\d,]+) more finding", text)
    left = int(more[1].replace(",", "")) if more else 0
    pages = {
        "cmarkgfm": cmarkgfm.github_flavored_markdown_to_html(text),
        "markdown-it-py": MarkdownIt("commonmark").enable("table").render(text),
    }
    for reader, page in pages.items():
        rows = re.findall(r"<tr>(.*?)</tr>", page, re.DOTALL)[1:]
        wrong = sum(len(re.findall("<td", row)) != 4 for row in rows)
        links = len(re.findall("<a |<img", html.unescape(page) if "<a " in page else page))
        told = f"{len(rows)} rows and {left} counted, {wrong} rows of other width, {links} links or images"
        yield reader, f"{told}; {len(text.encode()):,} bytes"


def validated(values: list[Any], schema: Path) -> int:
    import jsonschema

    loaded = json.loads(schema.read_text())
    validator = jsonschema.validators.validator_for(loaded)(loaded)
    for value in values:
        validator.validate(value)
    return len(values)


READERS = {
    "junit": junit,
    "gitlab": gitlab,
    "rdjson": rdjson,
    "checkstyle": checkstyle,
    "csv": csv_table,
    "markdown": markdown,
}

if __name__ == "__main__":
    main()
