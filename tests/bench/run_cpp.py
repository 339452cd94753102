# SPDX-License-Identifier: Apache-2.0
"""Compile and run generated C++ programs, many in one translation unit, against a stand-in for roscpp that writes down what is made.

Only programs that this project generates are given to it.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from tests.bench.run_judge import Run

RUNS = 12
#: Seconds that the compiler and all runs of one batch may take.
LIMIT = 240

STUB = r"""
#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <iostream>
#include <iterator>
#include <list>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>
#include <unistd.h>
#include <sys/resource.h>
#include <sys/wait.h>

inline int oracle_program, oracle_seed, oracle_made;
inline unsigned oracle_state;
inline std::vector<std::function<void()>>* oracle_callbacks = new std::vector<std::function<void()>>;
inline void oracle_write(const std::string& text) {
  std::string line = std::to_string(oracle_program) + "\t" + std::to_string(oracle_seed) + "\t" + text + "\n";
  if (write(1, line.data(), line.size()) < 0) _exit(9);
}
extern "C" bool chance() {
  oracle_state = oracle_state * 1103515245u + 12345u;
  return (oracle_state >> 16) & 1u;
}
inline void oracle_make(const char* kind, const std::string& ns, const std::string& name, const char* type, int queue) {
  if (++oracle_made > 500 || name.size() > 400) _exit(8);
  if (name.empty()) return;
  std::string full = !name.empty() && name[0] == '/' ? name : ns + "/" + name;
  for (char& c : full) if (c == '\n' || c == '\t') c = ' ';
  oracle_write(std::string(kind) + "\t" + full + "\t" + type + "\t" + std::to_string(queue));
}
namespace boost { using std::bind; using std::function; using std::make_shared; using std::shared_ptr; }
using std::placeholders::_1;
namespace std_msgs {
struct String { typedef std::shared_ptr<String const> ConstPtr; static const char* type() { return "String"; } std::string data; };
struct Bool { typedef std::shared_ptr<Bool const> ConstPtr; static const char* type() { return "Bool"; } bool data; };
struct Int32 { typedef std::shared_ptr<Int32 const> ConstPtr; static const char* type() { return "Int32"; } int data; };
struct Empty { typedef std::shared_ptr<Empty const> ConstPtr; static const char* type() { return "Empty"; } };
typedef String::ConstPtr StringConstPtr;
typedef Bool::ConstPtr BoolConstPtr;
}
namespace ros {
struct Publisher { template <class M> void publish(const M&) const {} };
struct Subscriber {};
inline void init(int&, char**, const std::string&) {}
inline bool ok() { return true; }
struct NodeHandle {
  std::string ns;
  NodeHandle() {}
  NodeHandle(const char* name) : NodeHandle(std::string(name)) {}
  NodeHandle(const std::string& name) : NodeHandle(NodeHandle(), name) {}
  NodeHandle(const NodeHandle& outer, const std::string& name) {
    if (name.empty()) ns = outer.ns;
    else if (name[0] == '~') ns = name.size() > 1 ? "/n/" + name.substr(1) : "/n";
    else ns = name[0] == '/' ? (name.size() > 1 ? name : "") : outer.ns + "/" + name;
  }
  template <class M> Publisher advertise(const std::string& name, int queue, bool = false) {
    oracle_make("publishers", ns, name, M::type(), queue);
    return Publisher();
  }
  template <class M, class F> Subscriber keep(const std::string& name, int queue, F callback) {
    oracle_make("subscribers", ns, name, M::type(), queue);
    oracle_callbacks->push_back([callback]() mutable { callback(std::make_shared<M const>()); });
    return Subscriber();
  }
  template <class M, class F, class = std::enable_if_t<!std::is_pointer<F>::value>> Subscriber subscribe(const std::string& name, int queue, F callback) {
    return keep<M>(name, queue, callback);
  }
  template <class M> Subscriber subscribe(const std::string& name, int queue, void (*callback)(const std::shared_ptr<M const>&)) {
    return keep<M>(name, queue, callback);
  }
  template <class M, class T> Subscriber subscribe(const std::string& name, int queue, void (T::*callback)(const std::shared_ptr<M const>&), T* object) {
    return keep<M>(name, queue, [object, callback](const std::shared_ptr<M const>& m) { (object->*callback)(m); });
  }
};
inline void spin() {
  for (int turn = 0; turn < 3; ++turn) {
    std::vector<std::function<void()>> now = *oracle_callbacks;
    for (auto& callback : now) callback();
  }
  oracle_write("spun");
}
}
"""

DRIVER = r"""
struct OracleProgram { int number; int (*main)(int, char**); };
static OracleProgram oracle_programs[] = {%s};
int main(int argc, char** argv) {
  rlimit memory{800000000, 800000000};
  setrlimit(RLIMIT_AS, &memory);
  rlimit core{0, 0};
  setrlimit(RLIMIT_CORE, &core);
  for (auto& program : oracle_programs)
    for (int seed = 0; seed < %d; ++seed) {
      pid_t child = fork();
      if (child == 0) {
        alarm(2);
        oracle_program = program.number;
        oracle_seed = seed;
        oracle_state = program.number * 7919u + seed * 104729u + 1u;
        program.main(argc, argv);
        _exit(0);
      }
      int status;
      waitpid(child, &status, 0);
    }
}
"""
FLAGS = ("-std=c++17", "-O0", "-w", "-D_GLIBCXX_ASSERTIONS", "-fmax-errors=0")
INCLUDE = re.compile(r"^#include.*$|^extern \"C\" bool chance.*$", re.MULTILINE)


class Compiler:
    """A directory with the stand-in, compiled once."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        (directory / "stub.h").write_text(STUB)
        subprocess.run(["g++", *FLAGS, "-x", "c++-header", "stub.h", "-o", "stub.h.gch"], cwd=directory, check=True)

    def run(self, texts: Mapping[int, str]) -> tuple[dict[int, list[Run]], dict[int, str]]:
        """The runs of each program by its number, and the first error of those that do not compile."""
        wrong: dict[int, str] = {}
        for _ in range(8):
            left = {number: text for number, text in texts.items() if number not in wrong}
            if not left:
                break
            errors = self._compile(left)
            if errors is None:
                return self._run(left), wrong
            wrong |= errors
        return {}, wrong

    def _compile(self, texts: Mapping[int, str]) -> dict[int, str] | None:
        parts = ['#include "stub.h"']
        for number, text in texts.items():
            parts.append(f'namespace p{number} {{\n#line 1 "p{number}.cpp"\n{INCLUDE.sub("", text)}\n}}')
        table = ", ".join(f"{{{number}, p{number}::main}}" for number in texts)
        parts.append('#line 1 "driver.cpp"' + DRIVER % (table, RUNS))
        (self.directory / "all.cpp").write_text("\n".join(parts))
        done = subprocess.run(
            ["g++", *FLAGS, "all.cpp", "-o", "all"],
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=LIMIT,
            check=False,
        )
        if done.returncode == 0:
            return None
        errors: dict[int, str] = {}
        for line in done.stderr.splitlines():
            found = re.match(r"p(\d+)\.cpp:\d+:\d+: (?:error|fatal error|internal)", line)
            if found:
                errors.setdefault(int(found[1]), line)
        if not errors:
            for line in done.stderr.splitlines():
                for name in re.findall(r"\bp(\d+)(?:\.cpp|::)", line):
                    errors.setdefault(int(name), line)
        return errors or dict.fromkeys(texts, done.stderr[:500])

    def _run(self, texts: Mapping[int, str]) -> dict[int, list[Run]]:
        done = subprocess.run(
            ["./all"],
            cwd=self.directory,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=LIMIT,
            check=False,
        )
        runs = {number: [Run([]) for _ in range(RUNS)] for number in texts}
        for line in done.stdout.decode(errors="replace").splitlines():
            number, seed, *rest = line.split("\t")
            if int(number) not in runs:  # it was made before any program began
                continue
            one = runs[int(number)][int(seed)]
            if rest == ["spun"]:
                one.error = ""
            else:
                kind, name, type_, queue = rest
                one.made.append((kind, name, type_, int(queue)))
        return runs


@contextmanager
def compiler() -> Iterator[Compiler]:
    with tempfile.TemporaryDirectory(prefix="run_cpp") as directory:
        yield Compiler(Path(directory))
