# SPDX-License-Identifier: Apache-2.0
"""What a check says of a part of the examples on its page is what it says of all of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.kept_findings import parts_of
from haros_ci.api.testing import examples_of, project_file_of, read, said
from haros_ci.registry import checks, page_of

CODE = (".cpp", ".hpp", ".h")
EXAMPLES = {
    f"{check.id} {number}": (check, example)
    for check in checks()
    for number, example in enumerate(examples_of(page_of(check)))
    if example.base is None and any(path.endswith(CODE) for path in example.files)
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_part_says_the_same_or_nothing(name: str, tmp_path: Path) -> None:
    check, example = EXAMPLES[name]
    if project_file_of(example.files):
        pytest.skip("who may use what is read from the project file")
    workspace, made, _ = read(example.files, tmp_path / "part", example.executables)
    every = said(check, example, tmp_path)
    for part in parts_of(made, workspace, "", ()):
        ask = part.of_systems if check.run is not None else None
        found = ask(check, "haros-ci") if ask is not None else part.of_project(check, "haros-ci", ())
        assert found is None or found.results == every
