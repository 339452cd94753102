# SPDX-License-Identifier: Apache-2.0
"""Directives and conditions that cppcheck would read otherwise than a compiler: the code under them is found, or named."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hostile_kit import Outcome, Trap

CODE = "int {name}(int x)\n{{\n  int * unset = nullptr;\n  return *unset + x;\n}}\n"
#: Before the code, by the file; the exit code of each would be 0.
FOUND = {
    "a_true": "#if true\n",
    "a_binary": "#if 0b11 == 3\n",
    "a_grouped": "#if 1'0 == 10\n",
    "a_signs": "#if !!defined(__linux__)\n",
    "a_backslashes": "#define A \\\\\n\n#if 1\n",
    "a_digraph": "%:define local kept\n#if 1\n",
    "a_behind": "/* why\n*/ %:if 1\n",
    "a_blanked": "#if 1 // \\ #include\n",
    "a_feature": "#if __cpp_lambdas >= 200907L\n",
    "a_library": "#ifdef __cpp_lib_optional\n",
    "a_processor": "#if defined(__SSE2__) && __INT64_MAX__ > 0\n",
    "a_system": "#ifdef linux\n",
}
NAMED = {
    "b_unsigned": "#if -1 > 0u\n",
    "b_signs": "#if - -1\n",
    "b_comma": "#if (0, 1)\n",
    "b_has": "#if __has_include(<vector>)\n",
    "b_begins": "#if 0\n/\\\n/ /*\n#endif\n#if 1\n",
}
QUIET = {
    "c_false": "#if false\n",
    "c_plain": "#ifndef __linux__\n",
    "c_new": "#if __cpp_lambdas > 209901L\n",
}
ASKED = "#if __has_include(<tf2/a.hpp>)\n#include <tf2/a.hpp>\n#else\n#include <tf2/a.h>\n#endif\n"


@pytest.fixture(scope="module")
def outcome(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Outcome]:
    place = tmp_path_factory.mktemp("conditions")
    trap = Trap(place, place / "cache")
    trap.use_cheap_control()
    trap.commit()
    for name, before in (FOUND | NAMED | QUIET).items():
        trap.write(f"src/{name}.cpp", f"{before}{CODE.format(name=name)}#endif\n")
    trap.write("src/c_asked.cpp", f"{ASKED}int asked(int x)\n{{\n  return x;\n}}\n")
    trap.commit()
    yield trap.run("--baseline-rev=HEAD~1")


@pytest.mark.parametrize("name", FOUND)
def test_it_is_found(outcome: Outcome, name: str) -> None:
    assert outcome.code == 1
    assert (f"src/{name}.cpp", "nullPointer") in {(path, rule) for path, _, rule in outcome.findings()}
    assert f"src/{name}.cpp" not in dict(outcome.notes())


@pytest.mark.parametrize("name", NAMED)
def test_it_is_named(outcome: Outcome, name: str) -> None:
    assert "in another way than the compiler" in dict(outcome.notes())[f"src/{name}.cpp"]


@pytest.mark.parametrize("name", [*QUIET, "c_asked"])
def test_what_no_compiler_sees_and_what_is_usual_is_not_told_of(outcome: Outcome, name: str) -> None:
    path = f"src/{name}.cpp"
    assert path not in dict(outcome.notes())
    assert path not in {found for found, _, _ in outcome.findings()}
