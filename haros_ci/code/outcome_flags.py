# SPDX-License-Identifier: Apache-2.0
"""Local variables that tell whether something has been done: they are set to one value where it is done, and nowhere else."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.records import dataclass
from haros_ci.syntax import Block, Expression, Statement

#: The kinds of values that a flag can be compared with.
_CONSTANTS = (syntax.Boolean, syntax.Number, syntax.String, syntax.Null)


@dataclass(frozen=True, slots=True)
class Flag:
    """A variable that has the value *done* once it has been done, and one of the *others* before."""

    done: Expression
    others: tuple[Expression, ...]


def outcome_flags(block: Block, does: Callable[[Expression], bool]) -> Mapping[str, Flag]:
    """The flags of a function.

    Every assignment of that value stands in a branch in which it is done; all others give other constants.
    """
    done: dict[str, list[Expression]] = {}
    others: dict[str, list[Expression]] = {}
    for name, value, is_done in _sets(block, does, False, True):
        (done if is_done else others).setdefault(name, []).append(value)
    return {
        name: Flag(values[0], tuple(others[name]))
        for name, values in done.items()
        if all(isinstance(value, _CONSTANTS) for value in (*values, *others.get(name, ())))
        and all(value == values[0] for value in values)
        and others.get(name)
        and values[0] not in others[name]
    }


def known_outcomes(test: Expression, flags: Mapping[str, Flag]) -> tuple[bool, bool]:
    """Whether a condition that holds says that it has been done, and whether one that does not hold says so."""
    turned = False
    while isinstance(test, syntax.Operation) and test.operator in ("!", "not") and len(test.operands) == 1:
        turned, test = not turned, test.operands[0]
    if isinstance(test, syntax.Operation) and test.operator in ("==", "!=", "is", "is not") and len(test.operands) == 2:
        turned ^= test.operator in ("!=", "is not")
        test, value = test.operands
    else:
        value = syntax.Boolean(True)
    known = flags.get(test.name) if isinstance(test, syntax.Name) else None
    if known is None:
        return False, False
    if value == known.done:
        return not turned, turned
    if all(value == other for other in known.others):
        return turned, not turned
    return False, False


def _sets(
    block: Block, does: Callable[[Expression], bool], is_done: bool, is_outer: bool
) -> Iterator[tuple[str, Expression, bool]]:
    """What variables are set to, and whether in a branch in which it is done: a *block* that does it itself, or one inside."""
    is_done = is_done or (
        not is_outer and any(does(statement.value) for statement in block if isinstance(statement, syntax.Do))
    )
    for statement in block:
        if isinstance(statement, syntax.Variable):
            for value in syntax.started(statement.init):
                yield statement.name, value, is_done
        elif isinstance(statement, (syntax.Do, syntax.Step)) and isinstance(statement.value, syntax.Assignment):
            made = statement.value
            if isinstance(made.target, syntax.Name):
                value = made.value if made.operator == "=" else made
                yield made.target.name, value, is_done
        else:
            for inner in _blocks(statement):
                yield from _sets(inner, does, is_done, is_outer and isinstance(statement, syntax.Nested))


def _blocks(statement: Statement) -> tuple[Block, ...]:
    if isinstance(statement, syntax.If):
        return statement.then, statement.other
    if isinstance(statement, syntax.Loop):
        return statement.before, statement.body
    if isinstance(statement, (syntax.Each, syntax.Nested)):
        return (statement.body,)
    if isinstance(statement, syntax.Switch):
        return tuple(case.body for case in statement.cases)
    if isinstance(statement, syntax.Try):
        return statement.body, *(handler.body for handler in statement.handlers)
    if isinstance(statement, syntax.Preprocessor):
        return tuple(branch.body for branch in statement.branches)
    return ()
