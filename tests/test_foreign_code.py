# SPDX-License-Identifier: Apache-2.0
"""Large copies of libraries that name nothing of ROS are libraries for the model: what they include is all that is read of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from haros_ci.analysis import foreign_code
from haros_ci.analysis.foreign_code import foreign, head
from haros_ci.analysis.programs import programs
from haros_ci.extract.apis.tables import rows
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

COPY = "p/third_party/solver"
MANIFEST = "<package format='2'><name>p</name><version>1.0.0</version></package>"
OWN = '#include "solver/solver.hpp"\nint main() { return 0; }\n'
LONG = "#include <vector>\nnamespace solver {\nstruct Base { virtual void run(); };\nint twice(int a) { return 2 * a; }\n}\n"


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(foreign_code, "LARGE", 5)


def functions(root: Path, files: Mapping[str, str], *, in_full: bool = False) -> dict[str, list[str]]:
    """The functions that are read, by path."""
    for path, text in {"p/package.xml": MANIFEST, "p/src/main.cpp": OWN, **files}.items():
        file = root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    found = programs(discover(root, ()), {}, MemoryCache(), [], in_full=in_full)
    return {each.path: [function.name for function in each.program.functions] for each in found}


@pytest.mark.parametrize(
    "more",
    [
        {},
        {f"{COPY}/macros.hpp": "#define across macros::list\n"},  # and no ros::
        {f"{COPY}/other.hpp": "struct Twice;\n", "p/src/own.cpp": "struct Own : std::Base {};\n"},
        {f"{COPY}/detail/ros.hpp": "// throws of rosy colour\n"},
        {"p/src/own.cpp": '#include "inner.hpp"\n'},  # of its own
        {"p/third_party/driver/driver.hpp": f"{LONG}ros::NodeHandle nh;\n"},  # another one
    ],
)
def test_a_large_copy_without_ros_is_not_read(more: Mapping[str, str], tmp_path: Path) -> None:
    found = functions(tmp_path, {f"{COPY}/inside.hpp": LONG, **more})
    assert found[f"{COPY}/inside.hpp"] == []
    assert found["p/src/main.cpp"] == ["main"]


def test_a_tree_of_a_well_known_library_is_not_read_whatever_includes_it(tmp_path: Path) -> None:
    tree = {f"p/include/fmt/{name}": LONG for name in ("format.h", "core.h", "ostream.h")}
    own = "#include <fmt/format.h>\nstruct Own : fmt::Base {};\n"
    found = functions(tmp_path, {**tree, "p/src/own.cpp": own})
    assert all(found[path] == [] for path in tree)


@pytest.mark.parametrize(
    "more",
    [
        {f"{COPY}/node.hpp": "void f(ros::NodeHandle nh);\n"},
        {f"{COPY}/node.hpp": "#include <rclcpp/rclcpp.hpp>\n"},
        {f"{COPY}/node.hpp": '#include "std_msgs/String.h"\n'},
        {f"{COPY}/node.hpp": "PLUGINLIB_EXPORT_CLASS(A, B)\n"},
        {f"{COPY}/node.hpp": "#define SAY(x) ROS_INFO(x)\n"},
        {f"{COPY}/node.cpp": "rcl_publisher_t publisher;\n"},
        {"p/src/own.cpp": "struct Own : solver::Base { void run() override; };\n"},
        {"p/src/own.cpp": "#include <solver/inside.hpp>\n"},
        {"p/src/own.cpp": '#include "../third_party/solver/inside.hpp"\n'},
    ],
)
def test_what_own_code_may_need_is_read(more: Mapping[str, str], tmp_path: Path) -> None:
    found = functions(tmp_path, {f"{COPY}/inside.hpp": LONG, **more})
    assert "solver::twice" in found[f"{COPY}/inside.hpp"]


@pytest.mark.parametrize(
    "path",
    ["p/src/inside.hpp", "p/solver/inside.hpp", f"{COPY}/inside.py", "p/third_party_notes/inside.hpp"],
)
def test_what_is_no_copy_or_no_cpp_is_read(path: str, tmp_path: Path) -> None:
    text = "# a\n" * 9 + "def twice(a):\n    return 2 * a\n" if path.endswith(".py") else LONG
    assert any(name.endswith("twice") for name in functions(tmp_path, {path: text})[path])


def test_small_copies_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(foreign_code, "LARGE", 6)
    assert "solver::twice" in functions(tmp_path, {f"{COPY}/inside.hpp": LONG})[f"{COPY}/inside.hpp"]


def test_metrics_read_all(tmp_path: Path) -> None:
    assert "solver::twice" in functions(tmp_path, {f"{COPY}/inside.hpp": LONG}, in_full=True)[f"{COPY}/inside.hpp"]


def test_a_workspace_without_copies_has_none(tmp_path: Path) -> None:
    functions(tmp_path, {"p/src/inside.hpp": LONG})
    assert foreign(discover(tmp_path, ())) == {}


def test_what_a_file_includes_is_as_in_the_whole_program() -> None:
    text = '#include <vector>\n  #  include "a/b.hpp" // c\n#include MACRO\n#include <vector>\n'
    assert head(text).includes == ("<vector>", '"a/b.hpp"')


def test_the_libraries_that_rows_describe_are_names_of_ros() -> None:
    no_ros = {"std", "boost", "QString", "QObject"}
    spaces = {
        row.call.removeprefix("::").partition("::")[0]
        for ros in (1, 2)
        for row in rows("cpp", ros)
        if "::" in row.call and not row.call.startswith("operator")
    }
    assert spaces - no_ros <= set(foreign_code.SPACES)
