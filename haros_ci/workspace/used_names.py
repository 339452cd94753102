# SPDX-License-Identifier: Apache-2.0
"""Names of files in the texts of C++, CMake and setup.py, by which code may be included, compiled or installed; nothing is evaluated."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Iterator

from haros_ci.regex import regex
from haros_ci.workspace.language import language_of

#: What is put behind the name of a file of which a build makes one: CMake's, empy's, Jinja's.
TEMPLATES = frozenset(("in", "em", "template", "tmpl", "tpl", "j2", "jinja", "jinja2"))
CODE = frozenset(("cpp", "python"))
PIECE = regex(r"[\w.+-]{1,255}")
STRING = regex(r"[\"']([^\"'\n]{1,1000})[\"']")

#: What may stand between the words of a directive, once lines are spliced.
_GAP = r"(?:[ \t\f\v]|/\*(?:[^*\n]|\*(?!/)){0,1000}\*/)*"
_HASH = rf"^{_GAP}(?:#|%:|\?\?=){_GAP}"
_INCLUDE = regex(rf"{_HASH}(?:include|import|embed)[^\"<\n]{{0,1200}}[\"<]([^\">\n]{{1,5000}})", re.M)
_DEFINE = regex(rf"{_HASH}define[^\"<\n]{{0,200}}[\"<]([^\">\n]{{1,1000}})[\">]", re.M)
#: An #include that a macro makes: then any name in the file may be what it makes.
_COMPUTED = regex(rf"{_HASH}include(?:_next)?{_GAP}[A-Za-z_]\w*", re.M)
_SPLICE = regex(r"(?:\\|\?\?/)[ \t\f\v]*\r?\n")
_COMMENT = regex(r"/\*[^*]*(?:\*(?!/)[^*]*)*\*/")

#: What makes CMake compile, or include, a file whatever its name is.
_AS_CODE = regex(
    r"(?<![\w])LANGUAGE(?:\s|#[^\n]{0,200}(?:\n|\]\]))+[\"\[=]{0,9}(?:C|CXX|CUDA|OBJC|OBJCXX)\b"
    r"|(?<![\w-])(?:-x\s*(?:;\s*)?\"?c\b|-xc|--?include\b|--?imacros\b|--language|/FI|@[\w./${}-]{1,200})"
)
_FILLED = regex(
    r"\b(?:configure_file|em_expand|em_expand_template|expand_template)\s*\(([^()]{1,2000})\)|GENERATE\s+OUTPUT\s+([^()]{1,2000})",
    re.I,
)
_PROGRAMS = regex(r"\bcatkin_install_python\s*\(([^()]{1,20000})\)|\bPROGRAMS\b([^()]{1,20000})", re.I)
_COMMAND = regex(r"\b([A-Za-z_]\w{0,100})[ \t]*\(([^()]{1,20000})\)")
_IDLE = frozenset(
    "install message project ament_export_include_directories include_directories set_directory_properties".split()
)
_WORD = regex(r"[^\s\"';()]{1,1000}")
#: The headers that a form of Qt names (doc.qt.io, "UI File Format"), entities of XML in their names, too.
_OF_FORM = regex(
    r"<(?:header|include)\b[^<>]{0,400}>\s*([^<>]{1,400}?)\s*<|<include\s[^<>]{0,400}location=\"([^\"<>]{1,400})\""
)
#: What has C++ compiled for Python.
_EXTENSIONS = regex(r"\b(?:Extension|ext_modules|extra_compile_args|Pybind11Extension)\b")


def included(text: str) -> Iterator[str]:
    if "\\" in text or "??/" in text:
        text = _SPLICE.sub("", text)
    yield from _INCLUDE.findall(text)
    if "/*" in text:  # where comments of several lines stand between the words of a directive
        text = _COMMENT.sub(" ", text)
        yield from _INCLUDE.findall(text)
    if _COMPUTED.search(text):
        yield from _DEFINE.findall(text)


def perhaps_included(text: str) -> Iterable[str]:
    """Any word, where a macro makes the name of what is included."""
    if "\\" in text or "??/" in text:
        text = _SPLICE.sub("", text)
    return PIECE.findall(text) if _COMPUTED.search(text) else ()


def compiled(text: str) -> Iterable[str]:
    return (word for word in _WORD.findall(text) if "." in word or "/" in word) if _AS_CODE.search(text) else ()


def named(text: str) -> Iterable[str]:
    """All that may be the name of a file."""
    return (word for word in PIECE.findall(text) if "." in word)


def of_extensions(text: str) -> Iterable[str]:
    """What a setup.py names that has extensions compiled."""
    return STRING.findall(text) if _EXTENSIONS.search(text) else ()


def of_form(text: str) -> Iterator[str]:
    for pair in _OF_FORM.findall(text):
        yield from (html.unescape(name) for name in pair if name)


def filled(text: str) -> Iterator[str]:
    for pair in _FILLED.findall(text):
        words = _WORD.findall(" ".join(pair))
        made = [language_of(word.rpartition("/")[2]) for word in words]
        for word in words:
            stem, _, suffix = word.rpartition("/")[2].rpartition(".")
            if CODE & {*made} or (suffix.lower() in TEMPLATES and language_of(stem) in CODE):
                yield word


def taken(text: str) -> Iterator[str]:
    """What commands are given that may copy, read or compile it under another name: all but those that install or say something."""
    for name, words in _COMMAND.findall(text):
        if name.lower() not in _IDLE:
            yield from (word for word in _WORD.findall(words) if "." in word)


def programs(text: str) -> Iterator[str]:
    for one, other in _PROGRAMS.findall(text):
        yield from _WORD.findall(one or other)
    for name, words in _COMMAND.findall(text):
        if name.lower() == "install" and "_EXECUTE" in words:
            yield from (word for word in _WORD.findall(words) if "." in word or "/" in word)
