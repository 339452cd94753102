# SPDX-License-Identifier: Apache-2.0
"""A setup.py whose setup() installs nothing is named where a change brings it."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.lost_setup import lost_setup, notifications

HEAD = "from setuptools import find_packages, setup\n"
CALL = "setup(name='arm', packages=['arm'])\n"
FIRES = {
    "function": f"{HEAD}def setup(**words):\n    pass\n{CALL}",
    "value": f"{HEAD}setup = print\n{CALL}",
    "lambda": f"{HEAD}setup = lambda **words: None\n{CALL}",
    "class": f"{HEAD}class setup:\n    pass\n{CALL}",
    "import": f"from functools import partial as setup\n{CALL}",
    "module": f"import json as setup\n{CALL}",
    "attribute": f"import setuptools\nsetuptools.setup = print\nsetuptools.{CALL}",
    "module_of_another": f"import types as setuptools\nsetuptools.{CALL}",
    "deleted": f"{HEAD}del setup\n{CALL}",
    "loop": f"{HEAD}for setup in (print,):\n    pass\n{CALL}",
    "false": f"{HEAD}if False:\n    {CALL}",
    "constant": f"{HEAD}name = 'arm'\nif name == 'leg':\n    {CALL}",
    "exit": f"{HEAD}import sys\nsys.exit(0)\n{CALL}",
    "raise": f"{HEAD}raise SystemExit\n{CALL}",
    "uncalled": f"{HEAD}def main():\n    {CALL}",
}
QUIET = {
    "plain": HEAD + CALL,
    "distutils": f"from distutils.core import setup\n{CALL}",
    "skbuild": f"from skbuild import setup\n{CALL}",
    "whole": f"import setuptools\nsetuptools.{CALL}",
    "core": f"import distutils.core\ndistutils.core.{CALL}",
    "either": f"try:\n    from setuptools import setup\nexcept ImportError:\n    from distutils.core import setup\n{CALL}",
    "as": f"import setuptools as core\ncore.{CALL}",
    "main": f"{HEAD}if __name__ == '__main__':\n    {CALL}",
    "function": f"{HEAD}def main():\n    {CALL}\nmain()\n",
    "handed_on": f"import setuptools\ndef setup(**words):\n    setuptools.setup(**words)\n{CALL}",
    "catkin": "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\nd = generate_distutils_setup()\nsetup(**d)\n",
    "argument": f"{HEAD}import sys\nif 'clean' in sys.argv:\n    sys.exit(0)\n{CALL}",
    "behind": f"{HEAD}{CALL}import sys\nsys.exit(0)\n",
    "none": "print('no setup')\n",
    "python_2": f"{HEAD}print 'arm'\n{CALL}",
    "method": f"{HEAD}class A:\n    def run(self):\n        self.setup()\n{CALL}",
}


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    assert lost_setup(FIRES[name]) is not None


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    assert lost_setup(QUIET[name]) is None


def test_what_a_change_brings(tmp_path: Path) -> None:
    def said(base: str, head: str) -> list[str | None]:
        places = [workspace(tmp_path / side / "w", {"arm/setup.py": text}) for side, text in (("b", base), ("h", head))]
        return [note.path for note in notifications(places[1], places[0])]

    assert said(QUIET["plain"], FIRES["function"]) == ["arm/setup.py"]
    assert said(FIRES["function"], FIRES["value"]) == []
    assert said(FIRES["function"], QUIET["plain"]) == []
    assert notifications(workspace(tmp_path / "w", {"setup.py": FIRES["function"]}), None) == ()
