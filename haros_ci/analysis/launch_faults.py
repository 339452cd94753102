# SPDX-License-Identifier: Apache-2.0
"""What roslaunch and ros2 launch refuse in a launch file as soon as they read it, whatever its arguments are."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from haros_ci.launch.ros1 import dialect
from haros_ci.linters.python2 import is_newer
from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.regex import regex

#: What only roslaunch has: a file with it was left over from ROS 1, which another rule says once.
_OF_ROS1 = regex(
    r"\$\((?:find|arg|optenv)\s|<(?:rosparam|test|machine|master)\b|<(?:node|test)\b[^<>]*\stype\s*=|\bclear_params\s*="
)
#: A parameter or remapping for what comes after it, as ROS 1 alone has it; so many files of ROS 1 beside it say that it is a leftover, too.
_FOR_OTHERS = regex(r"launch knows no <(?:param|remap)> here")
_MANY = 3
_YAML = (".launch.yaml", ".launch.yml", "_launch.yaml", "_launch.yml")
_PYTHON = (".launch.py", "_launch.py", "-launch.py")
#: How an extension of launch registers a tag (launch/frontend/expose.py).
_EXPOSED = regex(r"\bexpose_action\(\s*[\"']([\w-]+)[\"']")
#: How sentences on limits of ours begin.
_LIMITS = ("more than ", "nested deeper ")
#: Packages of find_package() commands.
_FOUND = regex(r"(?m)^[ \t]*find_package[ \t]*\([ \t\n]*([\w.-]+)", re.I)
#: How packages end that depend on launch to test themselves, or hold launch files alone.
_NO_EXTENSION = ("_msgs", "_interfaces", "launch_testing_ament_cmake", "_bringup", "_description")
#: A package that registers tags depends on one of these, whose own tags are all known.
_OF_LAUNCH = frozenset(
    ("launch", "launch_ros", "launch_xml", "launch_yaml", "launch_testing", "launch_testing_ros", "ros2launch")
)
#: roslaunch's xmlloader.py, ``reqd_attrs``.
_REQUIRED = {
    "node": ("pkg", "type", "name"),
    "test": ("test-name", "pkg", "type"),
    "include": ("file",),
    "arg": ("name",),
    "param": ("name",),
    "remap": ("from", "to"),
    "env": ("name", "value"),
    "machine": ("name", "address"),
}
_ENTERED = frozenset(("launch", "group", "node", "test", "include"))


def refused(workspace: Workspace) -> Iterator[Problem]:
    """Every place at which launch ends with an error, by file; templates, by their path, are left out.

    Of XML that is not well-formed the first fault. What is under a condition in a file of ROS 1 may never be read, so of that nothing is
    said.
    """
    from haros_ci.analysis.architecture import launch_reader
    from haros_ci.launch.ros2.dialect import is_ros2_file

    read = launch_reader(workspace)
    of_ros2 = is_ros2_file(workspace)
    own_tags: frozenset[str] | None = None
    ros = {package.name: package.ros for package in workspace.packages}
    extended: dict[str, bool] = {}
    unported: dict[str, bool] = {}
    for file in workspace.files:
        if "template" in file.path.lower():
            continue
        if file.language == "launch":
            is_ros1 = ros.get(file.package or "") == 1
            for problem in _of_tags(workspace, file.path, read, of_ros2(file.path), is_ros1):
                if not problem.is_certain:
                    own_tags = _registered(workspace) if own_tags is None else own_tags
                    if any(f"<{tag}>" in problem.message for tag in own_tags):
                        continue
                    owner = file.package or ""
                    if owner not in extended:
                        extended[owner] = _may_be_extended(workspace, owner)
                    if extended[owner]:
                        continue
                if not is_ros1 and _FOR_OTHERS.match(problem.message):
                    owner = file.package or ""
                    if owner not in unported:
                        unported[owner] = _is_unported(workspace, owner)
                    if unported[owner]:
                        continue
                yield problem
        elif file.language == "python" and file.path.endswith(_PYTHON) and ros.get(file.package or "") == 2:
            yield from _of_python(workspace, file.path)


def _of_tags(
    workspace: Workspace, path: str, read: Callable[[str], LaunchFile | None], of_ros2: bool, is_ros1: bool
) -> Iterator[Problem]:
    text = workspace.text(path)
    if path.endswith(_YAML):
        if of_ros2 and not is_ros1:
            from haros_ci.extract.launch.ros2_yaml import read_ros2_yaml

            description = read_ros2_yaml(text, path)
            yield from _problems(path, description.problems) if description is not None else ()
        return
    if not text.lstrip().startswith("<"):
        return
    launch = read(path)
    if launch is None:
        return
    if launch.root is None:
        yield from (Problem(path, message, line) for line, message in launch.problems[:1])
    elif is_ros1:
        # what has more of ROS 2 than of ROS 1 is for a build of the package in ROS 2, or a leftover, which another rule says once
        yield from _of_ros1(path, launch.root) if dialect.is_ros1(launch, 1) else ()
    elif of_ros2 and launch.root.tag == "launch" and not _OF_ROS1.search(text):
        from haros_ci.extract.launch.ros2_xml import read_ros2_xml

        yield from _problems(path, read_ros2_xml(launch, path).problems[len(launch.problems) :])


def _is_unported(workspace: Workspace, package: str) -> bool:
    """Whether *package* has many launch files of ROS 1: another rule says once that it has."""
    files = (file.path for file in workspace.files if file.language == "launch" and (file.package or "") == package)
    found = (path for path in files if not path.endswith(_YAML) and _OF_ROS1.search(workspace.text(path)))
    return sum(1 for _ in islice(found, _MANY)) == _MANY


def _problems(path: str, found: tuple[tuple[int, str], ...]) -> Iterator[Problem]:
    from haros_ci.extract.launch.ros2_entity import EXTENSION

    return (
        Problem(path, message, line, is_certain=not message.startswith(EXTENSION))
        for line, message in found
        if not message.startswith(_LIMITS)
    )


def _registered(workspace: Workspace) -> frozenset[str]:
    """The tags that Python code of the workspace registers with launch's front ends."""
    texts = (workspace.text(file.path) for file in workspace.files if file.language == "python")
    return frozenset(match[1] for text in texts if "expose_action" in text for match in _EXPOSED.finditer(text))


def _may_be_extended(workspace: Workspace, name: str) -> bool:
    """Whether the package *name* declares, or finds in its CMakeLists.txt, a package from elsewhere that may register tags.

    One that registers tags depends on launch, so a package from elsewhere may unless its dependencies are known and launch is not
    among them. Keys of rosdep, packages of launch itself and what the workspace holds do not.
    """
    from haros_ci.knowledge.knowledge import knowledge

    known = knowledge()
    here = {package.name for package in workspace.packages}
    names: set[str] = set()
    for package in workspace.packages:
        if package.name == name:
            names.update(dependency.name for dependency in package.dependencies)
            listed = f"{package.path}/CMakeLists.txt" if package.path not in ("", ".") else "CMakeLists.txt"
            found = {match[1] for match in _FOUND.finditer(workspace.text(listed))}
            names.update(item for item in found if known.is_package(item))
    for item in sorted(names - here - _OF_LAUNCH):
        needs = known.depends(item, 2)
        if needs is None and not known.is_key(item) and "-" not in item:
            return True
        if needs is not None and not _OF_LAUNCH.isdisjoint(needs) and not item.endswith(_NO_EXTENSION):
            return True
    return False


def _of_ros1(path: str, element: LaunchElement) -> Iterator[Problem]:
    if element.get("if") is not None or element.get("unless") is not None:
        return
    missing = [name for name in _REQUIRED.get(element.tag, ()) if element.get(name) is None]
    if missing:
        yield Problem(path, f"<{element.tag}> lacks the attribute '{missing[0]}'; add it", element.line)
    name = element.get("name") or ""
    if element.tag == "node" and "$(eval" not in name and "/" in re.sub(r"\$\([^()]*\)", "", name):
        yield Problem(
            path,
            f"node name '{name}' contains a namespace, which roslaunch rejects; write ns=... instead",
            element.line,
        )
    if element.tag in _ENTERED:
        for child in element.children:
            yield from _of_ros1(path, child)


def _of_python(workspace: Workspace, path: str) -> Iterator[Problem]:
    from haros_ci.extract.python.read import syntax_error

    text = workspace.text(path)
    error = syntax_error(text)
    if error is not None and not is_newer((text.split("\n")[error[0] - 1 : error[0]] or [""])[0], error[1]):
        yield Problem(
            path, f"Python syntax error: {error[1]}; ros2 launch cannot load the file; correct the syntax", error[0]
        )
