# SPDX-License-Identifier: Apache-2.0
"""pylint's findings on lines that flake8 is told to pass over."""

from __future__ import annotations

import pytest

from haros_ci.linters.noqa import without_noqa
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level


def left(rule: str, line: str, tool: str = "pylint", number: int = 2) -> bool:
    result = Result(tool, rule, Level.WARNING, "message", Location("a.py", number))
    return without_noqa([result], lambda _: f"import os\n{line}\n") == (result,)


@pytest.mark.parametrize(
    ("rule", "line"),
    [
        ("anomalous-backslash-in-string", r'X = "\S"  # noqa: W605'),
        ("anomalous-backslash-in-string", r'X = "\S"  # noqa: E501, W605'),
        ("anomalous-backslash-in-string", r'X = "\S"  #NOQA'),
        ("bare-except", "except:  # noqa: E722"),
        ("bare-except", "except:  # noqa:E7"),
        ("unused-import", "import a  # noqa because of b"),
        ("wildcard-import", "from a import *  # noqa: F401,F403"),
    ],
)
def test_is_silenced(rule: str, line: str) -> None:
    assert not left(rule, line)


@pytest.mark.parametrize(
    ("rule", "line"),
    [
        ("anomalous-backslash-in-string", r'X = "\S"'),
        ("anomalous-backslash-in-string", r'X = "\S"  # noqa: E501'),
        ("bare-except", "except:  # noqa: E501 W605"),
        ("bare-except", "except:  # type: ignore"),
        ("no-member", "a.b()  # noqa"),
        ("no-value-for-parameter", "f()  # noqa: F821"),
        ("unused-import", "import noqa"),
        ("unused-import", "import a  # pylint: disable=F401"),
    ],
)
def test_stays(rule: str, line: str) -> None:
    assert left(rule, line)


def test_other_places_and_tools_stay() -> None:
    assert left("bare-except", "except:  # noqa", tool="bandit")
    assert left("bare-except", "except:  # noqa", number=1)
    assert left("bare-except", "except:  # noqa", number=9)
