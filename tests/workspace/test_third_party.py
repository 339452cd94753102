# SPDX-License-Identifier: Apache-2.0
"""Which directories hold copies of other projects."""

from __future__ import annotations

import pytest

from haros_ci.workspace.third_party import ThirdParty, around

PACKAGES = ("src/demo",)

#: Path, other files, directories asked about, and the directory of the copy.
FIRES = [
    ("third_party/json/json.hpp", (), (), "third_party"),
    ("src/demo/3rdparty/a.cpp", (), (), "src/demo/3rdparty"),
    ("src/Vendor/a/b/c.cpp", (), (), "src/Vendor"),
    ("external/planner_ros/src/a.cpp", (), (), "external"),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/LICENSE",), (), "src/demo/lib/solver"),
    ("src/demo/lib/solver/x/a.c", ("src/demo/lib/solver/COPYING.LESSER",), (), "src/demo/lib/solver"),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/license-mit.txt",), (), "src/demo/lib/solver"),
    ("src/demo/vendor/a.cpp", (), ("src/demo",), "src/demo/vendor"),
]
QUIET = [
    ("src/demo/src/a.cpp", ("src/demo/LICENSE",), ()),
    ("src/demo/src/a.cpp", ("LICENSE", "src/LICENSE"), ()),
    ("src/other/a.cpp", ("src/other/LICENSE",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/license.py",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/License.hpp",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/licenses/MIT.txt",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/sub/LICENSE",), ()),
    ("src/demo_vendor/a.cpp", (), ()),
    ("src/vendors/a.cpp", (), ()),
    ("vendor.cpp", (), ()),
    ("external", (), ()),
    ("third_party/json/a.cpp", (), ("third_party/json",)),
    ("third_party/json/a.cpp", (), ("third_party",)),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/LICENSE",), ("src/demo/lib/solver",)),
]


@pytest.mark.parametrize(("path", "others", "asked", "directory"), FIRES)
def test_is_a_copy(path: str, others: tuple[str, ...], asked: tuple[str, ...], directory: str) -> None:
    assert ThirdParty((path, *others), PACKAGES, asked).directory(path) == directory


@pytest.mark.parametrize(("path", "others", "asked"), QUIET)
def test_is_none(path: str, others: tuple[str, ...], asked: tuple[str, ...]) -> None:
    assert ThirdParty((path, *others), PACKAGES, asked).directory(path) == ""


@pytest.mark.parametrize("sign", "-_.a")
def test_long_names_take_no_time(sign: str) -> None:
    """A pattern that goes back over its steps would not end."""
    for name in (f"LICENSE{sign * 5000}!", f"LICENSE{(sign + 'a') * 2500}!"):
        assert ThirdParty((f"src/demo/lib/{name}",), PACKAGES).directory("src/demo/lib/a.cpp") == ""


def test_around() -> None:
    assert around("a/b/c/d.cpp", {"a/b", "x"}) == "a/b"
    assert around("a/bc/d.cpp", {"a/b"}) == around("a", {"a"}) == ""
