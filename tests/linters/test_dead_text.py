# SPDX-License-Identifier: Apache-2.0
"""A header that is included where no compiler reads it is not seen through the file that does so."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import MemoryStore, workspace

from haros_ci.linters import includes
from haros_ci.linters.dead_text import dead, is_in, joined, without_raw_texts

LINE = '#include "b.hpp"\n'

DEAD = [
    f"#if 0\n{LINE}#endif\n",
    f"#if false  // never\n{LINE}#endif\n",
    f"# if (0)\n{LINE}# endif\n",
    f"#if 0 && defined(X)\n{LINE}#endif\n",
    f"#if !1\n{LINE}#endif\n",
    f"#if 0\n#ifdef X\n#endif\n{LINE}#endif\n",
    f"#if 0\n#ifdef X\n{LINE}#else\n#endif\n#endif\n",
    f"#if 1\n#else\n{LINE}#endif\n",
    f"#if X\n#elif 0\n{LINE}#endif\n",
    f"#if 0 /* never */\n{LINE}#endif\n",
    f"#if 0\n{LINE}",
    f"/*\n{LINE}*/\n",
    f"void f(int c) {{ switch (c) {{ case'\"': /* \"\n{LINE}*/ break; }} }}\n",
    f"int a = 0x1'0; /* '\n{LINE}*/\n",
    f"/* no end\n{LINE}",
    f'const char * text = R"(\n{LINE})";\n',
    f'const char * text = R"--(\n)"\n{LINE})--";\n',
    f'auto text = u8R"(\n{LINE})";\n',
    f"char quote = '\"'; /* \"\n{LINE}*/\n",
    f'const char * text = R\\\n"(\n{LINE})";\n',
    f'const char * text = R"(a)\\\n"\n{LINE})";\n',
]
ALIVE = [
    LINE,
    f"#if X\n{LINE}#endif\n",
    f"#ifdef X\n{LINE}#endif\n",
    f"#ifndef X\n#define X\n{LINE}#endif\n",
    f"#if 1\n{LINE}#endif\n",
    f"#if 0\n#else\n{LINE}#endif\n",
    f"#if 0\n#elif X\n{LINE}#endif\n",
    f"#if 0\n#endif\n{LINE}",
    f"#if 0\n#if 0\n#endif\n#endif\n{LINE}",
    f"#if 0 || X\n{LINE}#endif\n",
    f"#if 10\n{LINE}#endif\n",
    f"#if 0x1\n{LINE}#endif\n",
    f"#if __cplusplus > 0\n{LINE}#endif\n",
    f"/* one */\n{LINE}/* two */\n",
    f'const char * text = "/*";\n{LINE}// */\n',
    f"// /*\n{LINE}// */\n",
    f"// #if 0\n{LINE}// #endif\n",
    f"/*\n#if 0\n*/\n{LINE}",
    f'const char * text = R"(\n#if 0\n)";\n{LINE}',
    f'const char * text = R"(/*)";\n{LINE}// */\n',
    f"int quote = '\"';\n{LINE}int other = '\"';\n",
    f"long number = 1'000'000;\n{LINE}",
    f"#endif\n#else\n{LINE}",
    f'// why \\\n R"(\n{LINE}// )"\n',
    f'/\\\n/ R"(\n{LINE}// )"\n',
    f'const char * text = "a\\\n R";\n{LINE}const char * more = "(b";\n',
    f'const char * text = R"(a)\\\n" /* )";\n{LINE}/* */\n',
    f"int myR = 1;\n{LINE}",
    f"#if 0\n{LINE}#endif\n{LINE}",
]


def written(text: str, tmp_path: Path) -> tuple[str, ...]:
    space = workspace(tmp_path, {"a.cpp": text})
    return includes.written(space, space.files, MemoryStore())["a.cpp"]


@pytest.mark.parametrize("text", DEAD)
def test_an_include_that_no_compiler_reads(text: str, tmp_path: Path) -> None:
    assert written(text, tmp_path) == (f"{includes.PROBED}b.hpp",)


@pytest.mark.parametrize("text", ALIVE)
def test_an_include_that_a_compiler_may_read(text: str, tmp_path: Path) -> None:
    assert written(text, tmp_path) == ("b.hpp",)


def test_lines_are_joined_outside_of_raw_texts() -> None:
    assert joined("#def\\\nine A \\  \r\n1\n") == "#define A 1\n"
    assert joined('a\\\nb R"x(\\\n)")x" c\\\nd') == 'ab R"x(\\\n)")x" cd'
    assert joined('u\\\n8R"(\\\n)" // R"( \\\n a\\\n') == 'u8R"(\\\n)" // R"(  a'
    assert joined("/* R\"( *\\\n/ '\\\\' \\\n") == "/* R\"( */ '\\\\' "
    assert joined('barR"( \\\n)"') == 'barR"( )"'


def test_raw_texts_are_empty() -> None:
    assert (
        without_raw_texts('a R"(\n#endif\n)"; /* R"( */ // R"(\n"R(" R"b()") )b"') == 'a ""; /* R"( */ // R"(\n"R(" ""'
    )


def test_hostile_splices_take_linear_time() -> None:
    for text in ("\\\n", "R\\\n", '"\\', "\\ ", "/\\\n", "/*", "*\\\n", "'\\\n", 'R"('):
        joined(f'\\\n{text * 60_000} R"(')


def test_raw_texts_without_end_take_no_time_in_the_square_of_their_number() -> None:
    text = "".join(f'R"{number}(\n' for number in range(20_000))
    assert dead(text) == () and not is_in(3, ())
