# SPDX-License-Identifier: Apache-2.0
"""Macros of a row that a workspace numbers: those that nothing defines are not defined, all others may be."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, ends, follow, main, node

ROW = "#define TYPE_1 1\n#define TYPE_2 2\n"
GUARDED = '\n#ifdef TYPE_4\nADV("x", 1);\n#endif'
#: Texts of files beside those of the package with ``GUARDED`` in ``main``, of which ``before`` stands before it: is it ruled out?
MACROS = (
    ("the next of a row", {"before": ROW}, True),
    ("in a comment", {"before": ROW + "// #define TYPE_4 4\n/*\n#define TYPE_4 4\n*/\n"}, True),
    ("in a comment of CMake", {"before": ROW, "cmake": "# add_definitions(-DTYPE_4)\n"}, True),
    ("another name of CMake", {"before": ROW, "cmake": "add_definitions(-DTYPE_40)\n"}, True),
    ("a header outside", {"before": "#include <acme/types.h>\n" + ROW}, True),
    ("a row in a header", {"before": '#include "rows.h"\n', "p/src/rows.h": ROW}, True),
    ("in the middle of names", {"before": "#define T_1_X 1\n#define T_2_X 2\n", "guarded": "T_4_X"}, True),
    ("defined() of it", {"before": ROW, "guarded": "defined"}, True),
    # what may be defined
    ("no row", {"before": ""}, False),
    ("a row of one", {"before": "#define TYPE_1 1\n"}, False),
    ("a row in two files", {"before": "#define TYPE_1 1\n", "p/src/rows.h": "#define TYPE_2 2\n"}, False),
    ("a row in a comment", {"before": "// #define TYPE_1 1\n// #define TYPE_2 2\n"}, False),
    ("another row", {"before": "#define KIND_1 1\n#define KIND_2 2\n"}, False),
    ("defined in a file that is not included", {"before": ROW, "p/src/rows.h": "#define TYPE_4 4\n"}, False),
    ("taken back somewhere", {"before": ROW, "p/src/rows.h": "#undef TYPE_4\n"}, False),
    ("of another package's file", {"before": ROW, "q/include/q/rows.h": "#define TYPE_4 4\n"}, False),
    ("an option", {"before": ROW, "cmake": "option(TYPE_4 four OFF)\n"}, False),
    ("a definition under a condition", {"before": ROW, "cmake": "if(X_FOUND)\nadd_definitions(-DTYPE_4)\nendif()\n"}, False),
    ("a definition in a text", {"before": ROW, "cmake": 'set(F "# -DTYPE_4")\n'}, False),
    ("put together by CMake", {"before": ROW, "cmake": "foreach(i 4 5)\nadd_definitions(-DTYPE_${i})\nendforeach()\n"}, False),
    ("in another CMake file", {"before": ROW, "p/cmake/x.cmake": "set(DEFS TYPE_4)\n"}, False),
    ("in a script", {"before": ROW, "build.sh": "colcon build --cmake-args -DCMAKE_CXX_FLAGS=-DTYPE_4\n"}, False),
    ("in a document", {"before": ROW, "p/README.md": "Build with `-DTYPE_4` for the fourth.\n"}, False),
    ("in settings", {"before": ROW, "defaults.yaml": "build:\n  cmake-args: [-DCMAKE_CXX_FLAGS=-DTYPE_4]\n"}, False),
    ("of the compiler", {"before": "#define __GNUC_1 1\n#define __GNUC_2 2\n", "guarded": "__GNUC_4"}, False),
)  # fmt: skip


@pytest.mark.parametrize(("name", "texts", "expected"), MACROS)
def test_a_macro_of_a_row_that_nothing_defines(name: str, texts: dict[str, str], expected: bool) -> None:
    own = dict(texts)
    before, cmake, guarded = own.pop("before"), own.pop("cmake", ""), own.pop("guarded", "")
    code = GUARDED
    if guarded == "defined":
        code = code.replace("#ifdef TYPE_4", "#if defined(TYPE_4) && 1")
    elif guarded:
        code = code.replace("TYPE_4", guarded)
    files = cpp_files(main(code, before)) | own
    files["p/CMakeLists.txt"] += cmake
    (end,) = ends(node(follow(files)))
    assert end.is_ruled_out is expected


def test_what_is_left_out_of_the_build_is_followed_by_its_else() -> None:
    made = ends(node(follow(cpp_files(main('\n#ifdef TYPE_4\nADV("x", 1);\n#else\nADV("y", 1);\n#endif', ROW)))))
    assert [(end.name, end.is_ruled_out) for end in made] == [("/x", True), ("/y", False)]
