# SPDX-License-Identifier: Apache-2.0
"""The one table of what can silence a finding: every file, whence it is read, and the test that shows it.

docs/silencing.md has the same rows (tests/linters/test_silencing.py compares them).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import Enum

from haros_ci.linters import (
    bandit,
    black,
    clang_format,
    cmake_lint,
    cmakelint,
    codespell,
    cpplint,
    flake8,
    hadolint,
    isort,
    mypy,
    pylint_config,
    ruff,
    ruff_config,
    settings_files,
    shellcheck,
    vulture,
    yamllint,
)
from haros_ci.linters import tool_switches as reading
from haros_ci.linters.settings_files import Marks
from haros_ci.linters.silenced_by_change import BASE, CHANGE, FIRST_LOOK
from haros_ci.linters.switches import Switches
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field

OWN = "haros-ci"
_HERE = "tests/hostile/test_hostile_silencing.py"
_ROWS = f"{_HERE}::test_settings_silence_nothing"
_PAGES = "tests/test_checks.py::test_a_page_is_true"
_GIT = "tests/hostile/test_hostile_git.py::test_a_pull_request_cannot_judge_itself"


class SettingOrigin(Enum):
    """Where a file is read on a run with a base revision."""

    BASE = "the base revision"
    HEAD = "the change"
    NEVER = "nowhere"


@dataclass(frozen=True, slots=True)
class SilencingRow:
    """*files* that can silence *tool* (names, or kinds of files) by *what*, read at *origin*; *test* shows it.

    Settings of tools also have *read*: what the file at a path switches off. With *marks* the nearest file counts, else each
    counts for itself. *refers* tells the further files that the one at a path names.
    """

    tool: str
    files: tuple[str, ...]
    what: str
    origin: SettingOrigin
    test: str
    read: Callable[[Workspace, str], Switches] | None = None
    marks: Marks = field(default_factory=dict)
    refers: Callable[[Workspace, str], Iterable[str]] = lambda workspace, path: ()


def _settings(
    tool: str,
    what: str,
    read: Callable[[Workspace, str], Switches],
    marks: Marks,
    refers: Callable[[Workspace, str], Iterable[str]] = lambda workspace, path: (),
) -> SilencingRow:
    return SilencingRow(tool, tuple(marks), what, SettingOrigin.BASE, f"{_ROWS}[{tool}]", read, marks, refers)


def _chain(workspace: Workspace, path: str) -> Iterable[str]:
    return [link.path for link in ruff_config.chain(workspace, path)][1:]


def _extended(workspace: Workspace, path: str) -> Iterable[str]:
    read: list[str] = []
    try:
        yamllint.resolved(workspace, path, read)
    except ValueError:
        pass
    return read[1:]


def _word_lists(workspace: Workspace, path: str) -> Iterable[str]:
    settings = settings_files.read(workspace, path).get(codespell.NAME, {})
    return [name for key in codespell.FILES for name in codespell.lists(key, settings, path)]


_PYLINT: Marks = {
    **dict.fromkeys(("pylintrc", ".pylintrc"), ()),
    "pyproject.toml": ("[tool.pylint",),
    **dict.fromkeys(("setup.cfg", "tox.ini"), ("[pylint", "[tool:pylint")),
}
assert tuple(_PYLINT) == pylint_config.NAMES

#: The settings of tools, which a run with a base revision takes from there.
SETTINGS: tuple[SilencingRow, ...] = (
    _settings("bandit", "`skips`, fewer `tests`, `exclude`, `exclude_dirs`", reading.of_bandit, bandit.MARKS),
    _settings("black", "`exclude`, `extend-exclude`, `force-exclude`", reading.of_black, black.MARKS),
    _settings(
        "clang-format",
        "`DisableFormat`, `SortIncludes: Never`, no style file any more, patterns in `.clang-format-ignore`",
        reading.of_clang_format,
        dict.fromkeys((*clang_format.STYLES, clang_format.IGNORED), ()),
    ),
    _settings(
        "cmake-lint",
        "`disabled_codes`, higher limits",
        reading.of_cmake_lint,
        dict.fromkeys((".cmake-format", *cmake_lint.DATA), ()),
    ),
    _settings("cmakelint", "`filter=-…`, `linelength=`", reading.of_cmakelint, cmakelint.MARKS),
    _settings(
        "codespell",
        "`ignore-words-list`, `ignore-regex`, `skip`, files named by `ignore-words`, `exclude-file`, `dictionary`",
        reading.of_codespell,
        codespell.MARKS,
        _word_lists,
    ),
    _settings("cpplint", "`filter=-…`, `exclude_files=`, `linelength=`", reading.of_cpplint, {cpplint.CONFIG: ()}),
    _settings(
        "flake8",
        "`ignore`, `extend-ignore`, fewer `select`, `per-file-ignores`, `exclude`, `builtins`, higher limits",
        reading.of_flake8,
        flake8.MARKS,
    ),
    _settings("hadolint", "`ignored`, lower levels under `override`", reading.of_hadolint, hadolint.MARKS),
    _settings("isort", "`skip`, `skip_glob`, `only_modified`", reading.of_isort, isort.MARKS),
    _settings(
        "mypy",
        "`disable_error_code`, `ignore_errors`, `ignore_missing_imports`, `follow_imports`, less strictness, also for single modules",
        reading.of_mypy,
        mypy.MARKS,
    ),
    _settings(
        "pylint",
        "`disable`, fewer `enable`, `ignore`, `ignore-paths`, `ignored-modules`, `generated-members`, higher limits",
        reading.of_pylint,
        _PYLINT,
    ),
    _settings(
        "ruff",
        "`ignore`, fewer `select`, `per-file-ignores`, `exclude`, higher limits; also in files named by `extend`",
        reading.of_ruff,
        ruff.MARKS,
        _chain,
    ),
    _settings("shellcheck", "`disable=`, fewer `enable=`", reading.of_shellcheck, shellcheck.MARKS),
    _settings("vulture", "`ignore_names`, `exclude`, higher `min_confidence`", reading.of_vulture, vulture.MARKS),
    _settings(
        "yamllint",
        "rules disabled, `ignore`, higher limits; also in files named by `extends` and `ignore-from-file`",
        reading.of_yamllint,
        yamllint.MARKS,
        _extended,
    ),
)

#: For all that is no settings file of a tool.
OTHERS: tuple[SilencingRow, ...] = (
    SilencingRow(
        OWN,
        (".haros-ci.yaml", "haros.yaml"),
        "`ignore`, `exclude`, `levels`, `fail-on`, `linters`",
        SettingOrigin.BASE,
        _GIT,
    ),
    SilencingRow(OWN, (".haros-ci-baseline.jsonl",), "known findings", SettingOrigin.BASE, _GIT),
    SilencingRow(
        OWN,
        ("comments `haros: ignore[…]`",),
        "findings on that line; each needs a reason to be shown, and unused ones are findings",
        SettingOrigin.HEAD,
        "tests/results/test_suppress.py",
    ),
    SilencingRow(
        "all tools",
        (
            "the tool's own comments (`# noqa`, `NOLINT`, `pylint: disable`; for pylint also `# noqa: CODE` of flake8 or ruff for the same "
            "defect)",
        ),
        "findings on that line or in that file",
        SettingOrigin.HEAD,
        "tests/hostile/test_hostile_hiding_comments.py::test_they_are_counted_everywhere",
    ),
    SilencingRow(
        "all linters",
        ("a first comment that calls the file generated (`DO NOT EDIT`, `auto-generated`)",),
        "all that linters report on that file",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_comments.py::test_a_change_that_calls_a_file_generated",
    ),
    SilencingRow(
        "all tools",
        (
            "directories called `third_party`, `vendor`, `external` …, or like their package with `_backup`, `_old`, … behind it, or with `(no usado)`, `(unused)` … behind any name, or around packages and called `not_used`, `pkg_not_use` …, a licence in a directory inside a package, the version of a release, or the branch of a download (`solver-master`), in the name of a directory with a licence, and the files of a well-known library",
        ),
        "all findings in that directory",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_comments.py::test_a_change_that_calls_a_directory_third_party",
    ),
    SilencingRow(
        "all tools",
        (
            "the name and the first comment of a well-known library's single file (`json.hpp`, `stb_image.h`, `httplib.h` …)",
        ),
        "all findings in that file",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_comments.py::test_a_change_that_calls_a_file_a_known_library",
    ),
    SilencingRow(
        "all linters",
        (
            "a first comment with a copyright line and a licence that nothing else in the project names",
            "`package.xml`, `setup.py` and first comments that would name them",
        ),
        "all that linters report on that file in the profiles `ros` and `bugs-only`",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_comments.py::test_a_change_that_calls_a_file_another_owners",
    ),
    SilencingRow(
        "all linters",
        ("a C++ source that no target compiles, Python called old, archived or deprecated that nothing names",),
        "all that linters report on that file in the profiles `ros` and `bugs-only`",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_comments.py::test_a_change_that_takes_a_file_from_its_target",
    ),
    SilencingRow(
        "cppcheck, pylint, ruff",
        ("directories called `test`, `tests` …, files called `test_…` or `…_test` that no program has",),
        "in the profiles `ros` and `bugs-only` what tests do on purpose (unused values and objects, equal operands, unreachable code)",
        SettingOrigin.HEAD,
        "tests/linters/test_in_default.py",
    ),
    SilencingRow(
        "cppcheck, clang-tidy",
        ("compile_commands.json",),
        "definitions (`-D`) and include directories; it is made by a build, and one that git tracks is not read where the change brings or alters it",
        SettingOrigin.HEAD,
        "tests/linters/test_linter_inputs.py",
    ),
    SilencingRow(
        "clang-tidy",
        (".clang-tidy",),
        "`Checks: -…`; read with `--trust-config` alone",
        SettingOrigin.NEVER,
        f"{_HERE}::test_clang_tidy_has_no_settings_of_the_workspace",
    ),
    SilencingRow(
        OWN,
        (
            *("COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE", ".catkin", ".colcon_install_layout", ".built_by"),
            *("CMakeCache.txt", "pyvenv.cfg", ".catkin_workspace", "setup.bash", "package.xml", "CMakeLists.txt"),
        ),
        "all files below, where such a file is added (or the last two removed); what would be hidden is analysed and listed",
        SettingOrigin.BASE,
        "tests/hostile/test_hostile_hiding_markers.py::test_a_change_hides_nothing",
    ),
    SilencingRow(
        OWN,
        (".gitignore",),
        "files that git does not track; a file of a commit is analysed whatever stands there",
        SettingOrigin.HEAD,
        f"{_HERE}::test_a_tracked_file_is_analysed_whatever_gitignore_says",
    ),
    SilencingRow(
        OWN,
        (".gitignore",),
        "missing launch, parameter and share files that git ignores are notes",
        SettingOrigin.BASE,
        f"{_HERE}::test_gitignore_of_the_change_lowers_no_finding",
    ),
    *(SilencingRow(OWN, files, what, SettingOrigin.BASE, test) for files, what, test in BASE),
    *(SilencingRow(OWN, files, what, SettingOrigin.HEAD, test) for files, what, test in CHANGE),
    *(SilencingRow("all tools", files, what, SettingOrigin.NEVER, test) for files, what, test in FIRST_LOOK),
    SilencingRow(
        OWN,
        (".gitmodules",),
        "missing files below a directory that it names and that has no file (python-package-incomplete, missing launch and parameter files, "
        "meshes, catkin_lint's MISSING_*)",
        SettingOrigin.HEAD,
        "tests/linters/test_catkin_doubts.py::test_submodules_that_are_not_checked_out",
    ),
    SilencingRow(
        "pylint, ruff, flake8, mypy",
        (
            "code that loads Python files by path (`imp.load_source`, `runpy.run_path`, `exec(open(…))`), and the YAML, launch and XML files "
            "that name them",
        ),
        "undefined names in those files",
        SettingOrigin.HEAD,
        "tests/linters/test_undefined_names.py::test_files_that_are_loaded_by_path",
    ),
    SilencingRow(
        OWN,
        ("a comment before `<robot>` that says `autogenerated by xacro`",),
        "undefined-in-xacro in that file, unless a launch file runs xacro on it",
        SettingOrigin.HEAD,
        _PAGES,
    ),
    SilencingRow(
        "all tools",
        (".editorconfig", ".gitattributes"),
        "nothing",
        SettingOrigin.NEVER,
        f"{_HERE}::test_a_tracked_file_is_analysed_whatever_gitignore_says",
    ),
)

TABLE = (*SETTINGS, *OTHERS)


def page() -> str:
    """The table in Markdown."""
    rows = ["| Tool | Files | What can be silenced | Read from | Test |", "|---|---|---|---|---|"]
    for row in TABLE:
        files = ", ".join(name if " " in name else f"`{name}`" for name in row.files)
        rows.append(f"| {row.tool} | {files} | {row.what} | {row.origin.value} | `{row.test}` |")
    return "\n".join(rows) + "\n"
