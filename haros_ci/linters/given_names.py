# SPDX-License-Identifier: Apache-2.0
"""Names that a tool gives to the Python files that it runs: configurations and build scripts. A table of what their documentation says."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.linters.python_bindings import is_bound
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: What SCons makes global in its scripts (its manual: "SConscript Functions", "Builders", "Command-Line Construction Variables", "Action Objects").
_OF_SCONS = frozenset(
    """
    ARGLIST ARGUMENTS Action AddMethod AddOption AddPostAction AddPreAction Alias AllowSubstExceptions AlwaysBuild BUILD_TARGETS
    BoolVariable Builder CFile COMMAND_LINE_TARGETS CXXFile CacheDir Chmod Clean Command Configure Copy DEFAULT_TARGETS DVI Decider Default
    DefaultEnvironment Delete Depends Dir EnsurePythonVersion EnsureSConsVersion Entry EnumVariable Environment Execute Exit Export File
    FindFile FindInstalledFiles FindPathDirs FindSourceFiles Flatten GetBuildFailures GetBuildPath GetLaunchDir GetOption Glob Help Ignore
    Import Install InstallAs InstallVersionedLib Jar Java JavaH Library ListVariable Literal LoadableModule Local M4 Mkdir Move NoCache
    NoClean Object PCH PDF Package PackageVariable ParseDepends PathVariable Platform PostScript Precious Program Progress Pseudo
    PyPackageDir RES RMIC Repository Requires Return SConscript SConscriptChdir SConsignFile Scanner SetOption SharedLibrary SharedObject
    SideEffect Split StaticLibrary StaticObject Substfile Tag Tar Textfile Tool Touch TypeLibrary Value Variables VariantDir WhereIs Zip
    """.split()
)


@dataclass(frozen=True, slots=True)
class Given:
    """The *names* that files called *file* are given, where *mark* is in their text; *source* is the page that says so."""

    file: re.Pattern[str]
    names: frozenset[str]
    source: str
    mark: re.Pattern[str] = regex("")


GIVEN = (
    Given(
        regex(r"\.?cmake-format\.py"),
        frozenset({"section"}),
        "cmakelang, Configuration: python files use `with section(…)`",
    ),
    Given(
        regex(r"conf\.py"),
        frozenset({"tags"}),
        "Sphinx, Configuration: a special object named tags is available in the config file",
        regex(r"^(?:extensions|html_theme|master_doc|root_doc|source_suffix|templates_path)[ \t]*=(?!=)", re.MULTILINE),
    ),
    Given(
        regex(r"(?:ipython(?:_kernel)?|jupyter(?:hub|_\w+)?|nbgrader|ipcluster|ipcontroller|ipengine)_config\.py"),
        frozenset({"c", "get_config", "load_subconfig"}),
        "traitlets, Configuration: Python configuration files begin with c = get_config(), and load others by load_subconfig()",
    ),
    Given(
        regex(r".+-gdb\.py"),
        frozenset({"gdb"}),
        "GDB, Basic Python: GDB imports the gdb module for all scripts that it evaluates; objfile-gdb.py is loaded by it",
    ),
    Given(
        regex(r"[Ss][Cc]onstruct(?:\.py)?|SConscript(?:\.py)?"),
        _OF_SCONS,
        "SCons, manual: SConstruct.py is one of the names that it looks for; its functions are global there",
    ),
)


def is_given(path: str, name: str, text: str, runs: Callable[[str], bool] = lambda path: False) -> bool:
    """Whether the tool that runs the file at *path* with *text* gives it the global *name*, by the table or as a script of SCons imports it.

    *runs* tells of a path whether a ``platformio.ini`` has it as an extra script, which SCons runs (PlatformIO, Advanced Scripting).
    """
    file = path.rpartition("/")[2]
    if any(given.file.fullmatch(file) and name in given.names and given.mark.search(text) for given in GIVEN):
        return True
    if "Import" not in text or not (GIVEN[-1].file.fullmatch(file) or runs(path)):
        return False
    imported = _imported(text)
    return name in imported or (bool(imported) and name in _OF_SCONS)


def _imported(text: str) -> frozenset[str]:
    """The names that ``Import("env")`` brings into a script of SCons: texts, each with names between blanks.

    The call is a statement of the module, so that the script cannot be run by anything else.
    """
    tree = nodes(text)
    module = next(iter(tree), None)
    if not isinstance(module, ast.Module) or is_bound(tree, frozenset({"Import"})):
        return frozenset()
    calls = [node.value for node in module.body if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)]
    return frozenset(
        word
        for call in calls
        if isinstance(call.func, ast.Name) and call.func.id == "Import"
        for part in call.args
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
        for word in part.value.split()
    )


def is_extra_script(path: str, is_file: Callable[[str], bool], read: Callable[[str], str]) -> bool:
    """Whether a ``platformio.ini`` in the directory of *path*, or in one above it, has that file among its ``extra_scripts``.

    *is_file* tells of a path whether the workspace has it, and *read* has its text.
    """
    parts = path.split("/")
    for count in range(len(parts) - 1, max(len(parts) - 1 - _MOST_ABOVE, -1), -1):
        project = "/".join((*parts[:count], "platformio.ini"))
        if is_file(project):
            own = re.escape("/".join(parts[count:]))
            return (
                re.search(rf"(?<![\w./-])(?:(?:pre|post):)?(?:\./)?{own}(?![\w./-])", _options(read(project)))
                is not None
            )
    return False


#: Directories above a script that are looked at.
_MOST_ABOVE = 32


def _options(text: str) -> str:
    """The values of ``extra_scripts``, with the lines that continue them; comments begin with a semicolon or a number sign."""
    found, inside = [], False
    for line in text.split("\n"):
        bare = re.split(r"(?:^|[ \t])[;#]", line, maxsplit=1)[0]
        if line[:1].strip():
            inside = re.match(r"extra_scripts[ \t]*=", bare) is not None
        if inside:
            found.append(bare.partition("=")[2] if line[:1].strip() else bare)
    return "\n".join(found).replace(",", "\n")
