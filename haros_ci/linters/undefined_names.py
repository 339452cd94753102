# SPDX-License-Identifier: Apache-2.0
"""Names that a tool for Python 3 calls undefined, and that are there all the same, or in Python 2."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import lru_cache

from haros_ci.linters.dead_statements import is_dead
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.given_names import is_given as is_given_by_tool
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.linters.python_bindings import asks_for_version, is_bound
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

RULES = frozenset({"pylint:undefined-variable", "ruff:F821", "flake8:F821", "mypy:name-defined"})

#: Built-in names that Python 3 has no more (What's New in Python 3.0, "Builtins").
OF_PYTHON_2 = frozenset(
    "apply basestring buffer cmp coerce execfile file intern long raw_input reduce reload unichr unicode xrange".split()
)
#: Names that others put among the built-in ones: the compiler of a class, IPython, mypy, Windows.
_BROUGHT = frozenset("__class__ __path__ __IPYTHON__ get_ipython reveal_type WindowsError".split())
_GETTEXT, _INSTALLED = regex(r"\bgettext\b"), regex(r"\.install[ \t]*\(|\bbuiltins\b")
#: Those of gettext.install, which some file of the workspace calls, and of line_profiler, which is a decorator.
_OF_GETTEXT, _PROFILE = frozenset(("_", "ngettext")), "profile"
_PYTHON_3 = regex(r"#![^\n]{0,200}\bpython3")
_QUOTED = regex(r"['\"`](\w+)['\"`]")
_ASKS_FOR_VERSION = regex(r"\bversion_info\b|\bPY[23]\b|\bpython_version|\bexcept[ \t(]+[^\n:]{0,80}\bNameError\b")
#: What makes names that no reader of the text can know.
_MAKES_NAMES = regex(r"\b(?:globals|vars|locals)\(\)[ \t]*(?:\[|\.(?:update|setdefault)\b)|(?<![\w.])exec(?:file)?\(")

#: What ends the program, and what makes another thing of the name.
_EXIT = regex(r"^[ \t]*(?:exit|quit|sys\.exit|os\._exit)[ \t]*\(", re.MULTILINE)
_ENDS = frozenset({"exit", "quit", "_exit", "sys", "os"})

_LATE = regex(r"^from __future__ import [^\n]*\bannotations\b", re.MULTILINE)
_ANNOTATED = regex(r"(?:->|[\w)\]][ \t]*:)[ \t]*[\w\[\]., |]*$")
#: Characters of a line that are looked at before a name.
_LONGEST = 2_000
#: Where a colon begins no annotation.
_STATEMENT = regex(
    r"\s*(?:if|elif|else|for|while|with|try|except|finally|class|return|lambda|assert|case)\b|[^#]*[{]|[^#]*\[[^\]]*:|[^#]*\blambda\b"
)


def weighed_names(
    results: Iterable[Result],
    text: Callable[[str], str],
    is_ros1: Callable[[str], bool],
    is_given: Callable[[Result], bool] = lambda result: False,
    is_loaded: Callable[[str], bool] = lambda path: False,
    is_extra: Callable[[str], bool] = lambda path: False,
    is_translated: Callable[[], bool] = lambda: False,
) -> tuple[Result, ...]:
    """*results* without names that something else defines, and with a warning for those that may well be defined.

    Or that nothing evaluates: in annotations of a function's variables, and in all where the file imports them from __future__ (PEP 563). A name of Python 2 is defined in a package
    of ROS 1, all of whose distributions but the last have Python 2 (REP 3); may be, where the first line asks for Python 3. So may be a name
    in a string, where annotations stand that are not evaluated; any name where the file makes names of strings, and one whose import
    is in a comment: what uses it may be switched off like it. *text* reads
    a path, *is_ros1* tells of one whether it is of a package, or a workspace, of ROS 1; where the level *is_given* by the settings it stands.
    Where code of the workspace uses gettext (*is_translated*) its names are there.
    In a file that another one loads by its path (*is_loaded*) any name may have been put there; in one that a tool runs, which may be an extra
    script of PlatformIO (*is_extra*), those that the tool gives it. Below an ``exit()`` of the module, and behind a ``return``, nothing is evaluated.
    """
    weighed = []
    doubting = Doubting()
    for result in results:
        name = _QUOTED.search(result.message) if result.full_id in RULES else None
        if name is not None:
            if is_loaded(result.location.path):
                continue
            whole = text(result.location.path)
            if not doubting.may(result.location.path, result.full_id, whole):
                weighed.append(result)
                continue
            if _is_never_run(result, whole) or is_given_by_tool(result.location.path, name[1], whole, is_extra):
                continue
            if _is_brought(name[1], result, whole, is_translated) or _is_set_by_text(name[1], whole):
                continue
            if name[1] in OF_PYTHON_2 and _is_ready(result, whole):
                continue
            old = name[1] in OF_PYTHON_2 and is_ros1(result.location.path)
            if old and not _PYTHON_3.match(whole) and not is_given(result):
                continue
            unsure = old or _is_in_string(result, whole) or _is_in_annotation(result, whole)
            unsure = unsure or _is_switched_off(name[1], whole) or _is_in_local_annotation(result, whole)
            if (unsure or _MAKES_NAMES.search(code_alone(whole, "python"))) and not is_given(result):
                result = replace(result, level=max(result.level, Level.WARNING, key=lambda level: level.rank))
        weighed.append(result)
    return tuple(weighed)


def uses_gettext(text: str) -> bool:
    """Whether the code of a Python file calls something of gettext (gettext.install makes ``_`` and ``ngettext`` built-in names)."""
    if "gettext" not in text:
        return False
    code = code_alone(text, "python")
    return _GETTEXT.search(code) is not None and _INSTALLED.search(code) is not None


def _is_brought(name: str, result: Result, text: str, is_translated: Callable[[], bool]) -> bool:
    """Whether others put *name*, which *result* is about, among the built-in names."""
    if name in _OF_GETTEXT:
        return is_translated()
    if name != _PROFILE:
        return name in _BROUGHT
    decorators = (one for node in nodes(text) for one in getattr(node, "decorator_list", ()))
    return any(
        isinstance(one, ast.Name) and one.id == name and one.lineno == result.location.line for one in decorators
    )


def _is_set_by_text(name: str, text: str) -> bool:
    """Whether the file has code of its own as a text run that begins by setting *name*: ``exec("ret = self." + command)``."""
    if "exec" not in text:
        return False
    every = nodes(text)
    runs = any(isinstance(one, ast.Call) and isinstance(one.func, ast.Name) and one.func.id == "exec" for one in every)
    sets = re.compile(rf"\s*{re.escape(name)}\s*=(?!=)")
    texts = (one.value for one in every if isinstance(one, ast.Constant) and isinstance(one.value, str))
    return runs and any(map(sets.match, texts))


def _is_ready(result: Result, text: str) -> bool:
    """Whether the code around the place of *result* is for Python 2 and 3, and tells them apart."""
    line = result.location.line
    return (
        line is not None
        and _ASKS_FOR_VERSION.search(code_alone(text, "python")) is not None
        and asks_for_version(nodes(text), line)
    )


def _is_never_run(result: Result, text: str) -> bool:
    """Whether nothing evaluates what stands at the place of *result*."""
    line, column = result.location.line, result.location.column
    is_behind = line is not None and is_dead(text, line, None if column is None else column - 1)
    return is_behind or _is_behind_exit(result, text)


def _is_behind_exit(result: Result, text: str) -> bool:
    """Whether a statement before the place of *result*, of the module itself or of the same branch of it, ends the program."""
    line = result.location.line
    if not line or not _EXIT.search(text) or is_bound(nodes(text), _ENDS):
        return False
    tree = next(iter(nodes(text)), None)
    blocks = [tree.body] if isinstance(tree, ast.Module) else []
    while blocks:
        for statement in (block := blocks.pop()):
            if _ends(statement) and statement.end_lineno and statement.end_lineno < line <= (block[-1].end_lineno or 0):
                return True
            if isinstance(statement, ast.If):
                blocks += [statement.body, statement.orelse]
    return False


def _ends(statement: ast.stmt) -> bool:
    """Whether the statement is ``exit()``, ``sys.exit()`` or the like."""
    if not isinstance(statement, ast.Expr) or not isinstance(statement.value, ast.Call):
        return False
    return ast.unparse(statement.value.func) in ("exit", "quit", "sys.exit", "os._exit")


def _is_in_annotation(result: Result, text: str) -> bool:
    """Whether the place of *result* is in an annotation on its line, and the file has none evaluated."""
    lines, at = text.split("\n"), result.location
    if not at.line or not at.column or at.line > len(lines) or not _LATE.search(code_alone(text, "python")):
        return False
    before = lines[at.line - 1][: at.column - 1][-_LONGEST:]
    return _ANNOTATED.search(before) is not None and not _STATEMENT.match(before)


def _is_in_local_annotation(result: Result, text: str) -> bool:
    """Whether the place of *result* is in the annotation of a variable of a function, which is never evaluated (PEP 526)."""
    line = result.location.line
    return line is not None and any(
        place.lineno <= line <= (place.end_lineno or 0) and _is_within(place, result)
        for place in _local_annotations(text)
    )


@lru_cache(maxsize=8)
def _local_annotations(text: str) -> tuple[ast.expr, ...]:
    """The annotations of variables in functions of a file."""
    tree = next(iter(nodes(text)), None)
    waiting: list[tuple[ast.AST, bool]] = [(tree, False)] if tree is not None else []
    found: list[ast.expr] = []
    while waiting:
        node, is_local = waiting.pop()
        if isinstance(node, ast.AnnAssign) and is_local:
            found.append(node.annotation)
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            waiting += [(inner, True) for inner in node.body]
        elif isinstance(node, ast.ClassDef):
            waiting += [(inner, False) for inner in node.body]
        else:
            waiting += [(inner, is_local) for inner in ast.iter_child_nodes(node)]
    return tuple(found)


def _is_within(node: ast.expr, result: Result) -> bool:
    line, column = result.location.line, result.location.column
    if line is None or not column or line != node.lineno:
        return True
    return node.col_offset < column and (line != node.end_lineno or column <= (node.end_col_offset or 0))


def _is_in_string(result: Result, text: str) -> bool:
    """Whether the place of *result* is inside a string of one line."""
    lines, at = text.split("\n"), result.location
    if not at.line or not at.column or at.line > len(lines):
        return False
    quote = ""
    for character in lines[at.line - 1][: at.column - 1]:
        if quote == character:
            quote = ""
        elif not quote and character in "'\"":
            quote = character
    return bool(quote) and not re.search(r"\b[fF][rR]?['\"]|\b[rR][fF]['\"]", lines[at.line - 1])


def _is_switched_off(name: str, text: str) -> bool:
    """Whether the import of *name* is in a comment, as that of a tool for debugging."""
    imports = re.compile(
        rf"^[ \t]*#[# \t]*(?:import[ \t]+(?:[\w., \t]{{0,200}}[ \t,])??{name}[ \t]*(?:$|[,#;])"
        rf"|(?:import[ \t]+[\w.]{{1,200}}|from[ \t]+[\w.]{{1,200}}[ \t]+import[ \t]+[\w. \t,()]{{0,300}}?)\bas[ \t]+{name}\b"
        rf"|from[ \t]+[\w.]{{1,200}}[ \t]+import[ \t(]+(?:\w[\w \t,]{{0,300}}?[ \t,])??{name}[ \t]*(?:$|[,#;)]))",
        re.MULTILINE,
    )
    return imports.search(text) is not None
