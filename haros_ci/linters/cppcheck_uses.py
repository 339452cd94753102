# SPDX-License-Identifier: Apache-2.0
"""Loops over files and assignments of C++ of which cppcheck does not see that they are right: the read is checked, the value is copied."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.results.scope import scopes

_HIDDEN = regex(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.){0,1000}\"|'(?:[^'\\\n]|\\.){1,8}'|\bR\"\(.{0,4000}?\)\"", re.DOTALL
)
_LOOP = regex(r"\bwhile\s*\([^;{}]{0,200}?\bfeof\s*\(\s*([\w.>-]{1,80}?)\s*\)[^;{}]{0,80}\)\s*\{")
_READ = r"(?:std\s*::\s*)?(?:w?fgets|fgetws|v?fw?scanf|fread|fgetw?c|getw?c|getline|getdelim)\s*\("
#: A read inside the condition of an ``if``, in a comparison, or behind ``!``.
_TESTED = regex(rf"\bif\s*\((?:[^;{{}}]{{0,200}}?[(!=&|\s])?{_READ}")
#: ``n = fread(…);``, and ``char * line = fgets(…);``.
_KEPT = regex(rf"\b([A-Za-z_]\w*)\s*=\s*(?:\([\w\s*]{{1,40}}\)\s*)?{_READ}")
#: Characters of a loop, and lines above a use, that are looked at.
_LONGEST = 8000
_NEAR = 60
#: ``reply["map"]["file"] = (name + ".yaml").c_str();``
_ELEMENT = regex(
    r"^[ \t]*(?:this[ \t]*->[ \t]*)?([A-Za-z_]\w*)[ \t]*(?:\[[^\]\n]{1,100}\][ \t]*){1,6}=(?!=)[^;\n]{1,300}\.[ \t]*(?:c_str|data)\(\)[ \t]*;"
)
#: Classes that hold values of any kind, and copy the text that they are given.
_HOLDERS = (
    r"(?:nlohmann\s*::\s*(?:ordered_)?json|(?:ordered_)?json|Json\s*::\s*Value|YAML\s*::\s*Node|(?:XmlRpc\s*::\s*)?XmlRpcValue"
    r"|(?:std\s*::\s*)?(?:unordered_)?map\s*<[^<>;{{}}]{{0,80}}?,\s*(?:std\s*::\s*)?string\s*>|(?:std\s*::\s*)?vector\s*<\s*(?:std\s*::\s*)?string\s*>)"
    r"\s*(?:&\s*)?\b{name}\b"
)
#: ``Memory is allocated but not initialized: cells``
_ALLOCATED = regex(r"not initialized: ([A-Za-z_]\w*)")


def is_read_checked(line: int, text: str) -> bool:
    """Whether the body of the loop ``while (!feof(file))`` at *line* looks at what its read returns before it goes on."""
    rest = "\n".join(text.split("\n")[max(line - 1, 0) :])[:_LONGEST]
    rest = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), rest)
    loop = _LOOP.search(rest)
    if loop is None or "\n" in rest[: loop.start()]:
        return False
    body = rest[loop.end() : _closed(rest, loop.end())]
    if _TESTED.search(body):
        return True
    return any(
        re.search(rf"\b(?:if|while)\s*\([^;{{}}]{{0,200}}?\b{kept[1]}\b", body[kept.end() :])
        for kept in _KEPT.finditer(body)
    )


#: What an assignment assigns; what can be a truth value in it; and a variable that is copied to where a pointer points.
_ASSIGNED = regex(r"(?<![=!<>+*/|&^%-])=(?![=])([^;{}]*);")
_TRUTH = regex(r"\b(?:true|false|TRUE|FALSE|not|and|or|bool)\b|[!<>]|==|&&|\|\||\(")
_COPIED = regex(r"\s*\*\s?[A-Za-z_]\w*\s?=\s?([A-Za-z_]\w*)\s?;")
#: Lines above the use of a variable in which its declaration is looked for.
_FAR = 60
#: A reference that is made: its name, and of what.
_MADE_ANEW = regex(r"\b\w*(?:make|create|clone|unique|release|new)\w*\s?[<(]", re.IGNORECASE)
_REFERENCE = regex(r"&\s?([A-Za-z_]\w*)\s?=\s?([^;=][^;]*);")


def has_no_truth_value(line: str) -> bool:
    """Whether nothing on the right of the assignment on *line* can be a truth value: a pointer to a member is copied from a map, say."""
    assigned = _ASSIGNED.search(line[:_LONGEST].replace("->", "."))
    return assigned is not None and _TRUTH.search(assigned[1]) is None


def is_array_that_is_copied(line: int, text: str) -> bool:
    """Whether *line* assigns a local ``std::array``, which is copied as a whole: cppcheck takes it for a C array, of which the address is kept."""
    lines = text.split("\n")
    assigned = _COPIED.match(lines[line - 1][:_LONGEST]) if 0 < line <= len(lines) else None
    if assigned is None:
        return False
    declared = re.compile(rf"\b(?:std::)?array\s?<[^;]{{0,200}}>\s?{assigned[1]}\b")
    before = (lines[number - 1][:_LONGEST] for number in range(line - 1, max(line - _FAR, 0), -1))
    return any(declared.search(other) for other in before)


def is_copied(line: int, text: str) -> bool:
    """Whether what is used at *line* has been given the text of a temporary above, as an element of a class that copies it (JSON, YAML, strings)."""
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    inside = scopes(text, "cpp")
    here = set(re.findall(r"[A-Za-z_]\w*", lines[line - 1][:_LONGEST]))
    for number in range(max(line - _NEAR, 1), line):
        made = _ELEMENT.match(lines[number - 1][:_LONGEST])
        if made and made[1] in here and inside.at(number) == inside.at(line):
            return re.search(_HOLDERS.format(name=made[1]), text) is not None
    return False


def is_pointed_to(line: int, text: str) -> bool:
    """Whether what is used at *line* is a reference to what a pointer points to: ``auto & x = made()[0]->part;``, or one made of such a one.

    A temporary that held the pointer has gone, what it points to has not, unless that was made for it.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    names = set(re.findall(r"[A-Za-z_]\w*", lines[line - 1][:_LONGEST]))
    for number in range(line - 1, max(line - _NEAR, 0), -1):
        made = _REFERENCE.search(lines[number - 1][:_LONGEST])
        if made is None or made[1] not in names:
            continue
        if _is_pointed_at(made[2]):
            return _MADE_ANEW.search(made[2]) is None
        names |= set(re.findall(r"[A-Za-z_]\w*", made[2]))
    return False


def _is_pointed_at(value: str) -> bool:
    """Whether *value* as a whole is what a pointer points to, ``made()[0]->part``: not an argument of a call, nor an operand."""
    depth = 0
    arrow = None
    for found in re.finditer(r"[\])]\s?->|[()\[\]]", value):
        depth += {"(": 1, "[": 1}.get(found[0][0], -1)
        if depth == 0 and found[0].endswith("->"):
            arrow = found.end()
    return (
        arrow is not None
        and re.fullmatch(r"\s?\w+(?:\s?(?:\.|->)\s?\w+|\s?\[[^\[\]]*\]|\s?\([^()]*\))*\s?", value[arrow:]) is not None
    )


#: What a comment says of a declaration that is there to be compiled, or for what its constructor does.
_MEANT = regex(
    r"\b(?:should|must|shall|has to|needs to|does|just|only)(?: (?:not|still|also|just|always))? compile\b|\bcompiles\b"
    r"|\bcompil\w{1,6} (?:check|test)\b|\b(?:intentional|deliberate)(?:ly)?\b|\bon purpose\b",
    re.IGNORECASE,
)
_REMARK = regex(r"//([^\n]*)|/\*(.{0,2000}?)\*/", re.DOTALL)
_TEST = regex(
    r"\b(?:TYPED_)?(?:TEST(?:_F|_P|_CASE|_METHOD)?|BOOST_AUTO_TEST_CASE|BOOST_FIXTURE_TEST_CASE)\s*\([^{};]{0,300}\)\s*\{"
)
#: Template arguments without others inside, and so deep they stand in one another.
_TEMPLATE = regex(r" ?<[^<>;{}]{0,200}>")
_NESTED = 4
#: ``Type name;``, ``Type name(1, 2);``, ``Type name{};``, and ``using Type = Other;``, with single spaces and no template arguments.
_DECLARED = regex(
    r" ?(?!(?:return|delete|throw|goto)\b)(?:using [\w:<>, =]{1,200}|(?:[\w:]{1,200}[ *&]{1,4}){1,4}\w{1,200}"
    r" ?(?:\([^;{}]{0,200}\)|\{[^;{}]{0,200}\})?) ?;"
)


def is_meant(line: int, text: str) -> bool:
    """Whether the variable that is declared at *line* is there for its declaration: a comment at it says so, or a test has nothing else."""
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    above = lines[line - 2].strip()[:_LONGEST] if line > 1 else ""
    near = [lines[line - 1][:_LONGEST], above if above.startswith(("//", "/*", "*")) else ""]
    if any(_MEANT.search(remark[0] or remark[1]) for other_text in near for remark in _REMARK.findall(other_text)):
        return True
    return _is_test_of_declarations(line, lines)


def _is_test_of_declarations(line: int, lines: list[str]) -> bool:
    """Whether the test around *line* holds declarations alone: what it tests is that they compile, and that nothing is thrown."""
    first = max(line - _NEAR, 0)
    near = "\n".join(item[:_LONGEST] for item in lines[first : line + _NEAR])
    near = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), near)
    here = sum(len(part) + 1 for part in near.split("\n")[: line - 1 - first])
    shut = near.find("\n", here) if "\n" in near[here:] else len(near)
    test = None
    for test in _TEST.finditer(near, 0, shut):  # noqa: B007 - the last one is used below
        pass
    end = _closed(near, test.end()) if test is not None else None
    if test is None or end is None or end < here:
        return False
    body = re.sub(r"\s+", " ", near[test.end() : end])
    for _ in range(_NESTED):
        body = _TEMPLATE.sub("", body)
    at = 0
    while declared := _DECLARED.match(body, at):
        at = declared.end()
    return at > 0 and not body[at:].strip()


def _closed(text: str, start: int) -> int | None:
    """Where the bracket stands that closes the block whose text begins at *start*."""
    depth = 1
    for brace in re.finditer(r"[{}]", text[start:]):
        depth += 1 if brace[0] == "{" else -1
        if depth == 0:
            return start + brace.start()
    return None


def is_given_back(message: str, line: str) -> bool:
    """Whether *line* frees, and does no more to, what *message* says is allocated and not initialized: nothing of it is read.

    Objects of a class have their constructors run and their destructors after it; cppcheck reports arrays and structures of numbers too.
    """
    name = _ALLOCATED.search(message)
    if name is None:
        return False
    called = re.escape(name[1])
    freed = rf"\b(?:delete\s*(?:\[\s*\])?\s*\(?|(?:std\s*::\s*)?free\s*\()\s*{called}\b(?!\s*(?:\[|->|\.))"
    rest = re.sub(freed, "", line[:_LONGEST])
    if rest == line[:_LONGEST]:
        return False
    tested = re.sub(r"\bif\s*\([^()]{0,200}\)", "", rest)
    return re.search(rf"\b{called}\b(?!\s*=(?!=))", tested) is None
