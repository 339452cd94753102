# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.selection import AnalysedPaths, select

TREE = (
    "a.cpp",
    "arm/a.cpp",
    "arm/gen/arm.pb.h",
    "arm/src/vendor/x/x.cpp",
    "arm/vendor.cpp",
    "third_party/lib/l.cpp",
    "vendor/v.cpp",
)


def left_out(*patterns: str, directories: tuple[str, ...] = (".",), files: tuple[str, ...] = ()) -> set[str]:
    scope = AnalysedPaths(directories, files)
    return set(TREE) - {c.path for c in select(TREE, scope, Excludes(patterns))}


@pytest.mark.parametrize(
    ("patterns", "expected"),
    [
        (("third_party/",), {"third_party/lib/l.cpp"}),
        (("third_party",), {"third_party/lib/l.cpp"}),
        (("/third_party",), {"third_party/lib/l.cpp"}),
        (("./third_party/",), {"third_party/lib/l.cpp"}),
        (("**/vendor/**",), {"vendor/v.cpp", "arm/src/vendor/x/x.cpp"}),
        (("vendor/",), {"vendor/v.cpp", "arm/src/vendor/x/x.cpp"}),
        (("/vendor/",), {"vendor/v.cpp"}),
        (("vendor/**",), {"vendor/v.cpp"}),
        (("arm/**/vendor",), {"arm/src/vendor/x/x.cpp"}),
        (("arm/**/x.cpp",), {"arm/src/vendor/x/x.cpp"}),
        (("arm/*",), {path for path in TREE if path.startswith("arm/")}),
        (("arm/*.cpp",), {"arm/a.cpp", "arm/vendor.cpp"}),
        (("*.pb.h",), {"arm/gen/arm.pb.h"}),
        (("a.cpp",), {"a.cpp", "arm/a.cpp"}),
        (("/a.cpp",), {"a.cpp"}),
        (("?.cpp", "!a.cpp"), {"third_party/lib/l.cpp", "vendor/v.cpp", "arm/src/vendor/x/x.cpp"}),
        (("[l-v].cpp",), {"third_party/lib/l.cpp", "vendor/v.cpp"}),
        (("[^av].cpp",), {"third_party/lib/l.cpp", "arm/src/vendor/x/x.cpp"}),
        (("**",), set(TREE)),
    ],
)
def test_leaves_out(patterns: tuple[str, ...], expected: set[str]) -> None:
    assert left_out(*patterns) == expected


@pytest.mark.parametrize(
    "patterns",
    [
        (),
        ("",),
        ("# vendor/",),
        ("third",),
        ("party/",),
        ("lib/l.cpp",),  # a slash ties it to the root
        ("a.cpp/",),  # directories only
        ("*.CPP",),
        ("third_party/*.cpp",),  # a star does not cross directories
        ("vendor/", "!vendor/"),
        ("/",),
        ("(", "[", "a{1,2}.cpp"),
    ],
)
def test_leaves_alone(patterns: tuple[str, ...]) -> None:
    assert left_out(*patterns) == set()


def test_a_given_directory_is_entered_whatever_covers_it() -> None:
    chosen = set(TREE) - left_out("vendor/", "*.pb.h", directories=("arm/src/vendor",))
    assert chosen == {"arm/src/vendor/x/x.cpp"}
    assert set(TREE) - left_out("vendor/**", directories=("vendor",)) == {"vendor/v.cpp"}


def test_what_lies_below_a_given_directory_is_still_left_out() -> None:
    assert set(TREE) - left_out("vendor/", "x/", directories=("arm/src/vendor",)) == set()


def test_a_given_file_is_not_exempt() -> None:
    assert "vendor/v.cpp" in left_out("vendor/", directories=("arm",), files=("vendor/v.cpp",))


def test_patterns_take_bounded_time() -> None:
    excludes = Excludes(("**/a*a*a*a*a*a*a*a*a*a*/**/**/**/**/**/b" * 3,))
    assert not excludes.match("/".join(["a" * 60] * 100), is_directory=True)
