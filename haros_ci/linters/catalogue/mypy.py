# SPDX-License-Identifier: Apache-2.0
"""The error codes of mypy."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Group, Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

CODES = "https://mypy.readthedocs.io/en/stable/error_code_list.html"
MORE_CODES = "https://mypy.readthedocs.io/en/stable/error_code_list2.html"
SUPPRESS = "`# type: ignore[CODE]` on the line"

GROUPS: tuple[Group, ...] = (
    Group(
        "A value of this type cannot be used here: convert it, test it, or correct the annotation.",
        ("correctness", "types"),
        (
            ("arg-type", "R", "Argument of the wrong type."),
            ("assert-type", "R", "Expression of another type than assert_type states."),
            ("assignment", "R", "Value of the wrong type in an assignment."),
            ("call-arg", "B", "Call with wrong or missing arguments."),
            ("call-overload", "R", "Call that matches no overload."),
            ("comparison-overlap", "S", "Comparison of values that can never be equal."),
            ("dict-item", "R", "Dict item of the wrong type."),
            ("index", "R", "Invalid index."),
            ("list-item", "R", "List item of the wrong type."),
            ("method-assign", "S", "Assignment to a method."),
            ("operator", "R", "Operator with operands of the wrong type."),
            ("return", "R", "Missing return statement."),
            ("return-value", "R", "Returned value of the wrong type."),
            ("str-bytes-safe", "R", "bytes in a formatted string."),
            ("str-format", "B", "Format string that does not match its arguments."),
            ("str-unpack", "S", "String unpacked into characters."),
            ("typeddict-item", "R", "TypedDict item of the wrong type."),
            ("typeddict-readonly-mutated", "R", "Changed read-only item of a TypedDict."),
            ("typeddict-unknown-key", "R", "Unknown key of a TypedDict."),
            ("type-var", "R", "Type outside the bounds of its type variable."),
            ("literal-required", "R", "TypedDict key or attribute name that is not a literal."),
            ("func-returns-value", "R", "Used value of a function that returns None."),
            ("exit-return", "S", "__exit__ declared to return bool, although it never returns True."),
            ("no-redef", "S", "Redefined name."),
        ),
    ),
    Group(
        "What is named here does not exist on a value of this type, or not on every one: None, for example.",
        ("correctness", "names"),
        (
            ("attr-defined", "R", "Undefined attribute or module member."),
            ("name-defined", "B", "Undefined name."),
            ("union-attr", "S", "Attribute missing in one of the types of a union, often None."),
            ("used-before-def", "B", "Variable used before its assignment."),
            ("possibly-undefined", "S", "Variable that may be unassigned."),
        ),
    ),
    Group(
        "A coroutine does nothing until it is awaited.",
        ("correctness", "async"),
        (
            ("await-not-async", "B", "await outside an async function."),
            ("top-level-await", "B", "await outside a function."),
            ("unused-awaitable", "R", "Awaitable that is not awaited."),
            ("unused-coroutine", "B", "Coroutine that is not awaited."),
        ),
    ),
    Group(
        "Classes do not keep to what they inherit or declare.",
        ("correctness", "classes"),
        (
            ("abstract", "B", "Instantiated class with abstract methods."),
            ("empty-body", "R", "Empty body of a function that declares a return value."),
            ("explicit-override", "S", "Override without the @override decorator."),
            ("metaclass", "R", "Invalid metaclass."),
            ("mutable-override", "S", "Mutable variable overridden with a narrower type."),
            ("no-overload-impl", "B", "Overloaded function without an implementation."),
            ("overload-cannot-match", "R", "Overload that can never match."),
            ("overload-overlap", "S", "Overlapping overloads with different results."),
            ("override", "R", "Override incompatible with the overridden method."),
            ("prop-decorator", "S", "Decorator above @property."),
            ("safe-super", "R", "super() call of an abstract method without a body."),
            ("type-abstract", "S", "Abstract class passed as a type."),
        ),
    ),
    Group(
        "mypy cannot read this as a type, and checks nothing that depends on it.",
        ("correctness", "annotations"),
        (
            ("has-type", "S", "Value whose type cannot be inferred."),
            ("maybe-unrecognized-str-typeform", "S", "Syntax error in a quoted annotation."),
            ("misc", "S", "Other error of mypy without its own code."),
            ("name-match", "S", "Type name that differs from its variable."),
            ("narrowed-type-not-subtype", "R", "Type guard that does not narrow to a subtype."),
            ("nonetype-type", "S", "Invalid annotation of None."),
            ("syntax", "R", "Syntax error in the file or in a type comment."),
            ("valid-newtype", "R", "NewType without a class."),
            ("valid-type", "R", "Invalid type in an annotation."),
        ),
    ),
    Group(
        "This can never be, or is always so.",
        ("correctness",),
        (
            ("exhaustive-match", "S", "match statement that does not cover all values."),
            ("redundant-expr", "S", "Condition that is always true or always false."),
            ("truthy-bool", "S", "Tested value that is always true."),
            ("truthy-function", "B", "Function tested as a condition without a call."),
            ("truthy-iterable", "S", "Tested iterable that is always true."),
            ("unreachable", "S", "Unreachable statement."),
        ),
    ),
    Group(
        "A project that switches this on wants its types complete.",
        ("types", "strictness"),
        (
            ("deprecated", "S", "Use of a deprecated function or class."),
            ("explicit-any", "S", "Explicit Any."),
            ("ignore-without-code", "S", "type: ignore comment without an error code."),
            ("no-any-return", "S", "Any returned from a function with a declared type."),
            ("no-any-unimported", "S", "Type that becomes Any because of an import."),
            ("no-untyped-call", "S", "Call of a function without annotations."),
            ("no-untyped-def", "S", "Function without annotations."),
            ("redundant-cast", "S", "Redundant cast."),
            ("redundant-self", "S", "Redundant annotation of self."),
            ("type-arg", "S", "Generic type without parameters."),
            ("unimported-reveal", "S", "reveal_type used without an import."),
            ("untyped-decorator", "S", "Decorator without annotations."),
            ("unused-ignore", "S", "Unused type: ignore comment."),
            ("var-annotated", "S", "Variable that needs an annotation."),
        ),
    ),
    Group(
        "Only what is in the package and in the standard library is looked at, so that everything of ROS is missing.",
        ("imports",),
        (
            ("annotation-unchecked", "-", "Annotations inside an unchecked function."),
            ("import", "-", "Imported module not found or without types."),
            ("import-not-found", "-", "Imported module not found."),
            ("import-untyped", "-", "Imported module without types."),
        ),
        precision="low",
    ),
)


def rules() -> dict[str, Rule]:
    """The codes of the tables."""
    return {code: _rule(code, letters, summary, group) for group in GROUPS for code, letters, summary in group.rows}


def invented(code: str) -> Rule:
    """A rule for a code of a newer version or of a plug-in."""
    return _rule(code, "-", f"Finding of mypy's check '{words(code)}'.", Group("", (), (), precision="medium"))


def _rule(code: str, letters: str, summary: str, group: Group) -> Rule:
    return Rule(
        id=code,
        summary=summary,
        level=Level.ERROR if letters == "B" else Level.WARNING if letters in "RS" else Level.NOTE,
        help=help_text(code, summary, group.advice, SUPPRESS, "mypy"),
        help_uri=MORE_CODES if "strictness" in group.tags else f"{CODES}#code-{code}",
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "mypy", *group.tags),
    )
