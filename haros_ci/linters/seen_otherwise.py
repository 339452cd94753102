# SPDX-License-Identifier: Apache-2.0
"""What a change brings that cppcheck is given in another way than the compiler: notes, so that somebody looks there.

cppcheck does not read what ``#include NAME`` includes (:mod:`inclusions`), nor the arguments of macros of ROS that stand for nothing
(:mod:`ros_macros`): code there is compiled, if the workspace gives such a macro another meaning, and has no findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.linters import macro_scan, pasted_names, ros_macros
from haros_ci.linters.dead_text import dead, joined
from haros_ci.linters.linked_names import linked_names
from haros_ci.linters.macro_scan import is_decoration
from haros_ci.linters.macros_elsewhere import MacrosElsewhere, brought
from haros_ci.linters.meanings import SPELLED
from haros_ci.linters.spelled_conditions import odd_conditions, odd_lines
from haros_ci.linters.version_conditions import version_conditions
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

#: Files that are named; the rest is counted. And characters of what is quoted, and of the arguments that are looked at.
MOST_FILES = 20
_QUOTED = 80
_LONGEST = 20_000
_COMPUTED = regex(r"^[ \t]*(?:#|%:)[ \t]*(?:include(?:_next)?|import)[ \t]*([A-Za-z_]\w*[^\n]*)", re.M)
_DEFINED = regex(r"^[ \t]*(?:#|%:)[ \t]*define[ \t]+([A-Za-z_]\w*)(\([^()\n]*\))?([^\n]*)", re.M)
#: A condition on a name, and the one directive that may stand under it alone: that which defines the name, or takes it back.
_TESTED = regex(
    r"^[ \t]*(?:#|%:)[ \t]*(?:ifn?def[ \t]+|(?:el)?if\b[^\n]{0,200}?\bdefined\b[ \t(]*)([A-Za-z_]\w*)[^\n]*\n"
    r"(?P<own>(?:[ \t]*(?://[^\n]*)?\n)*[ \t]*(?:#|%:)[ \t]*(?:define|undef)[ \t]+\1\b[^\n]*\n(?:[ \t]*(?://[^\n]*)?\n)*[ \t]*(?:#|%:)[ \t]*endif\b)?",
    re.M,
)
#: A comment whose end is written over two lines; a line that goes on behind other white space than blanks, or by a trigraph; what is taken for an assembler's.
_OVER_LINES = regex(r"\*(?:(?:\\|\?\?/)[ \t\f\v]*\r?\n[ \t\f\v]*)+/")
#: One that begins so; texts and other comments are passed over.
_OVER_BEGIN = regex(r"/(?:(?:\\|\?\?/)[ \t]*\r?\n)+[/*]")
_BEGINS = regex(
    r"\"(?:[^\"\\\n]|\\[\s\S])*\"|'(?:[^'\\\n]|\\[^\n]){1,12}'|//(?:[^\n\\]|\\[ \t]*\r?\n|\\)*|/\*(?:[^*]|\*(?!/))*(?:\*/|\Z)"
    rf"|({_OVER_BEGIN.pattern})"
)
_ODD_SPLICE = regex(r"(?:\\|\?\?/)[ \t]*[\f\v][ \t\f\v]*\r?\n")
_TRIGRAPH_SPLICE = regex(r"\?\?/[ \t]*\r?\n")
_TRIGRAPH = regex(r"\?\?[=/'()!<>-]")
_ASSEMBLER = regex(r"(?<!\w)(?:_asm\b|__asm\s*\{)")
#: Pragmas that change warnings, speed, threads and layouts; all others may change what a word stands for, or what is read (GCC, "Pragmas").
_PRAGMA = regex(
    r"^[ \t]*(?:#|%:)[ \t]*pragma\b([^\n]*)|(?<!\w)(?:_Pragma|__pragma)\s*\(\s*(?:L?\"((?:[^\"\\\n]|\\.)*)\"|([^\n]{0,200}))",
    re.M,
)
_ANY_MACRO = regex(r"\b(?:push|pop)_macro\b")
_USUAL_PRAGMA = regex(
    r"\s*(?:once|(?:GCC|clang|gcc)\s+(?:diagnostic|system_header|visibility|optimize|target|ivdep|unroll|push_options|pop_options|reset_options|warning|error|loop|fp|attribute)\b"
    r"|(?:omp|acc|warning|pack|region|endregion|unroll|nounroll|message|STDC|ident|comment|simd|ivdep|vector|novector|loop_count|prefetch|HLS|hls|hd_warning_disable|nv_\w+|diag_\w+"
    r"|intel|optimize|float_control|fenv_access|fp_contract|mark|NOLINT\w*|nvtx|vtordisp|deprecated|inline_depth|inline_recursion|auto_inline|check_stack|hdrstop|managed|unmanaged|error|always_inline"
    r"|arm|DATA_SECTION|CODE_SECTION|link|cling|ide|code_seg|data_seg|bss_seg|const_seg|section|init_seg|function|intrinsic|runtime_checks|strict_gs_check|pointers_to_members|component"
    r"|clang_tidy|pylint|cppcheck|scalar_storage_order|no_inline|noinline|forceinline|distribute_point|parallel|block_loop|unused|weak)\b|\s*\Z)"
)
#: Without one of these, and a directive, nothing of this is in a text.
_WORDS_OF_NAMES = ("ragma", "asm", "attribute", "[[")
#: The number of a line that a directive sets, which tools are not given.
_LINE = regex(r"^[ \t]*(?:#|%:)[ \t]*(?:line[ \t]+)?\d", re.M)
#: Words that are there if a macro has more arguments: cppcheck counts one that is empty when it is expanded ([cpp.subst]). A comma alone is usual.
_OPTIONAL = regex(r"\b__VA_OPT__\s*\((?!\s*(?:,\s*)?\))")
#: A parameter that is called as a directive, and is made a text: in copies that tools get that is none (:mod:`inclusions`).
_MADE_TEXT = regex(
    r"^[ \t]*(?:#|%:)[ \t]*define[ \t]+\w+\([^()\n]{0,400}?\b(include|include_next|import|embed|pragma)\b[^()\n]{0,400}\)[^\n]{0,2000}?(?:#|%:)[ \t]*\1\b",
    re.M,
)
_CALL = regex(r"\b([A-Z]\w{3,80})[ \t]*\(")
_TOKEN = regex(r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,12}'|[(){};]")
#: What a decoration can mean without being code: attributes, words, other macros.
_WORDS = regex(
    r"(?:\s|\w|\"C\"|\[\[[^\[\]{};]{0,200}\]\]|(?:__attribute__|__attribute|__declspec)\s*\((?:[^(){};]|\((?:[^(){};]|\([^(){};]{0,200}\)){0,200}\)){0,400}\)|__pragma\s*\([^{};]{0,200}\))*"
)
_SPELLED = regex(rf"\b(?:{'|'.join(sorted(SPELLED))})\b")
#: Macros that cppcheck is given without a meaning, those with arguments and all; and all that it is given whatever the code says.
_WITH_ARGUMENTS = frozenset(name.partition("(")[0] for name in ros_macros.empty() if name.endswith("(...)"))
_EMPTY = frozenset(name.partition("(")[0] for name in ros_macros.empty())
_GIVEN = ros_macros.stand_ins()
#: A name that may be a decoration or a registration by its form, and is no guard.
_LIKE_ONE = regex(r"(?!\w*(?:_H|_HPP|_HH|_HXX|_INCLUDED|_VERSION\w*)_*\Z)[A-Z][A-Z0-9]*_[A-Z0-9_]*[A-Z0-9]")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each C++ file of *head* that has such code, which nothing in *base* has in the same words; none without a base."""
    if base is None:
        return ()
    found = sorted(_brought(head, base))
    rest = len(found) - MOST_FILES
    text = f"{rest} more files have code that cppcheck is given in another way than the compiler"
    return (
        *(Notification(Level.NOTE, f"{words}; look at it", path=path) for path, words in found[:MOST_FILES]),
        *([Notification(Level.NOTE, text)] if rest > 0 else []),
    )


def _brought(head: Workspace, base: Workspace) -> Iterator[tuple[str, str]]:
    """Each file of *head* that is read in another way than in *base*, and what of it, in words."""
    after, before = _Sight(head), _Sight(base)
    old = {file.path: file for file in before.files()}
    moved: set[Mark] | None = None
    for file in _affected(after, before, old):
        if not head.reports_on(file.path):
            continue
        marks = list(dict.fromkeys(after.marks(file)))
        if not marks:
            continue
        if moved is None:
            gone = old.keys() - {file.path for file in head.files}
            moved = {mark for path in gone for mark in before.marks(old[path])}
        known = {*moved, *(before.marks(old[file.path]) if file.path in old else ())}
        if new := [mark[0] for mark in marks if mark not in known]:
            more = f", and {len(new) - 1} more" if len(new) > 1 else ""
            yield file.path, f"since this change cppcheck is given {new[0]} in another way than the compiler{more}"


def _affected(after: _Sight, before: _Sight, old: dict[str, SourceFile]) -> list[SourceFile]:
    """The C++ files that changed, but for those that were only moved; then those that use a macro that means something else now."""
    every = after.files()
    edited = [file for file in every if file.path not in old or old[file.path].digest != file.digest]
    if not edited and before.has_same_builds(after):
        return []
    known = {file.digest for file in old.values()}
    changed = [file for file in edited if file.path in old or file.digest not in known]
    users = pasted_names.pattern(brought(after.elsewhere, before.elsewhere, edited, old))
    if not users:
        return changed
    others = (file for file in every if file not in changed)
    return [*changed, *(file for file in others if users.search(after.workspace.text(file.path)))]


#: What is seen otherwise, in words, and what it stands for.
Mark = tuple[str, str]


class _Sight:
    """How cppcheck sees the files of a *workspace*, and a compiler does not."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace
        self.elsewhere = MacrosElsewhere(workspace)

    def files(self) -> list[SourceFile]:
        """Those of C++."""
        return [file for file in self.workspace.files if file.language == "cpp"]

    def has_same_builds(self, other: _Sight) -> bool:
        mine, yours = self.elsewhere, other.elsewhere
        return not mine.templates and not yours.templates and mine.forced == yours.forced

    def marks(self, file: SourceFile) -> Iterator[Mark]:
        text = self.workspace.text(file.path)
        yield from ((words, "") for words in seen_otherwise(text))
        yield from ((words, "") for words in self._tested(text))
        yield from ((words, "") for words in pasted_names.pasted(file, self.workspace, self.elsewhere))
        yield from self.elsewhere.used(file)

    def _tested(self, text: str) -> Iterator[str]:
        """Conditions on names that cppcheck is given without a meaning, as the workspace uses them as decorations or registrations."""
        if "if" not in text:
            return
        asked = {match[1] for match in _TESTED.finditer(_code(text)) if match["own"] is None}
        for name in sorted(name for name in asked - _GIVEN if _LIKE_ONE.fullmatch(name)):
            texts = (self.workspace.text(file.path) for file in self.files())
            marks = {mark for text in texts if name in text for mark in macro_scan.marks(text)}
            if name in macro_scan.decorations(marks) or name in macro_scan.registrations(marks):
                yield f"a condition on {name}, which it takes for nothing,"


def seen_otherwise(text: str) -> Iterator[str]:
    """What *text* has of this, quoted, in its order by kind; takes linear time."""
    yield from _spellings(text)
    if (
        "#" not in text
        and not any(word in text for word in _WORDS_OF_NAMES)
        and "%:" not in text
        and not any(name in text for name in _WITH_ARGUMENTS)
    ):
        return
    text = _code(text)
    yield from (f"'#include {_quoted(match[1])}'" for match in _COMPUTED.finditer(text))
    yield from _pragmas(text)
    yield from _of_compilers(without_comments(text, "c"))
    if "__LINE__" in text and _LINE.search(text) is not None:
        yield "the number of a line, which a directive sets,"
    yield from _macros(text)
    done = 0
    for match in _CALL.finditer(text):
        if match[1] in _WITH_ARGUMENTS and match.start() >= done:
            has_code, done = _read(text, match.end())
            if has_code:
                yield f"code in the arguments of {match[1]}"


def _of_compilers(text: str) -> Iterator[str]:
    """What a compiler, or the linker behind it, decides otherwise; *text* is without comments."""
    yield from linked_names(text)
    yield from version_conditions(text)
    yield from odd_conditions(text)
    if "__VA_OPT__" in text and _OPTIONAL.search(text) is not None:
        yield "what stands in __VA_OPT__"
    yield from (f"the parameter {match[1]} of a macro" for match in _MADE_TEXT.finditer(text))


def _spellings(text: str) -> Iterator[str]:
    """What is written in a way that cppcheck reads as something else."""
    if _OVER_LINES.search(text) is not None:
        yield "a comment whose end is written over two lines"
    if _OVER_BEGIN.search(text) is not None and any(match[1] for match in _BEGINS.finditer(text)):
        yield "a comment whose beginning is written over two lines"
    yield from odd_lines(text)
    if _ODD_SPLICE.search(text) is not None:
        yield "a line that goes on behind a form feed or vertical tab"
    if "??" in text and (_TRIGRAPH_SPLICE.search(text) or _TRIGRAPH.search(without_comments(text, "c"))):
        yield "a trigraph"
    if _ASSEMBLER.search(text) is not None:
        yield "the name _asm, which it takes for an assembler's block,"


def _macros(text: str) -> Iterator[str]:
    """Macros whose meaning, and conditions whose answer, cppcheck is given another one."""
    guarded = {match[1] for match in _TESTED.finditer(text)}
    for match in _DEFINED.finditer(text):
        name, meaning = match[1], match[3].strip()
        if name not in guarded or not (name in _GIVEN or is_decoration(name)) or not meaning:
            continue
        if name in _GIVEN and name not in _EMPTY:
            yield f"the macro {name}, which it takes for another one,"
        elif match[2] or _may_be_code(meaning):
            yield f"the macro {name}, which it takes for nothing,"
    for match in _TESTED.finditer(text):
        if match[1] in _GIVEN and match["own"] is None:
            yield f"a condition on {match[1]}, which it is given,"


def _may_be_code(meaning: str) -> bool:
    """Whether the meaning of a macro is more than a decoration's."""
    return _WORDS.fullmatch(meaning[:_LONGEST]) is None or _SPELLED.search(meaning) is not None


def _pragmas(text: str) -> Iterator[str]:
    for match in _PRAGMA.finditer(text):
        words = next(group for group in match.groups() if group is not None)
        if not _USUAL_PRAGMA.match(words):
            yield f"the pragma '{_quoted(words)}'"
    if (found := _ANY_MACRO.search(text)) is not None:
        yield f"the pragma {found[0]}"


def _code(text: str) -> str:
    """*text* with spliced lines joined, and without comments, raw texts and what is written false."""
    text = joined(text)
    parts, at = [], 0
    for start, end in dead(text):
        parts.append(text[at:start] + " ")
        at = end
    return "".join((*parts, text[at:]))


def _read(text: str, at: int) -> tuple[bool, int]:
    """Whether the arguments that begin there hold a statement or a block, and how far that was looked for."""
    depth = 1
    for match in _TOKEN.finditer(text, at, at + _LONGEST):
        depth += {"(": 1, ")": -1}.get(match[0], 0)
        if depth == 0 or match[0] in ("{", ";"):
            return depth > 0, match.end()
    return False, at + _LONGEST


def _quoted(text: str) -> str:
    plain = " ".join(text.split())
    return plain if len(plain) <= _QUOTED else plain[:_QUOTED] + "…"
