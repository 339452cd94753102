# SPDX-License-Identifier: Apache-2.0
"""clang-tidy, where it is installed, finds the defect in the bad example of a check, and not in the good one.

It comes with no extra of ours (its wheel has 60 MB): ``pip install clang-tidy`` runs this. What the examples of the other tools do is in
test_example_pairs.py.
"""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from haros_ci.linters import clang_tidy
from haros_ci.linters.catalogue.clang_tidy_examples import PAIRS
from haros_ci.linters.catalogue.clang_tidy_texts import TEXTS
from haros_ci.linters.catalogue.examples import BY_RULE
from haros_ci.linters.linter import LintOptions


@dataclass(frozen=True)
class Around:
    """What stands around an example, which is put where the first @ is, as far to the right; and what else the compiler is told."""

    text: str = "@\n"
    flags: str = ""


AROUND = {
    "bugprone-bad-signal-to-kill-thread": Around("#include <pthread.h>\n#include <signal.h>\nextern volatile bool stop_;\nvoid f(pthread_t thread) {\n  @\n}\n"),
    "bugprone-command-processor": Around("#include <cstdlib>\n#include <string>\n#include <unistd.h>\nvoid f(const std::string & topic) {\n  @\n}\n"),
    "bugprone-copy-constructor-mutates-argument": Around("class Buffer {\n public:\n  @\n private:\n  int size_ = 0;\n};\n"),
    "bugprone-default-operator-new-on-overaligned-type": Around("@\n", "-std=c++14"),
    "bugprone-exception-copy-constructor-throws": Around("#include <stdexcept>\n#include <string>\n@\nvoid fail(const Failure & failure) { throw failure; }\n"),
    "bugprone-float-loop-counter": Around("void scan(float angle);\nvoid f() {\n  @\n}\n"),
    "bugprone-pointer-arithmetic-on-polymorphic-object": Around("#include <vector>\nclass Joint {\n public:\n  virtual ~Joint();\n  virtual void stop();\n};\n@\n"),
    "bugprone-random-generator-seed": Around("#include <random>\nvoid f() {\n  @\n}\n"),
    "bugprone-raw-memory-call-on-non-trivial-type": Around("#include <cstring>\n#include <string>\nstruct Pose {\n  std::string frame;\n  double x = 0;\n};\nvoid f(Pose & pose) {\n  @\n}\n"),
    "bugprone-signal-handler": Around("#include <signal.h>\n#include <stdio.h>\nvolatile sig_atomic_t stop = 0;\n@\nint main() { signal(SIGINT, on_signal); }\n", "-std=c++14"),
    "bugprone-signed-char-misuse": Around("void f(char byte) {\n  @\n  (void)code;\n}\n"),
    "bugprone-sizeof-expression": Around("#include <string.h>\nvoid f(char * target) {\n  char ranges[10] = {};\n  @\n}\n"),
    "bugprone-spuriously-wake-up-functions": Around("#include <condition_variable>\n#include <mutex>\nvoid f(std::mutex & mutex, std::condition_variable & condition, bool & ready) {\n  std::unique_lock<std::mutex> lock(mutex);\n  @\n}\n"),
    "bugprone-std-namespace-modification": Around("#include <string>\n@\n"),
    "bugprone-suspicious-memory-comparison": Around("#include <string.h>\nstruct Pose {\n  double x;\n  bool is_set;\n};\nbool f(const Pose & a, const Pose & b) {\n  @\n}\n"),
    "bugprone-throwing-static-initialization": Around("#include <string>\nstd::string load_name();\n@\n"),
    "bugprone-unchecked-string-to-number-conversion": Around("#include <cstdlib>\nvoid f(const char * text) {\n  @\n  (void)rate;\n}\n"),
    "bugprone-undelegated-constructor": Around("class Lamp {\n public:\n  @\n  explicit Lamp(int pin);\n};\n"),
    "bugprone-unhandled-self-assignment": Around("#include <utility>\nclass Scan {\n public:\n  Scan(const Scan & other);\n  ~Scan();\n  @\n private:\n  float * copy() const;\n  float * data_ = nullptr;\n};\n"),
    "bugprone-unsafe-functions": Around("#include <string.h>\n#include <strings.h>\nvoid f(char * buffer, size_t size) {\n  @\n}\n"),
    "bugprone-use-after-move": Around("#include <memory>\nstruct Message { int data; };\nstruct Publisher { void publish(std::unique_ptr<Message> message); };\nvoid log(int);\nvoid f(Publisher * publisher, std::unique_ptr<Message> message) {\n  @\n}\n"),
    "clang-analyzer-core.NullDereference": Around("struct Goal { const char * text; };\nGoal * find(int id);\nvoid log(const char *);\nvoid f(int id) {\n  @\n}\n"),
    "clang-analyzer-core.UndefinedBinaryOperatorResult": Around("int f(int count) {\n  @\n  return total;\n}\n"),
    "clang-analyzer-core.uninitialized.Assign": Around("int f() {\n  @\n  return flags;\n}\n"),
    "clang-analyzer-cplusplus.NewDelete": Around("#include <memory>\nstruct Goal { int id = 0; };\nvoid log(int);\nvoid f() {\n  @\n}\n"),
    "clang-analyzer-cplusplus.NewDeleteLeaks": Around("#include <vector>\nvoid f(int size) {\n  @\n}\n"),
    "clang-analyzer-unix.Malloc": Around("#include <cstdlib>\n#include <vector>\nvoid f(size_t size) {\n  @\n}\n"),
    "clang-analyzer-unix.MismatchedDeallocator": Around("#include <cstdlib>\nvoid f() {\n  @\n}\n"),
    "clang-diagnostic-cast-align": Around("#include <cstring>\nint f(const char * bytes) {\n  @\n  return value;\n}\n", "-Wcast-align"),
    "clang-diagnostic-cast-qual": Around("void f(const int * limit) {\n  @\n}\n", "-Wcast-qual"),
    "clang-diagnostic-char-subscripts": Around("int counts[256];\nvoid f(char byte) {\n  @\n}\n", "-Wall"),
    "clang-diagnostic-dangling-initializer-list": Around("#include <initializer_list>\n#include <vector>\nvoid f() {\n  @\n}\n"),
    "clang-diagnostic-delete-abstract-non-virtual-dtor": Around("@\n", "-Wall"),
    "clang-diagnostic-delete-non-abstract-non-virtual-dtor": Around("@\n", "-Wall"),
    "clang-diagnostic-dynamic-class-memaccess": Around("#include <string.h>\nstruct Part { virtual ~Part() = default; int id; };\nvoid f(Part * part) {\n  @\n}\n"),
    "clang-diagnostic-exceptions": Around("#include <stdexcept>\nvoid g();\nvoid f() {\n  try {\n    g();\n  @\n  }\n}\n"),
    "clang-diagnostic-format": Around("#include <cstdio>\nvoid f(long stamp) {\n  @\n}\n"),
    "clang-diagnostic-implicit-int": Around("@\n"),
    "clang-diagnostic-incompatible-pointer-types": Around("double speed;\nvoid f(void) {\n  @\n  (void)value;\n}\n"),
    "clang-diagnostic-incompatible-pointer-types-discards-qualifiers": Around("void reset(int * values);\nvoid f(const int * limits) {\n  @\n}\n"),
    "clang-diagnostic-int-conversion": Around("void read_into(int * target);\nvoid f(void) {\n  int count;\n  @\n}\n"),
    "clang-diagnostic-int-to-pointer-cast": Around("#include <cstdint>\n@\n"),
    "clang-diagnostic-int-to-void-pointer-cast": Around("#include <cstdint>\n@\n"),
    "clang-diagnostic-invalid-noreturn": Around("#include <cstdlib>\n@\n"),
    "clang-diagnostic-invalid-offsetof": Around("#include <cstddef>\nstruct Part { virtual ~Part(); int id; };\nvoid f(const Part & part) {\n  @\n  (void)at;\n}\n"),
    "clang-diagnostic-logical-op-parentheses": Around("void g();\nvoid f(bool a, bool b, bool c) {\n  @\n    g();\n  }\n}\n", "-Wall"),
    "clang-diagnostic-mismatched-new-delete": Around("#include <vector>\nvoid f() {\n  @\n}\n"),
    "clang-diagnostic-non-pod-varargs": Around("#include <cstdio>\n#include <string>\nvoid f(const std::string & name) {\n  @\n}\n"),
    "clang-diagnostic-parentheses": Around("enum State { STOPPED, MOVING };\nvoid g();\nvoid f(int state) {\n  @\n    g();\n  }\n}\n", "-Wall"),
    "clang-diagnostic-reorder-ctor": Around("struct Scan {\n  @\n};\n", "-Wall"),
    "clang-diagnostic-reserved-macro-identifier": Around("@\n", "-Weverything"),
    "clang-diagnostic-sometimes-uninitialized": Around("int f(bool enabled) {\n  @\n}\n", "-Wall"),
    "clang-diagnostic-trigraphs": Around("@\n", "-Wall"),
    "clang-diagnostic-unevaluated-expression": Around("void f(int count) {\n  @\n  (void)size;\n}\n", "-Wall"),
    "clang-diagnostic-uninitialized": Around("int f() {\n  @\n}\n", "-Wall"),
    "clang-diagnostic-unreachable-code": Around("void stop();\nint f() {\n  @\n}\n", "-Wunreachable-code"),
    "clang-diagnostic-unsequenced": Around("int f(int i) {\n  @\n  return i;\n}\n", "-Wall"),
    "clang-diagnostic-unused-comparison": Around("void f(int left, int right) {\n  @\n}\n", "-Wall"),
    "clang-diagnostic-unused-parameter": Around("struct Event {};\nvoid publish();\n@\n", "-Wextra"),
    "clang-diagnostic-unused-value": Around("void f(int left, int right, int & total) {\n  @\n}\n", "-Wall"),
    "clang-diagnostic-varargs": Around("#include <cstdarg>\nvoid f(int rate, const char * format, ...) {\n  va_list rest;\n  @\n  va_end(rest);\n}\n"),
    "clang-diagnostic-vexing-parse": Around("struct Mutex {};\nstruct Lock {\n  explicit Lock(Mutex mutex);\n};\nvoid f() {\n  @\n}\n"),
    "concurrency-thread-canceltype-asynchronous": Around("#include <pthread.h>\nvoid f() {\n  int old;\n  @\n}\n"),
    "google-readability-casting": Around("void f(int ticks) {\n  @\n  (void)ratio;\n}\n"),
    "modernize-use-override": Around("class Part {\n public:\n  virtual void stop();\n};\n@\n"),
    "performance-for-range-copy": Around("#include <string>\n#include <vector>\nstruct Pose { double x; std::string frame; };\nstruct Path { std::vector<Pose> poses; };\nvoid show(double);\nvoid f(const Path & path) {\n  @\n    show(pose.x);\n  }\n}\n"),
    "performance-move-const-arg": Around("#include <string>\n#include <utility>\nvoid store(std::string text);\nvoid f() {\n  @\n}\n"),
    "performance-move-constructor-init": Around("#include <string>\n#include <utility>\nclass Arm {\n public:\n  @\n private:\n  std::string name_;\n};\n"),
    "performance-noexcept-move-constructor": Around("struct Scan {\n  @\n};\n"),
    "performance-unnecessary-value-param": Around("#include <string>\nvoid print(size_t);\n@\n"),
}  # fmt: skip
#: Texts without an example: clang has these names for groups of warnings, and gives a finding the name in the group.
GROUPS = {
    "clang-diagnostic-delete-non-virtual-dtor": "clang-diagnostic-delete-non-abstract-non-virtual-dtor",
    "clang-diagnostic-reorder": "clang-diagnostic-reorder-ctor",
    "clang-diagnostic-reserved-id-macro": "clang-diagnostic-reserved-macro-identifier",
}
SHARED = frozenset(
    rule for rule in BY_RULE if rule.startswith(("bugprone-", "clang-", "google-", "modernize-", "performance-"))
)
LINE = re.compile(r"(.+?):\d+:\d+: (?:error|warning): .* \[([\w.,+-]+)\]")


@pytest.mark.parametrize("rule", sorted({*PAIRS, *SHARED}))
def test_the_defect_is_found_in_the_bad_example_alone(rule: str) -> None:
    found = _found()
    if found is None:
        pytest.skip("clang-tidy is not installed")
    kinds = {
        name.rpartition(".")[0].rpartition("_")[2] for name, check in found if check == rule and name in _files(rule)
    }
    assert kinds == {"bad"}


@pytest.mark.parametrize("rule", sorted({*PAIRS, *SHARED}))
def test_an_example_compiles(rule: str) -> None:
    found = _found()
    if found is None:
        pytest.skip("clang-tidy is not installed")
    assert not [name for name, check in found if check == "clang-diagnostic-error" and name in _files(rule)]


def test_every_text_has_an_example() -> None:
    assert {*TEXTS} - {*BY_RULE} == {*GROUPS}
    assert {*GROUPS.values()} <= {*BY_RULE}


def test_only_examples_that_there_are_have_surroundings() -> None:
    assert {*AROUND} <= {*PAIRS, *SHARED}


def _files(rule: str) -> dict[str, str]:
    """The bad and the good example of *rule* as files."""
    pair, stem = BY_RULE[rule], re.sub(r"\W", "_", rule)
    before, _, after = AROUND.get(rule, Around()).text.partition("@")
    indent = before.rpartition("\n")[2]
    texts = {"bad": pair.bad, "good": pair.good}
    return {
        f"{stem}_{kind}.{pair.language}": before + text.replace("\n", "\n" + indent) + after
        for kind, text in texts.items()
    }


@cache
def _found() -> frozenset[tuple[str, str]] | None:
    """Which check clang-tidy finds in which file: one process for all of them. None: it is not installed."""
    program = clang_tidy.locate(LintOptions())
    if program is None:
        return None
    rules = sorted({*PAIRS, *SHARED})
    with TemporaryDirectory() as name:
        directory, entries = Path(name), []
        for rule in rules:
            flags = AROUND.get(rule, Around()).flags.split()
            for file, text in _files(rule).items():
                (directory / file).write_text(text, encoding="utf-8")
                standard = (
                    [] if file.endswith(".c") or any(flag.startswith("-std") for flag in flags) else ["-std=c++17"]
                )
                entries.append({"directory": name, "file": file, "arguments": ["clang", *standard, *flags, "-c", file]})
        (directory / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
        files = [str(directory / entry["file"]) for entry in entries]
        command = [*program.argv, "-p", name, "--quiet", f"--checks=-*,{','.join(rules)},clang-diagnostic-*", *files]
        output = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    matches = (LINE.match(line) for line in output.splitlines())
    return frozenset((Path(match[1]).name, check) for match in matches if match for check in match[2].split(","))
