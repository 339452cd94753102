# SPDX-License-Identifier: Apache-2.0
"""Summaries of Python's built-in functions and of a few of its modules."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.container_methods import ordered, update
from haros_ci.launch.python.files import json_load, open_file, yaml_load
from haros_ci.launch.python.formats import as_text, formatted_value, plain
from haros_ci.launch.python.heap import LARGEST
from haros_ci.launch.python.operators import binary
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import certain, items_of
from haros_ci.launch.python.text_methods import count, literal, number_of, text
from haros_ci.launch.python.truth import truth
from haros_ci.launch.python.types import deep_copy, is_instance, parent_class, shallow
from haros_ci.launch.python.values import (
    Bound,
    LibraryCall,
    Maybe,
    Native,
    Rest,
    ScriptClass,
    ScriptFunction,
    ScriptInstance,
    Unknown,
    Value,
    holes,
    uncertain,
    why,
)

Summary = Callable[[ScriptEvaluation, LibraryCall], Value]


def nothing(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """A call that launches nothing."""
    return None


def sequence(kind: type) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        if not call.args:
            return kind()
        items = items_of(run, call.args[0], call.location)
        if isinstance(items, Unknown):
            return (
                run.unknown(items.reason, items.location) if kind is set else kind([Rest(items.reason, items.location)])
            )
        return run.made(kind(items), call.location)

    return summary


def dictionary(run: ScriptEvaluation, call: LibraryCall) -> Value:
    result: dict[Any, Value] = {}
    update(run, result, call)
    return run.made(result, call.location)


def enumerated(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("iterable start")
    items = certain(run, bound.get("iterable"), call.location)
    start = bound.get("start", 0)
    if isinstance(items, Unknown) or not isinstance(start, int):
        return run.unknown(items.reason if isinstance(items, Unknown) else why(start), call.location)
    return list(enumerate(items, start))


def zipped(run: ScriptEvaluation, call: LibraryCall) -> Value:
    columns = [certain(run, item, call.location) for item in call.args]
    doubt = next((item for item in columns if isinstance(item, Unknown)), None)
    if doubt is not None:
        return run.unknown(doubt.reason, doubt.location)
    return list(zip(*(item for item in columns if isinstance(item, list)), strict=False))


def number_range(run: ScriptEvaluation, call: LibraryCall) -> Value:
    if not all(isinstance(item, int) for item in call.args):
        return run.unknown(next((why(item) for item in call.args if not isinstance(item, int)), ""), call.location)
    made = range(*call.args)
    try:
        size = len(made)
    except OverflowError:
        size = LARGEST + 1
    return made if size <= LARGEST else run.unknown("the range is too large", call.location)


def mapped(run: ScriptEvaluation, call: LibraryCall) -> Value:
    if len(call.args) != 2:
        return run.unknown("map of several sequences is not followed", call.location)
    items = items_of(run, call.args[1], call.location)
    if isinstance(items, Unknown):
        return run.unknown(items.reason, items.location)
    return [
        item
        if isinstance(item, Rest)
        else Maybe(run.apply(call.args[0], (item.value,), call.location), item.tests)
        if isinstance(item, Maybe)
        else run.apply(call.args[0], (item,), call.location)
        for item in items
    ]


def filtered(run: ScriptEvaluation, call: LibraryCall) -> Value:
    items = certain(run, call.args[1] if len(call.args) > 1 else None, call.location)
    if isinstance(items, Unknown):
        return run.unknown(items.reason, items.location)
    result = []
    for item in items:
        known = truth(run, item if call.args[0] is None else run.apply(call.args[0], (item,), call.location))
        if isinstance(known, Unknown):
            return run.unknown(known.reason, call.location)
        if known:
            result.append(item)
    return result


def quantified(stop: bool) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        items = items_of(run, call.args[0] if call.args else None, call.location)
        if isinstance(items, Unknown):
            return run.unknown(items.reason, items.location)
        doubt: Unknown | None = None
        for item in items:
            known = truth(run, Unknown(why(item)) if isinstance(item, Maybe) else item)
            if isinstance(known, Unknown):
                doubt = doubt or known
            elif known is stop:
                return stop
        return not stop if doubt is None else Unknown(doubt.reason, doubt.location)

    return summary


def extreme(run: ScriptEvaluation, call: LibraryCall) -> Value:
    values = call.args if len(call.args) > 1 else tuple(as_items(run, call))
    if values and all(isinstance(item, (bool, int, float)) for item in values) and "key" not in call.keywords:
        return max(values) if call.name.endswith("max") else min(values)
    return run.unknown(f"{call.name.split('.')[-1]}() of values that are not known", call.location)


def as_items(run: ScriptEvaluation, call: LibraryCall) -> list[Value]:
    items = items_of(run, call.args[0] if call.args else None, call.location)
    return [Rest(items.reason, items.location)] if isinstance(items, Unknown) else items


def total(run: ScriptEvaluation, call: LibraryCall) -> Value:
    result: Value = call.args[1] if len(call.args) > 1 else call.keywords.get("start", 0)
    for item in as_items(run, call):
        result = binary(run, ast.Add(), result, item, call.location)
    return result


def reversed_(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return as_items(run, call)[::-1]


def boolean(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return truth(run, call.args[0]) if call.args else False


def absolute(run: ScriptEvaluation, call: LibraryCall) -> Value:
    value = call.args[0]
    return abs(value) if isinstance(value, (bool, int, float)) else run.unknown(why(value), call.location)


def rounded(run: ScriptEvaluation, call: LibraryCall) -> Value:
    if all(isinstance(item, (bool, int, float)) for item in call.args):
        return round(*call.args)
    return run.unknown(why(call.args[0]), call.location)


def represented(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return formatted_value(run, call.args[0], "r", "", call.location)


def next_(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``next(iterator, default)``: the first item; an iterator that is used twice is not followed."""
    items = call.args[0] if call.args else None
    if not isinstance(items, list):
        return run.unknown(why(items), call.location)
    if not items and len(call.args) > 1:
        return call.args[1]
    if holes(items[:1]) is None and items:
        run.heap.touch(items)
        return items.pop(0)
    return run.unknown("the next item is not known", call.location)


def attribute(run: ScriptEvaluation, call: LibraryCall) -> Value:
    if len(call.args) < 2 or not isinstance(call.args[1], str):
        return run.unknown("the name of an attribute is not known", call.location)
    found = run.attribute(run, call.args[0], call.args[1], call.location)
    if isinstance(found, Unknown) and len(call.args) > 2 and isinstance(call.args[0], ScriptInstance):
        return call.args[2]
    return found


def is_callable(run: ScriptEvaluation, call: LibraryCall) -> Value:
    value = call.args[0]
    return (
        run.unknown(why(value), call.location)
        if uncertain(value)
        else isinstance(value, (ScriptFunction, Bound, ScriptClass, Native))
    )


def chained(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``itertools.chain(a, b)`` and ``chain.from_iterable(x)``."""
    sources = as_items(run, call) if call.name.endswith("from_iterable") else call.args
    result: list[Value] = []
    for item in sources:
        items = items_of(run, item, call.location)
        result.extend([Rest(items.reason, items.location)] if isinstance(items, Unknown) else items)
    return run.made(result, call.location)


def product(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``itertools.product(a, b)`` of a few items."""
    rows: list[Value] = [()]
    for item in call.args:
        items = certain(run, item, call.location)
        if isinstance(items, Unknown) or len(rows) * len(items) > 10_000:
            return run.unknown("the items are not known or too many", call.location)
        run.budget.take(len(rows) * len(items))
        rows = [(*row, one) for row in rows for one in items]
    return rows


def dumped(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``json.dumps``."""
    value = call.args[0] if call.args else None
    if plain(value):
        import json

        return run.made(json.dumps(value), call.location)
    return run.unknown(f"what {call.name} gives is not followed", call.location)


def default_dict(run: ScriptEvaluation, call: LibraryCall) -> Value:
    lost = Rest("defaults of a defaultdict are not followed", call.location)
    return {lost: lost}


def pattern(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return run.unknown("regular expressions are not followed", call.location)


BUILTINS: dict[str, Summary] = {
    "str": text,
    "int": number_of,
    "float": number_of,
    "bool": boolean,
    "len": count,
    "list": sequence(list),
    "tuple": sequence(tuple),
    "set": sequence(set),
    "frozenset": sequence(set),
    "dict": dictionary,
    "iter": sequence(list),
    "enumerate": enumerated,
    "zip": zipped,
    "range": number_range,
    "map": mapped,
    "filter": filtered,
    "any": quantified(True),
    "all": quantified(False),
    "max": extreme,
    "min": extreme,
    "sum": total,
    "sorted": lambda run, call: ordered(run, call.args[0] if call.args else None, call),
    "reversed": reversed_,
    "abs": absolute,
    "round": rounded,
    "repr": represented,
    "next": next_,
    "getattr": attribute,
    "callable": is_callable,
    "isinstance": is_instance,
    "open": open_file,
    "eval": literal,
    "super": parent_class,
    "print": nothing,
    "setattr": nothing,
    "format": lambda run, call: formatted_value(
        run, call.args[0], "", call.args[1] if len(call.args) > 1 else "", call.location
    ),
}
SUMMARIES: dict[str, Summary] = {
    **{f"builtins.{name}": work for name, work in BUILTINS.items()},
    "yaml.safe_load": yaml_load,
    "yaml.load": yaml_load,
    "yaml.full_load": yaml_load,
    "ast.literal_eval": literal,
    "json.load": json_load,
    "json.loads": json_load,
    "json.dumps": dumped,
    "io.open": open_file,
    "copy.deepcopy": deep_copy,
    "copy.copy": shallow,
    "itertools.chain": chained,
    "itertools.chain.from_iterable": chained,
    "itertools.product": product,
    "collections.OrderedDict": dictionary,
    "collections.defaultdict": default_dict,
    **dict.fromkeys(
        (
            "os.remove",
            "os.unlink",
            "os.makedirs",
            "os.mkdir",
            "os.chdir",
            "os.rmdir",
            "os.chmod",
            "shutil.rmtree",
            "time.sleep",
            "random.seed",
            "os.environ.setdefault",
            "os.environ.update",
        ),
        nothing,
    ),
    "re.compile": pattern,
    "re.match": pattern,
    "re.sub": pattern,
    "typing.cast": lambda run, call: call.args[1] if len(call.args) > 1 else None,
    "typing.TypeVar": nothing,
    "textwrap.dedent": lambda run, call: as_text(run, call.args[0], call.location),
}
#: Modules whose functions launch nothing and give nothing that is followed.
HARMLESS = (
    "logging.",
    "warnings.",
    "sys.stdout.",
    "sys.stderr.",
    "launch.logging.",
    "unittest.",
    "pytest.",
    "rclpy.",
    "traceback.",
)
