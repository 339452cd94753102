# SPDX-License-Identifier: Apache-2.0
"""The page as a file: nothing is fetched, nothing of a workspace is markup or code, the same input gives the same bytes."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from base64 import b64encode
from dataclasses import replace
from hashlib import sha256

import pytest
from page_kit import HOSTILE, Parts, checked, given, samples, written

from haros_ci.html_page.document import SCRIPTS, STYLE, asset, code, escaped
from haros_ci.measuring.totals import METRICS

REPORTS = samples()
TAGS = [
    "html",
    "head",
    "meta",
    "meta",
    "meta",
    "meta",
    "title",
    "style",
    "body",
    "noscript",
    "p",
    "div",
    "script",
    "script",
]


def hash_of(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


@pytest.mark.parametrize("word", ["", *HOSTILE])
def test_a_parser_sees_our_tags_alone(word: str) -> None:
    parts = Parts(written(given(word)))
    assert [tag for tag, _ in parts.tags] == TAGS
    assert not [
        name
        for _, attributes in parts.tags
        for name in attributes
        if name.startswith("on") or name in ("src", "href", "style")
    ]
    data, script = parts.texts["script"]
    assert script == code()
    assert json.loads(data)["version"] == 1


@pytest.mark.parametrize("word", HOSTILE)
def test_the_data_holds_to_its_schema(word: str) -> None:
    checked(given(word))


@pytest.mark.parametrize("text", (*REPORTS.HOSTILE, *HOSTILE))
def test_a_report_that_is_hostile_all_over(text: str) -> None:
    made = replace(given(text), report=REPORTS.hostile(text))
    checked(made)
    assert [tag for tag, _ in Parts(written(made)).tags] == TAGS


def test_the_policy_names_what_is_there() -> None:
    parts = Parts(written(given()))
    (policy,) = (a["content"] for tag, a in parts.tags if a.get("http-equiv") == "Content-Security-Policy")
    script, style = parts.texts["script"][1], parts.texts["style"][0]
    assert policy is not None
    assert policy.split("; ")[:3] == [
        "default-src 'none'",
        f"script-src {hash_of(script)}",
        f"style-src {hash_of(style)}",
    ]


def test_the_policy_stands_before_all_that_it_is_for() -> None:
    text = written(given())
    assert text.index("Content-Security-Policy") < text.index("<style>") < text.index("<script")


@pytest.mark.parametrize("word", ["", HOSTILE[1]])
def test_the_same_run_gives_the_same_bytes(word: str) -> None:
    assert written(given(word)) == written(given(word))


def test_the_bytes_do_not_depend_on_the_process() -> None:
    program = "import sys; sys.path[:0] = sys.argv[1:]\nfrom page_kit import given, written\nfrom hashlib import sha256\nprint(sha256(written(given()).encode()).hexdigest())"
    said = {
        subprocess.run(
            [sys.executable, "-c", program, *sys.path],
            env={"PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(said) == 1


@pytest.mark.parametrize("text", ["</script>", "<!--", "&amp;", "\u2028", "<script"])
def test_nothing_ends_the_data(text: str) -> None:
    made = escaped({text: [text]})
    assert not re.search(r"[<>&\u2028\u2029]", made)
    assert json.loads(made) == {text: [text]}


@pytest.mark.parametrize("name", [*SCRIPTS, STYLE])
def test_our_own_parts_fetch_nothing_and_write_no_markup(name: str) -> None:
    text = asset(name)
    assert "</" not in text
    assert not re.search(
        r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(|new Function|import\(|fetch\(|XMLHttp|@import|DOMParser",
        text,
    )
    assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", text)
    assert not re.search(r"url\((?!#)", text)


def test_comments_stay_at_home_and_texts_are_whole() -> None:
    kept = {
        name: [line for line in map(str.lstrip, asset(name).splitlines()) if not line.startswith("//")]
        for name in SCRIPTS
    }
    assert all("\n".join(lines) in code() for lines in kept.values()) and "\n// " not in code()
    del kept["markdown.js"]  # its backticks stand in patterns
    assert all(line.count("`") % 2 == 0 for lines in kept.values() for line in lines), "a text over several lines"


def test_the_page_is_small() -> None:
    assert len(code()) + len(asset(STYLE)) < 200_000


def test_each_metric_is_explained() -> None:
    words = asset("metrics.js").partition("const METRIC_WORDS = {")[2].partition("};")[0]
    named = set(re.findall(r'(?:^|,)\s*"?([a-z]+(?:-[a-z]+)*)"?: "', words))
    assert named == set(METRICS)
