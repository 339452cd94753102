# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages, workspace_of

from haros_ci.workspace.build import build_of
from haros_ci.workspace.plugins_xml import read_plugins

LIBRARY = """<library path="lib/libarm">
  <class name="arm/Talker" type="arm::Talker" base_class_type="nodelet::Nodelet">
    <description>x</description>
  </class>
  <class type="arm::Other" base_class_type="nodelet::Nodelet"/>
</library>
"""


def rows(text: str) -> list[tuple[str, str, str, str, int | None]]:
    found, _ = read_plugins("p.xml", text, "arm")
    return [(c.name, c.type, c.base, c.library, c.location.line) for c in found]


def test_one_library() -> None:
    assert rows(LIBRARY) == [
        ("arm/Talker", "arm::Talker", "nodelet::Nodelet", "lib/libarm", 2),
        ("arm::Other", "arm::Other", "nodelet::Nodelet", "lib/libarm", 5),
    ]


def test_several_libraries() -> None:
    text = (
        '<class_libraries><library path="a"><class type="A"/></library>\n<library path="b"><class type="B"/></library>'
    )
    assert rows(f"{text}</class_libraries>") == [("A", "A", "", "a", 1), ("B", "B", "", "b", 2)]


def test_what_pluginlib_reads_though_it_is_no_xml() -> None:
    two = '<library path="a"><class type="A"/></library>\n<library path="b"><class type="B"/></library>'
    assert rows(f'<?xml version="1.0"?>\n{two}') == [("A", "A", "", "a", 2), ("B", "B", "", "b", 3)]
    assert rows('<library path="a">\n<class type="A<B>" name="x"/></library>') == [("x", "A<B>", "", "a", 2)]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ('<library path="a">\n<class name="x"/></library>', 2, "<class> without type; pluginlib ignores it"),
        ("<library>", 1, "not well-formed XML: no element found"),
        ("", 1, "not well-formed XML: no element found"),
        ("<launch/>", 1, "<launch> is no plug-in description; expected <library> or <class_libraries>"),
        ("<!DOCTYPE x><library/>", 1, "a document type or entity declaration is not allowed; remove it"),
    ],
)
def test_problems(text: str, line: int, message: str) -> None:
    found, problems = read_plugins("p.xml", text, "arm")
    assert found == [] and [(p.line, p.message) for p in problems] == [(line, message)]


def manifest(export: str) -> str:
    return f'<package format="2">\n<name>arm</name>\n<export>\n{export}\n</export>\n</package>'


def test_manifests_export_them() -> None:
    text = manifest(
        '<nodelet plugin="${prefix}/p.xml"/><build_type>catkin</build_type><a/><b plugin="${prefix}/p.xml"/>'
    )
    workspace = workspace_of({"src/arm/package.xml": text, "src/arm/p.xml": LIBRARY})
    build = build_of(workspace, workspace.packages[0])
    assert [(p.name, p.package, p.location.path) for p in build.plugins] == [
        ("arm/Talker", "arm", "src/arm/p.xml"),
        ("arm::Other", "arm", "src/arm/p.xml"),
    ]
    assert build.problems == ()


def test_a_description_that_is_not_there() -> None:
    workspace = workspace_of({"package.xml": manifest('<nodelet plugin="${prefix}/gone.xml"/>')})
    build = build_of(workspace, workspace.packages[0])
    assert messages(build) == [
        (4, "<nodelet plugin='${prefix}/gone.xml'>: there is no such file; its classes are missing")
    ]


def test_a_description_that_only_a_build_knows() -> None:
    for place in ("${prefix}/${PROJECT_NAME}.xml", "@PLUGIN_FILE@", "$(find arm)/p.xml", "${CMAKE_BINARY_DIR}/p.xml"):
        workspace = workspace_of({"package.xml": manifest(f'<nodelet plugin="{place}"/>')})
        build = build_of(workspace, workspace.packages[0])
        said = f"<nodelet plugin={place!r}>: which file that is, is only known in a build; it is not read"
        assert messages(build) == [(4, said)]


def test_what_other_tools_call_a_plugin() -> None:
    text = manifest('<sound plugin="${prefix}/p.yaml"/><nodelet plugin="${prefix}/q.plugin"/>')
    files = {"package.xml": text, "p.yaml": "- name: x\n", "q.plugin": LIBRARY}
    workspace = workspace_of(files)
    build = build_of(workspace, workspace.packages[0])
    assert (messages(build), len(build.plugins)) == ([], 2)
    assert read_plugins("p.plugin", "<library>", "arm")[1] != []


def test_cmake_exports_them() -> None:
    build = built("pluginlib_export_plugin_description_file(nav2_core p.xml)", p_xml=LIBRARY)
    assert [plugin.name for plugin in build.plugins] == ["arm/Talker", "arm::Other"]
    gone = built("pluginlib_export_plugin_description_file(nav2_core gone.xml)")
    assert messages(gone) == [(1, "the plug-in description arm/gone.xml is not among the files")]
