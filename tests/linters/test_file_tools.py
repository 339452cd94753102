# SPDX-License-Identifier: Apache-2.0
"""The linters for C++, build, shell and configuration files as installed: what they find, and what they do not follow."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters import (
    clang_format,
    cmake_lint,
    cmakelint,
    flawfinder,
    hadolint,
    shellcheck,
    xmllint,
    yamllint,
)
from haros_ci.linters.installed import HOW
from haros_ci.linters.linter import Linter, LintOptions
from haros_ci.linters.run import lint
from haros_ci.results.result import Run

STYLE = {".clang-format": "BasedOnStyle: Google\n"}
ALL = (clang_format, cmake_lint, cmakelint, flawfinder, hadolint, shellcheck, xmllint, yamllint)


def run(root: Path, linter: Linter, files: dict[str, str | bytes], trusted: bool = False, works: bool = True) -> Run:
    """All but xmllint come as wheels, so that they are there where the tests count."""
    if linter.locate(LintOptions()) is None and (linter is xmllint or not os.environ.get("CI")):
        pytest.skip(f"{linter.NAME} is not installed")
    options = LintOptions(enabled=frozenset({linter.NAME}), trust_config=trusted)
    (only,) = lint(workspace(root, files), [linter], options, MemoryStore(), everything)
    assert only.successful == works, only.notifications
    return only


def found(run: Run) -> set[tuple[str, str]]:
    return {(r.rule, str(r.location)) for r in run.results}


FIRES = [
    (clang_format, {**STYLE, "a.cpp": "int a;\nint  b;\n"}, ("formatting", "a.cpp:2:4")),
    (clang_format, {**STYLE, "a.cpp": "/* é */ int  b;\n"}, ("formatting", "a.cpp:1:12")),
    (cmake_lint, {"a.cmake": "set(a 1)\nbreak()\n"}, ("E0103", "a.cmake:2:1")),
    (cmake_lint, {"CMakeLists.txt": "set(A 1)  \n"}, ("C0303", "CMakeLists.txt:1")),
    (cmakelint, {"CMakeLists.txt": "if(A)\n   set(b c)\nendif()\n"}, ("whitespace/indent", "CMakeLists.txt:2")),
    (cmakelint, {"a.cmake": "set(a " + "b" * 140 + ")\n"}, ("linelength", "a.cmake:1")),
    (flawfinder, {"a.cpp": "void f(char* b, char* v) {\n  /* é */ strcpy(b, v);\n}\n"}, ("FF1001", "a.cpp:2:11")),
    (hadolint, {"Dockerfile": "FROM a:1 AS b\nCOPY --from=b c d\n"}, ("DL3023", "Dockerfile:2")),
    (hadolint, {"Dockerfile": "FROM a:1\nRUN cd $X\n"}, ("SC2086", "Dockerfile:2")),
    (shellcheck, {"a.sh": "#!/bin/sh\necho 'é' $1\n"}, ("SC2086", "a.sh:2:10")),
    (shellcheck, {"a.sh": b"#!/bin/sh\n\techo \xe9 $1\n"}, ("SC2086", "a.sh:2:9")),
    (shellcheck, {"a.sh": "#!/bin/sh\nif true\n"}, ("SC1073", "a.sh:2:1")),
    (xmllint, {"a.launch": "<launch>\n<node>\n</launch>\n"}, ("parser-error", "a.launch:3")),
    (xmllint, {"a.urdf": "<robot>\n<xacro:macro/>\n</robot>\n"}, ("namespace-error", "a.urdf:2")),
    (yamllint, {"a.yaml": "a: 1\nb: 'é'\na: 2\n"}, ("key-duplicates", "a.yaml:3:1")),
    (yamllint, {"a.yaml": b"a: \xe9 # \xe9\nb: yes\n"}, ("truthy", "a.yaml:2:4")),
    (yamllint, {"a.yaml": "\ufeffb: yes\n"}, ("truthy", "a.yaml:1:4")),
    (yamllint, {"a.yaml": "a: [\n"}, ("syntax", "a.yaml:2:1")),
]


@pytest.mark.parametrize(("linter", "files", "expected"), FIRES)
def test_each_tool_finds_its_defects(
    tmp_path: Path, linter: Linter, files: dict[str, str | bytes], expected: tuple[str, str]
) -> None:
    done = run(tmp_path, linter, files)
    assert expected in found(done) and done.tool.version[0].isdigit()


QUIET = [
    (clang_format, {"a.cpp": "int  a;\n"}),
    (clang_format, {**STYLE, "a.cpp": "// clang-format off\nint  a;\n// clang-format on\n"}),
    (clang_format, {**STYLE, ".clang-format-ignore": "third/*\n", "third/a.cpp": "int  a;\n"}),
    (clang_format, {**STYLE, "p/.clang-format": "DisableFormat: true\n", "p/a.cpp": "int  a;\n"}),
    (clang_format, {**STYLE, "p/.clang-format": "BasedOnStyle: InheritParentConfig\nColumnLimit: 99\n", "p/a.cpp": "int a;\n"}),
    (cmake_lint, {"a.cmake": "set(AB 1)\n"}),
    (cmake_lint, {"a.cmake": "set(a 1)\n", ".cmake-format.yaml": "lint:\n  disabled_codes: [C0103]\n"}),
    (cmakelint, {"CMakeLists.txt": "if(A)\n  set(b c)\nendif()\n"}),
    (cmakelint, {"CMakeLists.txt": "if(A)\n   set(b c)\nendif()\n", ".cmakelintrc": "filter=-whitespace\n"}),
    (cmakelint, {"a.cmake": "# lint_cmake: -whitespace\nif(A)\n   set(b c)\nendif()\n"}),
    (flawfinder, {"a.cpp": "// strcpy(b, v);\nint f() { return 1; }\n"}),
    (flawfinder, {"a.cpp": "void f(char* b, char* v) { strcpy(b, v); }  // Flawfinder: ignore\n"}),
    (hadolint, {"Dockerfile": "FROM a:1\nWORKDIR /b\n"}),
    (hadolint, {"Dockerfile": "FROM a\n", ".hadolint.yaml": "ignored: [DL3006]\n"}),
    (hadolint, {"Dockerfile": "FROM a:1 AS b\n# hadolint ignore=DL3023\nCOPY --from=b c /d\n"}),
    (shellcheck, {"a.sh": '#!/bin/sh\necho "$1"\n'}),
    (shellcheck, {"a.sh": "#!/bin/sh\necho $1\n", ".shellcheckrc": "disable=SC2086\n"}),
    (shellcheck, {"a.sh": "#!/bin/zsh\necho $1\n"}),
    (xmllint, {"a.launch": "<launch/>\n", "a.urdf": '<?xml version="1.0"?>\n<robot xmlns:xacro="http://x/y"><xacro:a/></robot>\n'}),
    (xmllint, {"a.launch": b'<?xml version="1.0" encoding="ISO-8859-1"?>\n<launch name="\xe9"/>\n'}),
    (yamllint, {"a.yaml": "---\na: 1\nb: True\nc: FALSE\n"}),
    (yamllint, {"a.yaml": "a: yes  # yamllint disable-line rule:truthy\n", ".yamllint": "rules: {truthy: enable}\n"}),
    (yamllint, {"p/q/a.yaml": "a:    yes\n", "p/.yamllint": "extends: default\nignore: q/\n"}),
]  # fmt: skip


@pytest.mark.parametrize(("linter", "files"), QUIET)
def test_each_tool_stays_quiet(tmp_path: Path, linter: Linter, files: dict[str, str | bytes]) -> None:
    done = run(tmp_path, linter, files)
    assert found(done) == set()
    assert not [note for note in done.notifications if "found no file to analyse" not in note.message]


CLEAN = {
    "cpp": "int  strcpy(int);\n",
    "cmake": "set(a 1)\n",
    "sh": "#!/bin/sh\necho $1\n",
    "launch": "<a>",
    "yaml": "a:   yes\n",
}


@pytest.mark.parametrize(
    ("linter", "suffix"),
    [(clang_format, "cpp"), (cmake_lint, "cmake"), (flawfinder, "cpp"), (shellcheck, "sh"), (xmllint, "launch"), (yamllint, "yaml")],
)  # fmt: skip
def test_odd_names(tmp_path: Path, linter: Linter, suffix: str) -> None:
    stems = ["-i", "--version", "two words", "100%.20", "::error::", "ü", "a'b", "@x", "$(id)", "a%41"]
    names = [f"{stem}.{suffix}" for stem in stems]
    done = run(tmp_path, linter, {**STYLE, **dict.fromkeys(names, CLEAN[suffix])})
    assert {result.location.path for result in done.results} == set(names)


@pytest.mark.parametrize("linter", ALL, ids=lambda linter: linter.NAME)
def test_what_is_said_of_a_file_does_not_depend_on_its_batch(tmp_path: Path, linter: Linter) -> None:
    files: dict[str, str | bytes] = {
        **STYLE,
        "p/.clang-format": "BasedOnStyle: LLVM\n",
        "a.cpp": "int  a;\n",
        "p/b.cpp": "int  strcpy(int);\n",
        "a.cmake": "# lint_cmake: -whitespace\nset (a 1)\n",
        "b.cmake": "set (a 1)\n",
        "a.sh": "#!/bin/sh\n# shellcheck source-path=SCRIPTDIR\n. ./b.sh\necho $1 $from_b\n",
        "b.sh": "#!/bin/sh\nfrom_b=$1\n",
        "Dockerfile": "FROM a\n",
        "a.launch": "<a>",
        "b.launch": "<b>",
        "a.yaml": "a: yes\n",
        "b.yaml": "a: yes\n",
    }
    together = run(tmp_path / "all", linter, files)
    alone: set[tuple[str, str]] = set()
    settings = {path: text for path, text in files.items() if path.startswith(".") or path.startswith("p/.")}
    for number, path in enumerate(files.keys() - settings.keys()):
        alone |= found(run(tmp_path / str(number), linter, {**settings, path: files[path]}))
    assert found(together) == alone != set()


OUTSIDE = [
    (clang_format, {".clang-format": "DisableFormat: true\n"}, {"a.cpp": "int  a;\n", ".clang-format": "BasedOnStyle: InheritParentConfig\n"}),
    (clang_format, {".clang-format-ignore": "*\n"}, {**STYLE, "a.cpp": "int  a;\n"}),
    (cmake_lint, {".cmake-format.yaml": "lint: {disabled_codes: [C0103]}\n"}, {"a.cmake": "set(a 1)\n"}),
    (cmakelint, {".cmakelintrc": "filter=-whitespace\n"}, {"a.cmake": "set (a 1)\n"}),
    (hadolint, {".hadolint.yaml": "ignored: [DL3006]\n"}, {"Dockerfile": "FROM a\n"}),
    (shellcheck, {".shellcheckrc": "disable=SC2086\n"}, {"a.sh": "#!/bin/sh\necho $1\n"}),
    (yamllint, {".yamllint": "rules: {}\n"}, {"a.yaml": "a: yes\n"}),
]  # fmt: skip


@pytest.mark.parametrize(("linter", "above", "files"), OUTSIDE)
def test_settings_above_the_root_and_at_home_do_not_count(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    linter: Linter,
    above: dict[str, str],
    files: dict[str, str | bytes],
) -> None:
    for name, text in above.items():
        (tmp_path / name).write_text(text)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    assert found(run(tmp_path / "root", linter, files))


SECRET = "hunter2: [secret\n"


@pytest.mark.parametrize(
    "files",
    [
        {"a.sh": "#!/bin/bash\n# shellcheck source=SECRET\n. x\n", ".shellcheckrc": "external-sources=true\n"},
        {
            "a.sh": "#!/bin/bash\n# shellcheck source-path=..\n. secret\n",
            ".shellcheckrc": "external-sources=true\nsource-path=ROOT\n",
        },
        {"a.launch": '<!DOCTYPE a [<!ENTITY x SYSTEM "file://SECRET">]>\n<a>&x;</a>\n'},
        {"a.launch": '<!DOCTYPE a [<!ENTITY % x SYSTEM "file://SECRET"> %x;]>\n<a/>\n'},
        {"a.launch": '<!DOCTYPE a SYSTEM "file://SECRET">\n<a/>\n'},
        {"a.launch": '<a xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="file://SECRET"/></a>\n'},
        {"a.launch": '<?xml-stylesheet href="file://SECRET"?><?xml-model href="file://SECRET"?><a/>\n'},
    ],
)
def test_nothing_outside_is_read(tmp_path: Path, files: dict[str, str | bytes]) -> None:
    """If it were, what is no shell and no XML would be told of."""
    secret = tmp_path / "secret"
    secret.write_text("if then <a>&&\n")
    given = {p: str(t).replace("SECRET", str(secret)).replace("ROOT", str(tmp_path)) for p, t in files.items()}
    linter = shellcheck if "a.sh" in given else xmllint
    done = run(tmp_path / "root", linter, dict(given))
    assert {rule for rule, _ in found(done)} <= {"SC1090", "SC1091"}


def test_a_bomb_of_entities_is_a_finding(tmp_path: Path) -> None:
    entities = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 30))
    text = f'<!DOCTYPE a [<!ENTITY e0 "boom">{entities}]>\n<a>&e29;</a>\n'
    assert {rule for rule, _ in found(run(tmp_path, xmllint, {"a.launch": text}))} <= {"parser-error"}


MARK = "open('MARK', 'w').write('ran')\n"


@pytest.mark.parametrize("name", [".cmake-format.py", "cmake-format.py"])
def test_a_configuration_in_python_runs_where_it_is_trusted_alone(tmp_path: Path, name: str) -> None:
    mark = tmp_path / "mark"
    files: dict[str, str | bytes] = {"a.cmake": "set(a 1)\n", name: MARK.replace("MARK", str(mark))}
    assert found(run(tmp_path / "root", cmake_lint, files)) and not mark.exists()
    run(tmp_path / "root", cmake_lint, files, trusted=True)
    assert mark.exists()


@pytest.mark.parametrize(("linter", "name"), [(yamllint, "a.yaml"), (cmakelint, "a.cmake"), (cmake_lint, "a.cmake")])
def test_no_module_of_the_workspace_is_imported(tmp_path: Path, linter: Linter, name: str) -> None:
    mark = tmp_path / "mark"
    trap = MARK.replace("MARK", str(mark))
    names = ("yaml", "json", "io", "pathspec", "yamllint", "cmakelint", "cmakelang", "argcomplete", "sitecustomize")
    run(tmp_path / "root", linter, {name: "a\n", **{f"{n}.py": trap for n in names}})
    assert not mark.exists()


BROKEN = [
    (clang_format, {".clang-format": "BasedOnStyle: [\n", "a.cpp": "int  a;\n"}, "Invalid argument"),
    (yamllint, {".yamllint": "extends: ../x\n", "a.yaml": ""}, ".yamllint: refers to '../x', which lies outside"),
    (yamllint, {".yamllint": "rules: {brand-new: enable}\n", "a.yaml": ""}, "brand-new"),
    (hadolint, {".hadolint.yaml": "ignored: {\n", "Dockerfile": "FROM a\n"}, ".hadolint.yaml: line 2: "),
]


@pytest.mark.parametrize(("linter", "files", "reason"), BROKEN)
def test_settings_that_cannot_be_used_are_no_success(
    tmp_path: Path, linter: Linter, files: dict[str, str | bytes], reason: str
) -> None:
    done = run(tmp_path, linter, files, works=False)
    assert reason in done.notifications[0].message and not done.results
    assert str(tmp_path) not in done.notifications[0].message


@pytest.mark.parametrize("linter", ALL, ids=lambda linter: linter.NAME)
def test_a_tool_that_is_asked_for_and_missing_is_trouble(
    tmp_path: Path, linter: Linter, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(linter, "locate", lambda options: None)
    options = LintOptions(enabled=frozenset({linter.NAME}))
    (done,) = lint(workspace(tmp_path, {"a.cpp": ""}), [linter], options, MemoryStore(), everything)
    assert not done.successful and "is not installed" in done.notifications[0].message
    assert f"install it ({HOW[linter.NAME]})" in done.notifications[0].message


def test_a_file_that_cmake_lint_cannot_parse_costs_only_itself(tmp_path: Path) -> None:
    done = run(tmp_path, cmake_lint, {"a.cmake": "foo(\n", "b.cmake": "set(a 1)\n"})
    assert [note.path for note in done.notifications] == ["a.cmake"] and ("C0103", "b.cmake:1:5") in found(done)
