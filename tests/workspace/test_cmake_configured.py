# SPDX-License-Identifier: Apache-2.0
"""What configure_file() writes, where it is found, and what of it is not known."""

from __future__ import annotations

import pytest
from in_memory import MANIFEST, workspace_of

from haros_ci.model.build import NOT_KNOWN, WrittenFile
from haros_ci.workspace.build import builds

USED = "configure_file(urdf/r.in.urdf ${PROJECT_SOURCE_DIR}/urdf/r.urdf @ONLY)\n"
TEMPLATE = '<robot name="@NAME@"><link name="${a}"/></robot>'
INSTALLED = (
    "configure_file(urdf/r.in.urdf r.urdf @ONLY)\n"
    "install(FILES ${CMAKE_CURRENT_BINARY_DIR}/r.urdf DESTINATION share/${PROJECT_NAME}/urdf)\n"
)


def written(cmake: str, template: str = TEMPLATE, **texts: str) -> dict[str, WrittenFile]:
    """What the package ``arm`` writes, by path; its project has this name, too."""
    more = {name.replace("__", "/").replace("_dot_", "."): text for name, text in texts.items()}
    workspace = workspace_of(
        {
            "arm/package.xml": MANIFEST.format("arm"),
            "arm/CMakeLists.txt": f"project(arm)\n{cmake}",
            "arm/urdf/r.in.urdf": template,
            **more,
        }
    )
    return {made.path: made for made in builds(workspace)["arm"].written}


@pytest.mark.parametrize(
    ("cmake", "path"),
    [
        (USED, "arm/urdf/r.urdf"),
        ("configure_file(urdf/r.in.urdf ${PROJECT_SOURCE_DIR}/urdf @ONLY)\n", "arm/urdf/r.in.urdf"),
        (INSTALLED, "arm/urdf/r.urdf"),
        (INSTALLED.replace("FILES", "PROGRAMS"), "arm/urdf/r.urdf"),
        (INSTALLED.replace("/urdf)", "/more RENAME s.urdf)"), "arm/more/s.urdf"),
        (
            "configure_file(urdf/r.in.urdf made/r.urdf @ONLY)\ninstall(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/made DESTINATION share/${PROJECT_NAME})\n",
            "arm/made/r.urdf",
        ),
        (
            "configure_file(urdf/r.in.urdf made/r.urdf @ONLY)\ninstall(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/made/ DESTINATION share/${PROJECT_NAME}/x)\n",
            "arm/x/r.urdf",
        ),
        (
            "configure_file(urdf/r.in.urdf ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION}/urdf/r.urdf @ONLY)\n",
            "arm/urdf/r.urdf",
        ),
    ],
)
def test_where_it_is_found(cmake: str, path: str) -> None:
    made = written(f"set(NAME left)\n{cmake}")[path]
    assert made.template == "arm/urdf/r.in.urdf"
    assert made.text == '<robot name="left"><link name="${a}"/></robot>'


@pytest.mark.parametrize(
    ("cmake", "template", "text"),
    [
        ("set(X 1)\n" + USED, "<a><b>@X@</b></a>", "<a><b>1</b></a>"),
        ('set(X "1")\nset(X "${X}<c/>\\n")\n' + USED, "<a>@X@</a>", "<a>1<c/>\n</a>"),
        ("set(X)\n" + USED, "<a>@X@</a>", "<a></a>"),
        ("option(X h ON)\n" + USED, '<a on="@X@"/>', '<a on="ON"/>'),
        ("set(X 7 CACHE STRING h)\n" + USED, '<a on="@X@"/>', '<a on="7"/>'),
        (USED, '<a on="@PROJECT_NAME@"/>', '<a on="arm"/>'),
        ("set(X 1)\n" + USED.replace(" @ONLY", ""), '<a b="${X}" c="@X@"/>', '<a b="1" c="1"/>'),
        ("set(X 1)\n" + USED.replace("@ONLY", "COPYONLY"), '<a b="${X}" c="@X@"/>', '<a b="${X}" c="@X@"/>'),
        (USED, "<a><!-- me@home.org, you@work.org --></a>", "<a><!-- me@home.org, you@work.org --></a>"),
    ],
)
def test_values(cmake: str, template: str, text: str) -> None:
    assert written(cmake, template)["arm/urdf/r.urdf"].text == text


@pytest.mark.parametrize(
    ("cmake", "reference"),
    [
        ("", "@X@"),
        ("find_package(Foo)\n", "@Foo_DIR@"),
        ("execute_process(COMMAND hostname OUTPUT_VARIABLE X)\n", "@X@"),
        ("if(FOO_FOUND_BY_HAND)\nset(X 1)\nendif()\nfind_path(X y)\n", "@X@"),
        ("set(X ${CMAKE_CURRENT_SOURCE_DIR}/meshes)\n", "@X@"),
        ("set(X ${CMAKE_INSTALL_PREFIX}/share)\n", "@X@"),
        ("", "@CMAKE_INSTALL_PREFIX@"),
        ("", "@CMAKE_CURRENT_BINARY_DIR@"),
        ("", "@CMAKE_BUILD_TYPE@"),
        ("", "@CMAKE_VERSION@"),
    ],
)
def test_what_is_not_known_of_a_value(cmake: str, reference: str) -> None:
    made = written(cmake + USED, f'<a b="x{reference}"><c>{reference}</c></a>')
    assert made["arm/urdf/r.urdf"].text == f'<a b="x{NOT_KNOWN}"><c>{NOT_KNOWN}</c></a>'


@pytest.mark.parametrize(
    ("cmake", "template"),
    [
        ("if(FOO_FOUND)\n" + USED + "endif()\n", TEMPLATE),  # whether it is written is not known
        ("find_package(Foo)\nif(Foo_FOUND)\nset(X 1)\n" + USED + "endif()\n", TEMPLATE),
        ("if(BUILD_TESTING)\n" + USED + "endif()\n", TEMPLATE),
        (USED + USED.replace("r.in.urdf", "s.in.urdf"), TEMPLATE),  # two templates
        ("set(NAME a)\n" + USED + "set(NAME b)\n" + USED, TEMPLATE),  # two values
        (USED.replace("r.in.urdf", "none.in.urdf"), TEMPLATE),
        (USED.replace("urdf/r.in.urdf", "${Foo_DIR}/r.in.urdf").replace("conf", "find_package(Foo)\nconf"), TEMPLATE),
        (USED.replace("urdf/r.urdf", "${Foo_X}.urdf").replace("conf", "find_package(Foo)\nconf"), TEMPLATE),
        (USED.replace("@ONLY", "ESCAPE_QUOTES"), TEMPLATE),
        (USED, "<a>@UNSET@<b/></a>"),  # elements may be hidden in it
        (USED, "<robot>@UNSET@</robot>"),
        (USED, '<a><plugin name="p" filename="f">@UNSET@</plugin></a>'),
        (USED, "<a><xacro:if value='1'>@UNSET@</xacro:if></a>"),
        (USED, "<a><b/>@UNSET@</a>"),
        (USED, "<a><b/>@UNSET@<b/></a>"),
        (USED.replace(" @ONLY", ""), '<a b="${1 + 2}"/>'),  # CMake refuses it
        (USED, "#cmakedefine X\n"),
        (USED, "a: @X@\n"),  # no XML
        (USED, "<a>\n#cmakedefine X\n</a>"),
        ("configure_file(urdf/r.in.urdf r.urdf @ONLY)\n", TEMPLATE),  # nobody installs it
        (INSTALLED.replace("share/${PROJECT_NAME}", "share/other"), TEMPLATE),
        (INSTALLED.replace("DIR}/r.urdf", "DIR}/q.urdf"), TEMPLATE),
        ("configure_file(urdf/r.in.urdf)\n", TEMPLATE),
        ("function(f)\n" + USED + "endfunction()\n", TEMPLATE),  # nobody calls it
    ],
)
def test_not_told(cmake: str, template: str) -> None:
    assert written(cmake, template, arm__urdf__s_dot_in_dot_urdf="<other/>") == {}


def test_a_file_of_the_package_stays_before_one_that_is_only_installed() -> None:
    assert written("set(NAME left)\n" + INSTALLED, arm__urdf__r_dot_urdf="<robot/>") == {}


def test_many_values_behind_a_long_tag_cost_no_more_than_their_length() -> None:
    long = "b" * 50_000
    assert (
        written(USED, f'<robot><a c="{long}">{"x@X@" * 30_000}</a></robot>')["arm/urdf/r.urdf"].text.count(NOT_KNOWN)
        == 30_000
    )
    assert written(USED, f'<robot><a c="{long}">{"x@X@" * 30_000}<b/></a></robot>') == {}
