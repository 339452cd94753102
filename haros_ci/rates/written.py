# SPDX-License-Identifier: Apache-2.0
"""How often a rate object turns as the code around it says, where the interpreter did not come by: numbers, parameters, what holds them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import product

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.architecture import Node, Parameter
from haros_ci.model.location import Location
from haros_ci.model.rates import Rate, at_most, either, exactly, unknown
from haros_ci.rates.assigned import Assigned, Given, bound, callers, of_local, of_member
from haros_ci.rates.made import REAL, duration, frequency, of_period, position_of
from haros_ci.rates.runs import runs
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything

#: What a parameter that was read is asked for (rclcpp/parameter.hpp, rclpy/parameter.py).
VALUES = frozenset("as_double as_int get_value value double_value integer_value".split())
#: Calls that give the value of a parameter, or the parameter (rclcpp/node.hpp, ros/node_handle.h, rospy/client.py, rclpy/node.py).
GETTERS = frozenset(
    "get_parameter declare_parameter get_parameter_or_default declare_or_get_parameter param get_param".split()
)
NUMBER = regex(r"(std::)?(u?int\d{0,2}(_t)?|size_t|unsigned|unsigned \w{1,8}|long|long \w{1,8}|short|float|double)")
#: Steps from a rate to a number, and numbers that it may be.
DEPTH, MOST = 10, 6


@dataclass(frozen=True, slots=True)
class Numbers:
    """The numbers that a value may be; none for a *reason*."""

    every: frozenset[float] = frozenset()
    reason: str = ""


NO_DURATION = Numbers(reason="it is no duration that is understood")


@dataclass(slots=True)
class Written:
    """What the code of *node* says in a configuration with the *parameters* of ROS 1."""

    code: Codebase
    node: Node
    parameters: Mapping[str, Parameter]
    #: Parameters of ROS 1 that nodes of the configuration set.
    changed: frozenset[str] = frozenset()
    _active: set[tuple[object, ...]] = field(default_factory=set)

    def rate(self, place: Location) -> Rate:
        """The turns a second of the rate object that is made at *place*; unknown for a reason."""
        found = None
        for routine in self.code.routines(place.path):
            found = found or frequency(self.code, routine, place)
        if found is None:
            return unknown("the node is not seen to make the rate of the loop")
        numbers = self.numbers(found[0], found[1], 0)
        positive = [exactly(round(number, 9)) for number in sorted(numbers.every) if number > 0]
        if numbers.reason or not positive:
            return unknown(f"its rate is not known: {numbers.reason or 'it is not greater than zero'}")
        result = positive[0]
        for one in positive[1:]:
            result = either(result, one)
        return result

    def timer(self, callback: Callback) -> Rate:
        """From zero to the rate of the timer that a member keeps, so that there is one at most; unknown for a reason."""
        where, call = callback.maker, callback.call
        missing = unknown("the node is not seen to make the timer")
        if where.is_python or not _is_kept(self.code, where, call.whole):
            return missing
        every = (self.seconds(where, argument) for argument in call.args)
        found = next((one for one in every if one.every and not one.reason), None)
        if found is None or min(found.every) <= 0:
            return missing
        return at_most(exactly(round(1.0 / min(found.every), 9)))

    def numbers(self, where: Routine, value: Expression, depth: int) -> Numbers:
        """What *value* may be in the routine *where*."""
        if depth > DEPTH:
            return Numbers(reason="there are too many steps to it")
        if isinstance(value, syntax.Number) and not isinstance(value.value, bool):
            return Numbers(frozenset((float(value.value),)))
        if isinstance(value, syntax.Cast):
            return self._cast(where, value, depth)
        if isinstance(value, syntax.Conditional):
            return _together((self.numbers(where, value.then, depth + 1), self.numbers(where, value.other, depth + 1)))
        if isinstance(value, syntax.Operation):
            return self._operation(where, value, depth)
        if isinstance(value, syntax.ListLiteral) and len(value.items) == 1:
            return self.numbers(where, value.items[0], depth + 1)
        if isinstance(value, (syntax.Name, syntax.Member)):
            return self._held(where, value, depth)
        if isinstance(value, syntax.Call):
            return self._called(where, value, depth)
        return Numbers(reason="it is computed in a way that is not understood")

    def _cast(self, where: Routine, value: syntax.Cast, depth: int) -> Numbers:
        inner = self.numbers(where, value.value, depth + 1)
        is_whole = all(number.is_integer() for number in inner.every)
        return inner if value.type.name in REAL or is_whole else Numbers(reason="it is rounded")

    def _operation(self, where: Routine, value: syntax.Operation, depth: int) -> Numbers:
        if len(value.operands) != 2 or value.operator not in ("*", "/"):
            return Numbers(reason="it is computed in a way that is not understood")
        is_real = where.is_python or any(_is_real(self.code, where, one) for one in value.operands)
        if value.operator == "/" and not is_real:
            return Numbers(reason="it may be a division of whole numbers")
        left, right = (self.numbers(where, one, depth + 1) for one in value.operands)
        if left.reason or right.reason:
            return Numbers(reason=left.reason or right.reason)
        pairs = list(product(left.every, right.every))
        if value.operator == "*":
            return _limited(frozenset(one * other for one, other in pairs))
        if any(other == 0 for _, other in pairs):
            return Numbers(reason="it may be divided by zero")
        return _limited(frozenset(one / other for one, other in pairs))

    def seconds(self, where: Routine, value: Expression, depth: int = 0) -> Numbers:
        """How long the duration *value* may be."""
        if depth > DEPTH:
            return Numbers(reason="there are too many steps to it")
        if isinstance(value, (syntax.Name, syntax.Member)):
            kind = kinds.type_of(self.code, where, value)
            if kind is not None and NUMBER.fullmatch(kind.name):
                return Numbers(reason="it is not seen to be a duration")
            return self._found(where, value, depth, True)
        if isinstance(value, syntax.Call):
            frequency_of = of_period(value)
            if frequency_of is not None:
                turns = self.numbers(where, frequency_of, depth + 1)
                is_plain = bool(turns.every) and min(turns.every) > 0
                return Numbers(frozenset(1.0 / one for one in turns.every), turns.reason) if is_plain else NO_DURATION
            unit, inner = duration(value)
            if unit > 0:
                return self._scaled(self.numbers(where, inner, depth + 1), unit)
            if unit < 0:
                return self.seconds(where, inner, depth + 1)
        return NO_DURATION

    def _scaled(self, found: Numbers, unit: float) -> Numbers:
        return Numbers(frozenset(one * unit for one in found.every), found.reason)

    def _held(self, where: Routine, value: syntax.Name | syntax.Member, depth: int) -> Numbers:
        """What a variable, a parameter of a function, or a member may be, as far as its type lets it."""
        if isinstance(value, syntax.Member) and where.is_python and value.name in VALUES:
            return self.numbers(where, value.object, depth + 1)
        kind = None if where.is_python else kinds.type_of(self.code, where, value)
        if kind is not None and NUMBER.fullmatch(kind.name) is None:
            return Numbers(reason="it is not seen to be a number")
        found = self._found(where, value, depth, False)
        is_real = kind is None or kind.name in REAL
        return found if is_real or all(one.is_integer() for one in found.every) else Numbers(reason="it is rounded")

    def _found(self, where: Routine, value: syntax.Name | syntax.Member, depth: int, is_long: bool) -> Numbers:
        name = value.name.rpartition("::")[2]
        if isinstance(value, syntax.Name):
            around: Routine | None = where
            while around is not None:
                position = position_of(around, name)
                if position is not None:
                    return self._passed(around, position, name, depth, is_long)
                if name in self.code.body(around).variables or (where.is_python and _sets(self.code, around, name)):
                    return self._all(around, name, of_local(self.code, around, name), depth, is_long)
                around = around.outer
            if where.is_python:
                return Numbers(reason="it is a variable of a module")
            owner = classes.owner_of(self.code, where)
            if owner is None or classes.field_of(self.code, owner, name) is None:
                return Numbers(reason="it is not seen what it is")
        else:
            owner = kinds.class_of(self.code, where, value.object)
        if owner is None:
            return Numbers(reason="it is not seen of which class it is a member")
        return self._all(owner[1], name, of_member(self.code, owner, name, where.is_python), depth, is_long)

    def _passed(self, where: Routine, position: int, name: str, depth: int, is_long: bool) -> Numbers:
        """What the callers of a function give it."""
        found = runs(self.code, where)
        if found.reason or found.callbacks or found.perhaps or found.asked or not (found.calls or found.threads):
            return Numbers(reason="not all is seen that calls the function that it is given to")
        if any(target == syntax.Name(name) for target, *_ in self.code.body(where).sets):
            return Numbers(reason="a function changes what it is given")
        shift = 1 if where.is_python and where.function.owner else 0
        given = (
            *callers(found.calls, position - shift, name),
            *bound(self.code, found.threads, where, position - shift),
        )
        if len(given) < len(found.calls) + len(found.threads):
            return Numbers(reason="a default of a function is not looked at")
        return self._all(where, name, Assigned(given), depth, is_long)

    def _all(self, holder: object, name: str, found: Assigned, depth: int, is_long: bool) -> Numbers:
        key = (id(holder), name)
        if found.reason or not found.given:
            return Numbers(reason=found.reason or "it is not seen where it gets a value")
        if key in self._active:
            return Numbers(reason="it is computed from itself")
        first = [one for one in found.given if not _is_set_again(self.code, one)]
        if len(first) < len(found.given) and not any(map(_reads_parameter, first)):
            return Numbers(reason="it is set when a parameter is")
        self._active.add(key)
        try:
            if is_long:
                return _together(self.seconds(one.routine, one.value, depth + 1) for one in first)
            return _together(self._given(one, depth + 1) for one in first)
        finally:
            self._active.discard(key)

    def _given(self, one: Given, depth: int) -> Numbers:
        if one.is_read and isinstance(one.value, syntax.Call):
            return self._parameter(one.routine, one.value)
        return self.numbers(one.routine, one.value, depth)

    def _called(self, where: Routine, call: syntax.Call, depth: int) -> Numbers:
        callee = call.callee
        if isinstance(callee, syntax.Member) and callee.name in VALUES and isinstance(callee.object, syntax.Call):
            return self.numbers(where, callee.object, depth + 1)
        name = syntax.name_of(callee).rpartition("::")[2].rpartition(".")[2]
        if name in GETTERS:
            return self._parameter(where, call)
        if where.is_python and name in ("float", "int") and len(call.arguments) == 1:
            inner = self.numbers(where, call.arguments[0], depth + 1)
            is_same = name == "float" or all(number.is_integer() for number in inner.every)
            return inner if is_same else Numbers(reason="it is rounded")
        return Numbers(reason="it is what a function returns")

    def _parameter(self, where: Routine, call: syntax.Call) -> Numbers:
        """The value of the parameter that a call reads or declares."""
        written = next((value.value for value in call.arguments if isinstance(value, syntax.String)), None)
        if written is None:
            return Numbers(reason="it is a parameter whose name is not known")
        place = Location(where.path, call.line, call.column)
        ends = [end for end in self.node.endpoints if end.kind in ("getters", "parameters")]
        here = {end.name for end in ends if end.location == place}
        last = written.lstrip("~/")
        names = here or {end.name for end in ends if end.name.endswith((f":{last}", f"/{last}"))}
        if len(names) != 1 or "?" in (name := names.pop()):
            return Numbers(reason=f"the node is not seen to have the parameter {last}")
        value = self._ros2(name) if self.node.ros == 2 else self._ros1(name)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return Numbers(reason=f"the value of the parameter {last} is not known")
        return Numbers(frozenset((float(value),)))

    def _ros2(self, name: str) -> object:
        found = [end for end in self.node.endpoints if end.kind == "parameters" and end.name == name]
        values = {repr(end.effective): end.effective for end in found}
        return next(iter(values.values())) if len(values) == 1 else None

    def _ros1(self, name: str) -> object:
        if name in self.changed:
            return None
        known = self.parameters.get(name)
        if known is not None:
            return None if known.conditions or known.unknowns else known.value
        prefixes = {other.partition("?")[0] for other in self.parameters if "?" in other}
        if any(name.startswith(prefix) for prefix in prefixes):
            return None
        found = [end for end in self.node.endpoints if end.kind == "getters" and end.name == name]
        values = {repr(end.value): end.value for end in found if end.value is not None}
        return next(iter(values.values())) if len(values) == 1 else None


def _together(every: Iterable[Numbers]) -> Numbers:
    found: set[float] = set()
    for one in every:
        if one.reason:
            return Numbers(reason=one.reason)
        found |= one.every
    return _limited(frozenset(found))


def _limited(every: frozenset[float]) -> Numbers:
    return Numbers(every) if len(every) <= MOST else Numbers(reason="it may be too many numbers")


def _sets(code: Codebase, where: Routine, name: str) -> bool:
    return any(target == syntax.Name(name) for target, *_ in code.body(where).sets)


def _is_real(code: Codebase, where: Routine, value: Expression) -> bool:
    """Whether what is divided is no whole number in C++."""
    if isinstance(value, syntax.Number):
        return isinstance(value.value, float)
    if isinstance(value, syntax.Cast):
        return value.type.name in REAL
    kind = kinds.type_of(code, where, value)
    return kind is not None and kind.name in REAL


def _reads_parameter(one: Given) -> bool:
    """Whether a value is that of a parameter, as a call reads it."""
    if one.is_read:
        return True
    every = (node for node in everything(one.value) if isinstance(node, syntax.Call))
    return any(syntax.name_of(node.callee).rpartition("::")[2].rpartition(".")[2] in GETTERS for node in every)


def _is_set_again(code: Codebase, one: Given) -> bool:
    """Whether a value is what somebody sets a parameter to while the node runs: its first value is another."""
    value = one.value
    if isinstance(value, syntax.Call):
        value = value.callee
    if not isinstance(value, syntax.Member) or value.name not in VALUES or not isinstance(value.object, syntax.Name):
        return False
    around: Routine | None = one.routine
    while around is not None:
        if any("Parameter" in str(parameter.type) for parameter in around.function.parameters):
            return True
        if any(callback.kind == "parameters" for callback in runs(code, around).callbacks):
            return True
        around = around.outer
    return False


def _is_kept(code: Codebase, where: Routine, call: syntax.Call) -> bool:
    """Whether a member is assigned what *call* makes, so that what it had is gone."""
    for target, operator, value, _ in code.body(where).sets:
        if value is call and operator == "=":
            is_own = isinstance(target, syntax.Member) and isinstance(target.object, syntax.This)
            return is_own or isinstance(target, syntax.Name) and not kinds.is_local(code, where, target.name)
    return False
