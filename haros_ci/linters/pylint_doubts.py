# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that the text around them refutes.

Pylint does not see what a decorator does that is not installed, nor why a name stands alone, nor that a callback is tested
before it is called; it takes any mutable default for a shared one, and what the main block of a script sets for unset.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from haros_ci.linters.class_methods import is_class_method, takes_value
from haros_ci.linters.decorated import is_decorated
from haros_ci.linters.nan_itself import is_of_nan_itself
from haros_ci.linters.pylint_definitions import is_of_renamed, loses_nothing
from haros_ci.linters.pylint_idioms import (
    is_choice_of_calls,
    is_instead_of_import,
    is_left_to_subclasses,
    is_no_object,
    is_of_known_key,
    is_one_of_several,
    is_placeholder,
    is_stub,
    is_to_fail,
    is_unpacked,
)
from haros_ci.linters.pylint_names import is_counted_up, is_deleted_global, is_set_by_main
from haros_ci.linters.pylint_statements import (
    gives_names,
    has_items,
    is_in_description,
    is_index_of_array,
    is_of_another,
    is_one_text,
    is_product,
    is_stop_on_condition,
    is_surplus,
    is_test_for_nan,
    is_text,
    unbinds,
)
from haros_ci.linters.python2 import runs_only_on_python2
from haros_ci.linters.python_defaults import is_only_read
from haros_ci.linters.several_classes import is_of_several_classes
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.overwritten import is_overwritten, is_used_before
from haros_ci.results.scope import scopes

_CALLEE = regex(r"(?<!\w)(\w+)[ \t]*\(")
#: The idiom of ROS 2's tutorials: ``self.subscription  # prevent unused variable warning``.
_KEPT = regex(r"\A[^#]*#.*\b(?:unused|warnings?|lint\w*|pylint|flake8|noqa|keep|reference)\b", re.IGNORECASE)
#: A conversion that takes a number as well as the text of a variable.
_CONVERTED = regex(r"\b(?:int|float|bool|str)\([ \t]*os\.(?:getenv|environ\.get)[ \t]*\(")
#: What is evaluated to see whether it raises.
_RAISING = regex(
    r"\s*(?:async\s+)?with\b.*\b(?:raises|assertRaises\w*|warns|assertWarns\w*|suppress|deprecated_call)\b|\s*try\s*:"
)
#: How far above its use a name of that idiom is assigned.
_NEAR = 40
#: Characters of a line that are looked at.
_LONGEST = 400
_NAME = regex(r"[A-Za-z_][\w.]*")
_OF_SHAPES = regex(r"\.(?:reshape|transpose|resize)[ \t]*\(")
_BRACKET_OR_SHAPE = regex(rf"{_OF_SHAPES.pattern}|[\[({{\])}}]")
#: Lines of a statement that are looked at.
_STATEMENT_LINES = 40
#: ``[call(x) for x in them]``, over several lines, too.
_COMPREHENSION = regex(r"[\[{(][^\[\]{}]{0,300}?\w\([^\[\]{}]{0,300}?\)\s*(?:\S{0,40}\s+)?for\s[^\n]{1,200}?\sin\s")
_SWITCHED = regex(
    r"\bor[ \t]+(?:True|1)\b(?![ \t]*[.=<>])|\band[ \t]+(?:False|0)\b(?![ \t]*[.=<>])|\b(?:if|elif|while)[ \t]+(?:True[ \t]+or|False[ \t]+and)\b"
)
_UNWRITTEN = regex(r"raise[ \t]+(?:NotImplementedError|NotImplemented)\b")
_TRY = regex(r"\s*try\s*:")
_MISSING = regex(r"\s*except\b(?:\s*:|[^\n:]{0,200}\b(?:ImportError|ModuleNotFoundError|Exception)\b)")
_BRANCH = regex(r"\s*(?:if|elif|else)\b")
_PLATFORM = regex(r"\s*(?:if|elif)\b.*\b(?:sys\.platform|platform\.system|os\.name|platform)\b")
_MAIN = regex(r"if\b.*__name__\s*==\s*['\"]__main__['\"]|if\b.*['\"]__main__['\"]\s*==\s*__name__")


#: What pylint says of a value: wrong where it takes for the object what a method without ``self`` is given through its class.
_OF_VALUES = frozenset(
    """
    invalid-sequence-index invalid-slice-index invalid-unary-operand-type not-a-mapping not-an-iterable not-callable no-member
    unhashable-member unsubscriptable-object unsupported-assignment-operation unsupported-binary-operation
    unsupported-delete-operation unsupported-membership-test
    """.split()
)
#: What pylint says of the arguments of a call, which raises a TypeError then.
_OF_CALLS = frozenset(
    "missing-kwoa no-value-for-parameter redundant-keyword-arg too-many-function-args unexpected-keyword-arg".split()
)

#: What happens when the line is run.
_RAISED = (
    _OF_VALUES
    | _OF_CALLS
    | {"undefined-variable", "used-before-assignment", "too-few-format-args", "too-many-format-args"}
)


#: What the text around a line refutes of one rule.
_AT_LINE: dict[str, Callable[[str, int], bool]] = {
    "bad-super-call": is_of_another,
    "comparison-with-itself": is_test_for_nan,
    "dangerous-default-value": is_only_read,
    "forgotten-debug-statement": is_stop_on_condition,
    "implicit-str-concat": is_one_text,
    "invalid-character-zero-width-space": is_in_description,
    "modified-iterating-dict": lambda text, line: unbinds(text, line) or is_of_known_key(text, line),
    "modified-iterating-list": unbinds,
    "modified-iterating-set": unbinds,
    "nan-comparison": is_of_nan_itself,
    "no-self-argument": is_class_method,
    "self-assigning-variable": is_one_of_several,
    "undefined-all-variable": lambda text, _: gives_names(text),
}


def is_refuted(rule: str, line: int, column: int, text: str) -> bool:  # noqa: C901 - one branch for each rule
    """Whether the *text* refutes what pylint says by *rule* at *line*, counted from 1, and *column*, from 0.

    Comments and texts refute nothing, but for comments that say what is meant: that a name is kept, that a test is for NaN.
    """
    code = code_alone(text, "python")
    if rule in _OF_VALUES and (takes_value(text, line) or is_product(code, line, column)):
        return True
    if rule in _OF_CALLS and (is_to_fail(text, line) or is_of_several_classes(text, line, column)):
        return True
    if rule in _RAISED and is_overwritten(text, line):
        return True
    if rule in _AT_LINE:
        return _AT_LINE[rule](text, line)
    if rule == "no-value-for-parameter":
        is_given = _is_decorated(code, line, column) or is_unpacked(code, line, column)
        return is_given or is_of_renamed(text, line, column)
    if rule in ("pointless-statement", "expression-not-assigned"):
        is_call = rule == "expression-not-assigned" and (_is_loop(code, line, column) or is_choice_of_calls(text, line))
        return is_call or is_stub(text, line) or _is_on_purpose(text, code, line)
    if rule == "unreachable":
        return _is_unwritten(code, line) or is_text(text, line)
    if rule == "invalid-envvar-default":  # int() and float() take the default as well as the text
        return 0 < line <= code.count("\n") + 1 and _CONVERTED.search(code.split("\n")[line - 1]) is not None
    if rule == "condition-evals-to-constant":
        return _is_switched(code, line)
    if rule == "too-many-format-args":
        return is_surplus(text, line, column)
    if rule == "function-redefined":
        return is_used_before(text, line) or is_instead_of_import(text, line) or loses_nothing(text, line)
    if rule == "self-cls-assignment":
        return is_no_object(text, line, column)
    if rule == "invalid-sequence-index":
        return is_index_of_array(text, line, column)
    if rule in ("bad-thread-instantiation", "trailing-comma-tuple"):
        return is_placeholder(code, line) if rule == "bad-thread-instantiation" else has_items(code, line)
    if rule == "too-many-function-args":
        return _is_of_shapes(code, line, column)
    if rule == "not-callable":
        return _is_tested(code, line, column) or is_left_to_subclasses(code, line, column)
    if rule in ("undefined-variable", "used-before-assignment"):
        is_global = _is_global_of_main(code, line, column) or is_deleted_global(text, line, column)
        return is_global or is_counted_up(text, line) or is_set_by_main(text, line, column)
    if rule == "possibly-used-before-assignment":
        return _is_of_main(code, line, column) or _is_module(code, line, column) or _is_of_platforms(code, line, column)
    if rule == "deprecated-module":
        return _has_fallback(code, line)
    if rule == "anomalous-backslash-in-string":  # Python 2 says nothing of it
        return runs_only_on_python2(text)
    return False


def _is_of_shapes(text: str, line: int, column: int) -> bool:
    """Whether a call of NumPy's that takes a shape as one argument or as several, which pylint does not know, ends the expression there.

    The place of the call is where what it is a method of begins, which may be lines above: ``np.array([…]).reshape(3, 3)``.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    if _OF_SHAPES.search(lines[line - 1], column) is not None:
        return True
    depth = 0
    for number, part in enumerate(lines[line - 1 : line - 1 + _STATEMENT_LINES]):
        for found in _BRACKET_OR_SHAPE.finditer(part, column if number == 0 else 0):
            if depth == 0 and found[0].startswith("."):
                return True
            depth += 1 if found[0][-1] in "([{" else -1
        if depth <= 0:
            return False
    return False


def _is_switched(text: str, line: int) -> bool:
    """Whether the condition at *line* is switched on or off by hand: ``a is None or True``."""
    lines = text.split("\n")
    return 0 < line <= len(lines) and _SWITCHED.search(lines[line - 1][:_LONGEST].partition("#")[0]) is not None


def _has_fallback(text: str, line: int) -> bool:
    """Whether the import at *line* is in a ``try``, or in its ``except``, that is ready for a module that is gone."""
    lines = text.split("\n")
    indent = len(lines[line - 1]) - len(lines[line - 1].lstrip()) if 0 < line <= len(lines) else 0
    index = line - 1
    while indent and index > 0:
        index -= 1
        own = len(lines[index]) - len(lines[index].lstrip())
        if not lines[index].strip() or own >= indent:
            continue
        indent = own
        if _MISSING.match(lines[index]):
            return True
        if _TRY.match(lines[index]):
            after = (
                other_text
                for other_text in lines[line:]
                if other_text.strip() and len(other_text) - len(other_text.lstrip()) <= own
            )
            if _MISSING.match(
                next((other_text for other_text in after if not other_text.lstrip().startswith("#")), "")
            ):
                return True
    return False


def _is_loop(text: str, line: int, column: int) -> bool:
    """Whether a comprehension stands there for what its calls do: a loop, only shorter."""
    start = "\n".join(text.split("\n")[max(line - 1, 0) : line + 6])[column : column + _LONGEST]
    return _COMPREHENSION.match(start) is not None


def _is_unwritten(text: str, line: int) -> bool:
    """Whether the statement before *line* says that the rest is still to be written."""
    lines = text.split("\n")
    here = lines[line - 1] if 0 < line <= len(lines) else ""
    indent = len(here) - len(here.lstrip())
    for above in reversed(lines[max(line - 1 - _NEAR, 0) : max(line - 1, 0)]):
        bare = above.strip()
        if bare and not bare.startswith(("#", ")")) and len(above) - len(above.lstrip()) <= indent:
            return _UNWRITTEN.match(bare) is not None
    return False


def _is_global_of_main(text: str, line: int, column: int) -> bool:
    """Whether a ``global`` statement names what is used there, and the main block of the script sets it before it calls."""
    lines = text.split("\n")
    used = _NAME.match(lines[line - 1], column) if 0 < line <= len(lines) else None
    if used is None:
        return False
    name = re.escape(used[0].partition(".")[0])
    named = re.compile(rf"[ \t]*global[ \t][\w, \t]*\b{name}\b")
    return any(named.match(other_text[:_LONGEST]) for other_text in lines) and _is_of_main(text, line, column)


def _is_of_platforms(text: str, line: int, column: int) -> bool:
    """Whether several branches on the platform set the name there, and none for all others: those are not supported."""
    lines = text.split("\n")
    name = _NAME.match(lines[line - 1][column : column + _LONGEST]) if 0 < line <= len(lines) else None
    if name is None:
        return False
    assigned = re.compile(rf"[ \t]+{re.escape(name[0].partition('.')[0])}[ \t]*(?::[^=#]*)?=(?!=)")
    above = [index for index, other_text in enumerate(lines[: line - 1]) if assigned.match(other_text[:_LONGEST])]
    return len(above) > 1 and all(_PLATFORM.match(_head(lines, index)) for index in above[:_NEAR])


def _is_module(text: str, line: int, column: int) -> bool:
    """Whether the name there is a module that a branch imports above (``if os.name == 'nt'``): the use is behind the same test."""
    lines = text.split("\n")
    name = _NAME.match(lines[line - 1][column : column + _LONGEST]) if 0 < line <= len(lines) else None
    if name is None:
        return False
    word = re.escape(name[0].partition(".")[0])
    imported = re.compile(
        rf"^[ \t]+(?:import[ \t]+(?:[\w., \t]*\b)?{word}\b|from[ \t]+[\w.]+[ \t]+import[ \t][^\n#]*\b{word}\b)"
    )
    above = (index for index, other_text in enumerate(lines[: line - 1]) if imported.match(other_text[:_LONGEST]))
    return any(_BRANCH.match(_head(lines, index)) for index in above)


def _head(lines: list[str], index: int) -> str:
    """The line above *index* that begins the block that it is in."""
    indent = len(lines[index]) - len(lines[index].lstrip())
    above = (line for line in reversed(lines[:index]) if line.strip() and len(line) - len(line.lstrip()) < indent)
    return next(above, "")


def _is_decorated(text: str, line: int, column: int) -> bool:
    """Whether the function that is called there has a decorator here that may give it arguments (click, hydra, mock)."""
    lines = text.split("\n")
    called = _CALLEE.search(lines[line - 1], column) if 0 < line <= len(lines) else None
    return called is not None and is_decorated(text, called[1])


def _is_on_purpose(text: str, code: str, line: int) -> bool:
    """Whether a comment at a name says so, or a block around it waits for what is raised; *code* is *text* without comments."""
    lines = code.split("\n")
    if not 0 < line <= len(lines):
        return False
    here = lines[line - 1]
    indent = len(here) - len(here.lstrip())
    if _NAME.fullmatch(here.strip()):
        if _KEPT.search(text.split("\n")[line - 1]):
            return True
        assigned = re.compile(rf"{re.escape(here.rstrip())}[ \t]*(?::[^=\n]*)?=(?!=)")  # the idiom without its comment
        if any(assigned.match(above) for above in lines[max(line - 1 - _NEAR, 0) : line - 1]):
            return True
    for above in reversed(lines[max(line - 50, 0) : line - 1]):
        if above.strip() and len(above) - len(above.lstrip()) < indent:
            return bool(_RAISING.match(above))
    return False


def _is_tested(text: str, line: int, column: int) -> bool:
    """Whether the name that is called there is tested before, in the same function: pylint has followed its None only."""
    lines = text.split("\n")
    called = _NAME.match(lines[line - 1], column) if 0 < line <= len(lines) else None
    if called is None:
        return False
    name = re.escape(called[0])
    test = re.compile(
        rf"(?:\b(?:if|elif|while|and|or|not|assert)[ \t(]+|\bcallable\(\s*){name}\b(?![\w.(\[])(?!\s*[=!<>]=)"
        rf"|(?<![\w.]){name}\s+(?:and|is\s+not|is\s+None)\b|(?<![\w.]){name}\s*!=\s*None\b|^\s*{name}\)?\s*:\s*$"
    )
    inside = scopes(text, "python")
    here = inside.at(line)
    return any(
        test.search(other_text[:_LONGEST]) and inside.at(number) == here
        for number, other_text in enumerate(lines[:line], start=1)
    )


def _is_of_main(text: str, line: int, column: int) -> bool:
    """Whether a function uses there what the main block of the script sets, which calls it afterwards."""
    lines = text.split("\n")
    used = _NAME.match(lines[line - 1], column) if 0 < line <= len(lines) else None
    if used is None or not scopes(text, "python").at(line):
        return False
    name = re.escape(used[0].partition(".")[0])
    assigned = re.compile(
        rf"[ \t]+(?:[^=()#]*[,( \t])?{name}\b[^=()#]*=(?!=)|[ \t]+.*\bas[ \t]+{name}\b|[ \t]+for\b.*\b{name}\b.*\bin\b"
    )
    in_main = False
    for item in (whole[:_LONGEST] for whole in lines):
        if item[:1].strip() and not item.startswith(("#", ")", "]", "}")):
            in_main = _MAIN.match(item) is not None
        elif in_main and assigned.match(item):
            return True
    return False
