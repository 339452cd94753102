# SPDX-License-Identifier: Apache-2.0
"""Only what every build includes, and only imports that happen on loading."""

from __future__ import annotations

import pytest

from haros_ci.checking.imports import imported
from haros_ci.checking.includes import includes


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("#include <a.h>\n", [("a.h", 1, 1)]),
        ('  #  include "b/c.h"  // why\n', [("b/c.h", 1, 3)]),
        ("#ifndef G\n#define G\n\n#include <a.h>\n#endif\n", [("a.h", 4, 1)]),
        ("#if !defined(G)\n#define G\n#include <a.h>\n#endif\n", [("a.h", 3, 1)]),
        ("/* c\n */ \n#include <a.h>\r\n#include <b.h>\n", [("a.h", 3, 1), ("b.h", 4, 1)]),
        ("#if X\n#endif\n#include <a.h>\n", [("a.h", 3, 1)]),
    ],
)
def test_included(text: str, found: list[tuple[str, int, int]]) -> None:
    assert [(i.header, i.location.line, i.location.column) for i in includes("x.cpp", text)] == found


@pytest.mark.parametrize(
    "text",
    [
        "// #include <a.h>\n",
        "/*\n#include <a.h>\n*/\n",
        "#ifdef X\n#include <a.h>\n#endif\n",
        "#if __has_include(<a.h>)\n#include <a.h>\n#endif\n",
        "#if X\n#else\n#include <a.h>\n#endif\n",
        "#ifndef X\n#include <a.h>\n#endif\n",
        "#ifndef G\n#define G\n#if X\n#include <a.h>\n#endif\n#endif\n",
        "#include HEADER\n",
        "#include\n",
        "#include <>\n#endif\n#endif\n",
    ],
)
def test_not_included_for_certain(text: str) -> None:
    assert list(includes("x.cpp", text)) == []


def test_imports_on_loading() -> None:
    text = 'import a, b.c as d\nfrom e.f import g\n"""\n    import h\n"""\ntry:\n    import i\nexcept ImportError:\n    pass\nfrom . import j\nimportant = 1\n'
    assert [(name, at.line) for name, at in imported("x.py", text, None)] == [("a", 1), ("b", 1), ("e", 2)]
