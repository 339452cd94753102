# SPDX-License-Identifier: Apache-2.0
"""C++: methods that change a text and give it back by reference, one after the other, and characters that a loop sets."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, follow, main, node


def topics(body: str) -> list[str]:
    found = node(follow(cpp_files(main(body))))
    return [end.name for end in found.endpoints if end.kind == "publishers" and not end.implicit]


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ('s.append("b").append("c");', "/abc"),
        ('s.append("b").insert(0, "z");', "/zab"),
        ('s.append("b").append(2, \'c\').insert(0, "z").erase(1, 1);', "/zbcc"),
        ("s.assign(2, 'k').append(\"1\");", "/kk1"),
        ('s.replace(0, 1, "x").append("y");', "/xy"),
        ('(s += "b") += "c";', "/abc"),
        ('std::string& r = s.append("b"); r += "c";', "/abc"),
        ('std::string t = s.append("b"); t += "c";', "/ab"),
        ('std::string t = std::string("q").append("b").append("c"); s = t;', "/qbc"),
        ('s = s.substr(0, 1).append("b").append("c");', "/abc"),
        ('std::string t = s.substr(0, 1).append("b");', "/a"),
        ('s.append("b"); s.append("c");', "/abc"),
        ('s.append(text()).append("c");', "/a?c"),
        ('s.append("b").erase(text());', "/?"),
    ],
)
def test_methods_in_a_row(changes: str, expected: str) -> None:
    assert topics(f'std::string s = "a"; {changes} ADV(s, 1);') == [expected]


@pytest.mark.parametrize(
    "loop",
    [
        "for (auto& c : s) c = toupper(c);",
        "for (char& c : s) { if (c == 'a') c = 'b'; }",
        "for (auto&& c : s) c = 'b';",
        "for (auto& c : s) change(c);",
        "for (char& c : s) c += 1;",
    ],
)
def test_characters_that_a_loop_sets(loop: str) -> None:
    assert topics(f'std::string s = "a"; {loop} ADV(s, 1);') == ["/?"]


@pytest.mark.parametrize(
    "loop",
    [
        "for (auto c : s) c = toupper(c);",
        "for (const auto& c : s) use(c);",
        "for (auto& c : s) n += c == 'a';",
        "for (auto& c : s) t += toupper(c);",
        "for (auto& c : s) if (isdigit(c)) n = 2;",
        "for (auto& c : t) c = 'x';",
        "for (auto& c : letters) c = 'x';",
    ],
)
def test_loops_that_set_none(loop: str) -> None:
    body = f'std::string s = "a", t = "t"; int n = 0; std::vector<char> letters; {loop} ADV(s, 1);'
    assert topics(body) == ["/a"]
