# SPDX-License-Identifier: Apache-2.0
"""Python programs of a package that no build installs and no shebang marks: started by ``python3 path/of/script.py``, each by itself.

They are in the model, as configurations ``package/name (script)``, since that is how people run them (the listeners and tools beside a driver), and
not in what checks see: nothing says that they run together with anything.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator

from haros_ci import syntax
from haros_ci.follow.follow import Entry
from haros_ci.index.index import Source, is_test
from haros_ci.model.build import Build
from haros_ci.systems import other_ros, ros2_system, system
from haros_ci.systems.following import Types
from haros_ci.systems.system import Job

#: How the name of such a configuration ends.
SCRIPT = "script"
#: Files that tools read, and directories whose files they do.
OTHERS = ("setup.py", "conftest.py", "conf.py")


def jobs(types: Types, launched: Iterable[Job]) -> Iterator[Job]:
    """A job for each such program, by path, but for those that launch files start by their paths (*launched*)."""
    groups = {job.group for job in launched}
    started = {path for path, (entry, _) in types.by_file.items() if id(entry) in groups}
    names: set[tuple[str, str]] = set()
    for path, source, ros in _programs(types):
        if path in started:
            continue
        package, name = source.package or "", posixpath.basename(path)
        name = path if (package, name) in names else name
        names.add((package, name))
        if types.versions.get(package) in (None, ros):
            made = ros2_system.alone if ros == 2 else system.alone
            yield made(types, package, name, label=SCRIPT, found=(Entry(source), frozenset((path,))))


def of_other_ros(types: Types) -> Iterator[tuple[str, int]]:
    """Those of them that are of the other ROS than their package, by path, with that ROS."""
    for path, source, ros in _programs(types):
        if types.versions.get(source.package or "") not in (None, ros):
            yield path, ros


def _programs(types: Types) -> Iterator[tuple[str, Source, int]]:
    """Each such program by path, with the ROS whose client library it uses."""
    used = {path for build in types.programs.builds.values() for path in _used(build)}
    used |= {entry.source.path for entry, _ in (*types.ros2_programs.values(), *types.startable.values())}
    for path, source in sorted(types.programs.sources.items()):
        if path in used or (source.package or "") not in types.programs.builds or not _is_program(source):
            continue
        ros = other_ros.client_of(types.programs, source)
        if ros is not None:
            yield path, source, ros


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
