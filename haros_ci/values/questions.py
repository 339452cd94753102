# SPDX-License-Identifier: Apache-2.0
"""Questions about data of which a program uses the answer alone, as in a condition: another value with that answer would do as well."""

from __future__ import annotations

import operator
from collections.abc import Callable

from haros_ci.records import dataclass
from haros_ci.values.marks import BEGIN, filled

#: How many questions about what one program is given are kept; after that the values count.
MOST = 400
#: What a question asks of data and its operand. It raises TypeError for data of another kind.
QUESTIONS: dict[str, Callable[..., int]] = {
    "==": operator.eq,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
    "truth": lambda data, _: bool(data),
    "size": lambda data, _: len(data),
    "longer than": lambda data, place: len(data) > place,
    "starts with": str.startswith,
    "ends with": str.endswith,
    "first place of": str.find,
    "last place of": str.rfind,
}
#: What an operand may be.
PLAIN = frozenset((bool, int, float, str))


@dataclass(frozen=True, slots=True)
class Answer:
    """What a question about *of* was answered: about a text with marks if it *is_text*, else the parameter of that name.

    An *operand* that is a text may have marks, too. Where there is a *place*, the question is about the number of that character of the text.
    """

    of: str
    is_text: bool
    question: str
    operand: object
    answer: int
    place: int | None = None

    def holds(self, texts: dict[str, str], provided: Callable[[str], object]) -> bool:
        """Whether the answer is the same where marks stand for *texts*, and parameters are those *provided*."""
        data = filled(self.of, texts) if self.is_text else provided(self.of)
        operand = self.operand
        if isinstance(operand, str) and BEGIN in operand:
            operand = filled(operand, texts)
        try:
            if self.place is not None:
                data = ord(data[self.place])  # type: ignore[index]  # of a text; TypeError for all else
            found = QUESTIONS[self.question](data, operand)
        except (TypeError, IndexError):
            return False
        return found.__class__ is self.answer.__class__ and bool(found == self.answer)
