# SPDX-License-Identifier: Apache-2.0
"""Methods of list, tuple, dict and set; each notes what it changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.assignments import forget_items, hashable
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import certain, items_of
from haros_ci.launch.python.subscripts import item_of
from haros_ci.launch.python.truth import equal
from haros_ci.launch.python.values import Absent, Choice, LibraryCall, Rest, Unknown, Value, holes, uncertain, why

Work = Callable[[ScriptEvaluation, Any, LibraryCall], Value]


def argument(call: LibraryCall, index: int = 0) -> Value:
    return call.args[index] if index < len(call.args) else None


def append(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    run.budget.take(1)
    value.append(argument(call))


def extend(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    items = items_of(run, argument(call), call.location)
    value.extend([Rest(items.reason, items.location)] if isinstance(items, Unknown) else items)
    run.budget.take(0 if isinstance(items, Unknown) else len(items))


def insert(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    index = argument(call)
    if isinstance(index, int) and (holes(value) is None or index == 0):
        value.insert(index, argument(call, 1))
    else:
        forget_items(value, "where an item is put is not known", call.location)


def pop(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> Value:
    index = argument(call) if call.args else -1
    if isinstance(index, int) and holes(value) is None and -len(value) <= index < len(value):
        return value.pop(index)
    forget_items(value, "which item is taken is not known", call.location)
    return run.unknown("which item is taken is not known", call.location)


def remove(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    for index, item in enumerate(value):
        found = equal(run, item, argument(call))
        if isinstance(found, Unknown):
            forget_items(value, found.reason, call.location)
            return
        if found:
            del value[index]
            return


def clear(run: ScriptEvaluation, value: Any, call: LibraryCall) -> None:
    value.clear()


def reverse(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    value.reverse()


def sort(run: ScriptEvaluation, value: list[Value], call: LibraryCall) -> None:
    done = ordered(run, value, call)
    if isinstance(done, Unknown):
        forget_items(value, done.reason, done.location)
    else:
        value[:] = done


def ordered(run: ScriptEvaluation, value: Value, call: LibraryCall) -> list[Value] | Unknown:
    """The items in order, if all keys can be compared; ``key`` and ``reverse`` are followed."""
    items = certain(run, value, call.location)
    if isinstance(items, Unknown):
        return items
    key, turn = call.keywords.get("key"), call.keywords.get("reverse", False)
    keys = [item if key is None else run.apply(key, (item,), call.location) for item in items]
    run.budget.step(len(items))
    comparable = all(isinstance(item, str) for item in keys) or all(
        isinstance(item, (bool, int, float)) for item in keys
    )
    if not comparable or not isinstance(turn, bool):
        return run.unknown("the order is not known", call.location)
    return [items[i] for i in sorted(range(len(items)), key=lambda i: keys[i], reverse=turn)]


def index_of(run: ScriptEvaluation, value: Any, call: LibraryCall) -> Value:
    for index, item in enumerate(value):
        found = equal(run, item, argument(call))
        if found is not False:
            return index if found is True else found
    return run.unknown("there is no such item", call.location)


def count_of(run: ScriptEvaluation, value: Any, call: LibraryCall) -> Value:
    found = [equal(run, item, argument(call)) for item in value]
    return next((item for item in found if isinstance(item, Unknown)), None) or found.count(True)


def copied(run: ScriptEvaluation, value: Any, call: LibraryCall) -> Value:
    return run.made(value.copy(), call.location)


def get(run: ScriptEvaluation, value: dict[Any, Value], call: LibraryCall) -> Value:
    bound = call.bind("key default")
    key = bound.get("key")
    if uncertain(key) or not hashable(key):
        return run.unknown(why(key), call.location)
    if key not in value and not any(isinstance(item, Rest) for item in value):
        return bound.get("default")
    found = value.get(key)
    if isinstance(found, Choice) and any(isinstance(item, Absent) for _, item in found.options):
        default = bound.get("default")
        options = tuple((tests, default if isinstance(item, Absent) else item) for tests, item in found.options)
        return Choice(found.reason, found.location, options)
    return item_of(run, value, key, call.location)


def views(kind: str) -> Work:
    def work(run: ScriptEvaluation, value: dict[Any, Value], call: LibraryCall) -> Value:
        run.budget.take(len(value))
        result: list[Value] = []
        for key, item in value.items():
            if isinstance(key, Rest):
                result.append(key)
            else:
                result.append(key if kind == "keys" else item if kind == "values" else (key, item))
        return result

    return work


def update(run: ScriptEvaluation, value: dict[Any, Value], call: LibraryCall) -> None:
    provided = argument(call)
    run.budget.take(len(call.keywords))
    if isinstance(provided, dict):
        run.budget.take(len(provided))
        if any(isinstance(key, Rest) for key in provided):
            forget_items(value, "what is added is not known", call.location)
        value.update(provided)
    elif provided is not None:
        pairs = certain(run, provided, call.location)
        if isinstance(pairs, list) and all(
            isinstance(p, (list, tuple)) and len(p) == 2 and hashable(p[0]) for p in pairs
        ):
            value.update({pair[0]: pair[1] for pair in pairs})
        else:
            forget_items(value, f"what is added is not known: {why(provided)}", call.location)
    value.update(call.keywords)


def set_default(run: ScriptEvaluation, value: dict[Any, Value], call: LibraryCall) -> Value:
    key = argument(call)
    if uncertain(key) or not hashable(key):
        forget_items(value, why(key), call.location)
        return run.unknown(why(key), call.location)
    return value.setdefault(key, argument(call, 1))


def pop_key(run: ScriptEvaluation, value: dict[Any, Value], call: LibraryCall) -> Value:
    key = argument(call)
    if uncertain(key) or not hashable(key):
        forget_items(value, why(key), call.location)
        return run.unknown(why(key), call.location)
    if key not in value and len(call.args) > 1:
        return call.args[1]
    found = item_of(run, value, key, call.location)
    value.pop(key, None)
    return found


def add(run: ScriptEvaluation, value: set[Value], call: LibraryCall) -> None:
    item = argument(call)
    value.add(item if hashable(item) else Rest(why(item), call.location))


def discard(run: ScriptEvaluation, value: set[Value], call: LibraryCall) -> None:
    item = argument(call)
    if uncertain(item) or not hashable(item):
        forget_items(value, why(item), call.location)
    else:
        value.discard(item)


def algebra(name: str) -> Work:
    def work(run: ScriptEvaluation, value: set[Value], call: LibraryCall) -> Value:
        other = certain(run, argument(call), call.location)
        doubt = holes(value)
        if isinstance(other, Unknown) or doubt is not None or not all(hashable(item) for item in other):
            return run.unknown("the items of a set are not known", call.location)
        return run.made(getattr(value, name)(other), call.location)

    return work


CHANGING: dict[type, dict[str, Work]] = {
    list: {
        "append": append,
        "extend": extend,
        "insert": insert,
        "pop": pop,
        "remove": remove,
        "clear": clear,
        "reverse": reverse,
        "sort": sort,
    },
    dict: {"update": update, "setdefault": set_default, "pop": pop_key, "clear": clear},
    set: {"add": add, "update": extend, "discard": discard, "remove": discard, "clear": clear},
}
ASKING: dict[type, dict[str, Work]] = {
    list: {"index": index_of, "count": count_of, "copy": copied},
    tuple: {"index": index_of, "count": count_of},
    dict: {"get": get, "keys": views("keys"), "values": views("values"), "items": views("items"), "copy": copied},
    set: {
        "copy": copied,
        "union": algebra("union"),
        "intersection": algebra("intersection"),
        "difference": algebra("difference"),
        "issubset": algebra("issubset"),
        "issuperset": algebra("issuperset"),
    },
}


def update_set(run: ScriptEvaluation, value: set[Value], call: LibraryCall) -> None:
    for item in (extra for one in call.args for extra in as_list(run, one, call)):
        value.add(item if hashable(item) else Rest(why(item), call.location))


def as_list(run: ScriptEvaluation, value: Value, call: LibraryCall) -> list[Value]:
    items = items_of(run, value, call.location)
    return [Rest(items.reason, items.location)] if isinstance(items, Unknown) else items


CHANGING[set]["update"] = update_set


def container_method(run: ScriptEvaluation, value: Any, name: str, call: LibraryCall) -> Value:
    """``value.name(…)``."""
    kind = type(value)
    if (work := CHANGING.get(kind, {}).get(name)) is not None:
        run.heap.touch(value)
        done = work(run, value, call)
        run.budget.step()
        if len(value) > 100_000:
            forget_items(value, "it is too large", call.location)
        return done
    if (work := ASKING.get(kind, {}).get(name)) is not None:
        return work(run, value, call)
    if kind in CHANGING:
        run.heap.touch(value)
        forget_items(value, f"{kind.__name__}.{name} is not followed", call.location)
    return run.unknown(f"{kind.__name__}.{name} is not followed", call.location)
