# SPDX-License-Identifier: Apache-2.0
"""A check's page: Markdown whose examples are small workspaces, and which lines of them the check reports.

The examples stand under ``## Bad`` and ``## Good``, each a ``### title`` with one fence per file::

    ```python title="listener.py"
    sub = node.create_subscription(Image, "scan", callback, 1)  # expect: topic-type-mismatch
    ```

A comment ``expect: <id>`` marks a line that is reported, in any comment syntax; ``expect-next: <id>`` marks the line after it, where
a comment cannot end the line. ``executable`` after the title sets the file's execute bit. Without a title of its own a section is one example. Files that every
package has (package.xml, CMakeLists.txt) are filled in where an example has no package.xml: its files are then those of the package
``demo``, with an executable for each C++ file and each Python file outside ``launch``, ``config`` and the like.

A title ``base/msg/Pose.msg`` gives what the file ``msg/Pose.msg`` was at the base revision: an example with such a fence shows a
change. At the base are the other files as they are now; an empty fence says that the file was not there yet. A file that only the
base has is removed by the change.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Titles of the files of the base revision begin with it.
BASE = "base/"
#: Directories of definitions, and how CMake calls what is in them.
KINDS = {"msg": "message", "srv": "service", "action": "action"}
#: Sections that a page has, in this order.
SECTIONS = ("What it finds", "Why it matters", "Bad", "Good", "Limits")
_FENCE = regex(r"^```(\w*)[ \t]+title=\"([^\"\n]+)\"[ \t]*(executable)?[ \t]*\n(.*?)^```[ \t]*$", re.M | re.S)
_HEAD = regex(r"^(#{1,3}) (.+)$", re.M)
_EXPECT = regex(r"\bexpect(-next)?: ([a-z0-9-]+)")


@dataclass(frozen=True, slots=True)
class Example:
    """A workspace as texts by path, and where the check reports: pairs of a path and a line.

    *base* is the workspace before the change that the example shows; None if it shows no change.
    *executables* are the paths of files with the execute bit: ``executable`` follows their title.
    """

    title: str
    is_bad: bool
    files: Mapping[str, str]
    expected: tuple[tuple[str, int], ...] = ()
    base: Mapping[str, str] | None = None
    executables: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Page:
    """*title* is the rule's id, *sections* the titles of the second level in order, *examples* the bad ones first."""

    title: str
    sections: tuple[str, ...]
    examples: tuple[Example, ...]


@dataclass(slots=True)
class _OpenFence:
    title: str
    is_bad: bool
    files: dict[str, str] = field(default_factory=dict)
    executables: set[str] = field(default_factory=set)


def read_page(text: str) -> Page:
    """The page in *text*; a page without a title or examples has none, which tests/test_checks.py refuses."""
    title, sections, section = "", [], ""
    examples: list[_OpenFence] = []
    for kind, first, second in _parts(text):
        if kind != "head":
            if section in ("Bad", "Good"):
                if not examples or examples[-1].is_bad != (section == "Bad"):
                    examples.append(_OpenFence(section, section == "Bad"))
                examples[-1].files[first] = second
                if kind == "program":
                    examples[-1].executables.add(first)
        elif first == "#":
            title = second
        elif first == "##":
            section = second
            sections.append(second)
        elif section in ("Bad", "Good"):
            examples.append(_OpenFence(second, section == "Bad"))
    return Page(title, tuple(sections), tuple(_example(example, title) for example in examples if example.files))


def _parts(text: str) -> Iterator[tuple[str, str, str]]:
    """Headings and titled code fences, in order; a line like a heading inside a fence is no heading."""
    at = 0
    for fence in re.finditer(r"^```.*?^```[ \t]*$", text, re.M | re.S):
        yield from (("head", head[1], head[2].strip()) for head in _HEAD.finditer(text[at : fence.start()]))
        found = _FENCE.fullmatch(fence[0])
        if found is not None:
            yield "program" if found[3] else "fence", found[2], found[4]
        at = fence.end()
    yield from (("head", head[1], head[2].strip()) for head in _HEAD.finditer(text[at:]))


def _example(found: _OpenFence, rule: str) -> Example:
    files = {path: text for path, text in found.files.items() if not path.startswith(BASE)}
    before = {path.removeprefix(BASE): text for path, text in found.files.items() if path.startswith(BASE)}
    base = {path: text for path, text in {**files, **before}.items() if text or path not in before} if before else None
    expected = [
        (path, number + (1 if mark[1] else 0))
        for path, text in files.items()
        for number, line in enumerate(text.split("\n"), 1)
        for mark in _EXPECT.finditer(line)
        if mark[2] == rule
    ]
    return Example(
        title=found.title,
        is_bad=found.is_bad,
        files=filled(files),
        expected=tuple(sorted(expected)),
        base=None if base is None else filled(base),
        executables=frozenset(found.executables),
    )


def filled(files: Mapping[str, str]) -> dict[str, str]:
    """*files* as they are if one is a package.xml, else with what makes them the package ``demo``."""
    if any(path.rpartition("/")[2] == "package.xml" for path in files):
        return dict(files)
    is_old = any(
        path.endswith(".launch") or re.search(r"\brospy\b|\bros/ros\.h\b", text) for path, text in files.items()
    )
    names = sorted(files)
    programs = [path for path in names if path.endswith(".cpp")]
    scripts = [path for path in names if path.endswith(".py") and path.partition("/")[0] not in ("launch", "config")]
    folders = sorted({path.partition("/")[0] for path in names if "/" in path} - {"src", "scripts", "include", *KINDS})
    interfaces = [path for path in names if path.partition("/")[0] in KINDS]
    made = {
        "package.xml": _manifest(is_old, bool(interfaces)),
        "CMakeLists.txt": _cmake(is_old, programs, scripts, folders, interfaces),
    }
    return {**made, **files}


#: What the manifest of a package with interfaces has besides, in ROS 2 and in ROS 1.
_GENERATES = {
    False: "<buildtool_depend>rosidl_default_generators</buildtool_depend><exec_depend>rosidl_default_runtime</exec_depend>"
    "<member_of_group>rosidl_interface_packages</member_of_group>",
    True: "<build_depend>message_generation</build_depend><exec_depend>message_runtime</exec_depend>",
}


def _manifest(is_old: bool, has_interfaces: bool) -> str:
    tool, client = ("catkin", "roscpp") if is_old else ("ament_cmake", "rclcpp")
    group = _GENERATES[is_old] if has_interfaces else ""
    return (
        '<?xml version="1.0"?>\n<package format="3">\n  <name>demo</name><version>1.0.0</version>'
        "<description>An example.</description>\n"
        '  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>\n'
        f"  <buildtool_depend>{tool}</buildtool_depend><depend>{client}</depend>{group}\n"
        f"  <export><build_type>{tool}</build_type></export>\n</package>\n"
    )


def _generated(is_old: bool, interfaces: list[str]) -> list[str]:
    """What generates the code of *interfaces*."""
    if not interfaces:
        return []
    if not is_old:
        names = " ".join(f'"{path}"' for path in interfaces)
        return [
            "find_package(rosidl_default_generators REQUIRED)",
            f"rosidl_generate_interfaces(${{PROJECT_NAME}} {names})",
        ]
    lines = ["find_package(catkin REQUIRED COMPONENTS message_generation)"]
    for kind, word in KINDS.items():
        names = " ".join(path.rpartition("/")[2] for path in interfaces if path.startswith(f"{kind}/"))
        lines += [f"add_{word}_files(FILES {names})"] if names else []
    return [*lines, "generate_messages()"]


def _cmake(is_old: bool, programs: list[str], scripts: list[str], folders: list[str], interfaces: list[str]) -> str:
    to = (
        ("${CATKIN_PACKAGE_BIN_DESTINATION}", "${CATKIN_PACKAGE_SHARE_DESTINATION}")
        if is_old
        else ("lib/demo", "share/demo")
    )
    find = "catkin REQUIRED COMPONENTS roscpp" if is_old else "rclcpp REQUIRED"
    lines = ["cmake_minimum_required(VERSION 3.8)", "project(demo)", f"find_package({find})"]
    lines += _generated(is_old, interfaces)
    lines += ["catkin_package()"] if is_old else ["find_package(ament_cmake REQUIRED)"]
    for path in programs:
        name = path.rpartition("/")[2].removesuffix(".cpp")
        lines += [f"add_executable({name} {path})", f"install(TARGETS {name} DESTINATION {to[0]})"]
        lines += [] if is_old else [f"ament_target_dependencies({name} rclcpp)"]
    lines += [f"install(PROGRAMS {path} DESTINATION {to[0]})" for path in scripts]
    lines += [f"install(DIRECTORY {folder} DESTINATION {to[1]})" for folder in folders]
    lines += [] if is_old else ["ament_package()"]
    return "\n".join((*lines, ""))
