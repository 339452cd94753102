# SPDX-License-Identifier: Apache-2.0
"""What shell scripts, ``.dsv`` files and ``.env`` files set, read off their text."""

from __future__ import annotations

import time

import pytest

from haros_ci.workspace.dotenv import read_dotenv
from haros_ci.workspace.environment import read_dsv
from haros_ci.workspace.shell_variables import read_script

LOST = None


def made(script: str, **given: str | None) -> dict[str, str | None]:
    found = read_script(script, given)
    return {**found.values, **dict.fromkeys(found.lost)}


@pytest.mark.parametrize(
    ("script", "expected"),
    [
        ("export A=1", {"A": "1"}),
        ("A=1; export A", {"A": "1"}),
        ("export A=1 B='two words' C=\"three\"  # B=4", {"A": "1", "B": "two words", "C": "three"}),
        (": ${A:=arm}  # base\nexport A", {"A": "arm"}),
        (': "${A:=[x, y]}"\nexport A', {"A": "[x, y]"}),
        (": ${A:=[x, y z]}\nexport A", {"A": "[x, y z]"}),
        ("export A=${A:-arm}", {"A": "arm"}),
        ('export A="${A-arm}"', {"A": "arm"}),
        ("B=arm\nexport A=${B}_left/$B", {"A": "arm_left/arm"}),
        ('if [ -z "$A" ]; then\n  export A=arm\nfi', {"A": "arm"}),
        ("if [ -z ${A+x} ]\nthen export A=arm; fi", {"A": "arm"}),
        ('if test "x$A" = "x"; then export A=arm; else export B=base; fi', {"A": "arm"}),
        ('if [ "$A" = sim ]; then export B=1; elif [ -n "$A" ]; then export B=2; else export B=3; fi', {"B": "3"}),
        ('[ -z "$A" ] && export A=arm\n[ -n "$B" ] || export B=base', {"A": "arm", "B": "base"}),
        ('[ ! -n "$A" ] && export A=arm\n[ ! ! -n "$B" ] && export B=base', {"A": "arm"}),
        ("[[ -z $A ]] && { export A=1; export B=2; }", {"A": "1", "B": "2"}),
        ("set -a\nA=1\nset +a\nB=2", {"A": "1"}),
        ("declare -x A=1", {"A": "1"}),
        ("export A=1 \\\n  B=2", {"A": "1", "B": "2"}),
        ("echo hello > /dev/null 2>&1\nexport A=1", {"A": "1"}),
        ("export A=a\nexport A+=b", {"A": "ab"}),
        # what cannot be told
        ("export A=$(rospack find arm)/x", {"A": LOST}),
        ("export A=`hostname`", {"A": LOST}),
        ("export A=$HOME/x", {"A": LOST}),
        ("export A=~/x", {"A": LOST}),
        ("export A=${HOSTNAME:-robot}", {"A": LOST}),
        ("export A=$A:/opt/models", {"A": LOST}),
        ("if [ -d /opt/x ]; then export A=1; fi", {"A": LOST}),
        ("if [ -d /opt/x ]; then export A=1; else export A=2; fi\nexport B=1", {"A": LOST, "B": "1"}),
        ('case "$A" in x) export B=1;; *) export B=2;; esac\nexport C=3', {"B": LOST, "C": "3"}),
        ("for d in a b; do export A=$d; done", {"A": LOST}),
        ("set_up() { export A=1; }\nset_up\nexport A=2", {"A": LOST}),
        ("export A=1\n. ./other.sh\nexport B=2", {"A": LOST, "B": "2"}),
        ("source ./other.sh\nexport B=${B:-2}", {"B": LOST}),
        ("if [ -d /opt/x ]; then return; fi\nexport A=1", {"A": LOST}),
        ("export A=1\nread A", {"A": LOST}),
        ('export A="no end\nexport B=1', {"A": LOST, "B": LOST}),
        ("cat <<END\nexport B=1\nEND\nexport A=1", {"A": LOST, "B": LOST}),
        ("export A=(1 2)", {"A": LOST}),
        # what sets nothing
        ("A=1", {}),
        ("A=1 run_it", {}),
        ("(export A=1)", {}),
        ("echo x | export A=1", {}),
        ("# export A=1\necho export A=1", {}),
        ("export A", {}),
        ("export A=1\nunset A", {}),
        ("return 0\nexport A=1", {}),
        ('if [ -n "$A" ]; then export B=1; fi', {}),
    ],
)
def test_scripts(script: str, expected: dict[str, str | None]) -> None:
    assert made(script) == expected


def test_what_is_set_before_counts() -> None:
    assert made(": ${A:=arm}\nexport A", A="leg") == {"A": "leg"}
    assert made("export B=$A", A="leg") == {"B": "leg"}
    assert made("export A=${A:-arm}", A=None) == {"A": LOST}


@pytest.mark.parametrize(
    "text",
    ["export A=1;" * 6000, "(" * 60000, "{ " * 30000, "! " * 30000, "${A:-" * 10000, '"$(' * 20000, "if " * 20000]
    + ["[ " + "! " * 16000 + "]"]
    + ["A=1|" * 10000, "for x in a;" * 5000, "`" * 60001, "$((" * 20000, "".join(f"A{n}=1|" for n in range(8000))],
)
def test_hostile_scripts_are_cheap(text: str) -> None:
    start = time.process_time()
    made(text)
    assert time.process_time() - start < 2


def test_a_script_that_loses_too_many_names_is_not_read() -> None:
    assert made("read " + " ".join(f"A{n}=" for n in range(600)) + "\nexport B=1")["B"] is LOST


def test_dsv() -> None:
    found = read_dsv(
        "set;MODE;sim\nset;ROOT;share/arm\nset;PREFIX;\nset;FILE;/etc/arm\nset-if-unset;NAME;arm\nset-if-unset;MODE;real\n"
        "prepend-non-duplicate;MODELS;share\nsource;share/arm/x.sh\nnonsense\n",
        {},
    )
    assert found.values == {"MODE": "sim", "FILE": "/etc/arm", "NAME": "arm"}
    assert found.lost == {"ROOT", "PREFIX", "MODELS"}


def test_dotenv() -> None:
    found = read_dotenv(
        '# a comment\nA=arm\nexport B = left arm  # which\nC=\'it # is $A\'\nD="${A}_$B"\nE=$UNSET\nF="open\nG=$(ls)\nH=\nI=a#b\nno line\n'
    )
    assert found.values == {"A": "arm", "B": "left arm", "C": "it # is $A", "D": "arm_left arm", "H": "", "I": "a#b"}
    assert found.lost == {"E", "F", "G"}


def test_a_value_that_is_too_long_is_not_known() -> None:
    long = "A=" + "x" * 4_000
    assert made(f"{long}\nexport A B=$A$A\nexport C=${{A:+$A$A}}") == {"A": "x" * 4_000, "B": LOST, "C": LOST}
    assert read_dotenv(f"{long}\nB=$A$A\nC=$A").lost == {"B"}
