# SPDX-License-Identifier: Apache-2.0
"""Console scripts that do not name the function to run: what is wrong with the line, and what to write (setuptools, "Entry Points")."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator

from haros_ci.checking.likeness import is_slip
from haros_ci.checking.project import ProjectPackage
from haros_ci.regex import regex

_MODULE = regex(r"([^=]+?)\s*=\s*([\w.]+)\s*\Z")
_PAIR = regex(r"([^=]+?)\s*=\s*([^=]+?)\s*\Z")
_JOINED = regex(r"[^=]+=\s*[\w.]+:\w+")


def entry_point_mistake(text: str, package: ProjectPackage) -> tuple[str, str]:
    """What the line *text* is and what follows of it; what to write in its place, "" where that is not known."""
    if (match := _MODULE.match(text)) is not None:
        return _without_function(match[1], match[2], package)
    if text.count("=") > 1 and _JOINED.match(text):
        what = "is several lines in one, as a comma is missing between them: none of their programs can be started"
        return f"{what}; write the comma", ""
    match = _PAIR.match(text)
    what = "is not of the form 'name = module:function': the build stops at it"
    if match is None:
        return what, ""
    target = re.sub(r"\(\s*\)\s*\Z", "", match[2])
    module, colon, function = target.partition(":")
    module = re.sub(r"\.py\Z", "", module.strip()).replace("/", ".")
    written = f"{match[1]} = {module}:{function.strip()}" if colon else ""
    is_right = re.fullmatch(r"[\w.]+", module) and re.fullmatch(r"[\w.]+", function.strip())
    return what, written if is_right else ""


def _without_function(name: str, module: str, package: ProjectPackage) -> tuple[str, str]:
    """``name = module``: the module is imported, and calling it fails (TypeError)."""
    what = f"names a module and no function: {name} fails when it is started, for a module cannot be called"
    if functions := _functions(module, package):
        function = "main" if "main" in functions else functions[0] if len(functions) == 1 else ""
        return what, f"{name} = {module}:{function}" if function else ""
    outer, _, last = module.rpartition(".")
    return what, f"{name} = {outer}:{last}" if last in _functions(outer, package) else ""


def _functions(module: str, package: ProjectPackage) -> tuple[str, ...]:
    """The functions of a module of the package."""
    program = package.project.programs.get(_file(module, package))
    return tuple(f.name for f in program.functions if f.name and not f.owner) if program is not None else ()


def _file(module: str, package: ProjectPackage) -> str:
    inner = f"{module.replace('.', '/')}.py"
    places = (inner if root == "." else f"{root}/{inner}" for name, root in package.build.python_roots if name == "")
    return next((path for path in places if package.project.exists(path)), "")


def is_own_module(module: str, package: ProjectPackage) -> bool:
    """Whether the module is to be one of the package: the package that it is in has other modules here."""
    top = module.partition(".")[0]
    roots = [directory for name, directory in package.build.python_roots if name in ("", top)]
    inner = module.replace(".", "/")
    if any(package.project.is_absent(inner if root == "." else f"{root}/{inner}") for root in roots):
        return False
    if any(path == top or path.startswith(f"{top}/") for path in _below(roots, package)):
        return not any(module.startswith(name) for name in _generated(package))
    return top == package.name and package.project.package(top) is not None and bool(roots)


def _below(roots: list[str], package: ProjectPackage) -> Iterator[str]:
    for root in roots:
        prefix = "" if root == "." else f"{root}/"
        for file in package.files:
            if file.language == "python" and file.path.startswith(prefix):
                yield file.path.removeprefix(prefix)


def _generated(package: ProjectPackage) -> tuple[str, ...]:
    """The modules that the build makes."""
    return tuple(
        f"{package.name}.{parameter_library.name}"
        for parameter_library in package.build.parameter_libraries
        if parameter_library.language == "python"
    )


def renamed_module(module: str, package: ProjectPackage) -> str:
    """The one module of the package that *module* is under a first name that nothing has: misspelt, or of before a renaming; else ""."""
    top, _, rest = module.partition(".")
    project = package.project
    knowledge, tops = project.knowledge, _tops(package)
    is_other = (
        project.package(top) is not None or knowledge.is_package(top) is not False or knowledge.provider_of_module(top)
    )
    if not rest or is_other or top in sys.stdlib_module_names or top in tops:
        return ""
    if not any(is_slip(top, own) for own in tops) and ("_" not in top or _is_required(top, package)):
        return ""  # a package of Python that others have
    same = [path for path in modules(package) if path.partition("/")[2] == f"{rest.replace('.', '/')}.py"]
    return same[0].removesuffix(".py").replace("/", ".") if len(same) == 1 else ""


def moved_module(module: str, package: ProjectPackage) -> str:
    """The one file of *package* with the name of the *module* that is not where it is looked for; "" if there is none, or more."""
    name = f"/{module.rpartition('.')[2]}.py"
    found = [file.path for file in package.files if file.path.endswith(name)]
    return found[0] if len(found) == 1 else ""


def _is_required(name: str, package: ProjectPackage) -> bool:
    """Whether setup.py names *name* as what is to be there: ``install_requires=["name>=1"]``."""
    return (
        re.search(
            rf"""["']{re.escape(name).replace("_", "[-_]")}\s*[<>=~!;"'\[]""",
            package.project.text(package.inside("setup.py")),
        )
        is not None
    )


def modules(package: ProjectPackage) -> tuple[str, ...]:
    """The Python files below the import roots of *package*, relative to them."""
    roots = [f"{root}/" if root != "." else "" for name, root in package.build.python_roots if name == ""]
    paths = [file.path for file in package.files if file.language == "python"]
    return tuple(path.removeprefix(root) for root in roots for path in paths if path.startswith(root))


def _tops(package: ProjectPackage) -> set[str]:
    return {path.partition("/")[0].removesuffix(".py") for path in modules(package)}
