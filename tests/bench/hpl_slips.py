# SPDX-License-Identifier: Apache-2.0
"""Makes slips in the properties of a workspace's project file, and counts those that the checks of properties find.

    python tests/bench/hpl_slips.py WORKSPACE [--seed 3] [--each 4]

Slips: a letter of a topic or of a field left out, a number replaced by a text, an alias renamed where it is bound, a brace or colon left out;
*each* of them at most in each property, drawn by the seed. A finding counts that is a warning or an error; hpl-implied is not asked.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.architectures import project_of
from haros_ci.behaviour.declared import Stated, in_file, in_project
from haros_ci.behaviour.tree import Field, Literal, Place, parts
from haros_ci.checking.run import run_on_project
from haros_ci.checking.system import systems
from haros_ci.config.load import load
from haros_ci.registry import checks
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover


def slips(stated: Stated, random: Random) -> Iterator[tuple[str, str]]:
    """Kinds of slips, and the text with each."""
    text = stated.source.text

    def changed(at: Place, word: str) -> str:
        return text[: at.offset] + word + text[at.end :]

    def short(word: str) -> str:
        at = random.randrange(1, len(word)) if len(word) > 3 else 0
        return word[:at] + word[at + 1 :] if at and word[at] != "/" else f"{word}x"

    assert stated.parsed is not None
    for event in stated.parsed.events:
        yield "topic", changed(event.topic_at, short(event.topic))
        if event.alias_at is not None:
            yield "alias", changed(event.alias_at, f"{event.alias}Q")
        for each in parts(event.predicate):
            if isinstance(each, Field):
                yield "field", changed(each.name_at, short(each.name))
            elif isinstance(each, Literal) and not isinstance(each.value, (bool, str)):
                yield "text for a number", changed(each.at, '"a"')
    for at, sign in enumerate(text):
        if sign in "{}:":
            yield "sign left out", text[:at] + text[at + 1 :]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("workspace", type=Path)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--each", type=int, default=4)
    options = parser.parse_args()
    root, random = options.workspace.resolve(), Random(options.seed)
    settings, workspace = load(root), discover(root, (".",))
    made = varied(workspace, settings, MemoryCache(), alternatives=False)
    every = tuple(systems(made.architecture, workspace))
    asked = [check for check in checks() if check.id.startswith("hpl-") and check.id != "hpl-implied"]
    name = settings.project_file or ""
    total: Counter[str] = Counter()
    found: Counter[str] = Counter()
    for stated in in_project(workspace.text(name), name, lambda file: None):
        if stated.parsed is None:
            continue
        drawn = tuple(slips(stated, random))
        for kind, text in random.sample(drawn, min(options.each, len(drawn))):
            changed = tuple(in_file(text, "slip.hpl", stated.owner))
            results = run_on_project(asked, project_of(made, workspace, every, stated=changed), "haros-ci").results
            total[kind] += 1
            if any(result.level.value != "note" for result in results):
                found[kind] += 1
            else:
                print(f"not found ({kind}): {text}")
    for kind in sorted(total):
        print(f"{found[kind]:5} of {total[kind]:5} {kind}")
    print(f"{sum(found.values()):5} of {sum(total.values()):5}")


if __name__ == "__main__":
    main()
