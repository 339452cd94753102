# SPDX-License-Identifier: Apache-2.0
"""Which seeded defects of the HAROS tutorial are found, and which findings its fixes take away.

    python tests/bench/tutorial.py CHECKOUT_OF_haros_tutorials [--profile strict]

Each exercise's diff is applied, with those before it, to a copy of the checkout; what is found before and not after is printed.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

EXERCISES = ("sec2-code-quality", "sec3-architecture")


def found(tree: Path, profile: str) -> Counter[str]:
    """The findings in *tree* as rule, file and message."""
    command = [sys.executable, "-m", "haros_ci", "check", "src", "--isolated", "--profile", profile, "--output", "json"]
    done = subprocess.run([*command, "--no-cache"], cwd=tree, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)
    results = json.loads(done.stdout)["results"]
    return Counter(f"{r['tool']}:{r['rule']} {r['path']}: {r['message']}" for r in results)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkout", type=Path)
    parser.add_argument("--profile", default="ros")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        tree = Path(place) / "tutorial"
        shutil.copytree(given.checkout, tree, ignore=shutil.ignore_patterns(".git"))
        before = found(tree, given.profile)
        for exercises in EXERCISES:
            for diff in sorted((tree / "exercises" / exercises).glob("*.diff")):
                subprocess.run(["git", "apply", "--directory=", str(diff)], cwd=tree, check=True)
                after = found(tree, given.profile)
                print(f"{exercises}/{diff.name}")
                for sign, change in (("gone", before - after), ("new", after - before)):
                    for text in sorted(change.elements()):
                        print(f"  {sign}: {text}")
                before = after


if __name__ == "__main__":
    main()
