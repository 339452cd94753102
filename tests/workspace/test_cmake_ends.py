# SPDX-License-Identifier: Apache-2.0
"""A ``return()`` that always ends a CMakeLists.txt before what makes or installs something."""

from __future__ import annotations

import pytest

from haros_ci.workspace.cmake_ends import early_end

INSTALL = "install(TARGETS node DESTINATION lib/arm)\nament_package()\n"
FIRES = [
    f"return()\n{INSTALL}",
    f"if(TRUE)\n  return()\nendif()\n{INSTALL}",
    f"if(NOT FALSE)\n  if(1)\n    RETURN()\n  endif()\nendif()\n{INSTALL}",
    f"if(A)\n  return()\nelse()\n  return()\nendif()\n{INSTALL}",
    f"return()\nif(BUILD)\n  {INSTALL}endif()\n",
    "return()\nadd_executable(node a.cpp)\n",
    "return()\ngenerate_messages()\nament_auto_add_library(node a.cpp)\n",
]
QUIET = [
    INSTALL,
    f"if(NOT CATKIN_ENABLE_TESTING)\n  return()\nendif()\n{INSTALL}",
    f"if(A)\n  return()\nelseif(B)\n  return()\nendif()\n{INSTALL}",
    f"function(a)\n  return()\nendfunction()\n{INSTALL}",
    f"macro(a)\n  if(TRUE)\n    return()\n  endif()\nendmacro()\n{INSTALL}",
    f"foreach(a IN LISTS b)\n  return()\nendforeach()\n{INSTALL}",
    f"if(FALSE)\n  return()\nendif()\n{INSTALL}",
    f"# return()\nmessage(STATUS [[\nreturn()\n]])\n{INSTALL}",
    f"{INSTALL}return()\n",
    f'{INSTALL}return()\nmessage(STATUS "end")\nset(a b)\n',
]


@pytest.mark.parametrize("text", FIRES)
def test_fires(text: str) -> None:
    end = early_end(text)
    assert end is not None and end.is_usual
    assert end.line == text[: text.lower().index("return()")].count("\n") + 1


@pytest.mark.parametrize("text", QUIET)
def test_stays_quiet(text: str) -> None:
    assert early_end(text) is None


def test_deep_blocks_end() -> None:
    assert early_end("if(TRUE)\n" * 5_000 + "return()\n" + "endif()\n" * 5_000 + INSTALL) is None
