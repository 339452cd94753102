# SPDX-License-Identifier: Apache-2.0
"""What a change does, in words and as a table: nothing twice, no long cells, links that lead to lines."""

from __future__ import annotations

from dataclasses import replace

import pytest
from report_samples import CPPCHECK_RUN, PLAIN, SCOPE_RESULT

from haros_ci.model.changes import ADDED, REMOVED, Change, Changes
from haros_ci.model.location import Location
from haros_ci.report import diff_markdown, diff_text, markdown
from haros_ci.report.github import blob_address

SHA = "0123456789abcdef0123456789abcdef01234567"
BLOB = f"https://github.com/acme/robot/blob/{SHA}"
GONE = Change(
    what="node",
    action=REMOVED,
    names=("/a/horn",),
    before="p/horn",
    programs=("p/horn",),
    base=Location("l/a.launch", 8),
)
NEW = Change(
    what="publisher",
    action=ADDED,
    names=("/chat",),
    after="std_msgs/String",
    programs=("p/talker",),
    head=Location("src/a b.py", 5),
)


def lines(*found: Change) -> list[str]:
    return diff_text.render(Changes(changes=found), "main", None).splitlines()[1:]


def test_a_program_is_named_once() -> None:
    assert lines(GONE) == ["  node removed: /a/horn: p/horn; l/a.launch:8"]
    program = replace(GONE, names=("p/horn",), before="node /a/horn: 1 publisher", aspect="program", base=None)
    assert lines(program) == ["  program removed: p/horn: node /a/horn: 1 publisher"]


def test_another_program_is_named() -> None:
    assert lines(NEW) == ["  publisher added: /chat: std_msgs/String; p/talker; src/a b.py:5"]
    assert lines(replace(NEW, names=("/p/talker",)))[0].count("p/talker; ") == 1


def test_a_place_leads_to_its_line() -> None:
    text = diff_markdown.render(Changes(changes=(NEW,)), blob=BLOB)
    assert f"]({BLOB}/src/a%20b.py#L5)" in text


@pytest.mark.parametrize(("change", "blob"), [(NEW, ""), (GONE, BLOB), (replace(NEW, head=None), BLOB)])
def test_no_link(change: Change, blob: str) -> None:
    assert "](" not in diff_markdown.render(Changes(changes=(change,)), blob=blob)


@pytest.mark.parametrize("path", ["a)b.py", "a](x).py", "a b.py", "a#b.py", "a?b.py", "a\nb.py", "<a>.py", 'a"b.py'])
def test_a_hostile_path_is_inside_its_address(path: str) -> None:
    text = diff_markdown.linked("x", path, 3, BLOB)
    address = text.partition("](")[2].removesuffix(")")
    assert address.startswith(f"{BLOB}/a") or address.startswith(f"{BLOB}/%3Ca")
    assert address.endswith("#L3") and not set(address.removesuffix("#L3")) & set("()[]<>\"' \n#?")


@pytest.mark.parametrize("count", [4, 12, 40, 90])
def test_a_cell_has_few_lines_and_the_list_has_the_rest(count: int) -> None:
    ends = tuple(f"publisher /t{number}" for number in range(count))
    text = diff_markdown.render(Changes(changes=(replace(GONE, details=ends),)))
    row = next(line for line in text.splitlines() if line.startswith("| node removed"))
    assert row.count("<br>publisher") == 3 and f"and {count - 3} more" in row
    listed = [line for line in text.splitlines() if line.startswith("- publisher")]
    assert len(listed) == min(count, 40) and ("- and 50 more" in text) == (count == 90)
    assert text.count("<details>") == text.count("</details>") == 1


@pytest.mark.parametrize("count", [0, 1, 3])
def test_few_ends_need_no_list(count: int) -> None:
    ends = tuple(f"publisher /t{number}" for number in range(count))
    assert "<details>" not in diff_markdown.render(Changes(changes=(replace(GONE, details=ends),)))


def test_findings_lead_to_their_lines() -> None:
    found = replace(SCOPE_RESULT, location=Location("src/a.cpp", 7))
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(found,)),))
    assert f"]({BLOB}/src/a.cpp#L7)" in markdown.render(report, blob=BLOB)
    assert "](" not in markdown.render(report)


def test_where_files_can_be_read() -> None:
    assert blob_address("https://github.com", "acme/robot", SHA) == BLOB
    assert blob_address("https://git.acme.example:8443", "acme/robot", SHA).startswith("https://git.acme.example:8443/")


@pytest.mark.parametrize(
    ("server", "repository", "commit"),
    [
        ("", "", ""),
        ("http://github.com", "acme/robot", SHA),
        ("https://github.com/x", "acme/robot", SHA),
        ("https://github.com", "acme", SHA),
        ("https://github.com", "acme/robot/x", SHA),
        ("https://github.com", "acme/ro)bot", SHA),
        ("https://github.com", "acme/robot", "main"),
        ("https://github.com", "acme/robot", SHA[:-1]),
    ],
)
def test_where_they_cannot(server: str, repository: str, commit: str) -> None:
    assert blob_address(server, repository, commit) == ""
