# SPDX-License-Identifier: Apache-2.0
"""Python: what is done to a text of which a part is not known leaves known what it cannot touch."""

from __future__ import annotations

import pytest
from follow_kit import python

NAME = "n = '/' + x() + '/sensor/Hum'\n"


def made(body: str) -> list[str]:
    return sorted(end.name for end in python("import re\n" + body).endpoints if end.kind == "publishers")


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("re.sub('[^a-zA-Z0-9_/]', '_', n)", "/?/sensor/Hum"),
        ("re.sub('[^0-9a-zA-Z_/~{}]', '_', n)", "/?/sensor/Hum"),
        ("re.sub(r'[^\\w/]', '_', n)", "/?/sensor/Hum"),
        ("re.sub('[sS]', 'z', n)", "/?/zenzor/Hum"),
        ("re.sub('[^a-z/]+', '_', n)", "/?/sensor/_um"),
        ("re.sub('-', '_', n)", "/?/sensor/Hum"),
        ("n.lower()", "/?/sensor/hum"),
        ("n.upper()", "/?/SENSOR/HUM"),
        ("n.replace('-', '_')", "/?/sensor/Hum"),
        ("n.replace('sens', 'mot')", "/?/motor/Hum"),
        ("n.strip()", "/?/sensor/Hum"),
        ("n.strip('/')", "/?sensor/Hum"),
        ("'/a' + n.rstrip('/')", "/a/?/sensor/Hum"),
        ("'/a_' + n.split('/')[-1]", "/a_Hum"),
        ("'/a_' + n.rsplit('/', 1)[1]", "/a_Hum"),
        ("n.rsplit('/', 1)[0] + '/b'", "/?/sensor/b"),
        ("'/a_' + n.rpartition('/')[2]", "/a_Hum"),
        ("'/a_' + (x() + '_b').split('/')[-1]", "/a_?_b"),
        ("re.sub('[^a-z/]', '_', '/a-b')", "/a_b"),
        # what may reach into what is known, and what is not known itself
        ("n.replace('x/s', 'y')", "/?"),
        ("n.replace('m', x())", "/?"),
        ("n.replace(x(), 'm')", "/?"),
        ("n.replace('', '_')", "/?"),
        ("n.replace('s', 'S', 1)", "/?"),
        ("re.sub('[/]+', '/', n)", "/?sensor/Hum"),
        ("re.sub('.*/', '/', n)", "/?"),
        ("re.sub('(/s)', '/', n)", "/?"),
        ("re.sub('^/', '/', n)", "/?"),
        ("re.sub('[^a-z]', r'\\g<0>', n)", "/?"),
        ("re.sub('[^a-z]', lambda m: 'b', n)", "/?"),
        ("re.sub('[z-a]', '_', n)", "/?"),
        ("re.sub('[a--b]', '_', n)", "/?"),
        ("re.sub('[a&&b]', '_', n)", "/?"),
        ("re.sub('[a-z]', '_', n, 1)", "/?"),
        ("re.sub(x(), '_', n)", "/?"),
        ("re.sub('[a-z]', '_', x())", "/?"),
        ("'/a_' + n.split('/')[1]", "/a_?"),
        ("'/a_' + n.split('/')[x()]", "/a_?"),
        ("'/a_' + n.split()[-1]", "/a_?"),
        ("'/a_' + ('/b/' + x()).split('/')[-1]", "/a_?"),
        ("'/a_' + ('/b/' + x()).rpartition('/')[2]", "/a_?"),
        ("'/a_' + (x() + '/b').partition('/')[2]", "/a_?"),
        ("('/b/' + x()).strip('/')", "/b?"),
        ("('/É' + x()).lower() + '/b'", "/?/b"),
    ],
)
def test_what_is_sure(written: str, expected: str) -> None:
    assert made(f"{NAME}PUB({written})") == [expected]


PIECES = NAME + "l = n.split('/')\n"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("for p in l:\n    PUB('/a/' + p)", ["/a/?", "/a/Hum"]),
        ("PUB('/a/' + l[-1])", ["/a/Hum"]),
        ("l.append(x())\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("l.pop()\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("del l[-1]\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("l[x()] = 'b'\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("l.sort()\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("l += ['b']\nPUB('/a/' + l[-1])", ["/a/?"]),
        ("x(l)\nPUB('/a/' + l[-1])", ["/a/?"]),
    ],
)
def test_the_last_piece(body: str, expected: list[str]) -> None:
    assert made(PIECES + body) == expected
