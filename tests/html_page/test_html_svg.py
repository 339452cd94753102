# SPDX-License-Identifier: Apache-2.0
"""The picture of one configuration: well-formed, without anything active, whatever the names are."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest
from commandline import haros, write
from page_kit import HOSTILE, configuration, node
from test_html_command import FILES

from haros_ci.html_page.elements import MOST_ELEMENTS
from haros_ci.html_page.svg import render
from haros_ci.model.architecture import Configuration

SVG = "{http://www.w3.org/2000/svg}"


@pytest.mark.parametrize("word", ["", "\ufffe\uffff", *HOSTILE])
def test_it_is_a_picture_and_nothing_else(word: str) -> None:
    text = render(configuration(word))
    assert text is not None
    tree = ElementTree.fromstring(text.encode("utf-8", "backslashreplace"))
    tags = {element.tag.removeprefix(SVG) for element in tree.iter()}
    assert tags == {"svg", "title", "style", "defs", "marker", "path", "rect", "g", "text"}
    names = {name for element in tree.iter() for name in element.attrib}
    assert not [name for name in names if name.startswith("on") or "href" in name or name == "style"]
    assert text == render(configuration(word))


def test_it_shows_what_is_there() -> None:
    text = render(configuration())
    assert text is not None
    words = ["".join(each.itertext()) for each in ElementTree.fromstring(text).iter(f"{SVG}text")]
    assert {
        "camera",
        "filter",
        "/image",
        "/arm/stop",
        "/go",
        "← /box/?",
        "container /box/container",
        "namespace /arm",
    } <= set(words)
    assert "/rosout" not in words
    assert text.count('class="n c"') == 2 and text.count('class="e c"') >= 2


def test_an_empty_configuration_is_an_empty_picture() -> None:
    text = render(Configuration(name="x"))
    assert text is not None and "<rect" in text


def test_what_is_too_large_is_none() -> None:
    assert render(Configuration(name="x", nodes=tuple(node(f"/n{n}") for n in range(MOST_ELEMENTS + 1)))) is None


def test_the_command(tmp_path: Path) -> None:
    root = write(tmp_path, FILES)
    done = haros("model", ".", "--launch", "robot/launch/a.launch.py", "--format", "svg", cwd=root)
    assert done.returncode == 0 and "/chatter" in done.stdout, done.stderr
    write(root, {"robot/launch/b.launch.py": FILES["robot/launch/a.launch.py"]})
    done = haros("model", ".", "--format", "svg", cwd=root)
    assert done.returncode == 2 and "--configuration" in done.stderr and "robot/launch/b.launch.py" in done.stderr
