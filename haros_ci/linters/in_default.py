# SPDX-License-Identifier: Apache-2.0
"""Findings of linters that are right and that nobody mends, by where they are: those who want every finding see them."""

from __future__ import annotations

import re
from collections.abc import Callable

from haros_ci.linters.catalogue import TOOLS
from haros_ci.regex import regex
from haros_ci.results.result import Result

#: What a test does on purpose, or what does no harm in one; what is certain to be wrong there, too, is not here.
IN_TESTS = frozenset(
    """
    cppcheck:accessMoved cppcheck:assertWithSideEffect cppcheck:comparisonFunctionIsAlwaysTrueOrFalse cppcheck:constStatement
    cppcheck:duplicateExpression cppcheck:duplicateExpressionTernary cppcheck:exceptThrowInDestructor
    cppcheck:identicalConditionAfterEarlyExit cppcheck:identicalInnerCondition cppcheck:ignoredReturnValue cppcheck:incorrectLogicOperator
    cppcheck:knownEmptyContainer cppcheck:memleak cppcheck:moduloofone cppcheck:nanInArithmeticExpression cppcheck:negativeIndex
    cppcheck:nullPointer cppcheck:oppositeExpression cppcheck:redundantCopy cppcheck:resourceLeak cppcheck:sameIteratorExpression
    cppcheck:selfAssignment cppcheck:staticStringCompare cppcheck:stringCompare cppcheck:unreachableCode
    cppcheck:unusedAllocatedMemory cppcheck:unusedScopedObject cppcheck:unusedVariable cppcheck:uselessCallsCompare cppcheck:uselessCallsSwap
    cppcheck:zerodiv
    pylint:abstract-class-instantiated pylint:anomalous-backslash-in-string pylint:assert-on-string-literal
    pylint:assignment-from-no-return pylint:comparison-of-constants pylint:comparison-with-callable pylint:comparison-with-itself
    pylint:condition-evals-to-constant pylint:expression-not-assigned pylint:literal-comparison pylint:nan-comparison
    pylint:no-method-argument pylint:no-self-argument pylint:pointless-statement pylint:redundant-unittest-assert
    pylint:self-assigning-variable pylint:unreachable
    ruff:B015 ruff:B018 ruff:F632 ruff:W605
    """.split()
)
_IN_TESTS = r"(?:^|/)(?:tests?|unit_?tests?|integration_?tests?|\w+_tests?|test_\w+)/"
_TEST = regex(rf"{_IN_TESTS}|(?:^|/)(?:test_[^/]*|[^/]*_(?:test|tests|unittest|spec))\.\w+$|(?:^|/)conftest\.py$")
_DIRECTORY = regex(_IN_TESTS)
#: What is deprecated goes with a later Python than any distribution of ROS 1 has (REP 3: 3.8 at most).
_DEPRECATION = regex(r"pylint:deprecated-(?:argument|attribute|class|decorator|method|module)")
#: Objects that are made for what they do until their scope ends, or that somebody forgot to throw.
_GUARD = regex(r"(?:lock|guard|scoped|mutex|exception|error)", re.IGNORECASE)

#: What follows if malloc() gives nothing; cppcheck has rules of their own for it (``nullPointerOutOfMemory``), and forgets that over two assignments.
_OF_ALLOCATION = regex(r"cppcheck:(?:ctu)?[nN]ull[pP]ointer(?:Arithmetic)?")
_FAILS = "Assuming allocation function fails"


def is_test(path: str) -> bool:
    """Whether the file at *path* is code for tests, by its name or the name of a directory."""
    return _TEST.search(path) is not None


def is_of_linter(result: Result) -> bool:
    """Whether a linter says it: not a check of ours, not a number of the metrics, not a tool of somebody else."""
    return result.tool in TOOLS and result.tool != "metrics"


def is_idle(result: Result, ros: int | None, is_built: Callable[[str], bool] = lambda path: False) -> bool:
    """Whether nobody mends what *result* says, as it is in a test or in a package of *ros*, 1 or 2.

    A file outside of directories of tests that *is_built* into a program which is no test is no test either, whatever it is called.
    """
    rule, path = result.full_id, result.location.path
    if rule in IN_TESTS and is_test(path) and (_DIRECTORY.search(path) is not None or not is_built(path)):
        return True
    if ros == 1 and _DEPRECATION.fullmatch(rule):
        return True
    if _OF_ALLOCATION.fullmatch(rule) and any(near.message == _FAILS for near in result.related):
        return True
    if rule == "cppcheck:invalidscanf" and result.message.startswith("scanf("):
        return True  # who types too much has only themselves to blame; files and texts of others stand
    if rule == "cppcheck:unusedScopedObject":  # of other objects the constructor alone may be meant
        return not _GUARD.search(result.message)
    # Where no condition of the code says so, cppcheck takes values that a loop or another object never gives.
    return rule == "cppcheck:negativeIndex" and not result.message.startswith("Either the condition")
