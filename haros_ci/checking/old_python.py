# SPDX-License-Identifier: Apache-2.0
"""Python as modules of the standard library read it, Python 2 tolerated: undefined names, and formats that do not fit their values. Nothing is run."""

from __future__ import annotations

import ast
import builtins
import re
import string
import symtable
import warnings
from collections.abc import Collection, Iterator, Mapping

from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.python_nodes import mentions
from haros_ci.results.unreached import EXITING, EXITS, dead_parts, is_bound

MAX_SOURCE = 500_000
_PRINT = regex(r"(^[ \t]*|[:;][ \t]*)print[ \t]*(?:>>[ \t]*|(?<=[ \t])(?=[\"'\w\[{`-]))", re.MULTILINE)
_EXCEPT = regex(r"^([ \t]*except[ \t]+[\w.]+|[ \t]*except[ \t]*\([\w., \t]+\)),[ \t]*(\w+)[ \t]*:", re.MULTILINE)
_RAISE = regex(r"^([ \t]*raise[ \t]+[\w.]+),[ \t]*(.+)$", re.MULTILINE)
_OCTAL = regex(r"(?<![\w.])0([0-7]+)[lL]?(?![\w.])")
#: What Python 2 has besides (docs.python.org/2/library/functions.html), and what every module has.
_NAMES = frozenset(dir(builtins)) | frozenset(
    """
    unicode xrange raw_input basestring long reduce file cmp unichr execfile reload apply buffer intern coerce StandardError WindowsError
    __file__ __name__ __doc__ __builtins__ __package__ __path__ __loader__ __spec__ __class__ __module__ __qualname__ __metaclass__ exec
    """.split()
)
#: How a module is loaded that may be given names from outside.
LOADS = regex(
    r"\bload_source\b|\bload_module\b|\bexec_module\b|\bimport_module\b|\b__import__\b|\bexecfile\b|\bexec[ \t(]"
)
#: What defines names in ways that no table shows, or asks for a name that may be missing.
_OPEN = regex(
    r"\bimport[ \t]*(?:\([ \t]*)?\*|\bexec\b|\bexecfile\b|\bglobals[ \t]*\(|\blocals[ \t]*\(|\bNameError\b|\b__builtin__\b|\bvars[ \t]*\("
)
_PLACE = regex(r"%(?:\((\w*)\))?[#0\- +]*(\*|\d+)?(?:\.(\*|\d+))?[hlL]?([diouxXeEfFgGcrsa%])")
#: An import or an assignment in a comment: all that is imported, and what is assigned.
_COMMENTED = regex(r"#[#\s]*(?:(?:from[ \t]+[\w.]+[ \t]+)?import\b[^#;]*|[A-Za-z_]\w*[ \t]*=(?!=))")
_WORD = regex(r"[A-Za-z_]\w*")
_LOGGER = regex(r"log|ros", re.IGNORECASE)
_LOGS = frozenset("logdebug loginfo logwarn logerr logfatal debug info warn warning error critical fatal".split())


@dataclass(frozen=True, slots=True)
class Misfit:
    """A format string with *places* for values and the number *received*, on *line*; *is_open* if the values stand behind it without parentheses."""

    line: int
    places: int
    received: int
    is_open: bool = False


def parsed_of_any_version(text: str) -> tuple[ast.Module, str, bool] | None:
    """The module, the text that it was read of, and whether Python 3 refuses the file; None if nobody can read it."""
    if len(text) > MAX_SOURCE:
        return None
    text = text.replace("\r\n", "\n")
    tabs = text.replace("\t", "        ")
    for number, source in enumerate((text, tabs, _modern(text))):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return ast.parse(source), source, number > 1
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
    return None


def _modern(text: str) -> str:
    """*text* with what is written otherwise in Python 3, as far as it is common; lines keep their numbers. What is printed stands alone."""
    text = _PRINT.sub(r"\1", text)
    text = _EXCEPT.sub(r"\1 as \2:", text)
    text = _RAISE.sub(r"\1(\2)", text)
    return _OCTAL.sub(r"0o\1", text).replace("\t", "        ")


def undefined_names(module: ast.Module, source: str) -> Iterator[tuple[str, int]]:
    """Names that some scope reads and nothing in the file defines, with the first line that does: one that is reached, if there is one."""
    if _OPEN.search(code_alone(source, "python")):
        return
    try:
        top = symtable.symtable(source, "module", "exec")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    tables = [top]
    for table in tables:
        tables += table.get_children()
    defined = set(_NAMES)
    defined |= {symbol.get_name() for symbol in top.get_symbols() if _is_made(symbol)}
    for table in tables:
        defined |= {
            symbol.get_name() for symbol in table.get_symbols() if symbol.is_declared_global() and _is_made(symbol)
        }
    for node in ast.walk(module):  # Python 2 leaves the variables of a list behind
        if isinstance(node, ast.comprehension):
            defined |= {other_node.id for other_node in ast.walk(node.target) if isinstance(other_node, ast.Name)}
    missing = {
        symbol.get_name()
        for table in tables
        for symbol in table.get_symbols()
        if symbol.is_referenced() and not _is_made(symbol) and (table is top or symbol.is_global())
    } - defined
    dead = switched_off(module) if missing else frozenset()
    first: dict[str, tuple[bool, int]] = {}
    for node in _unbound(module) if missing else ():
        if node.id in missing:
            place = (node.lineno in dead, node.lineno)
            first[node.id] = min(place, first.get(node.id, place))
    yield from sorted(((name, line) for name, (_, line) in first.items()), key=lambda pair: (pair[1], pair[0]))


def _unbound(module: ast.Module) -> Iterator[ast.Name]:
    """The names that are read, but for those that a function around them has as a parameter or assigns."""
    waiting: list[tuple[ast.AST, frozenset[str]]] = [(module, frozenset())]
    while waiting:
        node, bound = waiting.pop()
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id not in bound:
            yield node
        inner = bound
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
            inner |= {node.arg for node in ast.walk(node.args) if isinstance(node, ast.arg)}
            parts = [node.body] if isinstance(node, ast.Lambda) else node.body
            stored = (node for part in parts for node in ast.walk(part) if isinstance(node, ast.Name))
            inner |= {name.id for name in stored if isinstance(name.ctx, ast.Store)}
        waiting += ((node, inner) for node in ast.iter_child_nodes(node))


def switched_off(module: ast.Module) -> frozenset[int]:
    """The lines of what nothing reaches: below ``if False:``, behind ``quit()``, a ``return`` or a loop without an end."""
    found: set[int] = set()
    exits = frozenset() if is_bound(ast.walk(module), EXITING) else EXITS
    for node in ast.walk(module):
        for part in dead_parts(node, exits):
            if isinstance(part[0], ast.stmt):
                found.update(range(part[0].lineno, (part[-1].end_lineno or part[-1].lineno) + 1))
    return frozenset(found)


def commented_blocks(source: str, names: Collection[str]) -> Mapping[str, int]:
    """By name the first line of the block of comments that has an import or an assignment of it."""
    found: dict[str, int] = {}
    start = 0
    for number, line in enumerate(source.split("\n"), 1):
        text = line.lstrip()
        if not text.startswith("#"):
            start = start if not text and start else 0
            continue
        start = start or number
        made = _COMMENTED.match(text)
        for name in _WORD.findall(made[0]) if made is not None else ():
            if name in names:
                found.setdefault(name, start)
    return found


def _is_made(symbol: symtable.Symbol) -> bool:
    return symbol.is_assigned() or symbol.is_imported() or symbol.is_namespace() or symbol.is_parameter()


def misfits(module: ast.Module, is_old: bool) -> Iterator[Misfit]:
    """Formats whose values are too few or too many: all in a file that *is_old*, else those alone that linters for Python 3 cannot know."""
    for node in ast.walk(module):
        if isinstance(node, ast.Call) and len(node.args) > 1:
            found = _unparenthesised(node)
            if found is not None:
                yield found
        if is_old:
            found = (
                _percent(node) if isinstance(node, ast.BinOp) else _format(node) if isinstance(node, ast.Call) else None
            )
            if found is not None:
                yield found


def _unparenthesised(call: ast.Call) -> Misfit | None:
    """``loginfo("%s of %s" % one, other)``"""
    first, function = call.args[0], call.func
    if not isinstance(function, ast.Attribute) or function.attr not in _LOGS:
        return None
    if not mentions(function.value, _LOGGER) or not isinstance(first, ast.BinOp):
        return None
    places = _places(first)
    is_one = isinstance(first.right, (ast.Attribute, ast.Name, ast.Subscript, ast.Call, ast.Constant))
    if places is None or places != len(call.args) or not is_one or any(isinstance(a, ast.Starred) for a in call.args):
        return None
    return Misfit(first.lineno, places, 1, is_open=True)


def _places(node: ast.BinOp) -> int | None:
    """For how many values the text left of ``%`` has room; None if it is no text, or has names."""
    left = node.left
    if not isinstance(node.op, ast.Mod) or not isinstance(left, ast.Constant) or not isinstance(left.value, str):
        return None
    places = 0
    rest = _PLACE.sub("", left.value)
    if "%" in rest:
        return None
    for name, width, precision, kind in _PLACE.findall(left.value):
        if name:
            return None
        places += (kind != "%") + (width == "*") + (precision == "*")
    return places


def _percent(node: ast.BinOp) -> Misfit | None:
    places, right = _places(node), node.right
    if places is None:
        return None
    if isinstance(right, ast.Tuple):
        count = len(right.elts)
        return Misfit(node.lineno, places, count) if count != places and not _starred(right.elts) else None
    is_one = isinstance(right, (ast.Constant, ast.JoinedStr, ast.Compare, ast.List, ast.ListComp))
    return Misfit(node.lineno, places, 1) if is_one and places != 1 else None


def _format(node: ast.Call) -> Misfit | None:
    function = node.func
    if (
        not isinstance(function, ast.Attribute)
        or function.attr != "format"
        or not isinstance(function.value, ast.Constant)
    ):
        return None
    text = function.value.value
    if not isinstance(text, str) or _starred(node.args) or any(keyword.arg is None for keyword in node.keywords):
        return None
    try:
        fields = [
            field
            for _, field, spec, _ in string.Formatter().parse(text)
            if field is not None and "{" not in (spec or "")
        ]
    except ValueError:
        return None
    words = [re.split(r"[.\[]", field)[0] for field in fields]
    plain = words.count("")
    numbers = [int(word) + 1 for word in words if word.isdigit() and len(word) < 4]
    needed = max([plain, *numbers])
    return Misfit(node.lineno, needed, len(node.args)) if needed > len(node.args) else None


def _starred(nodes: list[ast.expr]) -> bool:
    return any(isinstance(node, ast.Starred) for node in nodes)
