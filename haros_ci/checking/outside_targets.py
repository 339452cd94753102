# SPDX-License-Identifier: Apache-2.0
"""Whether CMake may have targets that none of the followed commands makes: sources that are fetched, or are not in the checkout."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.regex import regex

#: Commands that take another project's CMake into this build (FetchContent, CPM, corrosion).
_FETCHING = (
    *("fetchcontent_makeavailable", "fetchcontent_populate", "cpmaddpackage", "cpmfindpackage", "cpmgetpackage"),
    *("corrosion_import_crate", "externalproject_add_subdirectory"),
)
#: Commands that bring files from elsewhere into a build, which a reader of the sources does not see.
_DOWNLOADING = (
    *("fetchcontent_declare", "externalproject_add", "cpmaddpackage", "ament_vendor", "catkin_simple"),
    "hunter_add_package",
)
#: Packages that CMake finds by itself (cmake-modules(7)): their targets have a namespace.
OF_CMAKE = frozenset(
    """
    alsa armadillo backtrace blas boost bullet bzip2 cuda cudatoolkit curl curses doxygen expat flex freetype git gif glew glut gsl gtest
    gtk2 hdf5 jpeg lapack libusb libxml2 lua matlab mpi openal opencv opengl openmp openssl patch perl pkgconfig png protobuf python python2
    python3 pythoninterp pythonlibs qt4 qt5 qt6 sdl sdl2 sqlite3 subversion swig threads tiff tinyxml tinyxml2 udev wget x11 zlib
    """.split()
)
_SUBDIRECTORY = regex(r"(?mi)^[ \t]*add_subdirectory[ \t]*\([ \t\n]*\"?([^\s\")]+)")


def may_have_more(package: ProjectPackage) -> bool:
    """Whether a fetched project, a directory that is not here, or a package that nobody knows may bring targets to *package*."""
    return any(package.commands(*_FETCHING)) or any(_lost(package)) or any(_unknown(package))


def downloads(package: ProjectPackage) -> bool:
    """Whether a build of *package* downloads another project: that may bring any header or library, to whoever depends on *package*, too."""
    return any(package.commands(*_DOWNLOADING))


def may_be_added(package: ProjectPackage, library: str) -> bool:
    """Whether some line of the CMake files adds the *library* that a description names, by no target that is followed: in a branch that is not.

    ROS 2 tries the name with and without ``lib`` before it, ROS 1 takes it as it is.
    """
    name = posixpath.basename(library).removesuffix(".so")
    stems = {name, name.removeprefix("lib")} if package.ros != 1 else {name[3:]} if name.startswith("lib") else set()
    names = "|".join(map(re.escape, sorted(stems - {target.name for target in package.build.targets})))
    call = re.compile(rf"^[ \t]*\w{{0,40}}add_library\s*\(\s*(?:{names})(?![\w.-])", re.MULTILINE | re.IGNORECASE)
    texts = (package.project.text(file.path) for file in package.files if file.language == "cmake")
    return bool(names) and any(call.search(text) for text in texts)


def builds_absent(package: ProjectPackage) -> bool:
    """Whether its CMakeLists.txt adds the directory of a submodule that is not checked out: a library that may bring any header."""
    project = package.project
    if not project.absent:
        return False
    text = project.text(posixpath.join(package.path, "CMakeLists.txt"))
    return any(
        project.is_absent(posixpath.normpath(posixpath.join(package.path, found[1])))
        for found in _SUBDIRECTORY.finditer(text)
    )


def _lost(package: ProjectPackage) -> Iterator[str]:
    """The directories of add_subdirectory() that no followed command adds: a branch of CMake that this checkout does not take."""
    followed = {command.location.path: set[int]() for command in package.build.commands}
    for command in package.commands("add_subdirectory"):
        followed[command.location.path].add(command.location.line or 0)
    for path, lines in sorted(followed.items()):
        text = package.project.text(path)
        folder = path.rpartition("/")[0]
        for found in _SUBDIRECTORY.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            inner = f"{folder}/{found[1]}" if folder else found[1]
            if line not in lines and ("$" in found[1] or not package.project.exists(inner.rstrip("/"))):
                yield found[1]


def _unknown(package: ProjectPackage) -> Iterator[str]:
    project = package.project
    for command in package.commands("find_package"):
        for name in command.arguments[:1]:
            knowledge = project.knowledge
            is_known = name.lower() in OF_CMAKE or project.package(name) is not None or knowledge.is_package(name)
            if not is_known and not knowledge.provider_of_cmake(name):
                yield name
