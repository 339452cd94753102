# SPDX-License-Identifier: Apache-2.0
"""Macros with parameters of headers of the workspace whose text calls an API (``#define ADVERTISE(T, n) nh.advertise<T>(n, 1)``) or registers a class, and who uses them.

A file is read by itself, so the macros that it gets by its includes are given to it when it is read once more. Given is what every
definition of the name in the workspace agrees on; of other macros a node says that they are not followed (``follow.calling_macros``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from posixpath import basename

from haros_ci.extract.apis.tables import rows
from haros_ci.extract.cpp.expansion import REGISTERING
from haros_ci.extract.cpp.read import Macro
from haros_ci.index.api_names import making_rows
from haros_ci.keeping.kept import digest_of
from haros_ci.regex import regex
from haros_ci.syntax import Program

#: What a macro's text calls: methods, also with template arguments, and functions.
_CALLED = regex(r"(\.|->|\b)\s*(?:template\s+)?([A-Za-z_]\w*)\s*(?:<[^<>(){};]{0,200}>\s*)?\(")
_WORD = regex(r"[A-Za-z_]\w*")
#: A macro's text that is a text, of a parameter's name among others, and one that is what another macro makes of its parameter.
_TEXT = regex(r"""(?:[\s()]|"(?:[^"\\\n]|\\.)*"|\#\s*[A-Za-z_]\w*)+""")
_PASSED = regex(r"\(?\s*([A-Za-z_]\w*)\s*\(\s*[A-Za-z_]\w*\s*\)\s*\)?")
#: Macros that are given, how much of the text of each, and headers that a file includes.
MOST, LONGEST, MOST_HEADERS = 200, 4000, 2000


def given(programs: Mapping[str, Program], mentions: Mapping[str, frozenset[str]]) -> dict[str, dict[str, Macro]]:
    """The macros of headers that each file uses and sees, by path; *mentions* are the words of files of C++ among those of ``names``."""
    macros = calling(programs)
    homes: dict[str, list[str]] = {}
    for path in programs:
        homes.setdefault(basename(path), []).append(path)
    found: dict[str, dict[str, Macro]] = {}
    for path, words in mentions.items():
        own = {name for name, parameters, _ in programs[path].macros if parameters is not None}
        used = words & macros.keys() - own
        if used and used & {name for seen in _reached(programs, homes, path) for name, *_ in programs[seen].macros}:
            found[path] = {name: macros[name] for name in sorted(macros.keys() - own)}
    return found


def calling(programs: Mapping[str, Program]) -> dict[str, Macro]:
    """The macros with parameters that all definitions of their names agree on, and whose text calls an API, one of those, or a parameter, or is a text (``#V``)."""
    single = _agreed(programs)
    calls = {name: set(_calls(macro)) for name, macro in single.items()}
    methods = _methods() if any(mark for called in calls.values() for mark, _ in called) else frozenset()
    making = {name for name, called in calls.items() if any(mark and word in methods for mark, word in called)}
    making |= {name for name, called in calls.items() if any(word in single[name][0] for _, word in called)}
    making |= {name for name, (_, body) in single.items() if REGISTERING.search(body)}
    while further := {name for name, called in calls.items() if {word for _, word in called} & making} - making:
        making |= further
    texts = _of_texts(single)
    return {name: single[name] for name in [*sorted(making), *sorted(texts - making)][:MOST]}


def _agreed(programs: Mapping[str, Program]) -> dict[str, Macro]:
    """The macros with parameters that have one definition, or the same one wherever they have any."""
    every: dict[str, set[Macro] | None] = {}
    for program in programs.values():
        for name, parameters, body in program.macros:
            if parameters is None or len(body) > LONGEST:
                every[name] = None
            elif (known := every.setdefault(name, set())) is not None:
                known.add((parameters, body))
    return {name: next(iter(found)) for name, found in every.items() if found is not None and len(found) == 1}


def _of_texts(single: Mapping[str, Macro]) -> set[str]:
    """The names of the macros that make a text of their argument, or pass it on to one of these."""
    texts = {name for name, (_, body) in single.items() if "#" in body and _TEXT.fullmatch(body)}
    passed = {name: _PASSED.fullmatch(body) for name, (_, body) in single.items()}
    texts |= {name for name, match in passed.items() if match and match[1] in texts}
    return texts


def state(programs: Mapping[str, Program]) -> str:
    """What the macros and who sees them depend on, besides the files that use them; "" where there are none."""
    macros = calling(programs)
    return digest_of(macros, [(path, program.includes) for path, program in sorted(programs.items())]) if macros else ""


def words_of(text: str, names: frozenset[str]) -> frozenset[str]:
    """Those of *names* that a file's text has."""
    return names.intersection(_WORD.findall(text)) if any(name in text for name in names) else frozenset()


def _methods() -> frozenset[str]:
    """The methods of C++ by which the tables of APIs make something."""
    return frozenset(name[1:] for ros in (1, 2) for name in making_rows(rows("cpp", ros))[0] if name.startswith("."))


def _calls(macro: Macro) -> Iterator[tuple[str, str]]:
    for match in _CALLED.finditer(macro[1]):
        yield match[1], match[2]


def _reached(programs: Mapping[str, Program], homes: Mapping[str, list[str]], path: str) -> set[str]:
    """The files of the workspace that *path* may include, itself and over others: those that end as the include is written."""
    found, waiting = {path}, [path]
    while waiting and len(found) < MOST_HEADERS:
        for written in programs[waiting.pop()].includes:
            name = written.strip('<>"')
            for home in homes.get(basename(name), ()):
                if home not in found and f"/{home}".endswith(f"/{name.replace('../', '')}"):
                    found.add(home)
                    waiting.append(home)
    return found
