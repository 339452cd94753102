# SPDX-License-Identifier: Apache-2.0
"""Labels that a ``goto`` of their function names: what the function assigns to is not known behind them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.regex import regex

if TYPE_CHECKING:
    from tree_sitter import Node

    from haros_ci.extract.cpp.unit import Unit

_FUNCTIONS = ("function_definition", "lambda_expression")
_LABEL = regex(r"[A-Za-z_]\w*")
_SET = regex(
    r"(?<![\w.>:])([A-Za-z_]\w*)\s*(?:(?:[-+*/|&%^]|<<|>>)?=(?!=)|\+\+|--)|(?:\+\+|--)\s*([A-Za-z_]\w*)(?![\w.(:]|->)"
)
WHY = "a goto comes here from elsewhere in the function"


def unknown(unit: Unit, node: Node) -> list[syntax.Statement]:
    """For a labelled statement an assignment of what is not known to each variable that the function assigns to; none without a ``goto``."""
    around = node.parent
    while around is not None and around.type not in _FUNCTIONS:
        around = around.parent
    label = _LABEL.match(unit.collapsed(node.start_byte, node.end_byte))
    if around is None or label is None:
        return []
    text = unit.collapsed(around.start_byte, around.end_byte)
    if re.search(rf"\bgoto {label[0]}\b", text) is None:
        return []
    names = dict.fromkeys(first or second for first, second in _SET.findall(text))
    return [syntax.Do(syntax.Assignment("=", syntax.Name(name), syntax.Unknown(WHY))) for name in sorted(names)]
