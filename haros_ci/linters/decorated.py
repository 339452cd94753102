# SPDX-License-Identifier: Apache-2.0
"""Functions and classes of Python that a decorator gives other parameters than stand in their definition, which pylint does not see."""

from __future__ import annotations

from haros_ci.linters.pylint_statements import called_at
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Result

#: Decorators that leave the parameters of a function, or of a class's constructor, as pylint knows them, by their last name.
TRANSPARENT = frozenset(
    "staticmethod classmethod property abstractmethod override final overload cache cached_property lru_cache wraps contextmanager"
    " asynccontextmanager total_ordering deprecated dataclass s attrs define frozen mutable unique runtime_checkable add_metaclass"
    " python_2_unicode_compatible".split()
)
_DECORATED = regex(r"^[ \t]*@[ \t]*([\w.]+)")
_DEFINITION = regex(r"^[ \t]*(?:(?:async[ \t]+)?def|class)[ \t]+(\w+)")


def decorators(text: str, name: str) -> list[list[str]]:
    """The last names of the decorators of each function or class called *name* that *text* defines in its code."""
    found: list[list[str]] = []
    waiting: list[str] = []
    for line in code_alone(text, "python").split("\n"):
        decorator, definition = _DECORATED.match(line), _DEFINITION.match(line)
        if decorator:
            waiting.append(decorator[1].rpartition(".")[2])
        elif definition:
            if definition[1] == name:
                found.append(waiting)
            waiting = []
    return found


def is_decorated(text: str, name: str) -> bool:
    """Whether *text* defines a function or class called *name* with a decorator that may change its parameters (click, hydra, mock, a singleton)."""
    return any(not TRANSPARENT.issuperset(decorator) for decorator in decorators(text, name))


def is_call_of_decorated(result: Result, workspace: Workspace) -> bool:
    """Whether the call at *result* is of a function or class of the workspace with a decorator that may change its parameters.

    A function that is called by its plain name or on ``self``, and that the file defines itself, is that one; else any of the name may be meant.
    """
    at = result.location
    if not at.line or not at.column:
        return False
    text = workspace.text(at.path)
    end = (at.end_line, at.end_column - 1) if at.end_line and at.end_column else None
    name = called_at(text, (at.line, at.column - 1), end)
    if not name or name.startswith("__"):
        return False
    own = decorators(text, name)
    before = text.split("\n")[at.line - 1][at.column - 1 :]
    if own and before.startswith((name, f"self.{name}", f"cls.{name}")):
        return any(not TRANSPARENT.issuperset(group) for group in own)
    sources = (file.path for file in workspace.files if file.language == "python")
    needles = f"def {name}", f"class {name}"
    return any(
        is_decorated(whole, name)
        for whole in map(workspace.text, sources)
        if any(needle in whole for needle in needles)
    )
