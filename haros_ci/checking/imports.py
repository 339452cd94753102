# SPDX-License-Identifier: Apache-2.0
"""The modules that installed Python files import from other packages as soon as they are loaded."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping, Set
from functools import lru_cache

from haros_ci.checking.needs import Need
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import Sources, exists
from haros_ci.checking.started import started_programs
from haros_ci.checking.worlds import serves_both
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.results.module_names import EXTENSIONS
from haros_ci.syntax import Program

_IMPORT = regex(r"^(?:import[ \t]+([^#\n;]+)|from[ \t]+([\w.]+)[ \t]+import\b)", re.M)
_IMPORTS = regex(r"^[ \t]*(?:import[ \t]+[^#\n;]+|from[ \t]+[\w.]+[ \t]+import[ \t]*(?:\([^()]*\)|[^#\n;]+))", re.M)
_MAIN = regex(r"^if[ \t(]+__name__[ \t]*==[ \t]*['\"]__main__['\"]", re.M)
#: Modules of Python that other versions have, and those that come with every Python for ROS.
_PYTHON = frozenset(
    "__builtin__ __main__ asynchat asyncore BaseHTTPServer binhex cPickle cStringIO cgi CGIHTTPServer commands ConfigParser Cookie cookielib "
    "copy_reg distutils exceptions httplib imp itertools md5 pkg_resources Queue SimpleHTTPServer SocketServer sets setuptools sha smtpd "
    "StringIO telnetlib thread tomllib typing_extensions urllib2 urlparse UserDict xmlrpclib _winreg "
    "anydbm bsddb compiler dbhash dircache DocXMLRPCServer dumbdbm dummy_thread fpformat gdbm htmlentitydefs htmllib HTMLParser ihooks "
    "mhlib mimetools MimeWriter mimify multifile mutex new popen2 posixfile repr rexec rfc822 robotparser sgmllib SimpleXMLRPCServer sre "
    "statvfs sunaudio toaiff user UserList UserString whichdb "
    # of Python 2 by their spelling: what brings tkinter today does not bring them
    "Canvas Dialog FileDialog FixTk ScrolledText SimpleDialog Tix Tkconstants Tkdnd Tkinter tkColorChooser tkCommonDialog tkFileDialog "
    "tkFont tkMessageBox tkSimpleDialog ttk".split()
)
#: Modules of Python's library that systems have as packages of their own (Debian's python3-tk), and their keys of rosdep.
_APART = {"tkinter": frozenset(("python3-tk", "python-tk"))}
#: What runs launch files brings these (ros2launch, roslaunch), some as dependencies of launch_ros (its package.xml).
_LAUNCHING = frozenset(
    "launch launch_ros launch_xml launch_yaml ament_index_python roslaunch rospkg ros2launch osrf_pycommon yaml lifecycle_msgs "
    "composition_interfaces rclpy".split()
)
#: Commands that run Python files as tests, and what they run of a folder.
_TESTING = ("ament_add_pytest_test", "ament_add_nose_test", "add_launch_test", "catkin_add_nosetests")
_RUN = regex(r"/(test_[^/]*|[^/]*_test)\.py$")
_ASIDE = regex(r"(^|/)(tests?|testing|docs?|examples?)/|(^|/)(conftest|setup)\.py$")
_TEST = regex(r"(^|/)(test_[^/]*|[^/]*_test)\.py$")
#: What only tests have: the launch files of launch_testing, the cases of unittest, the functions and fixtures of pytest.
_TEST_CODE = regex(
    r"^[ \t]*(?:async[ \t]+)?def[ \t]+(?:generate_test_description[ \t]*\(|test_\w+[ \t]*\()"
    r"|^[ \t]*(?:import|from)[ \t]+(?:launch_testing\w*|pytest)\b|^class[ \t]+\w+\([^()\n]*\bTestCase\b",
    re.MULTILINE,
)


#: Modules that a program with a Python of its own has for its scripts: what else they import is there as well, or is not.
_HOSTS = frozenset(
    """
    slicer bpy bmesh FreeCAD FreeCADGui maya pymel hou nuke unreal c4d adsk abaqus rhinoscriptsyntax omni isaacsim carb
    robolink gdb lldb idaapi gimpfu krita
    """.split()
)

#: The interface of launch in ROS 2 Ardent: nothing starts such a file today.
_OLD_LAUNCH = regex(
    r"^[ \t]*(?:from|import)[ \t]+launch\.(?:legacy|exit_handler|output_handler|launcher|descriptor|loader|main)\b"
    r"|^def[ \t]+launch[ \t]*\([ \t]*\w+[ \t]*,[ \t]*argv\b",
    re.MULTILINE,
)
#: Of namespace packages, which several distributions share, the portions of those whose keys are known.
_PORTIONS = {
    "backports": frozenset(("ssl_match_hostname",)),
    "google": frozenset(("protobuf",)),
    "mpl_toolkits": frozenset(("axes_grid", "axes_grid1", "axisartist", "mplot3d")),
    "ruamel": frozenset(("yaml",)),
}
#: So much of a line is read for the portions that it imports.
_LONGEST = 500
_NAME = regex(r"\w+")
#: What the names of packages for Python have besides the module's.
_AFFIXES = frozenset("py python python2 python3 ros ros1 ros2 lib pip catkin vendor".split())

#: Modules of ROS 1 alone.
_ROS_1 = frozenset(("rospy", "roslib", "rosnode", "rosparam", "rosservice", "rostopic"))


def imports_of(package: ProjectPackage, sources: Sources, *, tests: bool = False) -> tuple[Need, ...]:
    """What installed files, or *tests*, import at the outermost level, outside of ``try`` and ``if``, with known providers."""
    return sources.once(("imports", package.path, tests), lambda: tuple(_imports(package, sources, tests)))


def _imports(package: ProjectPackage, sources: Sources, tests: bool) -> Iterator[Need]:
    project = package.project
    own = _own(package)
    for path, is_launch in _tested(package) if tests else used_files(package):
        program = project.programs.get(path)
        found = list(imported(path, project.text(path), program))
        modules = frozenset(module for module, _ in found)
        if modules & _HOSTS or (package.ros == 2 and _is_left(modules, package)):
            continue
        if is_launch and _OLD_LAUNCH.search(project.text(path)):
            continue
        for module, location in found:
            if module in own or module in _PYTHON or module == package.name:
                continue
            if module in _APART:
                yield Need(_APART[module], location, f"import {module}", False)
            if module in sys.stdlib_module_names or module in _APART or (is_launch and module in _LAUNCHING):
                continue
            names = _providers(module, package, sources)
            if exists(names, package):
                names |= sources.built_modules.get(module, frozenset())
                yield Need(names, location, f"import {module}", False)


def _providers(module: str, package: ProjectPackage, sources: Sources) -> frozenset[str]:
    """The packages that have the Python *module*: of the workspace, known ones, and one of its name."""
    project = package.project
    names = frozenset(sources.modules.get(module, ())) | (project.knowledge.provider_of_module(module) or frozenset())
    of_name = project.package(module)
    if of_name is None or (names - {module} and not _may_have_modules(of_name)):
        return names if of_name is None else names - {module}
    return names | {module}


#: Directories of a package that are no modules of it.
_BESIDE = regex(r"^(?:build|docs?|examples?|tests?)/")


def _may_have_modules(package: ProjectPackage) -> bool:
    """Whether *package* has Python, interfaces, or a build that may make modules of C++: a driver in C++ that is called ``serial`` is no module ``serial``."""
    texts = (package.project.text(file.path) for file in package.files if file.language in ("cmake", "setup"))
    return bool(
        package.build.interfaces
        or any(file.language == "setup" for file in package.files)
        or any(
            file.language == "python" and _BESIDE.search(file.path[len(package.inside("")) :]) is None
            for file in package.files
        )
        or any(EXTENSIONS.search(text) for text in texts)
    )


def is_called_after(package: str, module: str) -> bool:
    """Whether the name of *package* is that of the Python *module* with words for Python or ROS before or behind it: ``<module>_py``."""
    words, parts = re.split(r"[-_.]", package.lower()), module.lower().split("_")
    count = len(parts)
    return any(
        words[at : at + count] == parts and _AFFIXES.issuperset((*words[:at], *words[at + count :]))
        for at in range(len(words) - count + 1)
    )


def _is_left(modules: Set[str], package: ProjectPackage) -> bool:
    """Whether a file with imports of *modules* was left over when *package* went to ROS 2: it is to be ported, whatever else it lacks."""
    return bool(modules & _ROS_1) and "rclpy" not in modules and not serves_both(package.raw, package.project.text)


def imported(path: str, text: str, program: Program | None) -> Iterator[tuple[str, Location]]:
    """The top-level modules of imports that begin a line; with the *program* of the file, those only that it has, too."""
    known = None if program is None else {str(alias.type.name).partition(".")[0] for alias in program.aliases}
    for match in _IMPORT.finditer(text):
        words = [match[2]] if match[2] else [part.split()[0] for part in match[1].split(",") if part.split()]
        for word in words:
            module = word.partition(".")[0]
            if module.isidentifier() and (known is None or module in known) and not _is_other_portion(word, match):
                yield module, Location(path, text.count("\n", 0, match.start()) + 1)


def _is_other_portion(word: str, match: re.Match[str]) -> bool:
    """Whether the import of *word* is of a portion of a namespace package that no known package has: ``google.genai`` comes from another one than ``google.protobuf``."""
    module, _, inner = word.partition(".")
    if module not in _PORTIONS:
        return False
    rest = match.string[match.end() : match.end() + _LONGEST].partition("\n")[0]
    return _PORTIONS[module].isdisjoint([inner.partition(".")[0]] if inner else _NAME.findall(rest))


def used_files(package: ProjectPackage) -> Iterator[tuple[str, bool]]:
    """The Python files that a user of the package loads, with whether each is a launch file; not its tests."""
    python = [file.path for file in package.files if file.language == "python"]
    launch = {file.path for file in package.files if file.language == "launch" and file.path.endswith(".py")}
    used: set[str] = {entry_point.path for entry_point in package.build.entry_points}
    folders = [directory for _, directory in package.build.python_roots]
    for thing in package.build.installed:
        if thing.kind == "directory" and not thing.destination.startswith("share"):
            folders.append(thing.path)
        elif thing.kind != "directory":
            used.add(thing.path)
    used |= _started_in_place(package)
    unused = _unused(package, used, python)
    tests = _test_code(package, used, python)
    share = [t.path for t in package.build.installed if t.kind == "directory" and t.destination.startswith("share")]
    for path in sorted({*python, *launch}):
        inner = path if package.path == "." else path[len(package.path) + 1 :]
        is_launch = path in launch or ".launch." in path or "launch" in inner.split("/")[:-1]
        places = share if is_launch else folders
        if _ASIDE.search(inner) or path in unused or path in tests:
            continue
        # a program that is installed by its name is no test, whatever it is called; of a whole folder the tests are left out
        if path in used or (
            not _TEST.search(inner) and any(place == "." or path.startswith(f"{place}/") for place in places)
        ):
            yield path, is_launch


def _started_in_place(package: ProjectPackage) -> frozenset[str]:
    """Scripts that no install() names, and that launch files of ROS 1 start: roslaunch finds them in the sources, as a devel space has them.

    One of several files of the name is not known to be the one.
    """
    if package.ros != 1:
        return frozenset()
    started = started_programs(package)
    named: dict[str, list[str]] = {}
    for path in (*package.build.scripts, *(thing.path for thing in package.build.installed)):
        named.setdefault(path.rpartition("/")[2], []).append(path)
    return frozenset(paths[0] for name, paths in named.items() if name in started and len(set(paths)) == 1)


def _unused(package: ProjectPackage, requested: set[str], python: list[str]) -> frozenset[str]:
    """Scripts inside an importable package that nothing starts, and the modules that only such scripts import: tools for training, plots, notebooks.

    A module without a main part that nothing imports counts as used: others may import it.
    """
    project = package.project
    roots = [f"{directory}/" if directory != "." else "" for _, directory in package.build.python_roots]
    below = [path for path in python if path not in requested and path.startswith(tuple(roots))] if roots else []
    scripts = {path for path in below if _MAIN.search(project.text(path))}
    if not scripts:
        return frozenset()
    started = started_programs(package)
    scripts = {path for path in scripts if path.rpartition("/")[2] not in started}
    modules: dict[str, list[str]] = {}
    for path in below:
        modules.setdefault(_name_of(path), []).append(path)
    every = {file.path for file in project.workspace.files if file.path.endswith(".py")} | {*python}
    imports = {
        path: {
            module for word in imported_words(project.text(path)) for module in modules.get(word, ()) if module != path
        }
        for path in every
    }
    imported = {item for found in imports.values() for item in found}
    used = reached_from((every - {*below}) | ({*below} - imported - scripts), imports)
    return reached_from(scripts - used, imports) - used


def _test_code(package: ProjectPackage, used: Set[str], python: list[str]) -> frozenset[str]:
    """The files with code for tests that are not installed and that only such files import, whatever their directories are called."""
    project = package.project
    folders = tuple(f"{installed.path}/" for installed in package.build.installed if installed.kind == "directory")
    loose = (path for path in python if path not in used and not path.startswith(folders))
    found = {path for path in loose if not _is_in_package(path, package) and _TEST_CODE.search(project.text(path))}
    if not found:
        return frozenset()
    words = {_name_of(path): path for path in found}
    for file in project.workspace.files:
        if file.path.endswith(".py") and file.path not in found and not _TEST.search(file.path):
            for word in words.keys() & imported_words(project.text(file.path)):
                found.discard(words[word])
    return frozenset(found)


def _is_in_package(path: str, package: ProjectPackage) -> bool:
    """Whether the file lies in a Python package, which is installed as a whole."""
    return f"{path.rpartition('/')[0]}/__init__.py" in package.project.workspace.names


def reached_from(start: Set[str], imports: Mapping[str, Set[str]]) -> frozenset[str]:
    """The files of *start* and all that these import."""
    found, todo = set(start), list(start)
    while todo:
        new = imports.get(todo.pop(), frozenset()) - found
        found |= new
        todo += new
    return frozenset(found)


def _name_of(path: str) -> str:
    """The name that an import has for the module at *path*."""
    folder, _, base = path.rpartition("/")
    return folder.rpartition("/")[2] if base == "__init__.py" else base.removesuffix(".py")


@lru_cache(maxsize=4096)
def imported_words(text: str) -> frozenset[str]:
    """All names in the imports of a file: modules, and what may be one."""
    found: set[str] = set()
    for match in _IMPORTS.finditer(text):
        found.update(re.findall(r"\w+", match[0]))
    return frozenset(found)


def _tested(package: ProjectPackage) -> Iterator[tuple[str, bool]]:
    """The Python files that ``colcon test`` or ``catkin test`` runs for certain."""
    python = {
        file.path for file in package.files if file.language in ("python", "launch") and file.path.endswith(".py")
    }
    found: dict[str, None] = {}
    if package.raw.build_type == "ament_python":
        places = tuple(package.inside(folder) for folder in ("test/", "tests/"))
        found |= dict.fromkeys(path for path in sorted(python) if path.startswith(places) and _RUN.search(path))
    for command in package.commands(*_TESTING):
        for place in map(command.place, command.arguments) if not command.is_conditional else ():
            if place in python:
                found[str(place)] = None
            elif place is not None and command.name != "add_launch_test":
                below = (path for path in sorted(python) if path.startswith(f"{place}/") and _RUN.search(path))
                found |= dict.fromkeys(below)
    yield from ((path, False) for path in found)


def _own(package: ProjectPackage) -> frozenset[str]:
    """Names that a module of the package itself may have: of its files and folders."""
    found: set[str] = set()
    for file in package.files:
        if file.path.endswith(".py") or file.language == "python":
            inner = file.path if package.path == "." else file.path[len(package.path) + 1 :]
            parts = inner.split("/")
            found.update(parts[:-1])
            found.add(parts[-1].removesuffix(".py"))
    for command in package.commands(
        "pybind11_add_module", "python_add_library", "add_library", "cython_add_module", "swig_add_library"
    ):
        found.update(command.arguments[:1])
    return frozenset(found)
