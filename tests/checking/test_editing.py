# SPDX-License-Identifier: Apache-2.0
"""Edits of manifests: each example is a manifest, what is done to it, and how it reads then."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.checking.editing import (
    add_dependency,
    add_element,
    add_export,
    drop_element,
    rename_element,
    set_attribute,
    set_text,
)
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.results.fix import Fix, applied
from haros_ci.workspace.discover import discover
from haros_ci.workspace.xml import parse_xml

HEAD = '<?xml version="1.0"?>\n<package format="3">\n  <name>demo</name>\n'


def package_of(text: str, tmp_path: Path) -> ProjectPackage:
    (tmp_path / "package.xml").write_bytes(text.encode())
    workspace = discover(tmp_path, (".",))
    project = Project(workspace, {}, {}, (), read_xml=lambda path: parse_xml(workspace.text(path).encode()))
    found = project.package("demo")
    assert found is not None
    return found


def after(package: ProjectPackage, fix: Fix | None) -> str:
    assert fix is not None and {edit.path for edit in fix.edits} == {"package.xml"}
    text = applied((package.project.workspace.root / "package.xml").read_bytes().decode(), fix.edits)
    parse_xml(text.encode())
    return text


DEPENDENCIES = [
    pytest.param("  <depend>a</depend>\n", "  <depend>a</depend>\n  <depend>new</depend>\n", id="after its like"),
    pytest.param("\t<depend>a</depend>\n", "\t<depend>a</depend>\n\t<depend>new</depend>\n", id="indented by a tab"),
    pytest.param(
        "  <depend>a</depend>\n  <depend>z</depend>\n",
        "  <depend>a</depend>\n  <depend>new</depend>\n  <depend>z</depend>\n",
        id="in the order of the alphabet",
    ),
    pytest.param(
        "  <depend>z</depend>\n",
        "  <depend>new</depend>\n  <depend>z</depend>\n",
        id="before the first of the alphabet",
    ),
    pytest.param(
        "  <depend>z</depend>\n  <depend>a</depend>\n",
        "  <depend>z</depend>\n  <depend>a</depend>\n  <depend>new</depend>\n",
        id="last where the alphabet does not count",
    ),
    pytest.param(
        "  <depend>a</depend>  <!-- why -->\n  <!-- more -->\n",
        "  <depend>a</depend>  <!-- why -->\n  <depend>new</depend>\n  <!-- more -->\n",
        id="after the comment of its like",
    ),
    pytest.param(
        "  <!-- <depend>z</depend> -->\n  <depend>\n    a\n  </depend>\n",
        "  <!-- <depend>z</depend> -->\n  <depend>\n    a\n  </depend>\n  <depend>new</depend>\n",
        id="an element on three lines, and one in a comment",
    ),
    pytest.param(
        "  <depend>a</depend><depend>b</depend><export/>\n",
        "  <depend>a</depend><depend>b</depend><depend>new</depend><export/>\n",
        id="on the line of its like",
    ),
    pytest.param(
        "  <depend>a</depend>\n  <depend>b</depend><export/>\n",
        "  <depend>a</depend>\n  <depend>b</depend><depend>new</depend><export/>\n",
        id="on a line that its like shares",
    ),
    pytest.param(
        "  <buildtool_depend>a</buildtool_depend>\n\n  <test_depend>t</test_depend>\n",
        "  <buildtool_depend>a</buildtool_depend>\n  <depend>new</depend>\n\n  <test_depend>t</test_depend>\n",
        id="where the order of tags has it",
    ),
    pytest.param(
        "  <test_depend>t</test_depend>\n",
        "  <depend>new</depend>\n  <test_depend>t</test_depend>\n",
        id="after the name",
    ),
    pytest.param(
        '  <depend version_gte="1>0">a</depend>\n',
        '  <depend version_gte="1>0">a</depend>\n  <depend>new</depend>\n',
        id="a bracket in an attribute",
    ),
    pytest.param(
        "  <description><![CDATA[</package> <depend>b</depend>]]></description>\n  <depend>a</depend>\n",
        "  <description><![CDATA[</package> <depend>b</depend>]]></description>\n  <depend>a</depend>\n  <depend>new</depend>\n",
        id="what looks like tags in CDATA",
    ),
]


@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["lf", "crlf"])
@pytest.mark.parametrize(("before", "expected"), DEPENDENCIES)
def test_a_dependency_comes_beside_its_like(before: str, expected: str, end: str, tmp_path: Path) -> None:
    package = package_of(f"{HEAD}{before}</package>\n".replace("\n", end), tmp_path)
    text = after(package, add_dependency(package, "depend", "new"))
    assert text == f"{HEAD}{expected}</package>\n".replace("\n", end)


def test_a_dependency_that_is_there_is_not_added_again(tmp_path: Path) -> None:
    package = package_of(f"{HEAD}  <depend>a</depend>\n</package>\n", tmp_path)
    assert add_dependency(package, "depend", "a") is None
    assert add_dependency(package, "exec_depend", "a") is not None


@pytest.mark.parametrize(
    ("kind", "added"),
    [
        ("depend", ["build_depend", "run_depend"]),
        ("exec_depend", ["run_depend"]),
        ("build_export_depend", ["run_depend"]),
        ("buildtool_depend", ["buildtool_depend"]),
        ("test_depend", ["test_depend"]),
    ],
)
def test_format_1_has_its_own_kinds(kind: str, added: list[str], tmp_path: Path) -> None:
    text = "<package>\n  <name>demo</name>\n  <run_depend>a</run_depend>\n</package>\n"
    package = package_of(text, tmp_path)
    root = parse_xml(after(package, add_dependency(package, kind, "new")).encode())
    assert sorted(c.tag for c in root.children if c.text == "new") == added


def test_of_two_kinds_of_format_1_only_the_missing_one_is_added(tmp_path: Path) -> None:
    text = "<package>\n  <name>demo</name>\n  <run_depend>a</run_depend>\n</package>\n"
    package = package_of(text, tmp_path)
    assert after(package, add_dependency(package, "depend", "a")) == text.replace(
        "  <run_depend>", "  <build_depend>a</build_depend>\n  <run_depend>"
    )


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ("<package><name>demo</name></package>", "<package><name>demo</name><test_depend>new</test_depend></package>"),
        (
            "<package>\n<name>demo</name>\n</package>",
            "<package>\n<name>demo</name>\n<test_depend>new</test_depend>\n</package>",
        ),
    ],
)
def test_manifests_of_other_layouts(before: str, expected: str, tmp_path: Path) -> None:
    package = package_of(before, tmp_path)
    assert after(package, add_dependency(package, "test_depend", "new")) == expected


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ("  <export>\n    <a/>\n  </export>\n", "  <export>\n    <build_type>x</build_type>\n    <a/>\n  </export>\n"),
        ("  <export><a/></export>\n", "  <export><build_type>x</build_type><a/></export>\n"),
        ("  <export/>\n", "  <export>\n    <build_type>x</build_type>\n  </export>\n"),
        ("  <export>\n  </export>\n", "  <export>\n    <build_type>x</build_type>\n  </export>\n"),
        (
            "  <export><!-- none --></export>\n",
            "  <export>\n    <build_type>x</build_type><!-- none --></export>\n",
        ),
        (
            "  <depend>a</depend>\n",
            "  <depend>a</depend>\n  <export>\n    <build_type>x</build_type>\n  </export>\n",
        ),
    ],
)
def test_an_export_is_added(before: str, expected: str, tmp_path: Path) -> None:
    package = package_of(f"{HEAD}{before}</package>\n", tmp_path)
    assert after(package, add_export(package, "build_type", "x", "say it")) == f"{HEAD}{expected}</package>\n"


def test_elements_are_renamed_dropped_and_set(tmp_path: Path) -> None:
    body = '  <run_depend condition="$A == 1">a</run_depend>\n  <run_depend />\n  <b>1</b> <c>2</c>\n'
    package = package_of(f"{HEAD}{body}</package>\n", tmp_path)
    assert package.manifest is not None
    first, empty, b, c = package.manifest.children[1:]
    assert after(package, rename_element(package, first, "exec_depend", "")) == (
        f"{HEAD}{body}</package>\n".replace("run_depend condition", "exec_depend condition").replace(
            "a</run_depend>", "a</exec_depend>"
        )
    )
    assert "<exec_depend />" in after(package, rename_element(package, empty, "exec_depend", ""))
    assert after(package, drop_element(package, empty, "")) == f"{HEAD}{body}</package>\n".replace(
        "  <run_depend />\n", ""
    )
    assert after(package, drop_element(package, b, "")) == f"{HEAD}{body}</package>\n".replace("<b>1</b>", "")
    assert "<c>a &lt; b</c>" in after(package, set_text(package, c, "a < b", ""))
    assert set_text(package, empty, "x", "") is None


def test_a_manifest_that_is_none_is_not_edited(tmp_path: Path) -> None:
    package = package_of(f"{HEAD}</package>\n", tmp_path)
    blind = Project(package.project.workspace, {}, {}).package("demo")
    assert blind is not None
    assert add_element(blind, "depend", "a", "") is None
    assert add_dependency(blind, "depend", "a") is None


@pytest.mark.parametrize(
    ("head", "expected"),
    [
        ("<package>", '<package format="3">'),
        ('<package format="2">', '<package format="3">'),
        ("<package xmlns:xi='x'\n   format = '2' >", "<package xmlns:xi='x'\n   format = \"3\" >"),
    ],
)
def test_an_attribute_is_set(head: str, expected: str, tmp_path: Path) -> None:
    package = package_of(f"{head}\n  <name>demo</name>\n</package>\n", tmp_path)
    assert package.manifest is not None
    text = after(package, set_attribute(package, package.manifest, "format", "3", ""))
    assert text == f"{expected}\n  <name>demo</name>\n</package>\n"
