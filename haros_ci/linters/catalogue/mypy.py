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
            ("arg-type", "R", "An argument has the type of its parameter."),
            ("assert-type", "R", "An expression has the type that assert_type names."),
            ("assignment", "R", "A value has the type of the variable that it is assigned to."),
            ("call-arg", "B", "A call has the arguments that the function takes."),
            ("call-overload", "R", "A call fits one of the function's overloads."),
            ("comparison-overlap", "S", "Values that are compared can be equal."),
            ("dict-item", "R", "An item of a dict has the dict's types."),
            ("index", "R", "What is indexed has items of that index."),
            ("list-item", "R", "An item of a list has the list's type."),
            ("method-assign", "S", "A method is not assigned to."),
            ("operator", "R", "An operator can be used with values of these types."),
            ("return", "R", "A function returns a value on every path."),
            ("return-value", "R", "A returned value has the type that the function declares."),
            ("str-bytes-safe", "R", "bytes are decoded before they become part of a text."),
            ("str-format", "B", "A format and its arguments fit each other."),
            ("str-unpack", "S", "A text is not unpacked letter by letter."),
            ("typeddict-item", "R", "An item of a TypedDict has its declared type."),
            ("typeddict-readonly-mutated", "R", "A read-only item of a TypedDict is not changed."),
            ("typeddict-unknown-key", "R", "A TypedDict has the keys that are declared."),
            ("type-var", "R", "A type fits the bounds of the type variable that it is given for."),
            ("literal-required", "R", "A key of a TypedDict or a name of an attribute is a literal."),
            ("func-returns-value", "R", "The value of a function that returns none is not used."),
            ("exit-return", "S", "__exit__ does not claim to return any bool."),
            ("no-redef", "S", "A name is defined once."),
        ),
    ),
    Group(
        "What is named here does not exist on a value of this type, or not on every one: None, for example.",
        ("correctness", "names"),
        (
            ("attr-defined", "R", "An attribute or a member of a module exists."),
            ("name-defined", "B", "A name is defined or imported before it is used."),
            ("union-attr", "S", "An attribute exists whatever the value is, None included."),
            ("used-before-def", "B", "A variable is assigned before it is used."),
            ("possibly-undefined", "S", "A variable is assigned on every path to its use."),
        ),
    ),
    Group(
        "A coroutine does nothing until it is awaited.",
        ("correctness", "async"),
        (
            ("await-not-async", "B", "await stands in an async function."),
            ("top-level-await", "B", "await stands in a function."),
            ("unused-awaitable", "R", "What can be awaited is awaited."),
            ("unused-coroutine", "B", "A coroutine is awaited."),
        ),
    ),
    Group(
        "Classes do not keep to what they inherit or declare.",
        ("correctness", "classes"),
        (
            ("abstract", "B", "A class with abstract methods is not instantiated."),
            ("empty-body", "R", "A function that declares a value has a body that returns one."),
            ("explicit-override", "S", "A method that overrides another says so."),
            ("metaclass", "R", "A metaclass is one that Python takes."),
            ("mutable-override", "S", "A variable that can change is not overridden with a narrower type."),
            ("no-overload-impl", "B", "An overloaded function has an implementation."),
            ("overload-cannot-match", "R", "An overload can be reached."),
            ("overload-overlap", "S", "Overloads do not overlap with different results."),
            ("override", "R", "A method takes and returns what the method that it overrides does."),
            ("prop-decorator", "S", "No decorator stands above property."),
            ("safe-super", "R", "super() does not call an abstract method without a body."),
            ("type-abstract", "S", "A class that is passed as a type can be instantiated."),
        ),
    ),
    Group(
        "mypy cannot read this as a type, and checks nothing that depends on it.",
        ("correctness", "annotations"),
        (
            ("has-type", "S", "The type of a value can be told where it is used."),
            ("maybe-unrecognized-str-typeform", "S", "An annotation in quotes can be read."),
            ("misc", "S", "Mypy's checks without a code of their own find nothing."),
            ("name-match", "S", "A type is called by the variable that it is assigned to."),
            ("narrowed-type-not-subtype", "R", "A type guard narrows to a subtype."),
            ("nonetype-type", "S", "None is annotated as None."),
            ("syntax", "R", "Mypy can read the file and its type comments."),
            ("valid-newtype", "R", "NewType gets a class."),
            ("valid-type", "R", "An annotation is a type."),
        ),
    ),
    Group(
        "This can never be, or is always so.",
        ("correctness",),
        (
            ("exhaustive-match", "S", "A match statement has a case for every value."),
            ("redundant-expr", "S", "A condition can be true and false."),
            ("truthy-bool", "S", "What is tested can be false."),
            ("truthy-function", "B", "A function is called rather than tested."),
            ("truthy-iterable", "S", "An iterable that is tested can be empty."),
            ("unreachable", "S", "Every statement can be reached."),
        ),
    ),
    Group(
        "A project that switches this on wants its types complete.",
        ("types", "strictness"),
        (
            ("deprecated", "S", "What is deprecated is not used."),
            ("explicit-any", "S", "Any is not written."),
            ("ignore-without-code", "S", "A type: ignore comment names its codes."),
            ("no-any-return", "S", "A function does not return Any for its declared type."),
            ("no-any-unimported", "S", "A type does not become Any because of an import."),
            ("no-untyped-call", "S", "An annotated function calls annotated functions."),
            ("no-untyped-def", "S", "A function has annotations."),
            ("redundant-cast", "S", "A cast changes the type."),
            ("redundant-self", "S", "The annotation of self is needed."),
            ("type-arg", "S", "A generic type has its parameters."),
            ("unimported-reveal", "S", "reveal_type is imported."),
            ("untyped-decorator", "S", "A decorator of an annotated function is annotated."),
            ("unused-ignore", "S", "A type: ignore comment hides an error."),
            ("var-annotated", "S", "A variable whose type cannot be told is annotated."),
        ),
    ),
    Group(
        "Only what is in the package and in the standard library is looked at, so that everything of ROS is missing.",
        ("imports",),
        (
            ("annotation-unchecked", "-", "Annotations stand in functions that are checked."),
            ("import", "-", "An imported module can be found and has types."),
            ("import-not-found", "-", "An imported module can be found."),
            ("import-untyped", "-", "An imported module has types."),
        ),
        precision="low",
    ),
)


def rules() -> dict[str, Rule]:
    """The codes of the tables."""
    return {code: _rule(code, letters, summary, group) for group in GROUPS for code, letters, summary in group.rows}


def invented(code: str) -> Rule:
    """A rule for a code of a newer version or of a plug-in."""
    return _rule(code, "-", f"Mypy's check '{words(code)}' finds nothing.", Group("", (), (), precision="medium"))


def _rule(code: str, letters: str, summary: str, group: Group) -> Rule:
    return Rule(
        id=code,
        summary=summary,
        level=Level.ERROR if letters == "B" else Level.WARNING if letters in "RS" else Level.NOTE,
        help=help_text(code, summary, group.advice, SUPPRESS),
        help_uri=MORE_CODES if "strictness" in group.tags else f"{CODES}#code-{code}",
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "mypy", *group.tags),
    )
