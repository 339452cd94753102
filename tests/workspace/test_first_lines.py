# SPDX-License-Identifier: Apache-2.0
"""Which interpreter the first line of a script asks for."""

from __future__ import annotations

import pytest

from haros_ci.workspace.first_lines import asks_for_another, asks_for_python

BODY = "\nprint(undefined)\n"


@pytest.mark.parametrize(
    "line",
    [
        "#!/usr/bin/python3",
        "#!/usr/bin/env python3.11",
        "#!/usr/bin/env -S nice python3 -u",
        '#!/usr/bin/env -S py"thon3"',
        "#!/usr/bin/env -S 'python3'",
        "#!/usr/bin/env -S p${EMPTY}ython3",
        "#!/usr/bin/env -S pyth\\on3",
        "#!/usr/bin/env ipython3",
        "#!/usr/bin/env -S coverage run",
        "#!/usr/bin/env xonsh",
        "#!/opt/own/start",
        "#!/opt/make/start",
        "#!/usr/bin/env -S xonsh make",
        "#!/usr/bin/env -S A=sh own",
    ],
)
def test_python(line: str) -> None:
    assert asks_for_python(line + BODY) and not asks_for_another(line + BODY)


@pytest.mark.parametrize(
    "line",
    [
        "#!/bin/sh",
        "#!/usr/bin/env bash",
        "#!/usr/bin/env -S perl -w",
        "#!/usr/bin/env -S 'ruby'",
        "#!/usr/bin/gawk -f",
        "#!/usr/bin/cmake -P",
        "#!/usr/bin/env -S node",
        "#!/usr/bin/fish",
        "#!/usr/bin/env -S nice -n 5 bash",
        "#!/usr/bin/env lua5.3",
    ],
)
def test_another(line: str) -> None:
    assert asks_for_another(line + BODY) and not asks_for_python(line + BODY)


@pytest.mark.parametrize(
    "text", ["", "print(1)\n", "#! \n", "\n#!/usr/bin/python3\n", "#!/opt/own/start\necho $a\n", "#!own\nrate = 10\n"]
)
def test_none(text: str) -> None:
    assert not asks_for_python(text) and not asks_for_another(text)
