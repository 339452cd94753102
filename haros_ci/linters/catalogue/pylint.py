# SPDX-License-Identifier: Apache-2.0
"""The messages of pylint as rules."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Group, Rule, help_text, profiles, tags_of, words
from haros_ci.linters.catalogue.pylint_more import GROUPS as MORE
from haros_ci.linters.catalogue.pylint_table import GROUPS as TABLE
from haros_ci.results.rule import Level

MESSAGES = "https://pylint.readthedocs.io/en/stable/user_guide/messages"
SUPPRESS = "`# pylint: disable=CODE` on the line"

#: By category letter: its name, in the documentation's addresses and in HAROS, and its level.
CATEGORIES: dict[str, tuple[str, Level]] = {
    "F": ("fatal", Level.ERROR),
    "E": ("error", Level.ERROR),
    "W": ("warning", Level.WARNING),
    "R": ("refactor", Level.NOTE),
    "C": ("convention", Level.NOTE),
    "I": ("information", Level.NOTE),
}

#: Messages in no profile but ``all``: they hold only where every import can be resolved (import-error, no-member), are
#: layout or taste, repeat a metric, or say that pylint itself gave up. (The category letter, then symbols.)
QUIET: tuple[tuple[str, str], ...] = (
    ("F", "astroid-error config-parse-error fatal method-check-failed parse-error"),
    ("E", "bad-configuration-section bad-plugin-value import-error no-member no-name-in-module"),
    ("E", "return-arg-in-generator unrecognized-inline-option unrecognized-option"),
    ("W", "arguments-renamed attribute-defined-outside-init bad-indentation duplicate-string-formatting-argument"),
    ("W", "fixme global-at-module-level global-statement inconsistent-quotes logging-format-interpolation"),
    ("W", "logging-fstring-interpolation nested-min-max non-ascii-file-name preferred-module protected-access"),
    ("W", "redefined-outer-name redundant-u-string-prefix unknown-option-value unnecessary-ellipsis"),
    ("W", "unnecessary-semicolon unused-argument unused-wildcard-import"),
    ("W", "using-assignment-expression-in-unsupported-version using-comprehension-unpacking-in-unsupported-version"),
    ("W", "using-exception-groups-in-unsupported-version using-f-string-in-unsupported-version"),
    ("W", "using-final-decorator-in-unsupported-version using-generic-type-syntax-in-unsupported-version"),
    ("W", "using-positional-only-args-in-unsupported-version"),
    ("R", "chained-comparison chained-comparison-all-equal consider-merging-isinstance consider-swap-variables"),
    ("R", "consider-using-dict-comprehension consider-using-generator consider-using-get consider-using-in"),
    ("R", "consider-using-join consider-using-max-builtin consider-using-min-builtin"),
    ("R", "consider-using-set-comprehension consider-using-sys-exit consider-using-ternary duplicate-code"),
    ("R", "match-class-bind-self match-class-positional-attributes no-classmethod-decorator no-else-break"),
    ("R", "no-else-continue no-else-raise no-else-return no-staticmethod-decorator simplifiable-if-statement"),
    ("R", "super-with-arguments too-few-public-methods too-many-ancestors too-many-arguments"),
    ("R", "too-many-boolean-expressions too-many-branches too-many-instance-attributes too-many-locals"),
    ("R", "too-many-positional-arguments too-many-public-methods too-many-return-statements too-many-statements"),
    ("R", "unnecessary-dict-index-lookup unnecessary-list-index-lookup use-a-generator use-dict-literal"),
    ("R", "use-list-literal use-yield-from useless-object-inheritance useless-option-value useless-return"),
    ("C", "consider-iterating-dictionary consider-using-dict-items consider-using-enumerate consider-using-f-string"),
    ("C", "disallowed-name import-outside-toplevel invalid-characters-in-docstring invalid-name line-too-long"),
    ("C", "missing-final-newline mixed-line-endings multiple-imports multiple-statements superfluous-parens"),
    ("C", "too-many-lines trailing-newlines trailing-whitespace typevar-double-variance"),
    ("C", "typevar-name-incorrect-variance typevar-name-mismatch unexpected-line-ending-format ungrouped-imports"),
    ("C", "unnecessary-direct-lambda-call unnecessary-lambda-assignment unnecessary-negation"),
    ("C", "use-implicit-booleaness-not-comparison use-implicit-booleaness-not-comparison-to-string"),
    ("C", "use-implicit-booleaness-not-comparison-to-zero use-implicit-booleaness-not-len use-maxsplit-arg"),
    ("C", "use-sequence-for-iteration useless-import-alias wrong-import-order wrong-import-position"),
    ("C", "wrong-spelling-in-comment wrong-spelling-in-docstring"),
    ("I", "bad-inline-option c-extension-no-member deprecated-pragma file-ignored locally-disabled"),
    ("I", "raw-checker-failed suppressed-message use-symbolic-message-instead useless-suppression"),
)

#: Errors by their category that stop nothing: of which pylint itself says "possibly", that logging or a wildcard import
#: alone meets, that are dead code or an unused value, or of layout in strings; and those that hold only if it is right about a value.
NOT_FATAL = frozenset(
    """
    possibly-used-before-assignment function-redefined undefined-all-variable invalid-all-format invalid-all-object
    assignment-from-no-return assignment-from-none bad-str-strip-call nonexistent-operator bad-except-order
    misplaced-bare-raise misplaced-format-function no-self-argument singledispatch-method singledispatchmethod-function
    logging-format-truncated logging-too-few-args logging-too-many-args logging-unsupported-format bad-super-call
    bidirectional-unicode invalid-character-backspace invalid-character-carriage-return invalid-character-esc
    invalid-character-nul invalid-character-sub invalid-character-zero-width-space declare-non-slot
    bad-reversed-sequence invalid-sequence-index invalid-slice-index invalid-unary-operand-type not-callable
    potential-index-error unsupported-binary-operation
    """.split()
)

SECURITY = {"bidirectional-unicode": "6.5", "eval-used": "6.0", "exec-used": "6.0"}


def rules() -> dict[str, Rule]:
    """Every message of the tables by symbol."""
    found = {
        symbol: _rule(symbol, letters, summary, group)
        for group in (*TABLE, *MORE)
        for symbol, letters, summary in group.rows
    }
    for category, symbols in QUIET:
        found.update((s, _rule(s, f"-{category}", _generic(s), _OTHER)) for s in symbols.split())
    return found


def invented(symbol: str) -> Rule:
    """A rule for a message that the tables do not know, for example of a newer version."""
    return _rule(symbol, "-W", _generic(symbol), _OTHER)


_OTHER = Group("", (), (), precision="medium")


def _generic(symbol: str) -> str:
    return f"Finding of pylint's check '{words(symbol)}'."


def _rule(symbol: str, letters: str, summary: str, group: Group) -> Rule:
    category, level = CATEGORIES[letters[1]]
    severity = SECURITY.get(symbol)
    security = ("security",) if severity else ()
    return Rule(
        id=symbol,
        summary=summary,
        level=Level.WARNING if symbol in NOT_FATAL else level,
        help=help_text(symbol, summary, group.advice, SUPPRESS),
        help_uri=f"{MESSAGES}/{category}/{symbol}.html",
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "pylint", category, *security, *group.tags),
        aliases=(f"haros_plugin_pylint:{category}",) if letters[1] != "I" else (),
        security_severity=severity,
    )
