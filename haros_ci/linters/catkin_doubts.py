# SPDX-License-Identifier: Apache-2.0
"""Messages of catkin_lint that the files of the workspace refute."""

from __future__ import annotations

import re
from posixpath import join, normpath

from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.submodules import is_below
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

_FILE = regex(r"'([^']*)'")
_VARIABLE = regex(r"\$\{(\w+)\}")
#: Commands that set a variable to what CMake alone knows (cmake-commands(7)), with the place of its name.
_COMPUTED = (
    r"(?:get_filename_component\s*\(\s*{name}\b|string\s*\([^()]{{0,300}}\b{name}\b|list\s*\([^()]{{0,300}}\b{name}\b"
    r"|foreach\s*\(\s*{name}\b|(?:function|macro)\s*\([^()]{{0,300}}\b{name}\b|file\s*\(\s*[A-Z_]+\s+{name}\b"
    r"|(?:execute_process|cmake_parse_arguments|get_target_property|get_property|find_\w+|math|option)\s*\([^()]{{0,300}}\b{name}\b"
    r"|set\s*\(\s*{name}\s[^()]{{0,300}}\$\{{)"
)
#: Variables that catkin_lint evaluates; others that CMake sets itself (``CMAKE_LIBRARY_ARCHITECTURE``) it takes for empty.
_KNOWN = regex(
    r"CMAKE_(?:(?:CURRENT_)?(?:SOURCE|BINARY)_DIR|CURRENT_LIST_(?:DIR|FILE)|INSTALL_PREFIX)|PROJECT_NAME|PROJECT_VERSION\w*"
    r"|(?:CATKIN|catkin)_\w*|\w+_(?:SOURCE|BINARY)_DIR"
)
#: How a file gives a variable a value that catkin_lint follows.
_SET = r"\bset\s*\(\s*{name}\s"
#: What CMake tries where a source has no extension (policy CMP0115).
_EXTENSIONS = "c C c++ cc cpp cxx cu mpp m M mm ixx cppm h hh h++ hm hpp hxx in txx f F for f77 f90".split()
#: The command that a message begins with, and how the names of those end that have sources.
_COMMAND = regex(r"(?<!\w)(\w*)\(\)")
_MAKES = ("executable", "library")
_OF_SOURCES = ("target_sources", "catkin_add_gtest", "add_rostest_gtest")
_SIMPLE = regex(r"^[ \t]*(?:cs_export\s*\(|find_package\s*\(\s*catkin_simple\b)", re.MULTILINE | re.IGNORECASE)
#: Commands that install: ``install()``, ``catkin_install_python()``, ``cs_install()`` and such of one's own.
_INSTALLS = regex(r"^[ \t]*\w*install\w*[ \t]*\(", re.MULTILINE | re.IGNORECASE)
#: Rules about files and directories that are not there.
_OF_FILES = frozenset(("MISSING_FILE", "MISSING_DIRECTORY", "MISSING_SUBDIR", "MISSING_INCLUDE_PATH", "MISSING_PLUGIN"))
_GENERATED = regex(r"\bgenerate_messages\s*\(\s*DEPENDENCIES\s([^()]{0,5000})\)", re.IGNORECASE)
#: The type of std_msgs that interfaces name without its package.
_BARE_HEADER = regex(r"^[ \t]*Header\b", re.MULTILINE)
_FOUND = regex(r"\bfind_package\s*\(([^()]{0,5000})\)", re.IGNORECASE)
#: Packages whose configuration finds a package of messages, too: what catkin_package(CATKIN_DEPENDS) of theirs names, or of what that finds.
#: A test compares it with the manifests of the distributions.
BRINGS = {
    "std_msgs": frozenset(
        """
        actionlib actionlib_msgs diagnostic_msgs dynamic_reconfigure geometry_msgs image_transport nav_msgs nodelet roscpp sensor_msgs
        shape_msgs stereo_msgs tf tf2_ros trajectory_msgs visualization_msgs
        """.split()
    ),
    "geometry_msgs": frozenset("nav_msgs sensor_msgs shape_msgs tf tf2_ros trajectory_msgs visualization_msgs".split()),
    "actionlib_msgs": frozenset("actionlib nav_msgs tf2_ros".split()),
    "sensor_msgs": frozenset("image_transport stereo_msgs tf".split()),
}
_HEADERS = (".h", ".hh", ".hpp", ".hxx")
#: ``add_subdirectory(../shared shared)``: CMake asks for a build directory, the second argument, where the first is outside.
_OUTSIDE = regex(
    r"[ \t]*add_subdirectory\s*\(\s*\"?([^\s()\"]+)\"?\s+(?!EXCLUDE_FROM_ALL\b|SYSTEM\b)[^\s()]", re.IGNORECASE
)
#: What setup.py installs.
_MODULES = regex(
    r"\b(?:packages|package_dir|package_data|py_modules|scripts|find_packages|find_namespace_packages|data_files|ext_modules|entry_points)\b"
)
#: ``package_dir={'': 'src'}``, the directories in it, and what else setup.py can install.
_PACKAGE_DIR = regex(r"\bpackage_dir['\"]?\s*[=:]\s*\{([^{}]{0,1000})\}")
_FOLDER = regex(r"['\"]([\w.]{0,200})['\"]\s*:\s*['\"]([^'\"]{1,200})['\"]")
_PACKAGES = regex(r"\bpackages['\"]?\s*[=:]\s*\[([^\[\]]{0,1000})\]")
_QUOTED = regex(r"['\"]([\w.]{1,200})['\"]")
_OTHERS = regex(
    r"\b(?:scripts|py_modules|data_files|ext_modules|entry_points|package_data|find_packages|find_namespace_packages)['\"]?\]?\s*[=:(]"
)
#: Characters of a statement that are looked at.
_LONGEST = 2000


def is_refuted(
    rule: str, message: str, directory: str, at: Location, workspace: Workspace, lacking: frozenset[str] = frozenset()
) -> bool:
    """Whether what catkin_lint says by *rule* at *at*, in the package in *directory*, is known to be wrong.

    A missing file is not known to be missing if its name has a variable that catkin_lint does not evaluate, or if it is of one of the
    submodules *lacking* in this checkout; a file of another place of the same repository is there wherever the repository is.
    """
    if rule == "MISSING_CMD":  # the macros of catkin_simple call catkin_package() and what belongs to it
        return (
            "catkin_package" in message
            and _SIMPLE.search(workspace.text(join(directory, "CMakeLists.txt"))) is not None
        )
    if rule.startswith("UNINSTALLED_") and not _installs(directory, workspace):
        return True
    if rule == "EXTERNAL_SUBDIR":
        return _is_shared(at, workspace)
    if rule == "MISSING_PYTHON_SETUP":
        setup = re.sub(r"#[^\n]*", "", workspace.text(join(directory, "setup.py")))
        return "setup" in setup and (_MODULES.search(setup) is None or _has_no_module(setup, directory, workspace))
    named = _FILE.search(message)
    if named is None:
        return False
    if rule == "MISSING_CATKIN_DEPEND":
        return _is_only_listed(named[1], directory, workspace)
    if rule == "UNCONFIGURED_MSG_DEPEND":
        return _is_brought(named[1], directory, workspace) and _is_only_listed(
            named[1], directory, workspace, with_headers=False
        )
    here = normpath(join(directory, named[1]))
    beside = normpath(join(at.path.rpartition("/")[0], named[1]))
    if rule in _OF_FILES and (is_below(here, lacking) or is_below(beside, lacking)):
        return True
    if rule == "MISSING_FILE" and _is_of_sources(message) and _has_extension(workspace, here, beside):
        return True
    if rule in ("MISSING_FILE", "MISSING_DIRECTORY", "MISSING_SUBDIR"):
        return _is_unknown(named[1], at.path, at.line, workspace.text(at.path))
    if rule == "EXTERNAL_FILE" and not named[1].startswith("/"):
        return any(file.path in (here, beside) for file in workspace.files)
    return False


def _has_no_module(setup: str, directory: str, workspace: Workspace) -> bool:
    """Whether the directories that setup.py names for its packages have no Python file, and it installs nothing else: a call would fail."""
    folders = [pair for match in _PACKAGE_DIR.finditer(setup) for pair in _FOLDER.findall(match[1])]
    named = [name for match in _PACKAGES.finditer(setup) for name in _QUOTED.findall(match[1])]
    if not folders or _OTHERS.search(setup):
        return False
    below: list[str] = []
    for key, folder in folders:
        inner = [name.replace(".", "/") for name in named] if named and not key else [""]
        below += [f"{normpath(join(directory, folder, item))}/" for item in inner]
    return not any(name.endswith(".py") and name.startswith(tuple(below)) for name in workspace.names)


def _is_shared(at: Location, workspace: Workspace) -> bool:
    """Whether add_subdirectory() names a directory beside the package, which the repository has, and where to build it: that is meant."""
    lines = workspace.text(at.path).split("\n")
    if at.line is None or at.line > len(lines):
        return False
    named = _OUTSIDE.match("\n".join(lines[at.line - 1 : at.line + 2])[:_LONGEST])
    if named is None:
        return False
    here = at.path.rpartition("/")[0]
    path = re.sub(r"^\$\{(?:CMAKE_CURRENT_(?:SOURCE|LIST)_DIR|PROJECT_SOURCE_DIR|CMAKE_SOURCE_DIR)\}/", "", named[1])
    return normpath(join(here, path, "CMakeLists.txt")) in workspace.names


def _installs(directory: str, workspace: Workspace) -> bool:
    """Whether the CMake files of the package have any command that installs; one without is built for its devel space alone."""
    prefix = "" if directory == "." else f"{directory}/"
    own = (file.path for file in workspace.files if file.path.startswith(prefix))
    return any(_INSTALLS.search(workspace.text(path)) for path in own if path.endswith(("CMakeLists.txt", ".cmake")))


def _is_of_sources(message: str) -> bool:
    """Whether *message* begins with a command that names sources: ``add_executable()``, ``target_sources()`` and such of one's own."""
    called = _COMMAND.match(message)
    name = called[1].lower() if called is not None else ""
    return name.endswith(_OF_SOURCES) or any(name.endswith(end) and "add_" in name.removesuffix(end) for end in _MAKES)


def _has_extension(workspace: Workspace, *paths: str) -> bool:
    """Whether one of *paths*, without extension, is the name of a source that CMake finds by adding one."""
    bare = [path for path in paths if "." not in path.rpartition("/")[2]]
    tried = {f"{path}.{extension}" for path in bare for extension in _EXTENSIONS}
    return not tried.isdisjoint(workspace.names)


def _is_brought(name: str, directory: str, workspace: Workspace) -> bool:
    """Whether something that the package's CMakeLists.txt finds finds the package of messages *name*, too: so its list does no harm."""
    text = re.sub(r"#[^\n]*", "", workspace.text(join(directory, "CMakeLists.txt")))
    return any(not BRINGS.get(name, frozenset()).isdisjoint(found[1].split()) for found in _FOUND.finditer(text))


def _within(directory: str, workspace: Workspace) -> list[SourceFile]:
    prefix = "" if directory == "." else f"{directory}/"
    return [file for file in workspace.files if file.path.startswith(prefix)]


def _is_only_listed(name: str, directory: str, workspace: Workspace, *, with_headers: bool = True) -> bool:
    """Whether the package of messages *name* is listed in generate_messages(), and no message, service, action or header of the package uses it.

    Then it is to be taken from the list, not to be exported. actionlib_msgs is used by every action.
    """
    listed = _GENERATED.search(workspace.text(join(directory, "CMakeLists.txt")))
    if listed is None or name not in listed[1].split():
        return False
    own = _within(directory, workspace)
    if name == "actionlib_msgs" and any(file.path.endswith(".action") for file in own):
        return False
    interfaces = [workspace.text(file.path) for file in own if file.language == "interface"]
    if not interfaces or (name == "std_msgs" and any(map(_BARE_HEADER.search, interfaces))):
        return False
    headers = [file.path for file in own if file.path.endswith(_HEADERS)] if with_headers else []
    return not any(f"{name}/" in text for text in (*interfaces, *map(workspace.text, headers)))


def _is_unknown(name: str, path: str, line: int | None, text: str) -> bool:
    """Whether the *name* of a file is what was left of one with variables."""
    if "${" in name or "$<" in name or "//" in name or not name or name[0] == "/" or name[-1] == "/":
        return True
    if re.fullmatch(r"(?:.*/)?\.[a-z]{1,8}", name):
        return True
    if line is None or not path.endswith((".txt", ".cmake")):
        return False
    statement = "\n".join(text.split("\n")[line - 1 : line + 60])[:_LONGEST]
    end = statement.find("\n)") if "\n)" in statement else statement.find(")")
    variables = set(_VARIABLE.findall(statement[: end + 1] if end >= 0 else statement))
    if re.search(r"\bOPTIONAL\b", statement[: end + 1]):
        return True
    unknown = [v for v in variables if not _KNOWN.fullmatch(v)]
    return any(
        re.search(_COMPUTED.format(name=v), text, re.IGNORECASE)
        or not re.search(_SET.format(name=v), text, re.IGNORECASE)
        for v in unknown
    )
