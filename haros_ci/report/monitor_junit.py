# SPDX-License-Identifier: Apache-2.0
"""What a recording says of properties, as JUnit XML: a suite for the recording, a case for each property.

A property that held is a case that passed, one that is violated has a ``failure`` with its messages; what was never exercised, or is undecided, is
``skipped`` with the reason. There are no times: readers take them for seconds that a test took.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.report.monitor_text import Held, Judged, violation
from haros_ci.report.xml_tags import HEAD, lines, tag


def render(held: Held) -> str:
    """The document; the same verdicts give the same bytes."""
    verdicts = [one.verdict for one in held.properties]
    counts = {
        "tests": len(verdicts),
        "failures": verdicts.count("violated"),
        "errors": 0,
        "skipped": sum(verdict not in ("held", "violated") for verdict in verdicts),
    }
    body = "".join(f"{line}\n" for one in held.properties for line in _case(one, held))
    notes = f"<system-err>{lines(held.notes)}</system-err>\n" if held.notes else ""
    suite = tag("testsuite", {"name": f"haros-ci monitor {held.name}", **counts, "time": "0"})
    whole = tag("testsuites", {"name": "haros-ci monitor", **counts, "time": "0"})
    return f"{HEAD}{whole}\n{suite}\n{body}{notes}</testsuite>\n</testsuites>\n"


def _case(judged: Judged, held: Held) -> Iterator[str]:
    place = judged.location
    attributes: dict[str, str | int | None] = {
        "name": judged.title,
        "classname": judged.node or held.configuration or held.name,
        "file": place.path if place is not None else None,
        "line": place.line if place is not None else None,
        "time": "0",
    }
    if judged.verdict == "held":
        yield tag("testcase", attributes, closed=True)
        return
    yield tag("testcase", attributes)
    if judged.verdict == "violated":
        text = lines([judged.text, *violation(judged, held)])
        message = judged.reason or f"{judged.title} is violated"
        yield f"{tag('failure', {'type': 'haros-ci:hpl-violated', 'message': message})}{text}</failure>"
    else:
        message = f"{judged.verdict}{f': {judged.reason}' if judged.reason else ''}"
        yield tag("skipped", {"message": message}, closed=True)
    yield "</testcase>"
