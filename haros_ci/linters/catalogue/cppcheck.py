# SPDX-License-Identifier: Apache-2.0
"""The checks of Cppcheck as rules."""

from __future__ import annotations

from haros_ci.linters.catalogue import haros
from haros_ci.linters.catalogue.cppcheck_more import GROUPS as MORE
from haros_ci.linters.catalogue.cppcheck_table import GROUPS as TABLE
from haros_ci.linters.catalogue.group import Group, Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

CHECKS = "https://sourceforge.net/p/cppcheck/wiki/ListOfChecks/"
SUPPRESS = "`// cppcheck-suppress CODE` on the line or before it"
CATCH_ALL = "haros_plugin_cppcheck:cppcheckRule"

LEVELS = {"e": Level.ERROR, "w": Level.WARNING, "s": Level.NOTE}

#: Checks that Cppcheck calls errors, and that hold only if it is right about a value, or do harm once a process ends.
UNSURE = frozenset(
    """
    IOWithoutPositioning bufferAccessOutOfBounds comparePointers ctuArrayIndex ctuPointerArith ctunullpointer
    ctuuninitvar danglingLifetime eraseIteratorOutOfBounds invalidContainer memleak memleakOnRealloc missingReturn
    negativeIndex negativeMemoryAllocationSize nullPointer nullPointerArithmetic subtractPointers
    uninitdata zerodiv
    """.split()
)

#: Checks in no profile but ``all``: they hold only with every header or the whole program at hand, are a matter of
#: taste, or say that Cppcheck itself gave up. (The severity letter, then ids.)
QUIET: tuple[tuple[str, str], ...] = (
    (
        "e",
        "ctuOneDefinitionRuleViolation directiveAsMacroParameter includeNestedTooDeeply invalidSuppression missingFile",
    ),
    ("e", "missingIncludeExplicit preprocessorErrorDirective syntaxError unhandledChar unknownMacro"),
    ("s", "missingInclude missingIncludeSystem toomanyconfigs purgedConfiguration class_X_Y checkersReport"),
    ("s", "normalCheckLevelMaxBranches unmatchedSuppression noValidConfiguration ConfigurationNotChecked"),
    (
        "s",
        "unusedFunction unusedStructMember staticFunction functionConst functionStatic useStandardLibrary"
        " useStlAlgorithm",
    ),
    ("s", "constParameter constParameterCallback constParameterPointer constParameterReference constVariable"),
    (
        "s",
        "constVariablePointer constVariableReference funcArgNamesDifferentUnnamed shadowFunction duplicateValueTernary",
    ),
    (
        "s",
        "knownArgumentHiddenVariableExpression suspiciousFloatingPointCast unusedLabelConfiguration"
        " redundantCopyInSwitch",
    ),
    ("s", "invalidConstFunctionType iterateByValue"),
    ("w", "invalidScanfFormatWidth_smaller unusedLabelSwitchConfiguration"),
)

#: Cppcheck's own mapping to CWE (its --errorlist), without 398, which is a category rather than a weakness.
CWE: tuple[tuple[int, str], ...] = (
    (119, "invalidscanf"),
    (128, "signedCharArrayIndex"),
    (131, "incompleteArrayFill negativeMemoryAllocationSize"),
    (170, "terminateStrncpy"),
    (190, "floatConversionOverflow integerOverflow"),
    (195, "signConversion"),
    (197, "checkCastIntToCharAndBack truncLongCastAssignment truncLongCastReturn"),
    (252, "ignoredReturnErrorCode ignoredReturnValue"),
    (362, "raceAfterInterlockedDecrement"),
    (369, "nanInArithmeticExpression zerodiv zerodivcond"),
    (391, "invalidTestForOverflow"),
    (401, "leakUnsafeArgAlloc memleak memleakOnRealloc"),
    (404, "virtualDestructor"),
    (415, "doubleFree"),
    (416, "deallocuse"),
    (457, "legacyUninitvar uninitStructMember uninitdata uninitvar ctuuninitvar"),
    (467, "arithOperationsOnVoidPointer pointerSize sizeofwithsilentarraypointer"),
    (475, "varFuncNullUB"),
    (
        476,
        "nullPointer nullPointerDefaultArg nullPointerOutOfMemory nullPointerOutOfResources nullPointerRedundantCheck",
    ),
    (476, "ctunullpointer ctunullpointerOutOfMemory ctunullpointerOutOfResources"),
    (480, "rethrowNoCurrentException"),
    (561, "duplicateBreak redundantContinue unreachableCode unreachableSwitchCase unusedFunction"),
    (562, "autoVariables danglingLifetime danglingReference danglingTempReference danglingTemporaryLifetime"),
    (562, "invalidLifetime returnDanglingLifetime returnReference returnTempReference"),
    (563, "redundantAssignInSwitch redundantAssignment redundantCopy redundantInitialization unreadVariable"),
    (563, "unusedAllocatedMemory unusedScopedObject unusedStructMember unusedVariable"),
    (570, "comparisonFunctionIsAlwaysTrueOrFalse incorrectStringCompare knownConditionTrueFalse pointerLessThanZero"),
    (570, "pointerPositive staticStringCompare unsignedLessThanZero unsignedPositive"),
    (571, "assignmentInCondition badBitmaskCheck incorrectCharBooleanError incorrectLogicOperator"),
    (571, "incorrectStringBooleanError pointerArithBool stringCompare"),
    (587, "assignBoolToPointer"),
    (590, "autovarInvalidDeallocation"),
    (595, "charLiteralWithCharPtrCompare literalWithCharPtrCompare"),
    (597, "stlIfStrFind"),
    (628, "eraseIteratorOutOfBounds eraseIteratorOutOfBoundsCond funcArgNamesDifferent invalidFunctionArg"),
    (628, "invalidFunctionArgBool invalidFunctionArgStr sprintfOverlappingData uselessCallsCompare uselessCallsSwap"),
    (664, "IOWithoutPositioning eraseDereference incompatibleFileOpen invalidContainer invalidContainerLoop"),
    (664, "invalidContainerReference invalidIterator1 iterators1 iterators3 mismatchingContainerExpression"),
    (664, "mismatchingContainerIterator mismatchingContainers readWriteOnlyFile sameIteratorExpression stlBoundaries"),
    (664, "stlcstr va_end_missing va_list_usedBeforeStarted va_start_subsequentCalls writeReadOnlyFile"),
    (665, "mallocOnClassError memsetClassReference selfInitialization strPlusChar unassignedVariable"),
    (667, "localMutex"),
    (672, "accessForwarded accessMoved deallocret"),
    (682, "divideSizeof multiplySizeof nullPointerArithmetic nullPointerArithmeticOutOfMemory"),
    (682, "nullPointerArithmeticRedundantCheck sizeofCalculation sizeofDereferencedVoidPointer sizeofDivisionMemfunc"),
    (682, "sizeofFunctionCall sizeofVoid sizeofsizeof sizeofwithnumericparameter"),
    (683, "funcArgOrderDifferent"),
    (685, "wrongPrintfScanfArgNum wrongPrintfScanfParameterPositionError"),
    (686, "invalidPrintfArgType_float invalidPrintfArgType_n invalidPrintfArgType_p invalidPrintfArgType_s"),
    (686, "invalidPrintfArgType_sint invalidPrintfArgType_uint invalidScanfArgType_float invalidScanfArgType_int"),
    (686, "invalidScanfArgType_s memsetValueOutOfRange"),
    (687, "invalidScanfFormatWidth memsetZeroBytes"),
    (688, "memsetFloat va_start_wrongParameter"),
    (703, "unhandledExceptionSpecification"),
    (704, "assignBoolToFloat invalidLengthModifierError invalidPointerCast stlcstrAssignment stlcstrConcat"),
    (704, "stlcstrConstructor stlcstrParam stlcstrReturn stlcstrStream"),
    (758, "AssignmentAddressToInteger AssignmentIntegerToAddress CastAddressToIntegerAtReturn"),
    (758, "CastIntegerToAddressAtReturn ctuOneDefinitionRuleViolation memsetClassFloat pointerOutOfBounds"),
    (758, "pointerOutOfBoundsCond shiftNegativeLHS unknownSignCharArrayIndex unpreciseMathCall"),
    (758, "comparePointers missingReturn negativeArraySize objectIndex shiftNegative shiftTooManyBits"),
    (758, "shiftTooManyBitsSigned stringLiteralWrite subtractPointers va_start_referencePassed wrongmathcall"),
    (762, "mallocOnClassWarning memsetClass mismatchAllocDealloc uselessCallsRemove"),
    (768, "unknownEvaluationOrder"),
    (771, "leakReturnValNotUsed"),
    (772, "leakNoVarFunctionCall"),
    (775, "resourceLeak"),
    (783, "clarifyCalculation clarifyStatement"),
    (786, "negativeContainerIndex negativeIndex"),
    (
        788,
        "algorithmOutOfBounds arrayIndexOutOfBounds arrayIndexOutOfBoundsCond bufferAccessOutOfBounds stlOutOfBounds",
    ),
    (788, "ctuArrayIndex"),
    (825, "derefInvalidIterator"),
    (833, "globalLockGuard"),
    (834, "StlMissingComparison"),
    (910, "fcloseInLoopCondition useClosedFile"),
)

#: Checks that find what an attacker can use, with GitHub's severity.
SECURITY = {
    "arrayIndexOutOfBounds": "7.0",
    "bufferAccessOutOfBounds": "7.5",
    "deallocuse": "7.5",
    "doubleFree": "7.0",
    "invalidScanfFormatWidth": "7.0",
    "invalidscanf": "7.0",
}


def weaknesses() -> dict[str, int]:
    """The CWE number of each check that has one."""
    return {name: number for number, names in CWE for name in names.split()}


def rules() -> dict[str, Rule]:
    """Every check of the tables by id."""
    cwe = weaknesses()
    found = {
        identifier: _rule(identifier, letters, summary, group, cwe.get(identifier))
        for group in (*TABLE, *MORE)
        for identifier, letters, summary in group.rows
    }
    for severity, names in QUIET:
        found.update(
            (name, _rule(name, f"-{severity}", _generic(name), _UNKNOWN, cwe.get(name))) for name in names.split()
        )
    return found


def invented(identifier: str) -> Rule:
    """A rule for a check that the tables do not know, for example of a newer version."""
    return _rule(identifier, "-w", _generic(identifier), _UNKNOWN, weaknesses().get(identifier))


_UNKNOWN = Group("", (), (), precision="medium")


def _generic(identifier: str) -> str:
    return f"Finding of cppcheck's check '{words(identifier)}'."


def _rule(identifier: str, letters: str, summary: str, group: Group, cwe: int | None) -> Rule:
    own = haros.aliases("cppcheck", identifier)
    severity = SECURITY.get(identifier)
    security = ("security",) if severity else ()
    return Rule(
        id=identifier,
        summary=summary,
        level=LEVELS[letters[1]],
        help=help_text(identifier, summary, group.advice, SUPPRESS),
        help_uri=CHECKS,
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "cppcheck", *security, *group.tags, *haros.tags("cppcheck", identifier)),
        aliases=own or (CATCH_ALL,),
        cwe=(cwe,) if cwe else (),
        security_severity=severity,
    )
