# SPDX-License-Identifier: Apache-2.0
"""What Python and shell files are there for: to be run, to be imported by others beside them, or given to an interpreter by code of their package."""

from __future__ import annotations

import re

from haros_ci import syntax
from haros_ci.checking.imports import imported_words
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.regex import regex

_PROSE = (".md", ".rst", "README.txt")
#: A file that is given to an interpreter, or sourced.
_GIVEN = r"""(?:\bpython[\d.]*|(?i:python)\w*EXECUTABLE\}?|\b(?:source|sh|bash)|^\s*\.)["']?[\s,][^\n;]{0,200}%s"""
#: Python files that tools read or load, and do not run.
_READ = ("launch.py", "__init__.py", "setup.py", "conftest.py")
_CMAKE = (".cmake", ".cmake.in", "CMakeLists.txt", ".cmake.em")
#: Shell scripts that are sourced: by their names, by their lines, and by who names them.
_SOURCED = regex(
    r"(?:^|[/_.-])(?:(?:local_)?setup|hooks?|completions?|complete|bashrc|zshrc|aliases|env(?:ironment)?)\.(?:ba|z)?sh$"
    r"|(?:^|/)(?:\w+[-_])?(?:hooks?|completions?)/[^/]+$|completion\.(?:ba|z)?sh$"
)
#: What imports a module by a text.
_DYNAMIC = regex(r"\b(?:import_module|__import__|load_source|spec_from_file_location|run_path|execfile)[ \t]*\(")
#: Calls that files have above their definitions, modules as well as programs.
_PREPARING = regex(
    r"(?:sys\.)?path\.(?:append|insert|extend|remove)|site\.addsitedir|os\.environ\.(?:setdefault|update)|os\.putenv"
    r"|warnings\.(?:filterwarnings|simplefilter)|(?:matplotlib|mpl)\.use|plt\.(?:switch_backend|style\.use)|(?:matplotlib|mpl|plt)\.rc(?:Params\.update)?"
    r"|(?:np|numpy)\.(?:set_printoptions|seterr)|torch\.set_printoptions|logging\.(?:basicConfig|disable|captureWarnings)|(?:roslib\.)?load_manifest"
    r"|gi\.require_version|locale\.setlocale|faulthandler\.enable|cv2\.setNumThreads|pd\.set_option"
)
_SETTING = regex(r"#|export\b|source\b|\.\s|alias\b|unset\b|complete\b|[A-Za-z_]\w*=\S*$")


def is_given_to_another(path: str, package: ProjectPackage) -> bool:
    """Whether code of the package gives the file to an interpreter, or reads it: ``python3 x.py``, ``. x.sh``; by a variable of CMake, too."""
    name = path.rpartition("/")[2]
    texts = {
        other: package.project.text(other)
        for other in package.project.below(package.path)
        if other != path and not other.endswith(_PROSE)
    }
    texts = {other: text for other, text in texts.items() if name in text}
    pattern = re.compile(_GIVEN % rf"\b{re.escape(name)}\b", re.MULTILINE)
    if any(pattern.search(text) for text in texts.values()):
        return True
    called = re.compile(
        rf"""\bset\s*\(\s*(\w+)\s+["']?[^\s"'()]{{0,300}}(?<![\w.-]){re.escape(name)}["']?\s*[)\s]""", re.IGNORECASE
    )
    for other, text in texts.items():
        if other.endswith(_CMAKE):
            variables = {match[1] for match in called.finditer(text)}
            if any(re.search(_GIVEN % rf"\$\{{{variable}\}}", text, re.MULTILINE) for variable in sorted(variables)):
                return True
    return False


def is_imported_beside(path: str, package: ProjectPackage) -> bool:
    """Whether another Python file in the directory of the module at *path* imports it by its plain name, as scripts do."""
    folder, _, name = path.rpartition("/")
    stem = re.escape(name.removesuffix(".py"))
    imported = re.compile(
        rf"^[ \t]*(?:from[ \t]+{stem}[ \t]+import\b|import[ \t]+(?:[\w.]+[ \t]*,[ \t]*)*{stem}\b)", re.MULTILINE
    )
    return any(
        file.language == "python"
        and file.path != path
        and file.path.rpartition("/")[0] == folder
        and imported.search(package.project.text(file.path)) is not None
        for file in package.files
    )


def is_to_be_run(path: str, project: Project) -> bool:
    """Whether a file does something when it is run: a module that is only imported needs no shebang.

    A call that prepares imports (``sys.path.insert(…)``), or sets a library up, is nothing that a file is run for.
    """
    if path.endswith(_READ):
        return False
    program = project.programs.get(path)
    if program is None:
        text = project.text(path)
        return text.startswith("#!") or ("." not in path.rpartition("/")[2] and _imports(text))
    body = next((function.body for function in program.functions if function.kind == "module"), None) or ()
    return any(
        (
            isinstance(statement, syntax.Do)
            and isinstance(statement.value, syntax.Call)
            and not _PREPARING.fullmatch(syntax.dotted(statement.value.callee))
        )
        or (isinstance(statement, syntax.If) and "__name__" in statement.text)
        for statement in body
    )


def is_for_nobody(path: str, package: ProjectPackage) -> bool:
    """Whether the Python file at *path* only defines functions and classes, is no program, and no other file of the workspace imports it by its name."""
    project = package.project
    if not path.endswith(".py") or path.endswith(_READ) or not _only_defines(path, project):
        return False
    stem = path.rpartition("/")[2].removesuffix(".py")
    files = project.workspace.files
    others = (file.path for file in files if file.path != path and file.language in ("python", "launch"))
    texts = (text for other in others if stem in (text := project.text(other)))
    return not any(stem in imported_words(text) or _DYNAMIC.search(text) for text in texts)


def _only_defines(path: str, project: Project) -> bool:
    """Whether the file, which has no shebang, defines functions or classes, and nothing else happens when it is run."""
    program = project.programs.get(path)
    if program is None or program.problems or project.text(path).startswith("#!"):
        return False
    defines = bool(program.classes) or any(function.kind != "module" for function in program.functions)
    return defines and not is_to_be_run(path, project)


def _imports(text: str) -> bool:
    """Whether the first line that is no comment is one of Python's imports."""
    code = (line for line in text.splitlines()[:100] if line.strip() and not line.startswith("#"))
    return next(code, "").startswith(("import ", "from "))


def is_sourced(path: str, package: ProjectPackage) -> bool:
    """Whether a shell script is there to be sourced: by its name, or as it only sets things."""
    if not path.endswith((".sh", ".bash", ".zsh")):
        return False
    lines = [line.strip() for line in package.project.text(path).splitlines()[:200]]
    code = [line for line in lines if line and not line.startswith("#")]
    return _SOURCED.search(path) is not None or (bool(code) and all(map(_SETTING.match, code)))
