# SPDX-License-Identifier: Apache-2.0
"""What a package.xml tells people."""

from __future__ import annotations

import pytest

from haros_ci.model.manifest import Manifest
from haros_ci.workspace.manifest import read_manifest


def test_all_of_it() -> None:
    text = b"""<package format="3"><name>a</name><description>
      One   <b>two</b> three</description>
      <maintainer email="m@example.org">M</maintainer><maintainer email="n@example.org"> N </maintainer>
      <author>A</author><author>A</author><author/>
      <url>http://a.example.org</url><url type="repository">http://r.example.org</url>
      <url type="bugtracker">http://b.example.org</url><url type="website">http://w.example.org</url></package>"""
    assert read_manifest(text) == Manifest(
        description="One two three",
        authors=("A",),
        maintainers=("M", "N"),
        website="http://w.example.org",
        repository="http://r.example.org",
        bugtracker="http://b.example.org",
    )


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"<package>",
        b"\xff\xfe",
        b"<package/>",
        b'<!DOCTYPE x [<!ENTITY a "b">]><package><description>&a;</description></package>',
        b"<a>" * 10_000,
        b"<package><description/><url/><author>  </author></package>",
    ],
)
def test_nothing_where_there_is_nothing(text: bytes) -> None:
    assert read_manifest(text) == Manifest()
