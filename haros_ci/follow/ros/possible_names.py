# SPDX-License-Identifier: Apache-2.0
"""Which names something may have whose name is one of several."""

from __future__ import annotations

from haros_ci.values.abstract import Choice, Known, Text, Value

#: Why it is not known whether something is made under a name.
ONE_OF_NAMES = "its name is one of several"


def possible_names(provided: Choice) -> list[Value]:
    """The names among the options: not the empty one, and none that is another one without its rest that is not known.

    ``s.empty() ? space : space + "/" + s`` joins two names, of which the second one is there most often.
    """
    begun = [
        option.parts[0] for option in provided.options if isinstance(option, Text) and isinstance(option.parts[0], str)
    ]
    return [
        option
        for option in provided.options
        if not isinstance(option, Known)
        or (option != Known("") and not any(text.startswith(f"{option.value}/") for text in begun))
    ]
