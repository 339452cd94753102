# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that other files refute: how a method is called, which of two modules of one name is imported, and of which Python a package is."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.linters import imports_of_self
from haros_ci.linters.class_methods import CLASS, method_at
from haros_ci.linters.decorated import is_call_of_decorated
from haros_ci.linters.exercises import is_exercise, is_template
from haros_ci.linters.modules_twice import is_of_another
from haros_ci.linters.python2 import imports_future, is_of_python2, names_python3
from haros_ci.linters.star_imports import is_of_unseen
from haros_ci.linters.uncalled import is_uncalled
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result

TOOL = "pylint"
#: What pylint says of a member of the wrong module.
_OF_MODULES = frozenset(
    "not-callable not-an-iterable unsubscriptable-object no-member no-name-in-module no-value-for-parameter".split()
)
#: ``yaml.load(stream)``, which PyYAML of Python 2 takes without a Loader.
_LOADER = regex(r"argument 'Loader'")
#: What later versions of Python say alone; an index is no fraction where Python 2 divides whole numbers.
_OF_PYTHON3 = frozenset(
    "invalid-sequence-index invalid-slice-index anomalous-backslash-in-string deprecated-argument deprecated-attribute deprecated-class deprecated-decorator deprecated-method"
    " deprecated-module used-prior-global-declaration".split()
)
#: What pylint says of a call by the signature that the installed version of a library has.
_OF_SIGNATURES = frozenset(
    "missing-kwoa no-value-for-parameter redundant-keyword-arg too-many-function-args unexpected-keyword-arg".split()
)
_APART = frozenset(("bad-super-call", "import-self", "no-self-argument", "syntax-error", "undefined-all-variable"))
#: An alias of typing, which no version of Python is said to remove; ByteString is to go.
_ALIAS = regex(r"\bclass (?!ByteString\b)\w+ of module typing\b")
_PYTHON2 = regex(r"#![^\n]*\bpython2")
#: Keywords that releases of NumPy before 2.1 and 1.22 have alone (release notes, np.reshape and np.quantile).
_FORMER = regex(r"\b(?:newshape|interpolation)[ \t]*=(?!=)")
_CALLEE = regex(r"([A-Za-z_]\w*)(?:[ \t]*\.[ \t]*\w+)*[ \t]*\(")
#: A tab reaches to the next column of eight in Python 2 ("Indentation" in its reference); Python 3 takes no line that depends on that.
_TABS = "inconsistent use of tabs and spaces"
_TAB, _BLANKS = regex(r"^\t", re.MULTILINE), regex(r"^ {2,8}\S", re.MULTILINE)
#: So many files that mix tabs and blanks are no slip.
_MANY_MIXED = 4
#: The interpreter of scripts that say no version.
_PLAIN = regex(r"#![^\n]*\bpython(?:[ \t]|$)", re.MULTILINE)
#: Files that may say for which distribution a workspace is, and what they say then.
_PAGE = regex(
    r"(?:^|/)(?:readme[^/]*|changelog[^/]*|package\.xml|\.travis\.yml|\.gitlab-ci\.yml|dockerfile[^/]*|[^/]*\.(?:sh|dockerfile)|[^/]*requirements[^/]*\.txt)$"
    r"|^\.(?:github|circleci)/.*\.ya?ml$",
    re.IGNORECASE,
)
_REQUIREMENTS = regex(
    r"(?:^|/)(?:[^/]*requirements[^/]*\.txt|setup\.py|setup\.cfg|pyproject\.toml|environment\.ya?ml)$", re.IGNORECASE
)
_OF_NEW_ROS = regex(r"noetic|python-?3|\bpip3\b|\bfocal\b|20\.04", re.IGNORECASE)
_ALL = regex(r"Undefined variable name '([A-Za-z_]\w*)' in __all__")
_STARRED = regex(r"^[ \t]*from[ \t]+([A-Za-z_]\w*)[ \t]+import[ \t]*\*", re.MULTILINE)
_EXPORTS = regex(r"^__all__\b", re.MULTILINE)
#: Files of a package that are asked for their Python.
_MOST_FILES = 300
_MOST_FILES_OF_ALL = 1000
_NAME = regex(r"[A-Za-z_]\w*")
_METHOD = regex(r"(?:self|cls)\.([A-Za-z_]\w*)[ \t]*\(")
_OWNER = regex(r"[ \t]*class[ \t]+(\w+)")
_LONGEST = 400


def is_refuted_around(result: Result, workspace: Workspace) -> bool:
    """Whether other files of *workspace* refute what pylint says in *result*."""
    line = result.location.line
    if result.tool != TOOL or not line:
        return False
    if result.rule in _APART:
        return _is_refuted_apart(result, line, workspace)
    if result.rule == "deprecated-class" and _ALIAS.search(result.message) is not None:
        return True
    if _is_refuted_by_age(result, workspace):
        return True
    if result.rule in _OF_SIGNATURES and (
        _is_of_library(result, line, workspace)
        or _is_of_a_patch(result, line, workspace)
        or is_call_of_decorated(result, workspace)
        or is_uncalled(result.location.path, line, workspace)
        or is_of_another(result, workspace)
    ):
        return True
    return result.rule in _OF_MODULES and _is_shadowed(result, line, workspace)


def _is_refuted_by_age(result: Result, workspace: Workspace) -> bool:
    """Whether the file is for Python 2, or for a PyYAML that asks for no loader, and the rule is of newer ones."""
    path = result.location.path
    is_of_yaml = result.rule == "no-value-for-parameter" and _LOADER.search(result.message) is not None
    if (is_of_yaml or result.rule in _OF_PYTHON3) and _is_python2(path, workspace):
        return True
    return is_of_yaml and _has_old_yaml(path, workspace)


def _is_refuted_apart(result: Result, line: int, workspace: Workspace) -> bool:
    """The same for the rules that are _APART: one thing alone refutes each."""
    if result.rule == "no-self-argument":
        return _is_helper(line, workspace.text(result.location.path), workspace)
    if result.rule == "bad-super-call":
        return _is_of_leaf(line, result, workspace)
    if result.rule == "import-self":
        return imports_of_self.are_of_another(result.location.path, line, workspace, _is_python2_around)
    if result.rule == "syntax-error":
        path = result.location.path
        is_unwritten = is_exercise(path, line, result.message, workspace) or is_template(path, workspace)
        return is_unwritten or (_TABS in result.message and _is_python2_around(path, workspace))
    return _is_starred(result, workspace) or is_of_unseen(result.location.path, workspace)


def _is_of_leaf(line: int, result: Result, workspace: Workspace) -> bool:
    """Whether ``super(type(self), self)`` stands in a class that no class of the workspace inherits: of a subclass it would call itself for ever."""
    lines = workspace.text(result.location.path).split("\n")
    above = (_OWNER.match(text) for text in reversed(lines[:line]))
    name = next((found[1] for found in above if found is not None), "") if "'type'" in result.message else ""
    if not name:
        return False
    inherits = re.compile(rf"^[ \t]*class[ \t]+\w+[ \t]*\([^()\n]{{0,{_LONGEST}}}\b{name}\b", re.MULTILINE)
    files = [file.path for file in workspace.files if file.language == "python"]
    return len(files) <= _MOST_FILES_OF_ALL and not any(
        name in text and inherits.search(text) for text in map(workspace.text, files)
    )


def _is_python2(path: str, workspace: Workspace) -> bool:
    """Whether the file at *path* is of a package of ROS 1 for Python 2."""
    name = workspace.package_finder()(path)
    if name is None:
        return _is_loose_python2(path, workspace)
    package = next((package for package in workspace.packages if package.name == name), None)
    if package is None or package.ros == 2:
        return False
    files = [file.path for file in workspace.files if file.package == name and file.language == "python"]
    texts = (workspace.text(file) for file in files[:_MOST_FILES])
    manifest = workspace.text(f"{package.path}/package.xml" if package.path != "." else "package.xml")
    return is_of_python2(workspace.text(path), texts, manifest)


def _has_old_yaml(path: str, workspace: Workspace) -> bool:
    """Whether the file at *path* is of a package of ROS 1, or of none among such: load() of its last distribution's PyYAML, 5.3 (REP 3), takes no Loader, and only warns.

    Where requirements for pip name PyYAML, another one may be there.
    """
    name = workspace.package_finder()(path)
    around = [package for package in workspace.packages if name is None or package.name == name]
    if not around or any(package.ros != 1 for package in around):
        return False
    pages = (name for name in workspace.names if _REQUIREMENTS.search(name))
    return not any(re.search(r"(?i)\bpyyaml\b", workspace.text(page)) for page in pages)


def _is_python2_around(path: str, workspace: Workspace) -> bool:
    """Whether the file at *path* is for Python 2: its package is, or the workspace of ROS 1, in which nothing asks for Python 3."""
    if _is_python2(path, workspace):
        return True
    if any(package.ros == 2 for package in workspace.packages):
        return False
    texts = [workspace.text(file.path) for file in workspace.files if file.language == "python"]
    if len(texts) > _MOST_FILES_OF_ALL:
        return False
    text = workspace.text(path)
    return is_of_python2(text, texts, "") or _is_usual(text, texts) or _is_of_old_ros(text, texts, workspace)


def _is_of_old_ros(text: str, texts: Iterable[str], workspace: Workspace) -> bool:
    """Whether the file, or if it asks for none another one, asks for `python`, which is Python 2 up to Melodic, and nothing of the workspace names Python 3 or a distribution that has it."""
    texts = tuple(texts)
    asks = _PLAIN.match(text) or (not text.startswith("#!") and any(map(_PLAIN.match, texts)))
    if not asks or any(map(names_python3, texts)):
        return False
    pages = [name for name in sorted(workspace.names) if _PAGE.search(name)][:_MOST_FILES]
    return not any(_OF_NEW_ROS.search(workspace.text(page)) for page in pages)


def _is_usual(text: str, texts: Iterable[str]) -> bool:
    """Whether the file asks for what Python 3 does, or several that do not ask for Python 3 mix tabs and blanks: they would have been seen to fail on it."""
    mixed = (other for other in texts if not names_python3(other) and _TAB.search(other) and _BLANKS.search(other))
    return not names_python3(text) and (imports_future(text) or sum(1 for _ in mixed) >= _MANY_MIXED)


def _is_starred(result: Result, workspace: Workspace) -> bool:
    """Whether a module beside the file has the name of ``__all__``, and is imported as a whole in the way of Python 2 (``from arm import *``)."""
    match, path = _ALL.search(result.message), result.location.path
    text = workspace.text(path)
    owner = workspace.package_finder()(path)
    package = next((package for package in workspace.packages if package.name == owner), None)
    if match is None or names_python3(text) or (package is not None and package.ros == 2):
        return False
    name = match[1]
    pattern = re.compile(
        rf"^(?:(?:async[ \t]+)?def|class)[ \t]+{name}\b|^{name}[ \t]*(?::[^=\n]{{0,200}})?=(?!=)|^from[ \t]+\S+[ \t]+import[ \t][^\n#]{{0,300}}\b{name}\b",
        re.MULTILINE,
    )
    here = path[: path.rfind("/") + 1]
    for module in _STARRED.findall(text):
        for beside in (f"{here}{module}.py", f"{here}{module}/__init__.py"):
            other = workspace.text(beside) if beside in workspace.names else ""
            is_public = f"'{name}'" in other or f'"{name}"' in other if _EXPORTS.search(other) else name[0] != "_"
            if is_public and pattern.search(other):
                return True
    return False


def _is_loose_python2(path: str, workspace: Workspace) -> bool:
    """Whether the file at *path*, which is in no package, is for Python 2, or others in and below its directory are, if only in part."""
    text = workspace.text(path)
    if names_python3(text) or any(package.ros == 2 for package in workspace.packages):
        return False
    below = path[: path.rfind("/") + 1]
    files = [file.path for file in workspace.files if file.language == "python" and file.package is None]
    texts = [workspace.text(file) for file in files if below and file.startswith(below)][:_MOST_FILES]
    return is_of_python2(text, texts, "") or (
        not any(map(names_python3, texts)) and any(map(imports_future, (text, *texts)))
    )


def _is_of_library(result: Result, line: int, workspace: Workspace) -> bool:
    """Whether what a script that asks for Python 2 calls there, or with a former keyword of NumPy, is of a module outside the workspace: of another version than the one here."""
    text = workspace.text(result.location.path)
    lines = text.split("\n")
    if line > len(lines):
        return False
    called = _CALLEE.match(lines[line - 1][max((result.location.column or 1) - 1, 0) :][:_LONGEST])
    if called is None:
        return False
    name = called[1]
    imported = re.search(
        rf"(?m)^[ \t]*(?:import[ \t]+(?:[\w., \t]{{0,200}},[ \t]*)?(?:([A-Za-z_]\w*)[\w.]{{0,200}}[ \t]+as[ \t]+{name}|({name}))\b"
        rf"|from[ \t]+([A-Za-z_]\w*)[\w.]{{0,200}}[ \t]+import[ \t][^\n#]{{0,300}}\b{name}\b)",
        text,
    )
    if imported is None or re.search(rf"(?m)^[ \t]*(?:def|class)[ \t]+{name}\b|^{name}[ \t]*=(?!=)", text):
        return False
    module = imported[1] or imported[2] or imported[3]
    if not (_PYTHON2.match(text) or (module == "numpy" and _FORMER.search(lines[line - 1]))):
        return False
    ends = (f"/{module}.py", f"/{module}/__init__.py")
    return not any(f"/{name}".endswith(ends) for name in workspace.names) and module not in {
        package.name for package in workspace.packages
    }


def _is_of_a_patch(result: Result, line: int, workspace: Workspace) -> bool:
    """Whether pylint speaks of a lambda where a method of the file is called: another file, a test, puts one in its place for a while."""
    lines = workspace.text(result.location.path).split("\n")
    if "lambda call" not in result.message or line > len(lines):
        return False
    called = _METHOD.search(lines[line - 1][max((result.location.column or 1) - 1, 0) :][:_LONGEST])
    if called is None:
        return False
    name = called[1]
    text = "\n".join(lines)
    is_given = re.search(rf"(?m)^[^#\n]{{0,{_LONGEST}}}\.{name}[ \t]*=(?!=)", text) is not None
    return not is_given and re.search(rf"(?m)^[ \t]+(?:async[ \t]+)?def[ \t]+{name}\b", text) is not None


def _is_helper(line: int, text: str, workspace: Workspace) -> bool:
    """Whether every use of the method at *line* goes through a class, ``Arm.by_name(x)``: it works, and lacks a decorator only.

    One whose first parameter is called as a class is (``cls``) is given a class by each: ``Arm.read(cls, x)``. Nor
    does one lack anything that is a decorator of other methods of its class.
    """
    method = method_at(text, line)
    if method is None:
        return False
    owner, name, is_of_class = method
    use = re.compile(rf"(\w+|[)\]}}'\"])[ \t]*\.[ \t]*{re.escape(name)}\b")
    every = (workspace.text(file.path) for file in workspace.files if file.language in ("python", "launch"))
    texts = tuple(item for item in every if name in item)
    pattern = re.compile(
        rf"\.[ \t]*{re.escape(name)}\b(?!\s*\(\s*(?:{'|'.join(CLASS)}|type\([^()\n]{{0,80}}\)|[A-Z]\w*)\s*[,)])"
    )
    if is_of_class and any(pattern.search(other_text) for other_text in texts):
        return False
    receivers = {found[1] for other_text in texts for found in use.finditer(other_text)}
    if not receivers:  # the body of the class itself uses it
        return not is_of_class and re.search(rf"(?m)^[ \t]+@[ \t]*{re.escape(name)}\b", text) is not None
    classes = CLASS if is_of_class else ()
    return owner in receivers and all(
        receiver == owner or receiver[0].isupper() or receiver in classes for receiver in receivers
    )


def _is_shadowed(result: Result, line: int, workspace: Workspace) -> bool:
    """Whether the name there is of a module beside the script that a directory elsewhere is called like.

    Python looks beside the script first; pylint takes the directory for a package.
    """
    path, text = result.location.path, workspace.text(result.location.path)
    lines = text.split("\n")
    if line > len(lines):
        return False
    here = lines[line - 1][max((result.location.column or 1) - 1, 0) :][:_LONGEST].lstrip()
    used = re.match(r"from[ \t]+(\w+)", here) or _NAME.match(here)
    if used is None:
        return False
    name = re.escape(used[used.lastindex or 0])
    imported = re.search(rf"(?m)^[ \t]*(?:import[ \t]+{name}|from[ \t]+{name}[ \t]+import)\b(?![.\w])", text)
    renamed = re.search(
        rf"(?m)^[ \t]*(?:import[ \t]+(\w+)[ \t]+as[ \t]+{name}|from[ \t]+(\w+)[ \t]+import[ \t][^\n#]{{0,300}}\b{name})\b",
        text,
    )
    module = used[used.lastindex or 0] if imported else (renamed[1] or renamed[2]) if renamed else ""
    beside = path[: path.rfind("/") + 1]
    if not module or f"{beside}{module}.py" not in workspace.names:
        return False
    return any(f"/{module}/" in f"/{name}" for name in workspace.names)
