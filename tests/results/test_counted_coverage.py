# SPDX-License-Identifier: Apache-2.0
"""What a run looked at is counted without copies of other projects, as its lines are."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.coverage import coverage


def file(path: str, package: str | None, copy: str = "", language: str = "cpp") -> SourceFile:
    return SourceFile(path, language, 0, "", package, lines=10, third_party=copy)


class Nothing:
    def text(self, path: str) -> str:
        return ""


OWN = (file("arm/a.cpp", "arm"), file("arm/b.yaml", "arm", language="yaml"))


@pytest.mark.parametrize(
    ("files", "packages", "counted"),
    [
        (OWN, ("arm",), (1, 2, 10)),
        ((*OWN, file("arm/lib/c.cpp", "arm", "arm/lib")), ("arm",), (1, 2, 10)),
        ((*OWN, file("leg/c.cpp", "leg", "leg")), ("arm", "leg"), (1, 2, 10)),
        ((*OWN, file("leg/c.cpp", "leg"), file("leg/lib/d.cpp", "leg", "leg/lib")), ("arm", "leg"), (2, 3, 20)),
        ((*OWN, file("vendor/c.cpp", None, "vendor")), ("arm",), (1, 2, 10)),
        ((*OWN, file("c.cpp", None)), ("arm",), (1, 3, 20)),
        (OWN, ("arm", "empty"), (2, 2, 10)),
        ((file("leg/c.cpp", "leg", "leg"),), ("leg",), (0, 0, 0)),
        ((), (), (0, 0, 0)),
    ],
)
def test_what_is_counted(
    files: tuple[SourceFile, ...], packages: tuple[str, ...], counted: tuple[int, int, int]
) -> None:
    workspace = Workspace(Path("/nowhere"), tuple(Package(name, name) for name in packages), files, Nothing())
    found = coverage(workspace)
    assert (found.packages, found.files, found.lines) == counted
