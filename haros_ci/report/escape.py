# SPDX-License-Identifier: Apache-2.0
"""Escaping for each sink: names, messages and source lines are chosen by whoever wrote the analysed code."""

from __future__ import annotations

import json
import re

from haros_ci.regex import regex

REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
_BREAK = "\N{ZERO WIDTH SPACE}"

#: C0, DEL and C1 controls, line and paragraph separators, bidirectional controls, surrogates, Unicode tags.
_UNSAFE = "\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufff9-\ufffb\U000e0000-\U000e007f"
#: How commands to a runner begin, anywhere in a line of the log: GitHub's older ones (actions/runner, ActionCommand.cs), those of Azure Pipelines
#: ("Logging commands"), and TeamCity's ("Service messages").
_COMMAND = r"(?<=##)\[|(?i:(?<=##vso)\[)|(?i:(?<=##teamcity)\[)"
_COMMANDS = regex(_COMMAND)
_MARK = "##"
_UNSAFE_IN_TEXT = regex(f"[{_UNSAFE}]|{_COMMAND}")
_UNSAFE_IN_LINE = regex(f"[{_UNSAFE}\n]|{_COMMAND}")
_HEAD = regex(r"^([^\S\n]*):(?=:)", re.MULTILINE)
#: Punctuation that forms something, and what GitHub and GitLab make links of: ``www.``, ``GH-1``.
_MARKDOWN_ACTIVE = regex(r"[!#$&()*+:<=>@\[\\\]^_`{|}~]|(?<=[wW]{3})\.|(?<=GH)-(?=\d)")
_ADDRESS_OF_PAGE = regex(r"https?://[A-Za-z0-9][A-Za-z0-9._~:/?#\[\]@!$&'()*+,;=%-]*")
_MAIL = regex(r"(?<=[\w.+-])&#64;(?=\w)")


def terminal(text: str) -> str:
    """One line that moves no cursor: every control or bidi character becomes U+FFFD, one for one, a tab a space.

    So does the bracket of ``##[``, ``##vso[`` and ``##teamcity[``, which begin commands to runners.
    """
    if text.isprintable() and _MARK not in text:
        return text
    return _UNSAFE_IN_LINE.sub(REPLACEMENT, text.replace("\t", " "))


def log_line(text: str) -> str:
    """As ``terminal``, for a whole line: one that begins with ``::`` is taken for a workflow command, and gets a ``./``."""
    return inert(terminal(text))


def inert(line: str) -> str:
    """*line* with a ``./`` before a ``::`` at its head, behind blanks: there a GitHub runner takes it for a command (actions/runner, ActionCommand.cs)."""
    rest = line.lstrip()
    return f"{line[: len(line) - len(rest)]}./{rest}" if rest.startswith("::") else line


def multiline(text: str) -> str:
    """As ``terminal``, but newlines and tabs stay and CR LF becomes LF."""
    if text.isprintable() and _MARK not in text:
        return text
    return _UNSAFE_IN_TEXT.sub(REPLACEMENT, text.replace("\r\n", "\n"))


def patch(text: str) -> str:
    """As ``multiline``, for a patch that is read and not applied: a line of context may begin as a workflow command does."""
    return _HEAD.sub(rf"\1{REPLACEMENT}", multiline(text))


def json_document(document: object, indent: int) -> str:
    """*document* as JSON for a file or a log: ASCII alone, so that no name in it moves a cursor or turns a line round, and no command to a runner."""
    return no_command(json.dumps(document, indent=indent, ensure_ascii=True))


def no_command(text: str) -> str:
    """JSON *text* that says the same and is no command to a runner that reads the log."""
    return _COMMANDS.sub(r"\\u005b", text) if _MARK in text else text


def workflow_data(text: str) -> str:
    """The text behind ``::`` of a GitHub workflow command (actions/toolkit, command.ts)."""
    return multiline(text).replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def workflow_property(text: str) -> str:
    """A property value of a GitHub workflow command."""
    return workflow_data(text).replace(":", "%3A").replace(",", "%2C")


def markdown(text: str) -> str:
    """Text that GitHub-flavoured Markdown shows as it stands, also inside a table cell.

    Active punctuation becomes entities, which cannot form links, images, HTML, code or tables. A zero-width space
    behind ``@``, and where an address or the number of an issue would go on, keeps people from being mentioned and
    links from being made, as GitHub and GitLab look for those after rendering.
    """
    return _MARKDOWN_ACTIVE.sub(_entity, terminal(text))


def markdown_code(text: str) -> str:
    """Inline code, also inside a table cell; entities as above, since pipes and backticks end other forms.

    Nobody is mentioned in it, but an address of mail would become a link: only there is a zero-width space.
    """
    written = _MARKDOWN_ACTIVE.sub(lambda match: f"&#{ord(match[0])};", terminal(text))
    return f"<code>{_MAIL.sub(f'&#64;{_BREAK}', written)}</code>"


def web_address(text: str | None) -> str | None:
    """*text* if it is a plain http(s) address: readers make links of it, and GitHub refuses a log with an invalid one."""
    return text if text and _ADDRESS_OF_PAGE.fullmatch(text) else None


def _entity(match: re.Match[str]) -> str:
    character, rest = match[0], match.string[match.end() : match.end() + 2]
    joins = character == "@" or (character == ":" and rest == "//") or (character in "#!" and rest[:1].isdigit())
    return f"&#{ord(character)};{_BREAK if joins or character == '-' else ''}"
