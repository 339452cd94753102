# SPDX-License-Identifier: Apache-2.0
"""What --show-settings prints."""

from __future__ import annotations

from pathlib import Path

from haros_ci.config.describe import describe
from haros_ci.config.load import load
from haros_ci.config.settings import Settings
from haros_ci.config.yaml_lines import parse

FILE = """\
profile: strict
select: [pylint]
levels: {a: off, "b*": note}
per-path:
  test/**:
    profile: bugs-only
    ignore: [cpplint]
linters:
  pylint: {timeout: 60}
  ruff: false
baseline: known.jsonl
analysis: {ignore: {tags: [formatting], files: [gen]}}
plugins: [mine]
"""

SHOWN = """\
# project file: ".haros-ci.yaml"
profile: strict  # .haros-ci.yaml:1
fail-on: error  # command line
exclude: ["build"]  # command line
packages: []  # default
ignore-files: ["*/gen"]  # analysis.ignore.files
max-file-size: 2000000  # default
compile-database: null  # default
baseline: known.jsonl  # .haros-ci.yaml:11
plugins: []  # .haros-ci.yaml:13
trust-config: false
linters:  # .haros-ci.yaml:8
  pylint: {"timeout": 60.0}
  ruff: {"enabled": false}
select: ["pylint"]
ignore: ["formatting"]
levels:
  a: off
  "b*": note
per-path:
  "test/**":
    profile: bugs-only
    ignore: ["cpplint"]
# on the command line, beating all of the above:
ignore: ["x"]
# note: .haros-ci.yaml:13: plugins are loaded only with --trust-config
"""


def test_describe(tmp_path: Path) -> None:
    (tmp_path / ".haros-ci.yaml").write_text(FILE, encoding="utf-8")
    flags = {"fail_on": "error", "exclude": ("build",), "ignore": ("x",)}
    assert describe(load(tmp_path, command_line=flags)) == SHOWN


def test_the_defaults() -> None:
    text = describe(Settings(root=Path("/ws")))
    assert text.startswith("# project file: none\nprofile: ros  # default\n")
    assert "/ws" not in text


def test_foreign_text_is_escaped_and_stays_yaml(tmp_path: Path) -> None:
    odd = 'ignore: ["\\e]0;x\\a", "no", "a: b", "\\u202e"]\nlevels: {"\\n::error": note}\nexclude: ["\\n#"]'
    (tmp_path / ".haros-ci.yaml").write_text(odd, encoding="utf-8")
    text = describe(load(tmp_path))
    assert text.isascii() and all(c.isprintable() or c == "\n" for c in text)
    assert "\n::error" not in text
    assert parse(text.encode(), "f").top is not None
