# SPDX-License-Identifier: Apache-2.0
"""Comments by which a change silences findings: counted in every report, with their places."""

from __future__ import annotations

import html

import pytest
from hostile_kit import CHEAP_FINDING, CONTROL, Trap, assert_harmless

QUICK = ("--ignore=pylint,cpplint,metrics,ruff,unassignedVariable",)
DEFECT = "int f(int x) { int *unset = 0; return *unset + x; }\n"


def pull_request(trap: Trap, base: dict[str, str], head: dict[str, str]) -> None:
    (trap.root / CONTROL).unlink()
    trap.write(CHEAP_FINDING[0], DEFECT)
    for name, text in base.items():
        trap.write(name, text)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    for name in base.keys() - head.keys():
        (trap.root / name).unlink()
    for name, text in head.items():
        trap.write(name, text)
    trap.commit()


def test_they_are_counted_everywhere(trap: Trap) -> None:
    own = "int g(int x) { int *unset = 0; return *unset + x; }  // haros: ignore[nullPointer] hush\n"
    tools = "int h(int x) {\n  // cppcheck-suppress nullPointer\n  return x;  // NOLINT\n}\n"
    pull_request(trap, {}, {"a.cpp": own, "b.cpp": tools, "::error::x.py": "import os  # noqa\n"})
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 0, outcome.formats["text"]
    silenced = outcome.report["silenced"]
    assert silenced["findings"] == 1
    assert [(c["path"], c["line"], c["comment"]) for c in silenced["comments"]] == [
        ("::error::x.py", 1, "noqa"),
        ("b.cpp", 2, "cppcheck-suppress"),
        ("b.cpp", 3, "NOLINT"),
    ]
    found = "1 finding suppressed by comments that this change adds"
    comments = "the change adds 3 comments that silence linters: ::error::x.py:1 (noqa), b.cpp:2 (cppcheck-suppress), b.cpp:3 (NOLINT)"
    assert outcome.says(found) and outcome.says(comments)
    short = "1 finding suppressed by this change; 3 comments that silence linters added by this change"
    assert short in outcome.formats["text"]
    summary = html.unescape(outcome.formats["markdown"])
    assert found in summary and "the change adds 3 comments that silence linters" in summary
    notes = [
        n["message"]["text"]
        for run in outcome.sarif["runs"]
        for i in run["invocations"]
        for n in i.get("toolExecutionNotifications", ())
    ]
    assert any(found in note for note in notes), notes
    assert_harmless(trap, outcome)


@pytest.mark.parametrize(
    "comment", ["/* cppcheck-\\\nsuppress nullPointer */", "/* cppcheck-suppress [a,\n  nullPointer] */"]
)
def test_one_over_two_lines_is_counted_and_what_it_hides_is_named(trap: Trap, comment: str) -> None:
    text = f"int g(int x) {{\n  int * unset = 0;\n  {comment}\n\n  return *unset + x;\n}}\n"
    pull_request(trap, {}, {"a.cpp": text})
    outcome = trap.run("--baseline-rev=main", *QUICK)
    silenced = outcome.report["silenced"]
    assert [(c["path"], c["line"], c["comment"]) for c in silenced["comments"]] == [("a.cpp", 3, "cppcheck-suppress")]
    assert outcome.says("comments silence more than they did in 1 place: a.cpp:6 (nullPointer)")
    assert_harmless(trap, outcome)


def test_a_pragma_that_enables_first_is_counted(trap: Trap) -> None:
    text = "# pylint: enable=all, disable=undefined-variable\nx = nowhere\n"
    pull_request(trap, {}, {"a.py": text})
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,metrics,ruff")
    assert [(c["path"], c["line"], c["comment"]) for c in outcome.report["silenced"]["comments"]] == [
        ("a.py", 1, "pylint: disable")
    ]


def test_words_in_quotes_silence_nothing(trap: Trap) -> None:
    pull_request(trap, {}, {"a.py": "x = nowhere + '# noqa: F821'\n"})
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,metrics,ruff")
    assert ("a.py", 1, "undefined-variable") in outcome.findings()


def test_files_that_moved_bring_nothing(trap: Trap) -> None:
    text = DEFECT.replace("\n", "  // haros: ignore[nullPointer] old\n") + "int a;  // NOLINT\nint b;\nint c;\n"
    pull_request(trap, {"src/old.cpp": text}, {"lib/new.cpp": "\n" + text.replace("int b", "  int bb")})
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.report["silenced"] == {"findings": 0, "comments": [], "more": []}
    assert outcome.report["counts"]["suppressed"] == 1 and outcome.notes() == []


def test_without_a_base_nothing_is_said(trap: Trap) -> None:
    pull_request(trap, {}, {"a.cpp": "int a;  // NOLINT\n"})
    for arguments in ((), ("--baseline-rev=nowhere", "--no-require-baseline")):
        outcome = trap.run(*arguments, *QUICK)
        assert outcome.report["silenced"] == {"findings": 0, "comments": [], "more": []} and not outcome.says("silence")


def test_excluded_files_and_other_targets_are_not_looked_at(trap: Trap) -> None:
    pull_request(
        trap,
        {".haros-ci.yaml": "exclude: [vendor]\n"},
        {
            ".haros-ci.yaml": "exclude: [vendor]\n",
            "vendor/a.cpp": "int a;  // NOLINT\n",
            "b.cpp": "int b;  // NOLINT\n",
        },
    )
    assert not trap.run("--baseline-rev=main", "--exclude=b.cpp", *QUICK).says("silence")
    given = trap.command("check", CHEAP_FINDING[0], "--baseline-rev=main", *QUICK)
    assert "silence" not in given


MARK = "// This file was automatically generated. DO NOT EDIT.\n"


def found(trap: Trap, *options: str) -> tuple[set[str], list[str]]:
    """The files in which the defect is found, and the sentences on what was not looked at."""
    outcome = trap.run(*options, *QUICK, "--fail-on=never")
    assert_harmless(trap, outcome)
    results = outcome.report["results"]
    return {r["path"] for r in results if r["rule"] == "nullPointer"}, outcome.report["coverage"]["unseen"]


def test_generated_files_are_not_linted(trap: Trap) -> None:
    pull_request(trap, {"gen.cpp": MARK + DEFECT}, {"gen.cpp": MARK + DEFECT, "a.cpp": DEFECT})
    paths, unseen = found(trap)
    assert "a.cpp" in paths and "gen.cpp" not in paths
    assert any("1 file was not linted" in each and "gen.cpp" in each for each in unseen), unseen


def test_a_change_that_calls_a_file_generated(trap: Trap) -> None:
    """The mark counts if the base revision has it; a file that moves keeps it."""
    long = DEFECT + "".join(f"int a{number};\n" for number in range(30))
    base = {"gen.cpp": MARK + DEFECT, "old.cpp": MARK + long, "a.cpp": "int a;\n"}
    head = {
        "gen.cpp": MARK + DEFECT + "int x;\n",
        "moved.cpp": MARK + long,
        "a.cpp": MARK + DEFECT,
        "b.cpp": MARK + DEFECT,
    }
    pull_request(trap, base, head)
    paths, unseen = found(trap, "--baseline-rev=main")
    assert {"a.cpp", "b.cpp"} <= paths and not {"gen.cpp", "moved.cpp"} & paths
    assert any("2 files were not linted" in each and "gen.cpp, moved.cpp" in each for each in unseen), unseen


def test_without_the_base_revision_no_file_is_generated(trap: Trap) -> None:
    """An orphan head has no base to look at; so every file is linted."""
    pull_request(trap, {"gen.cpp": MARK + DEFECT}, {"gen.cpp": MARK + DEFECT, "a.cpp": "int a;\n"})
    trap.git("checkout", "-q", "--orphan", "alone")
    trap.write("more.cpp", "int more;\n")
    trap.commit()
    assert "gen.cpp" in found(trap, "--baseline-rev=main", "--no-require-baseline")[0]


MANIFEST = "<package format='3'><name>demo</name></package>\n"


def test_third_party_code_has_no_findings(trap: Trap) -> None:
    copies = {"vendor/a.cpp": DEFECT, "demo/lib/b.cpp": DEFECT, "demo/lib/LICENSE": "MIT\n"}
    own = {"demo/package.xml": MANIFEST, "demo/LICENSE": "MIT\n", "demo/c.cpp": DEFECT, "vendors/d.cpp": DEFECT}
    pull_request(trap, {}, {**copies, **own})
    paths, unseen = found(trap)
    assert {"demo/c.cpp", "vendors/d.cpp"} <= paths and not copies.keys() & paths
    said = "2 files have no findings, because they are in copies of other projects: demo/lib, vendor."
    assert f"{said} A run that is given their directories (haros-ci check DIRECTORY) reports on them." in unseen


def test_a_change_that_calls_a_directory_third_party(trap: Trap) -> None:
    """A name or a licence counts if the base revision has it, and for files that come to be there; its removal counts as little."""
    base = {"demo/package.xml": MANIFEST, "demo/lib/a.cpp": "int a;\n", "vendor/b.cpp": "int b;\n"}
    base |= {"demo/old/c.cpp": "int c;\n", "demo/old/LICENSE": "MIT\n"}
    head = {**base, "demo/lib/a.cpp": DEFECT, "demo/lib/LICENSE": "MIT\n", "third_party/d.cpp": DEFECT}
    base["demo/lib/own.cpp"] = "".join(f"int own_{number};\n" for number in range(9))
    head |= {"vendor/new.cpp": DEFECT, "demo/old/c.cpp": DEFECT, "vendor/own.cpp": base["demo/lib/own.cpp"] + DEFECT}
    del head["demo/old/LICENSE"]
    pull_request(trap, base, head)
    paths, unseen = found(trap, "--baseline-rev=main")
    assert {"demo/lib/a.cpp", "third_party/d.cpp", "vendor/own.cpp"} <= paths, (
        "the project's own code stays so where it moves to"
    )
    assert not {"vendor/new.cpp", "demo/old/c.cpp"} & paths
    assert any("copies of other projects: demo/old, vendor." in each for each in unseen), unseen


def public_copies(maintainer: str = "Grete Stromberg") -> dict[str, str]:
    """A package of the workspace's own, and one that has the name of a public package, by *maintainer*."""
    manifest = (
        "<package format='3'><name>{}</name><version>1.2.0</version><maintainer email='{}'>{}</maintainer></package>\n"
    )
    return {
        "src/arm/package.xml": manifest.format("arm", "ada@robots.org", "Ada Lovage"),
        "src/arm/a.cpp": DEFECT,
        "src/amcl/package.xml": manifest.format("amcl", "m@robots.org", maintainer),
        "src/amcl/b.cpp": DEFECT,
    }


def test_a_copy_of_a_public_package_has_no_findings_in_a_first_look(trap: Trap) -> None:
    pull_request(trap, {}, public_copies())
    paths, unseen = found(trap)
    assert "src/arm/a.cpp" in paths and "src/amcl/b.cpp" not in paths
    assert any("copies of other projects: src/amcl." in each for each in unseen), unseen


def test_a_run_that_is_asked_about_a_copy_of_a_public_package(trap: Trap) -> None:
    pull_request(trap, {}, public_copies())
    assert "src/amcl/b.cpp" in found(trap, "src/amcl")[0]


def test_a_change_to_a_copy_of_a_public_package_is_seen(trap: Trap) -> None:
    """Where there is a base revision no package is quiet for its name, neither one that was there nor one that comes."""
    whole = public_copies()
    pull_request(trap, {**whole, "src/amcl/b.cpp": "int b;\n"}, {**whole, "src/amcl/c.cpp": DEFECT})
    assert {"src/amcl/b.cpp", "src/amcl/c.cpp"} <= found(trap, "--baseline-rev=main")[0]


def test_a_baseline_file_has_the_findings_of_copies_of_public_packages(trap: Trap) -> None:
    whole = public_copies()
    pull_request(trap, {}, whole)
    trap.command("baseline", "create", *QUICK)
    assert "src/amcl/b.cpp" in (trap.root / ".haros-ci-baseline.jsonl").read_text("utf-8")
    trap.write("src/amcl/c.cpp", DEFECT)
    trap.commit()
    results = trap.run("--baseline=.haros-ci-baseline.jsonl", *QUICK, "--fail-on=never").report["results"]
    assert {r["path"] for r in results if r["open"] and r["rule"] == "nullPointer"} == {"src/amcl/c.cpp"}


def test_without_the_base_revision_nothing_is_third_party(trap: Trap) -> None:
    pull_request(trap, {"vendor/a.cpp": DEFECT}, {"vendor/a.cpp": DEFECT, "a.cpp": "int a;\n"})
    trap.git("checkout", "-q", "--orphan", "alone")
    trap.write("more.cpp", "int more;\n")
    trap.commit()
    assert "vendor/a.cpp" in found(trap, "--baseline-rev=main", "--no-require-baseline")[0]


BANNER = "// Copyright (c) 2019 Niels Lohmann\n"
LONG = "\n" * 120


def test_the_single_file_of_a_known_library_has_no_findings(trap: Trap) -> None:
    files = {
        "demo/package.xml": MANIFEST,
        "demo/json.hpp": BANNER + LONG + DEFECT,
        "demo/a.cpp": BANNER + LONG + DEFECT,
    }
    pull_request(trap, {}, {**files, "demo/b/json.hpp": LONG + DEFECT})
    paths, unseen = found(trap)
    assert {"demo/a.cpp", "demo/b/json.hpp"} <= paths and "demo/json.hpp" not in paths
    said = "1 file has no findings, because by its name and first comment it is another project's: demo/json.hpp."
    assert said in unseen


def test_a_change_that_calls_a_file_a_known_library(trap: Trap) -> None:
    """By name and comment a file counts as a copy if both the base revision and the change have it so; else it is the project's."""
    copy, own = BANNER + LONG, LONG
    base = {"demo/package.xml": MANIFEST, "demo/json.hpp": copy, "demo/b/json.hpp": own, "demo/c/json.hpp": copy}
    base |= {"demo/d/json.hpp": copy + "int d;\n"}
    head = {**base, "demo/json.hpp": copy + DEFECT, "demo/b/json.hpp": copy + DEFECT, "demo/c/json.hpp": own + DEFECT}
    head |= {"demo/new/json.hpp": copy + DEFECT, "demo/d/LICENSE": "MIT\n", "demo/d/json.hpp": copy + DEFECT}
    pull_request(trap, base, head)
    paths, _ = found(trap, "--baseline-rev=main")
    assert {"demo/b/json.hpp", "demo/c/json.hpp", "demo/new/json.hpp"} <= paths
    assert not {"demo/json.hpp", "demo/d/json.hpp"} & paths


OWNED = "// Copyright 2020 Ada Lovage\nint n{};\n"
FOREIGN = (
    "// Copyright 1999 Grete Stromberg\n// Permission is hereby granted, free of charge, to any person\n"
    + LONG.partition("\n")[2]
    + "int b;\n" * 120
)


def test_a_change_that_calls_a_file_another_owners(trap: Trap) -> None:
    """Nor does it count where the change takes away what speaks against it: the revision before has it so, too, or it is the project's."""
    base = {"demo/package.xml": MANIFEST, "demo/a.cpp": FOREIGN, "demo/b.cpp": OWNED.format("b")}
    base |= {f"demo/n{number}.cpp": OWNED.format(number) for number in range(6)}
    head = {**base, "demo/a.cpp": FOREIGN + DEFECT, "demo/b.cpp": FOREIGN + DEFECT, "demo/new.cpp": FOREIGN + DEFECT}
    pull_request(
        trap, base, {**head, "demo/b.cpp": OWNED.format("b") + DEFECT} | {"demo/new.cpp": OWNED.format("x") + DEFECT}
    )
    paths, unseen = found(trap, "--baseline-rev=main")
    assert {"demo/b.cpp", "demo/new.cpp"} <= paths and "demo/a.cpp" not in paths
    assert any("names another owner and another licence" in each and each.endswith(" demo/a.cpp.") for each in unseen)
    assert "demo/a.cpp" in found(trap, "--baseline-rev=main", "--profile=strict")[0]
    trap.write("demo/b.cpp", head["demo/b.cpp"])
    trap.write("demo/a.cpp", OWNED.format("a") + DEFECT)
    trap.commit()
    assert {"demo/a.cpp", "demo/b.cpp"} <= found(trap, "--baseline-rev=main")[0]


CMAKE = "find_package(ament_cmake REQUIRED)\nadd_executable(a {})\nament_package()\n"
BUILT = "<package format='3'><name>demo</name><export><build_type>ament_cmake</build_type></export></package>\n"


def test_code_that_nothing_uses_has_no_findings_of_linters(trap: Trap) -> None:
    files = {"demo/package.xml": BUILT, "demo/CMakeLists.txt": CMAKE.format("a.cpp")}
    pull_request(trap, {}, {**files, "demo/a.cpp": DEFECT, "demo/b.cpp": DEFECT})
    paths, unseen = found(trap)
    assert "demo/a.cpp" in paths and "demo/b.cpp" not in paths
    said = "What linters say of 1 file was left out, because nothing compiles, starts or imports it: demo/b.cpp."
    assert said in unseen
    assert "demo/b.cpp" in found(trap, "--profile=strict")[0] and "demo/b.cpp" in found(trap, "--select=nullPointer")[0]


def test_a_change_that_takes_a_file_from_its_target(trap: Trap) -> None:
    """Nor does a new file count as unused, nor one whose copy is called old: they were not so before."""
    old = "import os\n\n\ndef f():\n    return nowhere + os.sep\n"
    base = {
        "demo/package.xml": BUILT,
        "demo/CMakeLists.txt": CMAKE.format("a.cpp b.cpp"),
        "demo/a.cpp": "int main() {}\n",
    }
    base |= {"demo/b.cpp": "int b;\n", "demo/c.cpp": "int c;\n"}
    head = {**base, "demo/CMakeLists.txt": CMAKE.format("a.cpp"), "demo/pick.py": "a = 1\n", "demo/pick_old.py": old}
    head |= {"demo/b.cpp": DEFECT, "demo/c.cpp": DEFECT, "demo/d.cpp": DEFECT}
    pull_request(trap, base, head)
    paths, unseen = found(trap, "--baseline-rev=main")
    assert {"demo/b.cpp", "demo/d.cpp"} <= paths and "demo/c.cpp" not in paths
    assert any("left out, because nothing compiles, starts or imports it: demo/c.cpp." in each for each in unseen), (
        unseen
    )


def test_without_the_base_revision_everything_is_used(trap: Trap) -> None:
    files = {"demo/package.xml": BUILT, "demo/CMakeLists.txt": CMAKE.format("a.cpp"), "demo/a.cpp": "int main() {}\n"}
    files["demo/b.cpp"] = DEFECT
    pull_request(trap, files, {**files, "a.cpp": "int a;\n"})
    trap.git("checkout", "-q", "--orphan", "alone")
    trap.write("more.cpp", "int more;\n")
    trap.commit()
    assert "demo/b.cpp" in found(trap, "--baseline-rev=main", "--no-require-baseline")[0]


NAMES = "def g():\n    return nowhere\n"
DISABLE = "# pylint: disable=undefined-variable\n"
ENABLE = "# pylint: enable=undefined-variable\n"
BLOCK = "// cppcheck-suppress-begin nullPointer\nint one();\n// cppcheck-suppress-end nullPointer\n"


def test_comments_that_come_to_silence_more_are_named(trap: Trap) -> None:
    old = DISABLE + "X = here\n"
    pull_request(
        trap,
        {
            "moved.py": old + ENABLE,
            "quiet.py": old + ENABLE,
            "alone.py": "X = here  " + DISABLE,
            "moved.cpp": BLOCK,
            "quiet.cpp": BLOCK,
        },
        {
            "moved.py": old + NAMES + ENABLE,
            "quiet.py": "Y = 1\n" + old.replace("X", "Z") + ENABLE,
            "alone.py": DISABLE + "X = here\n" + NAMES,
            "moved.cpp": BLOCK.replace("int one();\n", "int one();\n" + DEFECT),
            "quiet.cpp": "int two();\n" + BLOCK.replace("int", "  int"),
        },
    )
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,metrics,ruff,unassignedVariable")
    more = [(c["path"], c["line"], c["what"]) for c in outcome.report["silenced"]["more"]]
    assert more == [
        ("alone.py", 4, "undefined-variable"),
        ("moved.cpp", 1, "cppcheck-suppress"),
        ("moved.cpp", 3, "nullPointer"),
        ("moved.py", 4, "undefined-variable"),
    ]
    assert outcome.report["silenced"]["comments"] == []
    assert outcome.says("comments silence more than they did in 4 places: alone.py:4 (undefined-variable), ")


QUIET_NULL = "int give()\n{\n  int * box = %s;\n  return *box;  // cppcheck-suppress nullPointer\n}\n"
OF_FILE = "# pylint: skip-file\n"


def test_findings_that_old_comments_come_to_silence(trap: Trap) -> None:
    """The cause is on another line or in another file, or the comment has moved with its line; what the base has so, too, is no news."""
    user = "from names import %s\n\nX = %s  # noqa: F821\nY = %s  # haros: ignore[undefined-variable] why\n"
    base = {
        "null.cpp": "int kept;\n" + QUIET_NULL % "&kept",
        "header.h": "#define BOX &kept\n",
        "user.cpp": '#include "header.h"\nint kept;\n' + QUIET_NULL % "BOX",
        "all.py": OF_FILE + "A = 1\n",
        "names.py": "here = 1\n",
        "user.py": user % ("here", "here", "here"),
        "old.cpp": "int more;\n" + QUIET_NULL % "nullptr",
        "lost.cpp": "// cppcheck-suppress-file syntaxError\nint a;\n",
        "from.cpp": "int a();\n" + QUIET_NULL % "nullptr" + "int b();\n",
    }
    head = {
        **base,
        "null.cpp": "int kept;\n" + QUIET_NULL % "nullptr",
        "header.h": "#define BOX nullptr\n",
        "all.py": OF_FILE + "A = nowhere\n",
        "user.py": (user % ("here", "here", "here")).replace("from names import here\n", ""),
        "lost.cpp": "// cppcheck-suppress-file syntaxError\nint a;\n" + DEFECT.replace("{ int", "{ { int"),
        "old.cpp": "int more;\nint even_more;\n" + QUIET_NULL % "nullptr",
        "to.cpp": "int a();\n" + QUIET_NULL % "nullptr" + "int b();\n",
    }
    del head["from.cpp"]
    pull_request(trap, base, head)
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,metrics,ruff,unassignedVariable")
    more = [(c["path"], c["line"], c["what"]) for c in outcome.report["silenced"]["more"]]
    assert {*more} == {
        ("all.py", 2, "undefined-variable"),
        ("lost.cpp", None, "what cppcheck would say"),
        ("lost.cpp", 1, "cppcheck-suppress"),
        ("null.cpp", 5, "nullPointer"),
        ("user.cpp", 6, "nullPointer"),
        ("user.py", 2, "undefined-variable"),
        ("user.py", 3, "undefined-variable"),
    }, more
    assert outcome.says("comments silence more than they did in 7 places: all.py:2 ") and outcome.code == 0
    assert_harmless(trap, outcome)


KEPT = '#include "halt.h"\nvoid kept() noexcept\n{\n  STOP;\n}\n'
THROW = "void %s()\n{\n  throw 1;\n}\nvoid stop() noexcept\n{\n  %s();\n}\n"


def test_findings_that_a_change_brings_with_what_speaks_against_them(trap: Trap) -> None:
    """A filter drops them, by code that may have been written for it: they are named, but for those that the base has so, too."""
    names = "def early():\n    return %s\n\n\ndef early():\n    return 1\n" % "nowhere"
    one, two = THROW % ("halt", "halt"), THROW % ("end", "end")
    pull_request(
        trap,
        {
            **{"old.cpp": one, "old.py": names, "quiet.cpp": "int quiet();\n", "moved.cpp": one},
            **{"kept.cpp": KEPT, "halt.h": "#define STOP static_cast<void>(0)\n"},
        },
        {
            **{"kept.cpp": KEPT, "halt.h": "#define STOP throw 1\n"},
            "old.cpp": "int more();\n" + one,
            "old.py": names + "\n\nX = 1\n",
            "other.cpp": one,
            "new.cpp": two,
            "new.py": names,
            "quiet.cpp": "int quiet();\n" + one.replace(" noexcept", ""),
        },
    )
    ignored = "--ignore=cpplint,metrics,ruff,unassignedVariable,function-redefined"
    outcome = trap.run("--baseline-rev=main", "--select=throwInNoexceptFunction", ignored)
    said = [message for _, message in outcome.notes() if "speaks against" in message]
    assert said == [
        "since this change 3 findings are not reported, as the code around speaks against them: kept.cpp:4 (cppcheck:throwInNoexceptFunction), "
        "new.cpp:7 (cppcheck:throwInNoexceptFunction), new.py:2 (pylint:undefined-variable); look at them"
    ]
    assert outcome.code == 0 and outcome.report["silenced"] == {"findings": 0, "comments": [], "more": []}
    assert_harmless(trap, outcome)
