# SPDX-License-Identifier: Apache-2.0
"""C++: texts that are searched and changed by positions, and loops that clean names."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import PUB, component, explicit

CLEAN = """
std::string clean(const std::string & name) {
  std::string clean = name;
  size_t pos = clean.find("//");
  while (pos != std::string::npos) { clean.erase(pos, 1); pos = clean.find("//", pos); }
  if (!name.empty() && *clean.rbegin() == '/') { clean.erase(clean.size() - 1, 1); }
  return clean;
}
"""


@pytest.mark.parametrize(
    ("code", "name"),
    (
        ('clean("a//b")', "/a/b"),
        ('clean("//a///b//")', "/a/b"),
        ('clean("a/b")', "/a/b"),
    ),
)
def test_names_are_cleaned_in_a_loop(code: str, name: str) -> None:
    assert [end.name for end in explicit(component(f"{PUB}({code}, 1);", before=CLEAN))] == [name]


@pytest.mark.parametrize(
    ("code", "name"),
    (
        ('std::string s = "abcd"; s.erase(1, 2);', "/ad"),
        ('std::string s = "abcd"; s.erase(2);', "/ab"),
        ('std::string s = "abcd"; s.insert(1, "xy");', "/axybcd"),
        ('std::string s = "abcd"; s.replace(1, 2, "_");', "/a_d"),
        ('std::string s = "abcd"; s.replace(s.find("bc"), 2, "-x");', "/a-xd"),
        ('std::string s = "abcd"; s.resize(3);', "/abc"),
        ('std::string s = "a.b.c"; s = s.substr(s.find(".", 2) + 1);', "/c"),
        ('std::string s = "a.b/c"; s = s.substr(s.find_last_of("./") + 1);', "/c"),
        ('std::string s = "__a"; s = s.substr(s.find_first_not_of("_"));', "/a"),
        ('std::string s = "a.b.c"; s = s.substr(0, s.rfind(".", 2));', "/a"),
    ),
)
def test_texts_are_changed_by_positions(code: str, name: str) -> None:
    assert [end.name for end in explicit(component(f"{code} {PUB}(s, 1);"))] == [name]


@pytest.mark.parametrize(
    "code",
    (
        'std::string s = "abcd"; s.erase(s.begin());',
        'std::string s = "abcd"; s.erase(9);',
        'std::string s = "abcd"; s.erase(std::remove(s.begin(), s.end(), 97), s.end());',
        'std::string s = "abcd"; s.replace(s.begin(), s.end(), "x");',
        'std::string s = "abcd"; s.resize(declare_parameter<int>("n"));',
        'std::string s = "abcd"; while (declare_parameter<bool>("m")) { s.erase(0, 1); }',
    ),
)
def test_changes_that_are_not_known(code: str) -> None:
    assert [end.name for end in explicit(component(f"{code} {PUB}(s, 1);"))] == ["/?"]
