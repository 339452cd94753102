# SPDX-License-Identifier: Apache-2.0
"""Dependencies of a manifest that nobody has, and that are a slip of one that the package uses."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.api import (
    Check,
    Finding,
    Fix,
    Level,
    Location,
    Project,
    ProjectPackage,
    is_slip,
    listed,
    regex,
    spelled_out,
)
from haros_ci.api.packages import (
    OF_PYTHON,
    Need,
    distributions_of,
    drop_element,
    first_provider,
    holds_for_python,
    imports_of,
    is_nowhere,
    meant_released,
    needs_of,
    normal,
    place,
    repositories_named,
    stem_of_system,
    word,
)

_NAME = regex(r"[A-Za-z][\w-]{1,100}")
#: Files that bring sources of other repositories into the workspace.
_SOURCES = regex(r"\.(?:repos|rosinstall)$|(?:^|/)\.gitmodules$")
#: The most names of one package for which a correction is searched, and the most needs that are compared with them.
MAX_UNKNOWN = 100
MAX_NEEDS = 2_000


def check(project: Project) -> Iterator[Finding]:
    sources = project.sources
    for package in project.packages:
        yield from _together(package)
        yield from _of_python(package)
        declared = _declared(package)
        unknown = [name for name in sorted(declared) if is_nowhere(name, package.project) and name not in OF_PYTHON]
        if not unknown or package.manifest is None:
            continue
        needs = [
            need
            for tests in (False, True)
            for need in (*needs_of(package, sources, tests=tests), *imports_of(package, sources, tests=tests))
            if not need.providers & declared.difference(unknown)
        ]
        for name in unknown[:MAX_UNKNOWN]:
            meant: dict[str, Need] = {}
            for need in needs[:MAX_NEEDS]:
                alike = frozenset(provider for provider in need.providers - {name} if _is_meant(name, provider, need))
                there = _there(alike, package) or _there(need.providers if alike else frozenset(), package)
                if (
                    there
                ):  # the one to be had where the package is used: python3-x, where nothing here has keys of Python 2
                    meant.setdefault(first_provider(there, package), need)
            if meant:
                yield _finding(package, name, meant)
            elif (released := _released(name, package, declared)) is not None:
                yield _slip_of_released(package, name, released)


def _together(package: ProjectPackage) -> Iterator[Finding]:
    """Tags that hold several names: each is read as one name with blanks in it."""
    for child in package.manifest.children if package.manifest is not None else ():
        names = word(child).split() if child.tag.endswith("depend") else []
        if 1 < len(names) <= MAX_UNKNOWN and all(map(_NAME.fullmatch, names)):
            yield Finding(
                at=place(package, child),
                message=f"a <{child.tag}> of {package.name} holds {len(names)} names, {listed(names)}, and is read as one, which is neither a "
                "ROS package nor a rosdep key: rosdep stops here, and the build order leaves them out; write a tag for each",
                about=(package.name, word(child)),
                apart=(child.tag, *names),
            )


def _of_python(package: ProjectPackage) -> Iterator[Finding]:
    """Modules that come with Python, which is declared by no name of theirs: one finding for all of a manifest."""
    children = package.manifest.children if package.manifest is not None else ()
    found = [
        child
        for child in children
        if child.tag.endswith("depend") and word(child) in OF_PYTHON and is_nowhere(word(child), package.project)
    ]
    if not any(_is_imported(word(child), package) for child in found):
        return
    names = list(dict.fromkeys(map(word, found)))
    many = len(names) > 1
    drops = [drop_element(package, child, "") for child in found]
    edits = tuple(edit for drop in drops if drop is not None for edit in drop.edits)
    yield Finding(
        at=place(package, found[0]),
        message=f"{package.name} depends on {spelled_out(names)}, which {'are modules' if many else 'is a module'} of Python itself and neither "
        f"{'ROS packages nor rosdep keys' if many else 'a ROS package nor a rosdep key'}: rosdep stops here; remove {'them' if many else 'it'}",
        about=(package.name, *names),
        related=tuple((place(package, child), f"depends on {word(child)}, too") for child in found[1:]),
        apart=tuple(names),
        fixes=(Fix(f"remove {spelled_out(names)}", edits),) if None not in drops else (),
    )


def _is_imported(module: str, package: ProjectPackage) -> bool:
    """Whether a file of the package imports *module*: a package of this name may be elsewhere, and is not meant then."""
    line = re.compile(rf"^[ \t]*(?:import[ \t]+(?:[\w., \t]*,[ \t]*)?|from[ \t]+){module}\b", re.MULTILINE)
    return any(line.search(package.project.text(file.path)) for file in package.files if file.language == "python")


def _there(names: frozenset[str], package: ProjectPackage) -> frozenset[str]:
    """Those of *names* that somebody has: CMake's ``Eigen3`` is rosdep's ``eigen``."""
    return frozenset(name for name in names if not is_nowhere(name, package.project))


def _declared(package: ProjectPackage) -> frozenset[str]:
    """What *package* depends on with Python 3: the key for Python 2 beside a slip is none for it."""
    needs = package.raw.dependencies
    return frozenset(need.name for need in needs if holds_for_python(need.condition, "3") is not False)


def _is_meant(name: str, provider: str, need: Need) -> bool:
    """Whether somebody who wrote *name* may have meant *provider*: one slip, or the name of the module, or of pip, for that of its key."""
    if name != provider and normal(name) == normal(provider):  # pose-cov-ops for pose_cov_ops
        return True
    if is_slip(name, provider) or provider in (f"python3-{name}", f"python-{name}", f"lib{name}-dev"):
        return True
    if name.startswith("Qt") and provider.replace("-", "") == f"lib{name.lower()}":  # Qt5Widgets for libqt5-widgets
        return True
    stem = stem_of_system(name)
    if (
        stem != name
        and len(stem) > 2
        and (need.what.lower() == f"find_package({stem})" or provider == f"python3-{stem}")
    ):
        return True  # opencv2 for libopencv-dev
    first, _, module = need.what.partition("import ")
    prefix, _, stem = normal(name).partition("-") if name.startswith("python3-") else ("python3", "", normal(name))
    called = distributions_of(module.partition(".")[0]) if module and not first else frozenset()
    return "-" in name and stem in called and provider.startswith(f"{prefix}-") and not provider.endswith("-pip")


def _released(name: str, package: ProjectPackage, declared: frozenset[str]) -> str | None:
    """The released package that *name* is a slip of, though nothing here is seen to use it; None where *name* may be a package from elsewhere.

    That it may be where a file beside manifests and CMake's has the name, or where a page says to clone the repository of that name.
    """
    if package.ros is None or "-" in name:
        return None
    released = meant_released(name)
    if released is None or released in declared or not package.project.knowledge.is_current(released, package.ros):
        return None
    workspace = package.project.workspace
    if any(_SOURCES.search(path) for path in workspace.names) or name in repositories_named(workspace):
        return None
    word_of_it = re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w-])")
    others = (path for path in sorted(workspace.names) if not path.endswith(("package.xml", "CMakeLists.txt")))
    if any(name in path.split("/") for path in workspace.names):
        return None
    return (
        None if any(word_of_it.search(text) for path in others if name in (text := workspace.text(path))) else released
    )


def _slip_of_released(package: ProjectPackage, name: str, released: str) -> Finding:
    line = next((dependency.line for dependency in package.raw.dependencies if dependency.name == name), None)
    return Finding(
        at=Location(package.manifest_path, line or 1),
        message=f"{package.name} depends on {name}, which is neither a ROS package nor a rosdep key, and which nothing else here names: rosdep "
        f"stops here; did you mean {released}?",
        about=(package.name, name),
        apart=(name, released),
        level=Level.WARNING,
    )


def _finding(package: ProjectPackage, name: str, meant: Mapping[str, Need]) -> Finding:
    line = next((dependency.line for dependency in package.raw.dependencies if dependency.name == name), None)
    keys = listed([f"{item}, which the code uses ({need.what})" for item, need in meant.items()])
    return Finding(
        at=Location(package.manifest_path, line or 1),
        message=f"{package.name} depends on {name}, which is neither a ROS package nor a rosdep key: rosdep stops here; "
        f"write {keys}",
        about=(package.name, name),
        apart=(name, *meant),
        related=tuple((need.location, f"needs {item}: {need.what}") for item, need in meant.items()),
    )


CHECK = Check(
    id="misspelt-dependency",
    summary="Misspelt dependency: neither a ROS package nor a rosdep key.",
    level=Level.ERROR,
    project=check,
    tags=("packages",),
)
