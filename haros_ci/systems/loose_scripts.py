# SPDX-License-Identifier: Apache-2.0
"""Python programs of a package that no build installs and no shebang marks: started by ``python3 path/of/script.py``, each by itself.

They are in the model, as configurations ``package/name (script)``, since that is how people run them (the listeners and tools beside a driver), and
not in what checks see: nothing says that they run together with anything.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.follow.follow import Entry
from haros_ci.index.index import Source, is_test
from haros_ci.model.build import Build
from haros_ci.systems import ros2_system, system
from haros_ci.systems.following import Types
from haros_ci.systems.system import Job

#: How the name of such a configuration ends.
SCRIPT = "script"
#: Files that tools read, and directories whose files they do.
OTHERS = ("setup.py", "conftest.py", "conf.py")
CLIENTS = {"rospy": 1, "rclpy": 2}


def jobs(types: Types) -> Iterator[Job]:
    """A job for each such program, by path."""
    used = {path for build in types.programs.builds.values() for path in _used(build)}
    used |= {entry.source.path for entry, _ in (*types.ros2_programs.values(), *types.startable.values())}
    names: set[tuple[str, str]] = set()
    for path, source in sorted(types.programs.sources.items()):
        package = source.package or ""
        if path in used or package not in types.programs.builds or not _is_program(source):
            continue
        ros, name = _version(source), posixpath.basename(path)
        name = path if (package, name) in names else name
        names.add((package, name))
        if ros is None or types.versions.get(package) not in (None, ros):
            continue
        made = ros2_system.alone if ros == 2 else system.alone
        yield made(types, package, name, label=SCRIPT, found=(Entry(source), frozenset((path,))))


def _used(build: Build) -> Iterator[str]:
    """The files of a package that are started in another way."""
    yield from build.scripts
    yield from (point.path for point in build.entry_points)
    yield from (installed.path for installed in build.installed if installed.kind == "program")


def _is_program(source: Source) -> bool:
    """Whether a file has the branch of modules that are started, and is not one of a test or a launch file."""
    name = posixpath.basename(source.path)
    if source.separator != "." or is_test(source.path) or name in OTHERS:
        return False
    if name.startswith("test_") or name.endswith(("_test.py", "launch.py")):
        return False
    return any(
        isinstance(statement, syntax.If) and "__name__" in statement.text and "__main__" in statement.text
        for function in source.program.functions
        if function.kind == "module"
        for statement in function.body or ()
    )


def _version(source: Source) -> int | None:
    """The version of ROS whose client library a file imports; None for both or neither."""
    roots = {alias.type.name.partition(".")[0] for alias in source.program.aliases}
    found = [ros for name, ros in CLIENTS.items() if name in roots]
    return found[0] if len(found) == 1 else None
