# SPDX-License-Identifier: Apache-2.0
"""Which rules of tools check what coding standards demand, as tags (docs/standards.md).

A rule that a standard names has the standard's short tag (``cert``, ``cwe``, ``hicpp``, ``misra``) and one tag for each
rule of it, in the form that CodeQL's queries have: ``external/cwe/cwe-476``, ``external/cert/id/exp34-c``,
``external/hicpp/id/rule-6-1-1``, ``external/misra/id/rule-10-4``.

Sources: the aliases and pages of clang-tidy's list of checks (LLVM, clang-tools-extra/docs/clang-tidy/checks), Statick's
``rsc/plugin_mapping`` (four of its ids corrected: there is no DCP54-CPP, DCP59-CPP nor MEM32-C, and char-subscripts are STR34-C),
CWE numbers from each tool itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Final

from haros_ci.regex import regex
from haros_ci.results.rule import Rule

STANDARDS = {
    "cert": "SEI CERT C and C++ Coding Standards",
    "cwe": "Common Weakness Enumeration",
    "hicpp": "High Integrity C++ Coding Standard 4.0",
    "misra": "MISRA C and C++",
}

#: (CERT rules, checks of clang-tidy)
CERT_CLANG_TIDY: Final = (
    ("arr39-c", "bugprone-sizeof-expression"),
    ("con36-c con54-cpp", "bugprone-spuriously-wake-up-functions"),
    ("ctr56-cpp", "bugprone-pointer-arithmetic-on-polymorphic-object"),
    ("dcl03-c", "misc-static-assert"),
    ("dcl16-c", "readability-uppercase-literal-suffix"),
    ("dcl31-c", "clang-diagnostic-implicit-int"),
    ("dcl37-c dcl51-cpp", "bugprone-reserved-identifier"),
    ("dcl41-c", "clang-diagnostic-sometimes-uninitialized"),
    ("dcl50-cpp", "modernize-avoid-variadic-functions"),
    ("dcl51-cpp", "clang-diagnostic-reserved-id-macro clang-diagnostic-user-defined-literals"),
    ("dcl53-cpp", "clang-diagnostic-vexing-parse"),
    ("dcl54-cpp", "misc-new-delete-overloads"),
    ("dcl58-cpp", "bugprone-std-namespace-modification"),
    ("dcl59-cpp", "google-build-namespaces"),
    ("env33-c", "bugprone-command-processor"),
    ("err09-cpp err61-cpp", "misc-throw-by-value-catch-by-reference"),
    ("err34-c", "bugprone-unchecked-string-to-number-conversion"),
    ("err52-cpp", "modernize-avoid-setjmp-longjmp"),
    ("err53-cpp err54-cpp", "clang-diagnostic-exceptions"),
    ("err58-cpp", "bugprone-throwing-static-initialization"),
    ("err60-cpp", "bugprone-exception-copy-constructor-throws"),
    ("exp32-c", "clang-diagnostic-cast-qual clang-diagnostic-incompatible-pointer-types-discards-qualifiers"),
    ("exp34-c", "clang-analyzer-core.NullDereference"),
    ("exp36-c", "clang-diagnostic-cast-align"),
    ("exp42-c flp37-c", "bugprone-suspicious-memory-comparison"),
    ("exp45-c", "clang-diagnostic-parentheses"),
    ("exp50-cpp", "clang-diagnostic-unsequenced"),
    ("exp52-cpp", "clang-diagnostic-unevaluated-expression"),
    ("exp53-cpp", "clang-analyzer-core.UndefinedBinaryOperatorResult clang-diagnostic-uninitialized"),
    ("exp54-cpp", "clang-diagnostic-dangling-initializer-list"),
    ("exp57-cpp", "clang-diagnostic-delete-incomplete"),
    ("exp58-cpp", "clang-diagnostic-varargs"),
    ("exp59-cpp", "clang-diagnostic-invalid-offsetof"),
    ("exp60-cpp", "clang-diagnostic-dynamic-class-memaccess"),
    ("fio38-c", "misc-non-copyable-objects"),
    ("fio47-c", "clang-diagnostic-format"),
    ("flp30-c", "bugprone-float-loop-counter"),
    ("int09-c", "readability-enum-initial-value"),
    ("int36-c", "clang-diagnostic-int-conversion clang-diagnostic-int-to-pointer-cast"),
    ("mem34-c", "clang-analyzer-unix.Malloc"),
    ("mem50-cpp", "clang-analyzer-cplusplus.NewDelete"),
    ("mem51-cpp", "clang-analyzer-cplusplus.NewDeleteLeaks clang-analyzer-unix.MismatchedDeallocator"),
    ("mem51-cpp", "clang-diagnostic-mismatched-new-delete"),
    ("mem57-cpp", "bugprone-default-operator-new-on-overaligned-type"),
    ("msc07-c", "clang-diagnostic-unreachable-code"),
    ("msc12-c", "clang-diagnostic-unused-parameter clang-diagnostic-unused-value"),
    ("msc24-c msc33-c", "bugprone-unsafe-functions"),
    ("msc30-c msc50-cpp", "misc-predictable-rand"),
    ("msc32-c msc51-cpp", "bugprone-random-generator-seed"),
    ("msc52-cpp", "clang-diagnostic-return-type"),
    ("msc53-cpp", "clang-diagnostic-invalid-noreturn"),
    ("msc54-cpp sig30-c", "bugprone-signal-handler"),
    ("oop11-cpp", "performance-move-constructor-init"),
    ("oop52-cpp", "clang-diagnostic-delete-non-virtual-dtor"),
    ("oop53-cpp", "clang-diagnostic-reorder"),
    ("oop54-cpp", "bugprone-unhandled-self-assignment"),
    ("oop57-cpp", "bugprone-raw-memory-call-on-non-trivial-type"),
    ("oop58-cpp", "bugprone-copy-constructor-mutates-argument"),
    ("pos44-c", "bugprone-bad-signal-to-kill-thread"),
    ("pos47-c", "concurrency-thread-canceltype-asynchronous"),
    ("pre07-c", "clang-diagnostic-trigraphs"),
    ("str34-c", "bugprone-signed-char-misuse clang-diagnostic-char-subscripts"),
    ("str38-c", "clang-diagnostic-incompatible-pointer-types"),
)

#: (CERT rules, checks of Cppcheck)
CERT_CPPCHECK: Final = (
    ("arr30-c", "arrayIndexOutOfBounds arrayIndexOutOfBoundsCond arrayIndexThenCheck negativeIndex"),
    ("arr32-c", "negativeArraySize"),
    ("exp12-c", "ignoredReturnValue leakReturnValNotUsed"),
    ("exp33-c", "uninitMemberVar uninitStructMember uninitdata uninitvar"),
    ("exp34-c", "nullPointer nullPointerDefaultArg nullPointerRedundantCheck"),
    ("int31-c", "memsetValueOutOfRange"),
    ("int33-c", "zerodiv zerodivcond"),
    ("int34-c", "shiftNegative shiftTooManyBits"),
)

#: (rules of High Integrity C++, the alias in clang-tidy's module hicpp, the check that it is an alias of)
HICPP: Final = (
    ("1.3.3", "hicpp-deprecated-headers", "modernize-deprecated-headers"),
    ("1.3.5", "hicpp-use-noexcept", "modernize-use-noexcept"),
    ("2.5.3", "hicpp-use-nullptr", "modernize-use-nullptr"),
    ("4.1.1", "hicpp-avoid-c-arrays", "modernize-avoid-c-arrays"),
    ("4.1.1", "hicpp-no-array-decay", "cppcoreguidelines-pro-bounds-array-to-pointer-decay"),
    ("4.2.1", "hicpp-uppercase-literal-suffix", "readability-uppercase-literal-suffix"),
    ("5.3.2", "hicpp-no-malloc", "cppcoreguidelines-no-malloc"),
    ("5.4.1", "hicpp-explicit-conversions", "google-explicit-constructor"),
    ("6.1.1", "hicpp-braces-around-statements", "readability-braces-around-statements"),
    ("6.3.1", "hicpp-avoid-goto", "cppcoreguidelines-avoid-goto"),
    ("7.1.8", "hicpp-use-auto", "modernize-use-auto"),
    ("7.1.10", "hicpp-static-assert", "misc-static-assert"),
    ("8.2.1", "hicpp-named-parameter", "readability-named-parameter"),
    ("8.2.2 8.3.1 8.3.2", "hicpp-function-size", "readability-function-size"),
    ("8.4.1", "hicpp-invalid-access-moved", "bugprone-use-after-move"),
    ("10.2.1", "hicpp-use-override", "modernize-use-override"),
    ("12.3.1", "hicpp-new-delete-operators", "misc-new-delete-overloads"),
    ("12.4.2", "hicpp-member-init", "cppcoreguidelines-pro-type-member-init"),
    ("12.4.5", "hicpp-undelegated-constructor", "bugprone-undelegated-constructor"),
    ("12.5.1", "hicpp-use-equals-default", "modernize-use-equals-default"),
    ("12.5.1", "hicpp-use-equals-delete", "modernize-use-equals-delete"),
    ("12.5.4", "hicpp-noexcept-move", "performance-noexcept-move-constructor"),
    ("12.5.7", "hicpp-special-member-functions", "cppcoreguidelines-special-member-functions"),
    ("14.1.1", "hicpp-vararg", "cppcoreguidelines-pro-type-vararg"),
    ("17.3.1", "hicpp-move-const-arg", "performance-move-const-arg"),
    ("17.4.2", "hicpp-use-emplace", "modernize-use-emplace"),
    ("17.5.1", "hicpp-ignored-remove-result", ""),
)

#: Ids that name a standard's rule themselves: clang-tidy's module, and Cppcheck's add-ons of the same names.
_CERT = regex(r"(?:premium-)?cert-([a-z]{3}\d\d-(?:c|cpp))", re.IGNORECASE)
_MISRA = regex(r"(?:premium-)?misra-(?:c|cpp|c\+\+)-?\d{4}-(\d+[.-]\d+(?:[.-]\d+)?)", re.IGNORECASE)


@cache
def _table(tool: str) -> Mapping[str, tuple[str, ...]]:
    """The tags of each check of *tool* that a table names."""
    found: dict[str, list[str]] = {}
    for rules, checks in {"clang-tidy": CERT_CLANG_TIDY, "cppcheck": CERT_CPPCHECK}.get(tool, ()):
        for check in checks.split():
            found.setdefault(check, []).extend(f"external/cert/id/{rule}" for rule in rules.split())
    for rules, alias, check in HICPP if tool == "clang-tidy" else ():
        for name in filter(None, (alias, check)):
            tags = (f"external/hicpp/id/rule-{rule.replace('.', '-')}" for rule in rules.split())
            found.setdefault(name, []).extend(tags)
    if tool == "clang-tidy":  # under the names, too, that the checks have in the module cert
        rules = " ".join(rules for rules, check in CERT_CLANG_TIDY if not check.startswith("clang-"))
        found.update((f"cert-{rule}", [f"external/cert/id/{rule}"]) for rule in rules.split())
    return {check: tuple(dict.fromkeys(tags)) for check, tags in found.items()}


def named(tool: str) -> Iterable[str]:
    """The checks of *tool* that a standard names, sorted."""
    return sorted(_table(tool))


def tags(tool: str, rule: Rule) -> tuple[str, ...]:
    """The tags of standards that *rule* has: the short ones, then one for each rule of a standard."""
    exact = [f"external/cwe/cwe-{number:03d}" for number in sorted(rule.cwe)]
    exact += _table(tool).get(rule.id, ())
    if cert := _CERT.fullmatch(rule.id):
        exact.append(f"external/cert/id/{cert[1].lower()}")
    if misra := _MISRA.fullmatch(rule.id):
        exact.append(f"external/misra/id/rule-{misra[1].replace('.', '-')}")
    short = dict.fromkeys(tag.split("/")[1] for tag in exact)
    return (*short, *dict.fromkeys(exact))


def tagged(tool: str, rule: Rule) -> Rule:
    """*rule* with these tags after its own."""
    more = tags(tool, rule)
    return replace(rule, tags=tuple(dict.fromkeys((*rule.tags, *more)))) if more else rule
