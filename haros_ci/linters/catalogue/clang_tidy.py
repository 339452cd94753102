# SPDX-License-Identifier: Apache-2.0
"""The checks of clang-tidy as rules, by the module that they belong to."""

from __future__ import annotations

from haros_ci.linters.catalogue import haros, standards
from haros_ci.linters.catalogue.clang_tidy_texts import TEXTS
from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of, words
from haros_ci.results.rule import Level

CHECKS = "https://clang.llvm.org/extra/clang-tidy/checks"
ANALYZER = "https://clang.llvm.org/docs/analyzer/checkers.html"
DIAGNOSTICS = "https://clang.llvm.org/docs/DiagnosticsReference.html"
SUPPRESS = "`// NOLINT(CODE)` on the line or `// NOLINTNEXTLINE(CODE)` before it"

#: (beginning of check names, profile letters, tags, what they are about); the first that fits holds.
MODULES: tuple[tuple[str, str, str, str], ...] = (
    ("clang-analyzer-core.", "B", "correctness", "paths through the code that lead to undefined behaviour"),
    ("clang-analyzer-cplusplus", "B", "correctness memory", "objects that are used after their end or never freed"),
    ("clang-analyzer-deadcode", "S", "redundancy", "values that nothing reads"),
    ("clang-analyzer-optin", "S", "correctness", "suspicious paths through the code"),
    ("clang-analyzer-security", "S", "robustness", "functions of C that are hard to use safely"),
    ("clang-analyzer-", "R", "correctness", "paths through the code that end in a mistake"),
    ("clang-diagnostic-error", "-", "", "code that clang could not compile"),
    ("clang-diagnostic-", "R", "correctness", "warnings of the compiler"),
    ("bugprone-easily-swappable-parameters", "-", "readability", "parameters that can be swapped"),
    ("bugprone-narrowing-conversions", "-", "arithmetic", "conversions that lose digits"),
    ("bugprone-use-after-move", "B", "correctness lifetime", "objects that are used after a move"),
    ("bugprone-dangling-handle", "B", "correctness lifetime", "views of strings that are gone"),
    ("bugprone-infinite-loop", "B", "correctness", "loops that never end"),
    ("bugprone-", "S", "correctness suspicious", "code that is likely to be a mistake"),
    ("concurrency-", "S", "concurrency", "functions that are unsafe with threads"),
    ("performance-", "S", "performance", "copies and calls that can be spared"),
    ("portability-", "S", "portability", "what other compilers may treat otherwise"),
    ("google-explicit-constructor", "SG", "google-cpp readability", "constructors that convert implicitly"),
    ("google-", "G", "google-cpp", "Google's style"),
    ("hicpp-", "-", "hicpp", "High Integrity C++"),
    ("cert-", "-", "cert", "the CERT coding standard"),
    ("cppcoreguidelines-", "-", "cppcoreguidelines", "the C++ Core Guidelines"),
    ("misc-", "-", "readability", "readability and correctness"),
    ("modernize-", "-", "modernize", "older forms of C++"),
    ("readability-", "-", "readability", "readability"),
)


def rules() -> dict[str, Rule]:
    """What has a text, and what HAROS ids and coding standards refer to; every other check is invented from its name."""
    return {name: invented(name) for name in sorted({*NAMED, *TEXTS, *standards.named("clang-tidy")})}


NAMED = (
    "fuchsia-default-arguments-declarations",
    "google-explicit-constructor",
    "hicpp-no-assembler",
    "modernize-deprecated-headers",
    "modernize-use-noexcept",
    "readability-named-parameter",
)


def invented(name: str) -> Rule:
    """A rule for any check, by its module."""
    for prefix, letters, tags, subject in MODULES:
        if name.startswith(prefix):
            return _rule(name, letters, tags, subject)
    return _rule(name, "-", "", "a convention")


def _rule(name: str, letters: str, tags: str, subject: str) -> Rule:
    summary, advice = TEXTS.get(name) or (f"Finding of clang-tidy's check '{words(name)}' ({subject}).", "")
    return Rule(
        id=name,
        summary=summary,
        level=level_of(letters, Level.WARNING if letters[0] in "BRS" else Level.NOTE),
        help=help_text(name, summary, advice, SUPPRESS),
        help_uri=_address(name),
        precision="high" if letters[0] in "BR" else "medium",
        profiles=profiles(letters),
        tags=tags_of("code-standards", "clang-tidy", *tags.split(), *haros.tags("clang-tidy", name)),
        aliases=haros.aliases("clang-tidy", name),
    )


def _address(name: str) -> str:
    if name.startswith("clang-analyzer-"):
        return ANALYZER
    if name.startswith("clang-diagnostic-"):
        return DIAGNOSTICS
    module, _, check = name.partition("-")
    return f"{CHECKS}/{module}/{check}.html" if check else f"{CHECKS}/list.html"
