# SPDX-License-Identifier: Apache-2.0
"""Encodings that a Python file declares: in some of them a comment is code."""

from __future__ import annotations

import pytest

from haros_ci.extract.python.encoding import other_encoding
from haros_ci.extract.python.read import read_python

CODE = "import rospy\n# +AAo-rospy.init_node('hidden')\n"


@pytest.mark.parametrize(
    "name",
    [
        "utf-7",
        "UTF_7",
        "unicode_escape",
        "raw_unicode_escape",
        "hz",
        "iso2022_jp",
        "utf-16",
        "cp037",
        "shift_jis",
        "big5",
        "gbk",
        "rot13",
        "nowhere",
    ],
)
@pytest.mark.parametrize(
    "head", ["# -*- coding: {} -*-\n", "#!/usr/bin/env python3\n# coding={}\n", "\n# vim: set fileencoding={} :\n"]
)
def test_encodings_that_hide_code(name: str, head: str) -> None:
    text = head.format(name) + CODE
    assert other_encoding(text) == name
    [(line, message)] = read_python(text).problems
    assert (line, name in message, "is not read" in message) == (1, True, True)


@pytest.mark.parametrize(
    "head",
    [
        "",
        "# a comment\n",
        *(
            f"# -*- coding: {name} -*-\n"
            for name in (
                "utf-8",
                "UTF8",
                "utf_8",
                "utf-8-unix",
                "latin-1",
                "latin1",
                "iso-8859-15",
                "iso8859_1",
                "cp1252",
                "windows-1251",
                "ascii",
                "us-ascii",
                "koi8-r",
                "euc-jp",
            )
        ),
        "import os\n# coding: utf-7\n",
        "# a\n# b\n# coding: utf-7\n",
        "# encoding of the camera\n",
        "x = 'coding: utf-7'\n",
    ],
)
def test_encodings_that_hide_nothing(head: str) -> None:
    assert other_encoding(head + CODE) == "" and not read_python(head + CODE).problems
