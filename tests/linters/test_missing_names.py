# SPDX-License-Identifier: Apache-2.0
"""Names that a change takes from modules of the workspace that do not have them are named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.missing_names import notifications
from haros_ci.model.workspace import Workspace

BASE = {
    "arm/arm/__init__.py": "",
    "arm/arm/tools.py": "import json\n\ntry:\n    import yaml\nexcept ImportError:\n    yaml = None\n\n\ndef width():\n    return 1\n",
    "arm/arm/any.py": "from json import *\n",
    "arm/arm/deep/__init__.py": "",
    "arm/arm/deep/bottom.py": "depth = 3\n",
    "arm/arm/data.json": "",
    "arm/CMakeLists.txt": "add_library(made SHARED made.cpp)\n",
    "arm/scripts/beside.py": "near = 1\n",
    "other/other/__init__.py": "",
    "json/json/__init__.py": "",
}
FIRES = {
    "from arm.tools import height\n": ("arm.tools", "height"),
    "from arm.tools import width, heigth as h\n": ("arm.tools", "heigth"),
    "import arm.tools as t\n\n\ndef f():\n    return t.height()\n": ("arm.tools", "height"),
    "from arm import tools\n\n\ndef f():\n    return tools.height()\n": ("arm.tools", "height"),
    "from .tools import height\n": (".tools", "height"),
    "from . import nothing\n": (".", "nothing"),
    "from .nothing import x\n": (".", "nothing"),
    "from arm.nothing import x\n": ("arm", "nothing"),
    "import arm.nothing\n": ("arm", "nothing"),
    "from arm.deep.bottom import top\n": ("arm.deep.bottom", "top"),
    "from arm.deep import top\n": ("arm.deep", "top"),
    "def f():\n    from arm.tools import height\n    return height\n": ("arm.tools", "height"),
    "import arm.tools\n\n\ndef f():\n    return arm.tools.height()\n": ("arm.tools", "height"),
    "import importlib\nimportlib.import_module('arm.nothing')\n": ("arm", "nothing"),
    "if True:\n    from arm.tools import height\n": ("arm.tools", "height"),
    "try:\n    from arm.tools import height\nexcept ValueError:\n    pass\n": ("arm.tools", "height"),
}
QUIET = [
    "from arm.tools import width, json, yaml\n",
    "from arm.any import anything\n",
    "from arm import tools, deep, any\n",
    "from arm import made\n",
    "from arm import data\n",
    "from arm.msg import Word\nfrom arm.srv import Say\nfrom arm.cfg import ArmConfig\n",
    "from arm import msg\n",
    "from arm import __version__\n",
    "from arm.tools import _hidden\n",
    "from arm.tools import *\n",
    "import arm.deep.bottom\n\nprint(arm.deep.bottom.depth)\n",
    "import arm.tools\n\n\ndef f(arm):\n    return arm.tools.height()\n",
    "import importlib\nimportlib.import_module('arm.tools')\nimportlib.import_module('..nothing', 'arm')\n",
    "try:\n    from arm.tools import height\nexcept ImportError:\n    height = None\n",
    "try:\n    from arm.tools import height\nexcept:\n    height = None\n",
    "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from arm.tools import Height\n",
    "if False:\n    from arm.tools import height\n",
    "from arm import tools\nif hasattr(tools, 'height'):\n    tools.height()\n",
    "from arm import tools\ntools.height = 1\nprint(tools.height)\n",
    "from arm import tools\n\n\ndef f(tools):\n    return tools.height\n",
    "try:\n    from arm import tools\nexcept ImportError:\n    import other as tools\nprint(tools.height)\n",
    "from unknown.tools import height\n",
    "from json import anything\n",
    "import arm_tools\narm_tools.height()\n",
    "from beside import far\n",
]


def space(root: Path, files: dict[str, str]) -> Workspace:
    made = workspace(root, files)
    return replace(made, names=frozenset(files))


def said(place: Path, base: dict[str, str], head: dict[str, str]) -> list[str]:
    found = notifications(space(place / "head", head), space(place / "base", base))
    return [f"{note.path}: {note.message}" for note in found]


@pytest.mark.parametrize("text", FIRES)
def test_named(tmp_path: Path, text: str) -> None:
    module, name = FIRES[text]
    (message,) = said(tmp_path, BASE, BASE | {"arm/arm/new.py": text})
    assert message.startswith(f"arm/arm/new.py: since this change it takes {name} from {module}, ")


@pytest.mark.parametrize("text", QUIET)
def test_quiet(tmp_path: Path, text: str) -> None:
    assert said(tmp_path, BASE, BASE | {"arm/arm/new.py": text}) == []


OF_PYTHON = {
    "import os\nos.mkdirs('a')\n": ("os", "mkdirs"),
    "import pickle\n\n\ndef f(x):\n    return pickle.dump_s(x)\n": ("pickle", "dump_s"),
    "import os\nos.path.joined('a', 'b')\n": ("os.path", "joined"),
    "import os as o\no.path.joined('a', 'b')\n": ("os.path", "joined"),
    "from os import path\npath.joined('a', 'b')\n": ("os.path", "joined"),
    "from math import squareroot\n": ("math", "squareroot"),
    "import time as t\nt.wait(1)\n": ("time", "wait"),
    "import datetime\ndatetime.now()\n": ("datetime", "now"),
    "import xml.etree.ElementTrees\n": ("xml.etree", "ElementTrees"),
    "import concurrent.future\n": ("concurrent", "future"),
    "from threading import Thread, Lok\n": ("threading", "Lok"),
    "import importlib\nimportlib.import_module('xml.etree.Trees')\n": ("xml.etree", "Trees"),
    "import logging\nlogging.TRACE = 5\nprint(logging.TRACED)\n": ("logging", "TRACED"),
}
QUIET_OF_PYTHON = [
    "import time\ntime.clock()\ntime.sleep(1)\n",
    "import os\nprint(os.errno, os.getcwdu, os.startfile, os.path.walk, os.PathLike)\n",
    "import string, sys, itertools, urllib\nprint(string.letters, sys.maxint, itertools.izip, urllib.urlencode)\n",
    "from collections import Mapping, abc\n",
    "from typing import override, TypeAlias\n",
    "import signal\nprint(signal.CTRL_C_EVENT, signal.SIGHUP)\n",
    "import xml.etree.cElementTree\nimport logging.handlers\nimport concurrent.futures\n",
    "import sys\nprint(sys._MEIPASS, sys.__stdout__)\n",
    "import logging\nlogging.TRACE = 5\nprint(logging.TRACE)\n",
    "import logging\nsetattr(logging, 'NOTICE', 25)\nprint(logging.NOTICE)\n",
    "import os\nif hasattr(os, 'fly'):\n    os.fly()\n",
    "import time\ntry:\n    time.wait(1)\nexcept AttributeError:\n    pass\n",
    "from time import time\ntime.wait\n",
    "import time\n\n\ndef f(time):\n    return time.wait\n",
    "from datetime import datetime\ndatetime.now()\n",
    "import json\njson.dump_s(1)\n",
    "from distutils.core import anything\n",
    "import yaml\nyaml.anything()\n",
    "if False:\n    import math\n    math.squareroot(2)\n",
]


@pytest.mark.parametrize("text", OF_PYTHON)
def test_modules_of_python(tmp_path: Path, text: str) -> None:
    module, name = OF_PYTHON[text]
    (message,) = said(tmp_path, BASE, BASE | {"arm/arm/new.py": text})
    assert message.startswith(f"arm/arm/new.py: since this change it takes {name} from {module}, a module of Python's ")


@pytest.mark.parametrize("text", QUIET_OF_PYTHON)
def test_modules_of_python_quiet(tmp_path: Path, text: str) -> None:
    assert said(tmp_path, BASE, BASE | {"arm/arm/new.py": text}) == []


def test_another_file_gives_a_module_of_python_a_name(tmp_path: Path) -> None:
    base = BASE | {"other/other/levels.py": "import logging as log\nimport logging\n\nlogging.NOTICE = 25\n"}
    assert said(tmp_path, base, base | {"arm/arm/new.py": "import logging\nprint(logging.NOTICE)\n"}) == []


def test_the_other_side_changes(tmp_path: Path) -> None:
    base = BASE | {"other/other/user.py": "from arm.tools import width\n", "other/other/far.py": "import arm\n"}
    head = base | {"arm/arm/tools.py": "def height():\n    return 1\n"}
    assert [one.partition(":")[0] for one in said(tmp_path / "1", base, head)] == ["other/other/user.py"]
    gone = {path: text for path, text in base.items() if path != "arm/arm/tools.py"}
    assert [one.partition(":")[0] for one in said(tmp_path / "2", base, gone)] == ["other/other/user.py"]


def test_beside_a_script(tmp_path: Path) -> None:
    head = BASE | {"arm/scripts/run.py": "from beside import far\n"}
    assert len(said(tmp_path / "1", BASE, head)) == 1
    head = BASE | {"arm/scripts/run.py": "import sys\nsys.path.insert(0, '..')\nfrom beside import far\n"}
    assert said(tmp_path / "2", BASE, head) == []


def test_one_of_two_modules_of_a_name(tmp_path: Path) -> None:
    base = BASE | {"run/deep/tools.py": "a = 1\n", "run/tools/__init__.py": "b = 2\n"}
    assert said(tmp_path, base, base | {"run/deep/use.py": "from tools import b\n"}) == []


def test_modules_of_c(tmp_path: Path) -> None:
    base = BASE | {"arm/CMakeLists.txt": "pybind11_add_module(${PROJECT_NAME}_core core.cpp)\n"}
    assert said(tmp_path, base, base | {"arm/arm/new.py": "from arm import arm_core\n"}) == []


def test_what_the_base_had(tmp_path: Path) -> None:
    old = BASE | {"arm/arm/new.py": "from arm.tools import height\n"}
    assert said(tmp_path / "1", old, BASE | {"arm/arm/new.py": "# more\nfrom arm.tools import height\n"}) == []
    assert said(tmp_path / "2", old, BASE | {"arm/arm/moved.py": "# more\nfrom arm.tools import height\n"}) == []
    assert notifications(space(tmp_path, old), None) == ()
