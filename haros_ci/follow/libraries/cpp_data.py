# SPDX-License-Identifier: Apache-2.0
"""Methods of values that are known in C++: texts, and data of YAML and XmlRpc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow.conversions import NPOS
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import text_methods, texts
from haros_ci.follow.libraries import xml as library_xml
from haros_ci.follow.walk import Walk
from haros_ci.index.types import SEQUENCES, STRINGS
from haros_ci.values.abstract import (
    LIST_LIMIT,
    NONE,
    Cell,
    Character,
    Known,
    Library,
    Object,
    Pointer,
    Value,
    concatenate,
)
from haros_ci.values.given import beginning, letter

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument


def _of_list(walk: Walk, data: list[object], cell: Cell, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """Methods of a vector that holds a parameter's list."""
    if name == "empty":
        return Known(not data)
    if name in ("at", "front", "back"):
        place = Known({"front": 0, "back": -1}[name]) if not args and name != "at" else args[0].value if args else NONE
        number = place.value if isinstance(place, Known) else None
        return Known(data[number]) if type(number) is int and -1 <= number < len(data) and data else None
    if name in ("push_back", "emplace_back") and len(args) == 1 and len(data) < LIST_LIMIT:
        added = args[0].value
        if isinstance(added, Known):
            walk.state.write(cell, Known([*data, added.value]))
            return NONE
    if name == "clear":
        walk.state.write(cell, Known([]))
        return NONE
    return None


def _asked_alone(text: Known, name: str) -> Value | None:
    """The same of a method without arguments."""
    if name in ("size", "length"):
        return Known(text.ask("size"))
    if name == "empty":
        return Known(not text.ask("truth"))
    return texts.number(letter(text, 0 if name == "front" else -1)) if name in ("front", "back") else None


def _asked(text: Known, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What a method of a text that is given from outside says of it, where it need not be looked at any further for that."""
    if not args:
        return _asked_alone(text, name)
    operands = [argument.value.value for argument in args if argument.value.__class__ is Known]
    if len(operands) != len(args):
        return None
    if name == "substr" and len(operands) == 2:
        start, count = operands
        return beginning(text, count) if start == 0 and count.__class__ is int else None
    operand = chr(operands[0]) if isinstance(operands[0], Character) else operands[0]
    if name in ASKED and len(operands) == 1 and operand.__class__ is str:
        found = text.ask(ASKED[name], operand)
        return Known(NPOS if found.__class__ is int and found < 0 else found)
    return None


#: Methods with one text of which the result says no more than the answer to a question.
ASKED = {"starts_with": "starts with", "ends_with": "ends with", "find": "first place of", "rfind": "last place of"}
#: Parts of a path.
PARTS = frozenset(("path", "string", "filename", "extension", "stem", "parent_path"))


def of_known(  # noqa: C901 - one branch for each method
    walk: Walk, frame: Frame, receiver: Known, cell: Cell | None, name: str, args: tuple[PassedArgument, ...]
) -> Value | None:
    if name == "has_value" and not args and receiver.kind is bool:
        return receiver  # what BT::TreeNode::getInput says
    if name in ("c_str", "str", "data", "Scalar", "as", "toString") and not args:
        return receiver
    if name in ("append", "push_back") and issubclass(receiver.kind, str) and cell is not None and args:
        return texts.changed(walk, cell, concatenate((receiver, texts.constructed(args))))
    if receiver.__class__ is not Known and receiver.kind is str:
        answer = _asked(receiver, name, args)
        if answer is not None:
            return answer
    data = receiver.value
    if isinstance(data, str):
        if name in ("size", "length"):
            return Known(len(data))
        if name == "empty":
            return Known(not data)
        values = [argument.value.value if isinstance(argument.value, Known) else None for argument in args]
        numbers = [item for item in values if isinstance(item, int)]
        if not args and name in PARTS:
            return Known(library_xml.part(data, name))
        if name in ("starts_with", "ends_with") and len(values) == 1 and isinstance(values[0], str):
            return Known(data.startswith(values[0]) if name == "starts_with" else data.endswith(values[0]))
        if name == "substr" and not args:
            return receiver
        if name == "substr" and values and len(numbers) == len(values):
            count = numbers[1] if len(numbers) > 1 else len(data)
            count = len(data) if count < 0 else count  # npos
            return Known(data[numbers[0] : numbers[0] + count]) if 0 <= numbers[0] <= len(data) else None
        if "find" in name and cell is not None or name in ("find", "rfind"):
            found = text_methods.found(data, name, args)
            if found is not None:
                return found
        if name == "compare" and len(values) == 1 and isinstance(values[0], str):
            return Known((data > values[0]) - (data < values[0]))
        if name in ("at",) and values and isinstance(values[0], int) and 0 <= values[0] < len(data):
            return texts.number(Known(data[values[0]]))
        if name in ("front", "back") and data:
            return texts.number(Known(data[0 if name == "front" else -1]))
        if name in ("begin", "end", "cbegin", "cend", "rbegin", "rend") and cell is not None:
            return Object("[iterator]", fields={"[of]": Cell(Pointer(cell))})
        if name == "pop_back" and cell is not None and data:
            walk.state.write(cell, Known(data[:-1]))
            return NONE
        if name == "swap" and cell is not None and args and args[0].cell is not None:
            walk.state.write(cell, args[0].value)
            walk.state.write(args[0].cell, receiver)
            return NONE
        if name == "assign" and cell is not None and args:
            return texts.changed(walk, cell, concatenate((texts.constructed(args),)))
        if name == "clear" and cell is not None:
            walk.state.write(cell, Known(""))
            return NONE
        if cell is not None and name in ("insert", "erase", "replace", "swap", "resize", "pop_back"):
            if name == "swap" and args and args[0].cell is not None:
                walk.state.write(args[0].cell, walk.opaque("it is swapped", frame, None, args[0].cell.type))
            changed = text_methods.changed(data, name, args)
            unknown = walk.opaque(f"it is changed by {name}", frame, None, cell.type) if changed is None else None
            return texts.changed(walk, cell, unknown or Known(changed))
        return None
    if name in ("size",) and isinstance(data, (list, dict)):
        return Known(len(data))
    if isinstance(data, list) and cell is not None and cell.type is not None and cell.type.name in SEQUENCES:
        result = _of_list(walk, data, cell, name, args)
        if result is not None:
            return result
    if name in ("FindValue", "hasMember") and args and isinstance(args[0].value, Known):
        pairs, key = data if isinstance(data, dict) else {}, args[0].value.value
        inside = isinstance(data, dict) and key in pairs
        if name == "hasMember":
            return Known(inside)
        return Known(pairs[key]) if inside else NONE
    if name in ("IsDefined", "IsScalar", "IsSequence", "IsMap", "IsNull", "valid"):
        kinds: dict[str, bool] = {
            "IsDefined": data is not None,
            "valid": data is not None,
            "IsNull": data is None,
            "IsMap": isinstance(data, dict),
            "IsSequence": isinstance(data, list),
            "IsScalar": isinstance(data, (str, int, float)),
        }
        return Known(kinds[name])
    if name == "getType":
        for kind, message in (
            (bool, "TypeBoolean"),
            (int, "TypeInt"),
            (float, "TypeDouble"),
            (str, "TypeString"),
            (list, "TypeArray"),
            (dict, "TypeStruct"),
        ):
            if isinstance(data, kind):
                return Library(f"XmlRpc::XmlRpcValue::{message}")
    return None


def of_text(cell: Cell | None) -> Object | None:
    """An iterator of the text in *cell*, of which a part may be known; None of what is declared as no text."""
    if cell is None or cell.type is None or cell.type.name not in STRINGS:
        return None
    return Object("[iterator]", fields={"[of]": Cell(Pointer(cell))})
