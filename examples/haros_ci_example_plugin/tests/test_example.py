# SPDX-License-Identifier: Apache-2.0
"""The page of the check is true, and the linter's output is read rightly."""

from __future__ import annotations

from pathlib import Path

import haros_ci_example_plugin
import pytest
from haros_ci_example_plugin import todo
from haros_ci_example_plugin.camel_case_topic import CHECK

from haros_ci.api.linters import Batch, LintOptions, Output
from haros_ci.api.testing import Example, examples_of, faults, faults_of_page, filled, read

PAGE = Path(haros_ci_example_plugin.__file__).with_name("camel_case_topic.md").read_text(encoding="utf-8")


def test_the_page_is_whole() -> None:
    assert not faults_of_page(CHECK, PAGE)


@pytest.mark.parametrize("example", examples_of(PAGE), ids=lambda example: example.title)
def test_the_page_is_true(example: Example, tmp_path: Path) -> None:
    assert not faults(CHECK, example, tmp_path)


def test_the_linters_output_is_read(tmp_path: Path) -> None:
    workspace, _, _ = read({"a.py": "x = 1  # TODO later\n"}, tmp_path)
    batch = Batch(workspace, (), LintOptions(), tmp_path)
    (found,) = todo.parse(Output(b'[["./a.py", 1, 10, "later"]]', b"", 0), batch)
    assert (found.unit, found.result.rule, str(found.result.location)) == ("a.py", "no-owner", "a.py:1:10")


@pytest.mark.parametrize("stdout", [b"", b"[[1]]", b"{}{}"])
def test_nonsense_is_refused(stdout: bytes, tmp_path: Path) -> None:
    workspace, _, _ = read({"a.py": "x = 1\n"}, tmp_path)
    with pytest.raises(ValueError):
        list(todo.parse(Output(stdout, b"", 0), Batch(workspace, (), LintOptions(), tmp_path)))


def test_the_wrapper_publishes(tmp_path: Path) -> None:
    code = (
        "import rclpy\nfrom rclpy.node import Node\nimport acme_ros\n\n"
        'rclpy.init()\nnode = Node("lamp")\nacme_ros.beacon(node, "red")\n'
    )
    _, made, _ = read(filled({"lamp.py": code}), tmp_path, plugins=("haros_ci_example_plugin",))
    (configuration,) = made.architecture.configurations
    (node,) = configuration.nodes
    assert "/red/beacon" in [end.name for end in node.endpoints if end.kind == "publishers"]
