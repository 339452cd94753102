# SPDX-License-Identifier: Apache-2.0
"""The process in which libclang reads hostile source: one JSON request on standard input, one JSON answer on output.

Started as ``python -I -m haros_ci.extract.cpp.exact_worker``. ``exact`` writes the request and reads the answer. Exit
code 2 is a request that makes no sense, 3 that libclang is missing; a crash, or a limit reached, ends the process.
"""

from __future__ import annotations

import contextlib
import glob
import json
import os
import platform
import re
import sys
from collections.abc import Iterator, Sequence
from typing import Any, BinaryIO

from haros_ci.regex import regex

REQUEST_LIMIT = 16_000_000
FILE_LIMIT = 4_000_000
#: Bytes of address space; a large ROS file takes 0.5 GB.
MEMORY_LIMIT = 4_000_000_000
#: For one file; the slowest seen took a tenth of it.
SECONDS = 60
#: What may be included and named by flags besides the root and the headers; the same as for linters.
SYSTEM_PREFIXES = ("/usr", "/opt", "/lib", "/Library", "/Applications")
DIRECTORY_FLAGS = ("-isystem", "-iquote", "-I")
_PLAIN = regex(r"-D[A-Za-z_]\w*(?:\([\w, .]*\))?(?:=.*)?|-U[A-Za-z_]\w*|-std=(?:c|gnu)\+\+[0-9a-z]{2}")
_ABSENT = regex(r"#\s*(?:ifndef\s+(\w+)|if\s*!\s*defined\b[\s(]*(\w+))")
_DEFINE = regex(r"#\s*define\s")
_ENDIF = regex(r"#\s*endif\b")
_OPTIONS = (
    "-x", "c++", "-nostdinc", "-nostdinc++", "-w", "-ferror-limit=0", "-fno-spell-checking", "-ftemplate-depth=512",
)  # fmt: skip
#: What differs from one day to the next is not a constant.
_UNDEFINED = ("-U__DATE__", "-U__TIME__", "-U__TIMESTAMP__")
#: The least of a compiler's own headers, for systems without a compiler.
_STUBS = {
    "stddef.h": "#pragma once\ntypedef __SIZE_TYPE__ size_t;\ntypedef __PTRDIFF_TYPE__ ptrdiff_t;\n"
    "#ifndef __cplusplus\ntypedef __WCHAR_TYPE__ wchar_t;\n#endif\n#undef NULL\n#define NULL __null\n"
    "#define offsetof(t, d) __builtin_offsetof(t, d)\ntypedef long double max_align_t;\n",
    "stdarg.h": "#pragma once\ntypedef __builtin_va_list va_list;\ntypedef __builtin_va_list __gnuc_va_list;\n"
    "#define va_start(a, b) __builtin_va_start(a, b)\n#define va_end(a) __builtin_va_end(a)\n"
    "#define va_arg(a, t) __builtin_va_arg(a, t)\n#define va_copy(a, b) __builtin_va_copy(a, b)\n",
    "stdbool.h": "#pragma once\n",
    "limits.h": "#pragma once\n#define CHAR_BIT 8\n#define SCHAR_MAX 127\n#define SCHAR_MIN (-128)\n"
    "#define UCHAR_MAX 255\n#define CHAR_MAX SCHAR_MAX\n#define CHAR_MIN SCHAR_MIN\n#define SHRT_MAX 32767\n"
    "#define SHRT_MIN (-32768)\n#define USHRT_MAX 65535\n#define INT_MAX __INT_MAX__\n"
    "#define INT_MIN (-__INT_MAX__ - 1)\n#define UINT_MAX (__INT_MAX__ * 2U + 1U)\n"
    "#define LONG_MAX __LONG_MAX__\n#define LONG_MIN (-__LONG_MAX__ - 1L)\n"
    "#define ULONG_MAX (__LONG_MAX__ * 2UL + 1UL)\n",
    "float.h": "#pragma once\n"
    + "".join(
        f"#define {kind}_{name} __{kind}_{name}__\n"
        for kind in ("FLT", "DBL", "LDBL")
        for name in ("MAX", "MIN", "EPSILON", "DIG", "MANT_DIG", "MAX_EXP", "MIN_EXP")
    ),
}


def main(stdin: BinaryIO) -> int:
    """Answer the request on *stdin*."""
    try:
        data = stdin.read(REQUEST_LIMIT + 1)
        request: Any = json.loads(data) if len(data) <= REQUEST_LIMIT else None
        root, headers, files = request["root"], request["headers"], request["files"]
        well = os.path.isabs(root) and os.path.isdir(root) and isinstance(files, list) and isinstance(headers, list)
        found = answer(os.path.realpath(root), files, [h for h in headers if isinstance(h, str)]) if well else None
    except (ValueError, TypeError, KeyError, RecursionError):
        found = None
    except Exception as err:
        if not isinstance(err, ImportError) and type(err).__name__ != "LibclangError":
            raise
        print(f"libclang cannot be loaded: {err}", file=sys.stderr)
        return 3
    if found is None:
        print("not a request: an object with root, headers and files is expected", file=sys.stderr)
        return 2
    json.dump(found, sys.stdout, sort_keys=True, allow_nan=False)
    return 0


def answer(root: str, files: Sequence[object], headers: Sequence[str]) -> dict[str, Any]:
    """The answer; empty at once, without libclang, where there are no headers."""
    found: dict[str, Any] = {}
    failed: dict[str, str] = {}
    prefixes = [os.path.realpath(h) for h in headers if os.path.isabs(h) and os.path.isdir(h)]
    if not prefixes:
        return {"files": found, "failed": failed}
    system, unsaved = installed(prefixes)
    base = [*_OPTIONS, f"-fmacro-prefix-map={root}/=", *_UNDEFINED]
    for entry in files:
        if not isinstance(entry, dict) or not isinstance(entry.get("path"), str):
            continue
        name, calls = entry["path"], places(entry.get("calls"))
        path = within(root, name)
        if path is None:
            failed[name] = "not a readable file inside the workspace"
            continue
        if not calls:
            continue
        provided = list(harmless(entry.get("flags"), [root, *prefixes, *SYSTEM_PREFIXES]))
        standard = [] if any(f.startswith("-std=") for f in provided) else ["-std=c++17"]
        limit_time()
        from haros_ci.extract.cpp import exact_clang

        try:
            unknown = undecided([path], provided)
            unit = exact_clang.read(path, [*base, *standard, *unknown, *provided, *system], unsaved)
            # An #include may name any file. What came from outside must not show in an answer: the file then has none.
            seen = exact_clang.included(unit).difference(stub for stub, _ in unsaved)
            if not all(_is_inside(p, [root, *prefixes, *SYSTEM_PREFIXES]) for p in seen):
                failed[name] = "includes a file from outside of the workspace and the installed headers"
                continue
            again = undecided([path, *(p for p in seen if _is_inside(p, [root]))], provided)
            if again != unknown:
                unit = None
                unit = exact_clang.read(path, [*base, *standard, *again, *provided, *system], unsaved)
            found[name] = exact_clang.calls(unit, path, calls)
        except exact_clang.Unreadable as err:
            failed[name] = str(err)
        finally:
            unit = None
    return {"files": found, "failed": failed}


def undecided(paths: Sequence[str], flags: Sequence[str]) -> list[str]:
    """Flags for the macros that the files at *paths* define only where the build does not: nobody knows their value.

    ``#ifndef X``, ``#define X value``, ``#endif``: X becomes an undeclared name, and with it whatever it is used for.
    """
    keys = {flag[2:].partition("=")[0] for flag in flags if flag.startswith(("-D", "-U"))}
    names: set[str] = set()
    for path in paths:
        with contextlib.suppress(OSError), open(path, encoding="utf-8", errors="replace") as stream:
            lines = [line.strip() for line in stream if line.strip()]
            for first, second, third in zip(lines, lines[1:], lines[2:], strict=False):
                name = _ABSENT.match(first)
                if name and _DEFINE.match(second) and _ENDIF.match(third):
                    defined = second.partition("define")[2].split()
                    if len(defined) > 1 and defined[0] == (name[1] or name[2]):
                        names.add(defined[0])
    return [f"-D{name}=_unknown_value_of_{name}" for name in sorted(names - keys)]


def places(value: object) -> set[tuple[int, int]]:
    """The lines and columns asked for."""
    entries = value if isinstance(value, list) else []
    pairs = [e for e in entries if isinstance(e, list) and len(e) == 2]
    return {(e[0], e[1]) for e in pairs if all(type(n) is int and n > 0 for n in e)}


def within(root: str, name: str) -> str | None:
    """The real path of a regular file inside *root*, of a size that is read."""
    if not name.isprintable() or os.path.isabs(name) or ".." in name.split("/"):
        return None
    path = os.path.realpath(os.path.join(root, name))
    try:
        is_fit = _is_inside(path, [root]) and os.path.isfile(path) and os.path.getsize(path) <= FILE_LIMIT
    except OSError:
        return None
    return path if is_fit else None


def harmless(flags: object, prefixes: Sequence[str]) -> Iterator[str]:
    """Of *flags* those that cannot make libclang read or write anything else: definitions, the standard, directories.

    They have passed such a list before; this one does not rely on it.
    """
    following = iter([f for f in flags if isinstance(f, str)] if isinstance(flags, list) else [])
    for argument in following:
        flag = next((f for f in DIRECTORY_FLAGS if argument.startswith(f)), None)
        if flag is not None:
            value = argument[len(flag) :] or next(following, "")
            path = os.path.realpath(value) if os.path.isabs(value) and value.isprintable() else ""
            if os.path.isdir(path) and _is_inside(path, prefixes):
                yield from (flag, path)
        elif argument.isprintable() and _PLAIN.fullmatch(argument):
            yield argument


def installed(prefixes: Sequence[str]) -> tuple[list[str], list[tuple[str, str]]]:
    """Flags for the directories below *prefixes* in a compiler's order, and stubs of its own headers if it has none.

    libstdc++ keeps its headers in ``c++/<version>``, Debian part of the C library's in ``<triplet>``; a ROS 2 package
    in ``<package>/<package>``.
    """
    machine = f"{platform.machine()}-linux-gnu"
    library, others, own, system = [], [], [], []
    for prefix in prefixes:
        if os.path.isfile(os.path.join(prefix, "stddef.h")):
            own.append(prefix)
            continue
        versions = sorted(glob.glob(os.path.join(glob.escape(prefix), "c++", "[0-9]*")), key=_version)
        if versions:
            number = os.path.basename(versions[-1])
            library += [versions[-1], os.path.join(prefix, machine, "c++", number), f"{versions[-1]}/backward"]
        is_system = bool(versions) or os.path.isfile(os.path.join(prefix, "features.h"))
        if is_system:
            system += [os.path.join(prefix, machine), prefix]
        else:
            names = sorted(os.listdir(prefix))
            others += [prefix, *(f"{prefix}/{n}" for n in names if os.path.isdir(f"{prefix}/{n}/{n}"))]
    unsaved: list[tuple[str, str]] = []
    if not own:  # a directory must exist; the files in it exist for libclang alone
        own = [os.path.dirname(os.path.realpath(__file__))]
        unsaved = [(os.path.join(own[0], name), text) for name, text in _STUBS.items()]
    found = [d for d in (*library, *others, *own, *system) if os.path.isdir(d)]
    return [part for directory in dict.fromkeys(found) for part in ("-isystem", directory)], unsaved


def _version(path: str) -> list[int]:
    return [int(n) for n in re.findall(r"\d+", os.path.basename(path))]


def _is_inside(path: str, prefixes: Sequence[str]) -> bool:
    return any(path == prefix or path.startswith(prefix.rstrip("/") + "/") for prefix in prefixes)


def limit_time() -> None:
    """The process ends, in whatever library code it is, when one file takes too long."""
    with contextlib.suppress(ImportError, AttributeError, ValueError):
        import signal

        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(SECONDS)


def limit_memory() -> None:
    """Caps memory and core files; clang's search paths no longer depend on the environment."""
    for name in [n for n in os.environ if n not in ("PATH", "LANG", "LC_ALL", "TMPDIR")]:
        del os.environ[name]
    with contextlib.suppress(ImportError, AttributeError, OSError, ValueError):
        import resource

        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        cap = MEMORY_LIMIT if hard == resource.RLIM_INFINITY else min(MEMORY_LIMIT, hard)
        resource.setrlimit(resource.RLIMIT_AS, (cap, cap))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


if __name__ == "__main__":
    limit_memory()
    sys.exit(main(sys.stdin.buffer))
