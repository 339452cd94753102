# SPDX-License-Identifier: Apache-2.0
"""Whether a program publishes again for those who come late, as far as the text of the file tells that makes the publisher."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import chain, islice

from haros_ci.regex import regex

#: What asks for subscribers, or hears of new ones.
_ASKS = regex(
    r"\b(?:get_(?:intra_process_)?subscription_count|getNumSubscribers|get_num_connections|count_subscribers|getSubscriberCount"
    r"|matched_callback|PublisherEventCallbacks|SubscribeListener|peer_subscribe|SubscriberStatusCallback)\b"
)
#: Calls whose functions run again and again, or on request.
_AGAIN = regex(
    r"\b(?:create_(?:wall_)?timer|create(?:Wall|Steady)?Timer|create_service|create_server|advertiseService|Timer|Service|ActionServer"
    r"|create_rate|add_on_set_parameters_callback)\s*(?:<[^<>;]{0,200}>\s*)?\("
)
_LOOP = regex(r"\bwhile\b[^\n;]{0,200}|\bfor\s*\(\s*;\s*;\s*\)")
_WAITS = regex(r"\b(?:sleep|sleep_for|sleep_until|spin_some|spin_once|spinOnce|wait)\b")
_PUBLISHER = regex(
    r"\b(?:([A-Za-z_]\w*)\s*(?:\[[^\]\n]{0,100}\]\s*)?(?::[\w.\[\], ]{1,100})?=(?!=)\s*|([A-Za-z_]\w*)\s*[({]\s*)"
    r"(?:[\w.>()\[\]:&* -]{0,80}[.>:]\s*)?(?:create_publisher|advertise)\b"
)
_FUNCTION = regex(r"\b([A-Za-z_]\w*)\s*\([^;{}]{0,400}\)[^;{}()]{0,100}\{")
_DEF = regex(r"^([ \t]*)(?:async[ \t]+)?def[ \t]+(\w+)[ \t]*\(", re.MULTILINE)
_OUTERMOST = regex(r"^(?:while|if[ \t]+__name__)\b", re.MULTILINE)
_CALL = regex(r"\b([A-Za-z_]\w*)\b")
_NO_FUNCTIONS = frozenset(("if", "for", "while", "switch", "catch"))
#: So much of a file, and of an argument list, is looked at.
_MAX = 200_000
_ARGUMENTS = 1500
_PARTS = 200
#: The statement that makes a publisher begins so many lines above the call at most.
_ABOVE = 3


def publishes_again(text: str, line: int | None, is_python: bool) -> bool:
    """Whether the file *text* that makes a publisher in *line* publishes with it in a timer, on request or in a loop, or counts subscribers.

    Functions are identified by their names. Where the publisher's name is not seen, every ``publish`` counts as one of it.
    """
    text = text[:_MAX]
    if _ASKS.search(text):
        return True
    name = _name(text, line or 1)
    publish = re.compile(
        rf"\b{re.escape(name)}\b[^\n;=]{{0,100}}?(?:->|\.)\s*publish\s*\(" if name else r"(?:->|\.)\s*publish\s*\("
    )
    functions = _functions(text, is_python)
    parts = islice(chain(_repeated(text), _loops(functions)), _PARTS)
    return any(_reaches(part, functions, publish) for part in parts)


def _name(text: str, line: int) -> str:
    lines = text.splitlines()
    place = "\n".join(lines[max(0, line - 1 - _ABOVE) : line])
    found = list(_PUBLISHER.finditer(place))
    return (found[-1][1] or found[-1][2]) if found else ""


def _reaches(part: str, functions: dict[str, str], publish: re.Pattern[str]) -> bool:
    """Whether *part*, or a function that it names, publishes."""
    todo, seen = [part], set[str]()
    while todo:
        body = todo.pop()
        if publish.search(body):
            return True
        new = {word for word in _CALL.findall(body) if word in functions} - seen
        seen |= new
        todo += [functions[word] for word in new]
    return False


def _repeated(text: str) -> Iterator[str]:
    """The arguments of the calls that have a function run again."""
    for call in _AGAIN.finditer(text):
        yield text[call.end() : _end(text, call.end(), "()", _ARGUMENTS)]


def _loops(functions: dict[str, str]) -> Iterator[str]:
    """What stands from the first loop of a function on, if it waits there."""
    for body in functions.values():
        loop = _LOOP.search(body)
        if loop is not None and _WAITS.search(body, loop.start()):
            yield body[loop.start() :]


@lru_cache(maxsize=32)
def _functions(text: str, is_python: bool) -> dict[str, str]:
    """The bodies of functions by name; of those of one name, together."""
    found: dict[str, str] = {}
    if is_python:
        for head in _DEF.finditer(text):
            below = re.compile(rf"^[ \t]{{0,{len(head[1])}}}\S", re.MULTILINE)
            next_one = below.search(text, head.end())
            body = text[head.end() : next_one.start() if next_one is not None else len(text)]
            found[head[2]] = found.get(head[2], "") + body
        outermost = _OUTERMOST.search(text)  # a script has its loop there
        found[""] = text[outermost.start() :] if outermost is not None else ""
        return found
    at = 0
    while opened := _FUNCTION.search(text, at):
        at = opened.end()
        if opened[1] not in _NO_FUNCTIONS:
            end = _end(text, at, "{}", len(text))
            found[opened[1]] = found.get(opened[1], "") + text[at:end]
            at = end
    return found


def _end(text: str, start: int, signs: str, most: int) -> int:
    """Where what was opened before *start* is closed, at most *most* characters behind."""
    depth = 1
    for at in range(start, min(len(text), start + most)):
        depth += (text[at] == signs[0]) - (text[at] == signs[1])
        if not depth:
            return at
    return min(len(text), start + most)
