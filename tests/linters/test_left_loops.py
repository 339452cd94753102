# SPDX-License-Identifier: Apache-2.0
"""Loops that end as soon as their container is changed, and those that go on."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_steps import is_never_so

HEAD = "void Planner::drop(int id)\n{\n  for (auto & goal : goals_) {\n"
IF = HEAD + "    if (goal.id == id) {\n"
PUSH = "goals_.push_back(next);"


def never(text: str, called: str = "push_back") -> bool:
    lines = text.split("\n")
    line = next(number for number, item in enumerate(lines, 1) if f"{called}(" in item)
    loop = next(number for number, item in enumerate(lines, 1) if "goals_)" in item and "for" in item)
    steps = [("a.cpp", line, ""), ("a.cpp", loop, "Iterating container here.")]
    said = f"Calling '{called}' while iterating the container is invalid."
    return is_never_so("invalidContainerLoop", said, steps, {"a.cpp": text}.__getitem__)


LEFT = [
    IF + f"      {PUSH}\n      break;\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n      return;\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH} // the last one\n      log(id);\n      throw std::runtime_error(name);\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n    }}\n    break;\n  }}\n}}\n",
    IF + f"      {PUSH}\n    }} else {{\n      skip();\n    }}\n    return;\n  }}\n}}\n",
    IF + f"      {PUSH}\n    }} else if (id > 3) {{\n      skip();\n    }} else\n      skip();\n    break;\n  }}\n}}\n",
    IF
    + f"      {PUSH}\n      if (id > 3) {{ log(id); }} else log(3);\n      while (busy()) wait();\n      break;\n    }}\n  }}\n}}\n",
    IF + f"      for (int i = 0; i < 3; i++) {{\n        {PUSH}\n      }}\n      return;\n    }}\n  }}\n}}\n",
    IF
    + f"      for (int i = 0; i < 3; i++) {{\n        {PUSH}\n        break;\n      }}\n      break;\n    }}\n  }}\n}}\n",
    HEAD
    + f"    switch (goal.kind) {{\n      case 1:\n        {PUSH}\n        break;\n      default:\n        log(1);\n    }}\n    break;\n  }}\n}}\n",
    HEAD + f"    if (goal.id == id) {PUSH}\n    break;\n  }}\n}}\n",
    "void drop()\n{\n  for (const auto & [name, goal] : goals_)\n    if (id == 3) {\n      goals_.push_back(id);\n      return;\n    }\n}\n",
]


@pytest.mark.parametrize("text", LEFT)
def test_the_loop_is_left(text: str) -> None:
    assert never(text)


GOES_ON = [
    IF + f"      {PUSH}\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n      continue;\n    }}\n    break;\n  }}\n}}\n",
    IF + f"      {PUSH}\n      // break;\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n      if (id > 3) {{\n        break;\n      }}\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n      if (id > 3) break;\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n    }} else {{\n      break;\n    }}\n  }}\n}}\n",
    IF + f"      {PUSH}\n      log(goal.id);\n      break;\n    }}\n  }}\n}}\n",  # a reference into what was moved
    IF + f"      {PUSH}\n      return goal;\n    }}\n  }}\n}}\n".replace("return goal", "use(goal); return"),
    IF + f"      for (int i = 0; i < 3; i++) {{\n        {PUSH}\n        break;\n      }}\n    }}\n  }}\n}}\n",
    IF + f"      switch (id) {{\n        case 1:\n          {PUSH}\n          break;\n      }}\n    }}\n  }}\n}}\n",
    IF + f"      auto later = [&] {{\n        {PUSH}\n        return;\n      }};\n      later();\n    }}\n  }}\n}}\n",
    IF + "      if (goals_.push_back(next)) break;\n    }\n  }\n}\n",
    IF + "      if (goals_.push_back(next)) {\n        break;\n      }\n    }\n  }\n}\n",
    HEAD + f"    {PUSH}\n  }}\n  return;\n}}\n",
    HEAD + f"    {PUSH}\n",
    HEAD + f"    {PUSH}\n    break;",
]


@pytest.mark.parametrize("text", GOES_ON)
def test_the_loop_goes_on(text: str) -> None:
    assert not never(text)


def test_what_is_called_otherwise() -> None:
    steps = [("a.cpp", 5, ""), ("b.cpp", 3, "Iterating container here.")]
    said = "Calling 'push_back' while iterating the container is invalid."
    assert not is_never_so("invalidContainerLoop", said, steps, lambda path: LEFT[0])
    assert not is_never_so("invalidContainerLoop", "Calling it", [("a.cpp", 5, "")] * 2, lambda path: LEFT[0])
    assert not is_never_so("invalidContainerLoop", said, [("a.cpp", 5, "")], lambda path: LEFT[0])


def test_long_texts_end() -> None:
    text = HEAD + f"    {PUSH}\n" + "    {" * 3000
    assert not never(text)
    assert not never(HEAD + f"    {PUSH}\n" + "    if (a) " * 3000)
