# SPDX-License-Identifier: Apache-2.0
"""Makes one slip at a time in a repository, as a pull request would bring it, and counts those that ``haros-ci check`` finds.

    python tests/bench/slips.py [--seed 1] [--most 3] [--kinds KIND ...] [--work DIRECTORY] [--output FILE] CHECKOUT ...

A slip is what a hand does: a letter left out of a name, another type, a line forgotten (KINDS has them all). For every checkout at most
*most* places of a kind are drawn by the seed. The files are copied into a git repository of their own and committed; each slip is written there,
``check . --isolated --fail-on never --baseline-rev HEAD`` runs, and the file is put back. Nothing of a checkout is run.
Found: a new error or warning. Noted: a new note alone. FILE gets one JSON object per slip, to be read. Prints a table by kind.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import NamedTuple

#: A change of a text: from, to, and what stands there instead.
Edit = tuple[int, int, str]


class Slip(NamedTuple):
    """One changed place of a file."""

    kind: str
    path: str
    line: int
    before: str
    after: str
    text: str


#: Kind: which files (by the end of their names), what is matched (group 1 is changed), and how.
KINDS: dict[str, tuple[tuple[str, ...], str, str]] = {}
_LAUNCH = (".launch", ".launch.xml", ".test")
_PYTHON_LAUNCH = (".launch.py", "_launch.py")
_CPP = (".cpp", ".cc", ".cxx", ".hpp", ".h")
_NAME = r"([A-Za-z][A-Za-z0-9_./~-]{3,})"


def _kind(name: str, ends: tuple[str, ...], pattern: str, how: str = "letter") -> None:
    KINDS[name] = (ends, pattern, how)


_kind("launch: program", _LAUNCH, rf"<node\b[^>]*?\b(?:type|exec)\s*=\s*\"{_NAME}\"")
_kind("launch: package", _LAUNCH, rf"<node\b[^>]*?\bpkg\s*=\s*\"{_NAME}\"")
_kind("launch: remapping", _LAUNCH, rf"<remap\b[^>]*?\bfrom\s*=\s*\"{_NAME}\"")
_kind("launch: parameter", _LAUNCH, rf"<param\b[^>]*?\bname\s*=\s*\"{_NAME}\"")
_kind("launch: included file", _LAUNCH, r"<include\b[^>]*?\bfile\s*=\s*\"[^\"]*/([A-Za-z][\w.-]+)\"")
_kind("launch: argument passed", _LAUNCH, rf"<arg\b(?=[^>]*\bvalue)[^>]*?\bname\s*=\s*\"{_NAME}\"")
_kind("launch: argument used", _LAUNCH, rf"\$\((?:arg|var) {_NAME}\)")
_kind(
    "launch: file of parameters",
    _LAUNCH,
    r"<(?:rosparam|param)\b[^>]*?\b(?:file|from)\s*=\s*\"[^\"]*/([A-Za-z][\w.-]+)\"",
)
_kind("launch.py: program", _PYTHON_LAUNCH, rf"\bexecutable\s*=\s*['\"]{_NAME}['\"]")
_kind("launch.py: package", _PYTHON_LAUNCH, rf"\bpackage\s*=\s*['\"]{_NAME}['\"]")
_kind("launch.py: share directory", _PYTHON_LAUNCH, rf"get_package_share_directory\(\s*['\"]{_NAME}['\"]")
_kind("launch.py: file", _PYTHON_LAUNCH, r"['\"/]([A-Za-z][\w-]+\.(?:launch\.py|yaml|rviz|xacro|urdf|world|sdf))['\"]")
_kind("launch.py: configuration", _PYTHON_LAUNCH, rf"LaunchConfiguration\(\s*['\"]{_NAME}['\"]")
_kind("launch.py: remapping", _PYTHON_LAUNCH, rf"remappings\s*=\s*\[\s*\(\s*['\"]{_NAME}['\"]")
_kind("YAML: parameter", (".yaml",), r"(?m)^[ ]*([a-z][a-z0-9_]{3,}):[ ]")
_kind("C++: topic subscribed", _CPP, rf"\b(?:subscribe|create_subscription)\s*(?:<[\w:<>, ]*>)?\s*\(\s*\"{_NAME}\"")
_kind("C++: topic published", _CPP, rf"\b(?:advertise|create_publisher)\s*(?:<[\w:<>, ]*>)?\s*\(\s*\"{_NAME}\"")
_kind("C++: service called", _CPP, rf"\b(?:serviceClient|create_client)\s*(?:<[\w:<>, ]*>)?\s*\(\s*\"{_NAME}\"")
_kind("C++: type published", _CPP, r"\b(?:advertise|create_publisher)\s*<\s*([\w:]+)\s*>\s*\(", "type")
_kind("C++: parameter declared", _CPP, rf"\bdeclare_parameter\s*(?:<[\w:<>, ]*>)?\s*\(\s*\"{_NAME}\"")
_kind("C++: parameter read", _CPP, rf"\b(?:get_parameter|getParam|param)\s*(?:<[\w:<>, ]*>)?\s*\(\s*\"{_NAME}\"")
_kind(
    "Python: topic subscribed", (".py",), rf"(?:Subscriber\(\s*|create_subscription\(\s*[\w.]+\s*,\s*)['\"]{_NAME}['\"]"
)
_kind("Python: topic published", (".py",), rf"(?:Publisher\(\s*|create_publisher\(\s*[\w.]+\s*,\s*)['\"]{_NAME}['\"]")
_kind(
    "Python: type published",
    (".py",),
    r"(?:Publisher\(\s*['\"][\w/~]+['\"]\s*,\s*|create_publisher\(\s*)([A-Z]\w+)\s*,",
    "type",
)
_kind("Python: callback", (".py",), r"(?:Subscriber|create_subscription|create_timer)\([^()]*\bself\.(\w{4,})\b")
_kind("Python: field of a message", (".py",), r"\b(?:msg|message|data|twist|cmd|pose|odom)\.(\w{4,})\b")
_kind("Python: imported type", (".py",), r"(?m)^from \w+\.(?:msg|srv|action) import (\w{4,})\s*$")
_kind("Python: parameter read", (".py",), rf"\b(?:get_parameter|get_param)\(\s*['\"]{_NAME}['\"]")
_kind("Python: parameter declared", (".py",), rf"\bdeclare_parameter\(\s*['\"]{_NAME}['\"]")
_kind("Python: attribute read", (".py",), r"(?<![\w.])self\.(\w{4,})\b(?!\s*(?:=[^=]|\())")
_kind("Python: method called", (".py",), r"(?<![\w.])self\.(\w{4,})\(")
_kind("Python: name read", (".py",), r"(?:\(|, )([a-z]\w{3,})\)")
_kind("setup.py: entry point", ("setup.py",), r"=\s*([\w.]{4,}):\w+['\"]")
_kind("setup.py: function of an entry point", ("setup.py",), r"=\s*[\w.]+:(\w{3,})['\"]")
_kind(
    "package.xml: dependency",
    ("package.xml",),
    r"(?m)^(\s*<(?:depend|build_depend|run_depend|exec_depend)>[\w-]+</\w+>\s*?\n)",
    "out",
)
_kind("CMake: find_package", ("CMakeLists.txt",), r"(?m)^(\s*find_package\(\s*\w+ REQUIRED\s*\)\s*?\n)", "out")
_kind(
    "CMake: component", ("CMakeLists.txt",), r"find_package\(\s*catkin REQUIRED COMPONENTS[^)]*?(\s\w{4,})(?=\s)", "out"
)
_kind("CMake: source file", ("CMakeLists.txt",), r"add_(?:executable|library)\([^)]*?([\w-]{3,}\.c(?:pp|c|xx))")
_kind("CMake: target", ("CMakeLists.txt",), r"(?:target_link_libraries|ament_target_dependencies)\(\s*(\w{4,})\b")
_kind("CMake: installed directory", ("CMakeLists.txt",), r"install\(\s*DIRECTORY\s+([a-z]\w{3,})/?\s")
_kind("CMake: installed program", ("CMakeLists.txt",), r"install\(\s*PROGRAMS\s+(?:\w+/)*(\w{3,}\.py)")
_kind("CMake: message file", ("CMakeLists.txt",), r"([A-Z]\w{3,}\.(?:msg|srv|action))\b")
_kind("interface: type", (".msg", ".srv", ".action"), r"(?m)^([a-zA-Z][\w/]{4,})(?:\[\d*\])?[ \t]+\w+\s*$")
_kind("URDF: link of a joint", (".urdf", ".xacro"), rf"<(?:parent|child)\s+link\s*=\s*\"{_NAME}\"")
_kind("URDF: mesh", (".urdf", ".xacro"), r"<mesh\b[^>]*?filename\s*=\s*\"[^\"]*/([\w-]{3,}\.(?:stl|STL|dae|DAE))\"")
_kind("xacro: property", (".xacro",), r"\$\{(\w{4,})\}")
_kind("xacro: macro", (".xacro",), r"<xacro:(?!property|macro|include|arg|if|unless|insert_block)(\w{4,})\b")


def slips(root: Path, files: list[str], random: Random, most: int, kinds: list[str]) -> Iterator[Slip]:
    """At most *most* slips of each kind in the files, drawn by *random*."""
    texts = {}
    for file in files:
        try:
            texts[file] = (root / file).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError):
            continue
    for kind in kinds:
        ends, pattern, how = KINDS[kind]
        places = [
            (file, found)
            for file in sorted(texts)
            if file.endswith(ends) and len(texts[file]) < 200_000
            for found in re.finditer(pattern, texts[file])
            if not _is_comment(texts[file], found.start(1))
        ]
        random.shuffle(places)
        done = 0
        for file, found in places:
            if done == most:
                break
            word = HOW[how](found[1], random)
            if word is None:
                continue
            text = texts[file]
            line = text.count("\n", 0, found.start(1)) + 1
            yield Slip(kind, file, line, found[1].strip(), word, text[: found.start(1)] + word + text[found.end(1) :])
            done += 1


def _is_comment(text: str, at: int) -> bool:
    """Whether a line is a comment, roughly: from the first signs of its line, or within an XML comment."""
    line = text[text.rfind("\n", 0, at) + 1 : at].lstrip()
    return line.startswith(("#", "//", "*", "<!--")) or text.rfind("<!--", 0, at) > text.rfind("-->", 0, at)


def _letter(word: str, random: Random) -> str | None:
    """The word without one of its letters, that of its last part, so that file endings and namespaces stay."""
    stem = word.rpartition(".")[0] if re.search(r"\.[A-Za-z]{2,6}$", word) else word
    start = stem.rfind("/") + 1
    letters = [at for at in range(start + 1, len(stem)) if stem[at].isalpha() and stem[at] != stem[at - 1]]
    if len(stem) - start < 3 or not letters:
        return None
    at = random.choice(letters)
    return word[:at] + word[at + 1 :]


def _type(word: str, random: Random) -> str | None:
    """Another type of the same package, which is there."""
    others = {"String": "Int32", "Twist": "Pose", "Float64": "Float32", "LaserScan": "Imu", "Bool": "Int8", "Image": "Imu", "Int32": "String",
              "PoseStamped": "TwistStamped", "Path": "Odometry", "Odometry": "Path", "Float32": "Float64", "Imu": "Image"}  # fmt: skip
    head, sign, last = word.rpartition("::")
    return f"{head}{sign}{others[last]}" if sign and last in others else None


def _out(word: str, random: Random) -> str | None:
    return ""


HOW: dict[str, Callable[[str, Random], str | None]] = {"letter": _letter, "type": _type, "out": _out}


def _git(root: Path, *arguments: str) -> None:
    names = [
        "-c",
        "user.name=a",
        "-c",
        "user.email=a@example.org",
        "-c",
        "commit.gpgsign=false",
        "-c",
        "core.hooksPath=/dev/null",
    ]
    subprocess.run(["git", "-C", str(root), *names, *arguments], check=True, capture_output=True)


def check(root: Path, cache: Path) -> list[dict[str, object]]:
    """The new results of the tree against its last commit, known ones with others left out."""
    log = cache / "log.json"
    command = [
        sys.executable,
        "-m",
        "haros_ci",
        "check",
        ".",
        "--isolated",
        "--fail-on",
        "never",
        "--baseline-rev",
        "HEAD",
    ]
    done = subprocess.run(
        [*command, "--cache-dir", str(cache), "--output", f"json={log}"], cwd=root, capture_output=True, text=True
    )
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr[-500:]}")
    return [result for result in json.loads(log.read_text(encoding="utf-8"))["results"] if result["state"] == "new"]


def of_checkout(checkout: Path, options: argparse.Namespace) -> Iterator[tuple[Slip, list[dict[str, object]]]]:
    """Each slip that is made in a copy of *checkout*, with the new results of ``check``."""
    with tempfile.TemporaryDirectory(dir=options.work) as directory:
        root, cache = Path(directory, checkout.name), Path(directory, "cache")
        cache.mkdir()
        shutil.copytree(checkout, root, symlinks=True, ignore=shutil.ignore_patterns(".git"))
        _git(root, "init", "-q")
        _git(root, "add", "-A", "-f")
        _git(root, "commit", "-q", "-m", "base")
        files = sorted(
            str(path.relative_to(root))
            for path in root.rglob("*")
            if path.is_file() and not path.is_symlink() and ".git" not in path.parts
        )
        random = Random(f"{options.seed} {checkout.name}")
        for slip in list(slips(root, files, random, options.most, options.kinds)):
            place = root / slip.path
            before = place.read_bytes()
            place.write_text(slip.text, encoding="utf-8")
            try:
                yield slip, check(root, cache)
            finally:
                place.write_bytes(before)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkouts", nargs="+", type=Path, metavar="CHECKOUT")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=int, default=3, help="of each kind, in each checkout (3)")
    parser.add_argument("--kinds", nargs="+", default=list(KINDS), choices=list(KINDS), metavar="KIND")
    parser.add_argument("--work", type=Path, help="where copies are made (the system's temporary directory)")
    parser.add_argument("--output", type=Path, help="gets one JSON object per slip")
    options = parser.parse_args()
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for checkout in options.checkouts:
        for slip, new in of_checkout(checkout.resolve(), options):
            loud = [result for result in new if result["level"] != "note"]
            verdict = "found" if loud else "noted" if new else "missed"
            counts[slip.kind][verdict] += 1
            row = slip._asdict() | {"checkout": checkout.name, "verdict": verdict}
            del row["text"]
            row["results"] = [
                [each["tool"], each["rule"], each["level"], each["path"], each["line"], each["message"]]
                for each in (loud or new)[:4]
            ]
            if options.output:
                with options.output.open("a", encoding="utf-8") as output:
                    output.write(json.dumps(row) + "\n")
            print(
                f"{verdict:6} {slip.kind}: {checkout.name}/{slip.path}:{slip.line} {slip.before!r} > {slip.after!r}",
                file=sys.stderr,
                flush=True,
            )
    print("| kind | slips | found | noted | missed |\n|---|---|---|---|---|")
    for kind, count in [*counts.items(), ("all", sum(counts.values(), Counter()))]:
        print(f"| {kind} | {count.total()} | {count['found']} | {count['noted']} | {count['missed']} |")


if __name__ == "__main__":
    main()
