# SPDX-License-Identifier: Apache-2.0
"""A lambda that returns a text copies what a pointer points to; one that returns a view does not."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted

MESSAGE = "Returning object that points to local variable 'p' that will be invalid when returning."
COPIED = [
    "auto f = []() -> std::string {\n  A p;\n  return p.get();\n}();\n",
    "auto f = [&](int a) mutable noexcept -> std::string {\n  return p.get();\n};\n",
    "auto f = []() -> std::string {\n  if (a) {\n    for (;;) {\n      return p.get();\n    }\n  }\n};\n",
    "auto f = []() -> std::string {\n  if (a) { b(); } else {\n      return p.get();\n  }\n};\n",
    'auto f = []() -> std::string { while (a) { use("}"); /* } */ } return p.get(); };\n',
    "auto f() -> std::string {\n  return p.get();\n}\n",
    "auto f = []() -> const std :: string {\n  return p.get();\n};\n",
    "auto f = []() -> ::std::wstring {\n  return p.get();\n};\n",
    "auto f = []() -> std::filesystem::path {\n  return p.get();\n};\n",
    "auto f = []() -> std::optional<std::string> {\n  return p.get();\n};\n",
    "using namespace std;\nauto f = []() -> string {\n  return p.get();\n};\n",
    "using std::string;\nauto f = []() -> string {\n  return p.get();\n};\n",
    "auto f = []() -> QString {\n  switch (a) {\n    case 1: {\n      return p.get();\n    }\n  }\n};\n",
    "auto f = []() -> std::string {\n  try {\n    return p.get();\n  } catch (const E & e) {}\n};\n",
    "auto f = []() -> std::string {\n  auto g = []() { return 1; };\n  // the last\n  const char * c = p.get(); return c;\n};\n",
]
VIEWED = [
    "auto f = []() -> std::string_view {\n  return p.get();\n};\n",
    "auto f = []() -> const char * {\n  return p.get();\n};\n",
    "auto f = []() -> const std::string & {\n  return p.get();\n};\n",
    "auto f = []() -> std::string * {\n  return p.get();\n};\n",
    "auto f = []() -> std::string && {\n  return p.get();\n};\n",
    "auto f = []() -> auto {\n  return p.get();\n};\n",
    "auto f = []() -> decltype(auto) {\n  return p.get();\n};\n",
    "auto f = []() {\n  return p.get();\n};\n",
    "auto f = [] {\n  return p.get();\n};\n",
    "auto f = []() -> string {\n  return p.get();\n};\n",
    "auto f = []() -> my::string {\n  return p.get();\n};\n",
    "auto f = []() -> std::span<char> {\n  return p.get();\n};\n",
    "auto f = []() -> std::vector<const char *> {\n  return {p.get()};\n};\n",
    "std::string f() {\n  auto g = []() {\n    return p.get();\n  };\n}\n",
    "auto f = []() -> std::string {\n  auto g = []() {\n    return p.get();\n  };\n};\n",
    "auto f = []() -> std::string {\n  auto g = []() -> std::string_view { return p.get(); };\n};\n",
    "auto f = []() -> std::string {\n  struct A { char * g() {\n    return p.get();\n  } };\n};\n",
    "auto f = []() -> std::string { return a; }; auto g = []() { return p.get(); };\n",
    "auto f = []() /* -> std::string */ {\n  return p.get();\n};\n",
    "auto f = []()\n#ifdef A\n-> std::string {\n#else\n{\n#endif\n  return p.get();\n};\n",
    "// []() -> std::string {\nauto f = []() {\n  return p.get();\n};\n",
    'const char * t = "() -> std::string {"; auto f = []() {\n  return p.get();\n};\n',
    "return p.get();\n",
]


def line(text: str) -> int:
    return next(number for number, item in enumerate(text.split("\n"), 1) if "p.get()" in item)


@pytest.mark.parametrize("text", COPIED)
def test_a_text_that_is_made_of_the_pointer(text: str) -> None:
    assert is_refuted("returnDanglingLifetime", MESSAGE, line(text), text)
    assert not is_refuted("danglingLifetime", MESSAGE, line(text), text)


@pytest.mark.parametrize("text", VIEWED)
def test_what_still_points_there(text: str) -> None:
    assert not is_refuted("returnDanglingLifetime", MESSAGE, line(text), text)


@pytest.mark.parametrize("filler", ["{ ", "} ", "return ", "() -> ", '"', "/* "])
def test_a_long_line(filler: str) -> None:
    assert not is_refuted("returnDanglingLifetime", MESSAGE, 1, filler * 20_000)


@pytest.mark.parametrize("place", [0, -1, 9])
def test_a_line_outside(place: int) -> None:
    assert not is_refuted("returnDanglingLifetime", MESSAGE, place, COPIED[0])
