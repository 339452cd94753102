# SPDX-License-Identifier: Apache-2.0
"""What a change brings that neither linters nor the model see: a note names it, and what it resembles is not told of."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hostile_kit import CONTROL, Outcome, Trap, assert_harmless

SETUP = "from setuptools import setup\n\nsetup(name='{0}', version='1', packages=['{0}'])\n"
#: By its file what a change brings, and words of the note on it.
NAMED = {
    "given.py": (
        "from threading import Thread\n\n\ndef f(node):\n    Thread(target=node.create_timer, args=(1, f)).start()\n",
        "is given to something that may call it",
    ),
    "given.cpp": (
        "auto made = std::async(&rclcpp::Node::create_client, node);\n",
        "is given to something that may call",
    ),
    "macro.hpp": ('#define HEAR(n) n->create_subscription<M>("a", 1, f)\n', "the macro HEAR makes topics"),
    "lost/setup.py": (f"{SETUP.format('lost')}".replace("setup\n\n", "setup\n\nsetup = dict\n"), "is not that of set"),
    "unbound.py": ("if 2 - 2:\n    import json\n\n\ndef f():\n    return json.dumps({})\n", "json has no value where"),
    "missing.py": ("from tools import height\n\n\ndef f():\n    return height()\n", "takes height from tools"),
    "own.py": ("import pickle\n\n\ndef f(a):\n    return pickle.dump_s(a)\n", "takes dump_s from pickle, a module of"),
    "prefix.launch": ("<launch><node pkg='a' type='a' name='a' launch-prefix='echo'/></launch>\n", "the prefix 'echo'"),
    "shell.launch.xml": (
        "<launch><executable cmd=\"bash -c 'r=ros2; $r run a b'\"/></launch>\n",
        "of a shell stands for what starts programs",
    ),
    "return.yaml": ("# why\ra: 1\nb: 2\n", "in a carriage return alone"),
    "return.cmake": ("# why\rset(A 1)\n", "in a carriage return alone"),
    "later.py": ("value = late() if 1 else 0\n\n\ndef late():\n    return 1\n", "it is bound only behind it"),
    "text.py": (
        "import operator\n\n\ndef f(node):\n    return operator.attrgetter('create_client')(node)\n",
        "create_client is given to something that may call it",
    ),
    "pkg/msg/Word.msg": ("int32 bigName\n", "rosidl refuses the name bigName of a field"),
    "installs.cmake": ("install(TARGETS a DESTINATION lib EXCLUDE_FROM_ALL)\n", "install() has EXCLUDE_FROM_ALL"),
    ".gitmodules": (
        '[submodule "a"]\n\tpath = a\n\turl = ../a\n',
        "2 changed files name other repositories, of which nothing is analysed but what is checked out here: .gitmodules, all.repos",
    ),
    "aside.cpp": ('#include "test/part.hpp"\n', "a file of tests or of another project"),
    "computed.hpp": ('#define PART "part.hpp"\n#include PART\n', "in another way than the compiler"),
}
#: What is usual, and resembles the above.
QUIET = {
    "q_given.py": "from functools import partial\n\n\ndef f(node):\n    return partial(node.create_timer, 1)\n",
    "q_macro.hpp": '#define HEAR_OF(n) n->get_parameter("a")\n',
    "q_setup/setup.py": SETUP.format("q_setup"),
    "q_unbound.py": "import os\n\nif os.name:\n    import json\n\n\ndef f():\n    return json.dumps({})\n",
    "q_missing.py": "from tools import width\n\n\ndef f():\n    return width()\n",
    "q_own.py": "import time\nimport signal\n\n\ndef f():\n    return time.clock(), signal.CTRL_C_EVENT\n",
    "q_prefix.launch": "<launch><node pkg='a' type='a' name='a' launch-prefix='gdb -ex run --args'/></launch>\n",
    "q_return.yaml": "# why\r\na: 1\r\n",
    "q_later.py": "def f():\n    return late()\n\n\ndef late():\n    return 1\n\n\nvalue = f()\n",
    "pkg/msg/Said.msg": "int32 big_name\nint32 A=1\n",
    "q_installs.cmake": "install(TARGETS a DESTINATION lib OPTIONAL)\n",
    "all.repos": "repositories: {a: {type: git, url: 'https://example.org/a.git', version: main}}\n",
    "q_repos.yaml": "repositories: {}\n",
    "q_moved.hpp": '#define TELL(n) n->create_publisher<M>("a", 1)\n',
    "test/q_test.cpp": '#include "part.hpp"\n',
}


@pytest.fixture(scope="module")
def outcome(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Outcome]:
    place = tmp_path_factory.mktemp("brought")
    trap = Trap(place, place / "cache")
    (trap.root / CONTROL).unlink()
    trap.write("haros.yaml", "linters: {cpplint: false, pylint: false, cppcheck: false, lizard: false, radon: false}\n")
    trap.write("tools.py", "def width():\n    return 1\n")
    trap.write("test/part.hpp", "int part();\n")
    trap.write(
        "pkg/package.xml",
        "<package format='3'><name>pkg</name><export><build_type>ament_cmake</build_type></export></package>\n",
    )
    trap.write("old.hpp", QUIET["q_moved.hpp"])
    trap.commit()
    (trap.root / "old.hpp").unlink()
    for name, text in {**{name: text for name, (text, _) in NAMED.items()}, **QUIET}.items():
        trap.write(name, text)
    trap.commit()
    outcome = trap.run("--baseline-rev=HEAD~1", "--profile=bugs-only")
    assert_harmless(trap, outcome)
    yield outcome


@pytest.mark.parametrize("name", NAMED)
def test_it_is_named(outcome: Outcome, name: str) -> None:
    assert any(path == name and NAMED[name][1] in message for path, message in outcome.notes()), outcome.notes()


@pytest.mark.parametrize("name", QUIET)
def test_what_is_usual_is_not_told_of(outcome: Outcome, name: str) -> None:
    assert [message for path, message in outcome.notes() if path == name and "since this change" in message] == []
