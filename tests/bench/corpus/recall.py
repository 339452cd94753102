# SPDX-License-Identifier: Apache-2.0
"""What disappears from the report with each of the fixes that fixes.py has drawn.

    python tests/bench/corpus/recall.py CLONES FIXES.yaml DETAILS.json [--part 1/2]

For each fix the trees of its parent and of itself are written to a temporary directory, as tests/bench/history.py does, and
``haros-ci check --profile architecture --isolated`` looks at both with the checks that are on by default. DETAILS gets of each fix the
findings that went and came, and its difference of the text files; what it has already is not run again. Whether what
went is what the fix is about is for a reader to say (docs/corpus.md).
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import yaml

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import history

#: Characters of a difference that are kept.
LONGEST = 12_000


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("fixes", type=Path)
    parser.add_argument("details", type=Path)
    parser.add_argument("--part", default="1/1", help="the fixes of one of several processes")
    given = parser.parse_args()
    number, of = map(int, given.part.split("/"))
    fixes = yaml.safe_load(given.fixes.read_text("utf-8"))["fixes"][number - 1 :: of]
    done: dict[str, Any] = json.loads(given.details.read_text()) if given.details.exists() else {}
    history.checks = lambda: ()  # no more rules than those that are on
    for fix in fixes:
        if fix["commit"] in done:
            continue
        git = history.repository(given.clones, fix["repository"])
        start = time.monotonic()
        found = history.compare({"fix": fix["commit"], "parent": fix["parent"]}, git, None)
        difference = subprocess.run(
            ["git", f"--git-dir={git}", "show", "--stat", "--patch", "--no-color", fix["commit"]],
            capture_output=True,
            check=True,
        ).stdout.decode("utf-8", "replace")
        done[fix["commit"]] = {**fix, **found, "difference": difference[:LONGEST]}
        given.details.write_text(json.dumps(done, indent=1), "utf-8")
        print(
            f"{fix['repository']} {fix['commit'][:10]}: {len(found['gone'])} went, {time.monotonic() - start:.0f} s",
            flush=True,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
