# SPDX-License-Identifier: Apache-2.0
"""The metric thresholds as rules; their tags name the standards that the numbers come from."""

from __future__ import annotations

from haros_ci.linters.catalogue import haros
from haros_ci.linters.catalogue.group import Rule, help_text, profiles, tags_of
from haros_ci.results.rule import Level

_BRANCHES = (
    "Every branch, loop, `case`, `catch`, `?:`, `&&` and `||` adds a path that a test has to take. Callbacks of"
    " robots grow this way; split the function by task, or turn the branches into a table."
)
_LENGTH = "Long functions hide more than one task. Move each task into a function with a name of its own."
_COMMENTS = (
    "The part of the non-blank lines that hold a comment (in Python docstrings too, licence headers included). Say"
    " what the code cannot: units, frames, assumptions, why."
)
_HALSTEAD = (
    "Halstead's volume is N · log2 n, with N operators and operands in all, n of them distinct; bugs are estimated as"
    " V / 3000. Split the file along its classes or tasks."
)
_INDEX = (
    "171 − 5.2 ln V − 0.23 ΣCC − 16.2 ln lines + 50 sin √(2.46 · comments), scaled to 0–100 per file. Long files"
    " with many branches score low; split them."
)

_CALLS = (
    "How many different functions a function calls by name; a macro in capitals is none. One that calls many knows too"
    " much: give parts of its work to functions of their own."
)
_NESTING = (
    "Control structures one inside another: `if`, loops, `switch` and `match`, `try`; an `else if` is no deeper than its"
    " `if`. Return early, or move the inner part into a function."
)
_PATHS = (
    "Nejmeh's NPATH, the ways through the function without going round a loop twice: a sequence multiplies, a branch"
    " adds. Each may need a test. Counting stops at 1000000000. Split the function where its decisions have nothing to"
    " do with each other."
)
_COUPLING = (
    "How many other classes of the workspace the class and its methods name: bases, members, parameters, local"
    " variables, calls of static methods. Each change there can mean one here. Depend on interfaces, or split the class."
)
_WEIGHT = "The cyclomatic complexities of its methods added up. A heavy class does several things; give each a class of its own."

#: (id, profile letter, tags, summary, advice)
ROWS: tuple[tuple[str, str, str, str, str], ...] = (
    (
        "max-cyclomatic-complexity-10",
        "S",
        "nasa-satc his cyclomatic-complexity",
        "Function with a cyclomatic complexity above 10.",
        _BRANCHES,
    ),
    (
        "max-cyclomatic-complexity-15",
        "R",
        "kth ros cyclomatic-complexity",
        "Function with a cyclomatic complexity above 15.",
        _BRANCHES,
    ),
    (
        "max-function-length-40",
        "S",
        "code-standards google-cpp verifysoft functions lines-of-code loc",
        "Function with more than 40 lines of code.",
        _LENGTH,
    ),
    (
        "max-eloc-50",
        "S",
        "nasa-satc his eloc lines-of-code loc",
        "Function with more than 50 effective lines of code (lines of braces not counted).",
        _LENGTH,
    ),
    (
        "max-eloc-70",
        "S",
        "kth ros eloc lines-of-code loc",
        "Function with more than 70 effective lines of code (lines of braces not counted).",
        _LENGTH,
    ),
    (
        "max-function-parameters-6",
        "S",
        "code-standards hicpp functions parameters",
        "Function with more than 6 parameters.",
        "Arguments in a row are easily swapped. Group those that belong together into a struct or a message.",
    ),
    (
        "max-file-length-400",
        "S",
        "verifysoft lines-of-code loc",
        "File with more than 400 lines of code.",
        "A file that long holds more than one thing. Give each class or task a file of its own.",
    ),
    (
        "min-comment-ratio-20",
        "-",
        "nasa-satc his unak ros comments comment-ratio",
        "File with comments on less than 20 percent of its lines.",
        _COMMENTS,
    ),
    (
        "max-comment-ratio-30",
        "-",
        "nasa-satc comments comment-ratio",
        "File with comments on more than 30 percent of its lines.",
        _COMMENTS,
    ),
    (
        "max-comment-ratio-40",
        "-",
        "unak comments comment-ratio",
        "File with comments on more than 40 percent of its lines.",
        _COMMENTS,
    ),
    (
        "halstead-volume-above-8000",
        "S",
        "verifysoft halstead halstead-volume",
        "File with a Halstead volume above 8000.",
        _HALSTEAD,
    ),
    (
        "halstead-bugs-above-2",
        "-",
        "verifysoft halstead halstead-bugs bugs",
        "File with more than 2 bugs by Halstead's estimate.",
        _HALSTEAD,
    ),
    (
        "mi-below-20",
        "R",
        "microsoft maintainability mi maintainability-index",
        "File with a maintainability index below 20.",
        _INDEX,
    ),
    (
        "mi-below-65",
        "-",
        "verifysoft maintainability mi maintainability-index",
        "File with a maintainability index below 65.",
        _INDEX + " On this scale nearly every file longer than a page is below 65.",
    ),
    (
        "max-function-calls-7",
        "S",
        "his function-calls",
        "Function that calls more than 7 different functions.",
        _CALLS,
    ),
    (
        "max-function-calls-10",
        "S",
        "kth ros function-calls",
        "Function that calls more than 10 different functions.",
        _CALLS,
    ),
    (
        "max-control-nesting-4",
        "S",
        "his nesting control-structures control-flow",
        "Control structures nested more than 4 deep.",
        _NESTING,
    ),
    (
        "max-control-nesting-5",
        "S",
        "kth ros nesting control-structures control-flow",
        "Control structures nested more than 5 deep.",
        _NESTING,
    ),
    (
        "max-static-path-80",
        "S",
        "his static-path",
        "Function with more than 80 static paths.",
        _PATHS,
    ),
    (
        "max-static-path-200",
        "S",
        "hicpp static-path",
        "Function with more than 200 static paths.",
        _PATHS,
    ),
    (
        "max-static-path-250",
        "S",
        "kth ros static-path",
        "Function with more than 250 static paths.",
        _PATHS,
    ),
    (
        "max-coupling-objects-5",
        "S",
        "nasa-satc ros coupling cbo",
        "Class coupled to more than 5 other classes.",
        _COUPLING,
    ),
    (
        "max-immediate-children-10",
        "S",
        "unak immediate-children noc",
        "Class with more than 10 immediate children.",
        "Classes of the workspace that derive from it directly. With many, a change of it reaches far, and it may be the"
        " wrong abstraction: look for groups among the children.",
    ),
    (
        "max-weighted-methods-50",
        "S",
        "unak wmc weighted-methods methods",
        "Class whose methods have a total complexity above 50.",
        _WEIGHT,
    ),
    (
        "max-weighted-methods-100",
        "S",
        "nasa-satc ros wmc weighted-methods methods",
        "Class whose methods have a total complexity above 100.",
        _WEIGHT,
    ),
    (
        "max-methods-available-20",
        "S",
        "nasa-satc ros mac methods-available methods",
        "Class with more than 20 public methods.",
        "Public methods that it declares itself, without constructors and destructor. Split the class by who uses which.",
    ),
    (
        "max-deepest-inheritance-5",
        "S",
        "nasa-satc unak dit inheritance",
        "Class more than 5 levels deep in inheritance.",
        "The classes on the longest way to a root, itself included; a base outside of the workspace counts as one level,"
        " which is the least that it can be. Prefer members to bases.",
    ),
)


def rules() -> dict[str, Rule]:
    """Every metric rule by id."""
    return {
        identifier: Rule(
            id=identifier,
            summary=summary,
            level=Level.NOTE,  # a change that crosses a limit weighs more: results/counted.py
            help=help_text(identifier, summary, advice, "a comment on the line of the signature"),
            help_uri="https://github.com/git-afsantos/haros/blob/master/haros/definitions.yaml",
            precision="very-high",
            profiles=profiles(letters),
            tags=tags_of("metrics", *tags.split()),
            aliases=haros.aliases("metrics", identifier),
        )
        for identifier, letters, tags, summary, advice in ROWS
    }


def invented(identifier: str) -> Rule | None:
    """No other metric exists."""
    return None
