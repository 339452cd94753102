# SPDX-License-Identifier: Apache-2.0
"""A plug-in is looked at when it is loaded, and refused with what is wrong and what to do."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from commandline import write
from plugin_cases import PAGE, check_module

from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.location import Location
from haros_ci.plugins.guard import GuardedLinter, sound
from haros_ci.plugins.load import load
from haros_ci.plugins.place import keep_workspace_out
from haros_ci.registry import built_in, registry

LINTER = (
    "from types import SimpleNamespace\nfrom haros_ci.api.linters import *\n"
    "def boom(*a): raise {error}\n"
    "LINTERS = (SimpleNamespace(NAME={name!r}, LANGUAGES={{'cpp'}}, WHEN=When.ASKED, COST=1.0, locate=boom, fingerprint=boom,"
    " dependencies=boom, command=boom, parse=boom),)\n"
)
CHECK = "from haros_ci.api import Check, Level\n"


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A directory that modules are imported from, beside the workspace; what is imported of it is forgotten."""
    place, before = tmp_path / "lib", set(sys.modules)
    place.mkdir()
    monkeypatch.syspath_prepend(str(place))
    yield place
    for name in set(sys.modules) - before:
        if str(getattr(sys.modules[name], "__file__", None) or "").startswith(str(place)):
            del sys.modules[name]
    load.cache_clear()


def settings(tmp_path: Path, *plugins: str) -> Settings:
    (tmp_path / "ws").mkdir(exist_ok=True)
    return Settings(root=tmp_path / "ws", plugins=plugins)


REFUSED = [
    ("", "offers none of CHECKS, LINTERS"),
    ("1 / 0", "cannot be imported: ZeroDivisionError"),
    ("import nothing_of_that_name", "cannot be imported: ModuleNotFoundError"),
    ("print 'two'", "cannot be imported: SyntaxError"),
    ("raise SystemExit(0)", "cannot be imported: SystemExit"),
    ("CHECKS = 3", "CHECKS is a int"),
    ("CHECKS = ('x',)", "CHECKS has a str"),
    (CHECK + "CHECKS = (Check(id='Odd', summary='', level=Level.NOTE, run=print),)", "the id of a check is 'Odd'"),
    (CHECK + "CHECKS = (Check(id='odd', summary='', level=Level.NOTE),)", "not one of 'run' and 'project'"),
    (CHECK + "CHECKS = (Check(id='odd', summary='', level=Level.NOTE, run=print),)", "check odd has no page"),
    (CHECK + "CHECKS = (Check(id='odd', summary='', level=Level.NOTE, run=print),)\nPAGES = {'odd': '# even'}", "not made as pages"),
    (check_module("odd", "pass") + "CHECKS *= 2", "the check 'odd' is there twice"),
    (check_module("self-loop", "pass"), "the check 'self-loop' is one of haros-ci already"),
    (check_module("odd", "pass") + "REQUIRES_API = (1, 0)", "made for the API 1.0; this is 2.0, where the code of a program is typed nodes"),
    (check_module("odd", "pass") + "REQUIRES_API = (1, 999)", "made for the API 1.999; this is 2.0, where"),
    (check_module("odd", "pass") + "REQUIRES_API = (3, 0)", "made for the API 3.0; this is 2.0"),
    (check_module("odd", "pass") + "REQUIRES_API = (2, 999)", "made for the API 2.999; this is 2.0"),
    (check_module("odd", "pass") + "REQUIRES_API = 1", "REQUIRES_API is 1"),
    (check_module("odd", "pass") + "REQUIRES_API = ()", "REQUIRES_API is ()"),
    (check_module("odd", "pass") + "REQUIRES_API = (2, 'x')", "REQUIRES_API is (2, 'x')"),
    ("LINTERS = (3,)", "the NAME of a linter is None"),
    ("class a: NAME = 'mine'\nLINTERS = (a,)", "linter mine: it has no LANGUAGES, WHEN, COST, locate"),
    (LINTER.format(name="pylint", error="ValueError"), "the linter 'pylint' is one of haros-ci already"),
    (LINTER.format(name="metrics", error="ValueError"), "the linter 'metrics' is one of haros-ci already"),
    (LINTER.format(name="mine", error="ValueError") + "LINTERS[0].RULES = ['x']", "RULES are not rules"),
    ("API_ROWS = [{'cal': 'x'}]", "row 1 of API_ROWS: unknown key 'cal'"),
    ("API_ROWS = ['x']", "row 1 of API_ROWS: a row is a mapping"),
    ("RENDERERS = []", "RENDERERS is a list"),
    ("RENDERERS = {'x': 3}", "RENDERERS has 'x'"),
]  # fmt: skip


@pytest.mark.parametrize(("code", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_what_is_no_plugin_is_refused(code: str, said: str, library: Path, tmp_path: Path) -> None:
    write(library, {"case_refused.py": code})
    with pytest.raises(UserError) as raised:
        registry(settings(tmp_path, "case_refused"))
    assert raised.value.message.startswith("plug-in case_refused: ")
    assert said in raised.value.message
    assert raised.value.help


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("no_such_module_of_ours", "no such module"),
        ("no_such_package.of_ours", "no such module"),
        ("a-b", "not the name of a module"),
        ("a/b.py", "not the name of a module"),
        ("..b", "not the name of a module"),
        ("haros_ci.api", "part of haros-ci"),
        ("sys", "not a module of files"),
    ],
)
def test_a_name_that_is_none_is_refused(name: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=said):
        registry(settings(tmp_path, name))


def test_two_plugins_do_not_share_a_name(library: Path, tmp_path: Path) -> None:
    write(library, {"case_one.py": check_module("odd", "pass"), "case_two.py": check_module("odd", "pass")})
    with pytest.raises(UserError, match="plug-in case_two: the check 'odd' is one of case_one already"):
        registry(settings(tmp_path, "case_one", "case_two"))


def test_a_whole_plugin_is_taken_in(library: Path, tmp_path: Path) -> None:
    look = "def look(system):\n    return ()\n"
    inner = f"{CHECK}{look}CHECK = Check(id='odd-one', summary='', level=Level.NOTE, run=look)\n"
    outer = (
        "from case_whole.checks.odd import CHECK\n__version__ = '3.1'\nREQUIRES_API = (2, 0)\nCHECKS = [CHECK]\n"
        "API_ROWS = ({'call': 'acme.f', 'args': [1], 'makes': [{'kind': 'publishers', 'name': '{0}'}]},)\n"
        "RENDERERS = {'acme': lambda report: 'x'}\n"
    )
    files = {
        "__init__.py": outer,
        "checks/__init__.py": "",
        "checks/odd.py": inner,
        "checks/odd_one.md": PAGE.format(id="odd-one"),
    }
    write(library / "case_whole", files)
    known = registry(settings(tmp_path, "case_whole"))
    assert known.check_rules["odd-one"].help.startswith("# odd-one")
    assert known.check_rules["odd-one"].profiles == ("ros", "strict", "architecture")
    assert [(tool.name, tool.version) for tool in known.components] == [("case_whole", "3.1")]
    assert list(known.renderers) == ["acme"]
    assert len(known.checks) == len(built_in().checks) + 1
    (plugin,) = load(("case_whole",), tmp_path / "ws")
    assert [row.call for row in plugin.rows] == ["acme.f"]


def test_without_plugins_the_registry_is_the_built_in_one(tmp_path: Path) -> None:
    assert registry(settings(tmp_path)) is built_in()


def test_the_digest_is_of_all_files(library: Path, tmp_path: Path) -> None:
    package = write(library / "case_digest", {"__init__.py": "API_ROWS = ()", "data.json": "1"})
    digests = []
    for text in ("1", "2", "1"):
        write(package, {"data.json": text})
        load.cache_clear()
        digests.append(load(("case_digest",), tmp_path / "ws")[0].digest)
    assert digests[0] == digests[2] != digests[1]


def test_what_an_adapter_raises_is_a_value_error(library: Path, tmp_path: Path) -> None:
    for number, error in enumerate(("KeyError('a')", "SystemExit(3)", "RecursionError()", "ValueError('b')")):
        write(library, {f"case_adapter{number}.py": LINTER.format(name="mine", error=error)})
        (plugin,) = load((f"case_adapter{number}",), tmp_path / "ws")
        (linter,) = plugin.linters
        assert isinstance(linter, GuardedLinter)
        with pytest.raises(ValueError, match="its adapter"):
            linter.locate(None)  # type: ignore[arg-type]
        with pytest.raises(ValueError, match="its adapter"):
            linter.parse(None, None)  # type: ignore[arg-type]


# -- the workspace ------------------------------------------------------------------------------------------------


def test_the_workspace_is_never_imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = write(
        tmp_path / "ws", {"evil_case.py": "1 / 0", "deep/evil_case2.py": "1 / 0", "pkg_case/__init__.py": "1 / 0"}
    )
    monkeypatch.setattr(sys, "path", [str(root), str(root / "deep"), "", ".", *sys.path])
    monkeypatch.chdir(root)
    for name in ("evil_case", "evil_case2", "pkg_case"):
        with pytest.raises(UserError, match="no such module"):
            registry(Settings(root=root, plugins=(name,)))
    assert not [entry for entry in sys.path if not entry.startswith("/") or entry.startswith(str(root))]


def test_nor_is_it_through_a_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = write(tmp_path / "ws", {"evil_link.py": "1 / 0"})
    (tmp_path / "elsewhere").symlink_to(root)
    monkeypatch.setattr(sys, "path", [str(tmp_path / "elsewhere"), *sys.path])
    with pytest.raises(UserError, match="no such module"):
        registry(Settings(root=root, plugins=("evil_link",)))


def test_nor_is_a_link_to_its_files(tmp_path: Path, library: Path) -> None:
    root = write(tmp_path / "ws", {"evil_file.py": "1 / 0"})
    (library / "evil_file.py").symlink_to(root / "evil_file.py")
    with pytest.raises(UserError, match="it lies in the workspace"):
        registry(Settings(root=root, plugins=("evil_file",)))


def test_what_is_outside_stays_importable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "ws").mkdir()
    before = [entry for entry in sys.path if entry.startswith("/")]
    keep_workspace_out(tmp_path / "ws")
    assert sys.path == before


# -- findings -----------------------------------------------------------------------------------------------------


def test_a_finding_is_looked_at() -> None:
    from haros_ci.api import Edit, Finding, Fix

    here = Location("a.py", 1)
    good = Finding(at=here, message="m", about=("/a",), related=((here, "there"),), fixes=(Fix("do", (Edit("a.py"),)),))
    assert sound(good, {"a.py"}) is good
    assert sound(good, None) is good
    wrong: list[object] = [
        None,
        "text",
        Finding(at=Location("b.py", 1), message="m", about=()),
        Finding(at=Location("../a.py", 1), message="m", about=()),
        Finding(at=Location("a.py", 0), message="m", about=()),
        Finding(at="a.py", message="m", about=()),  # type: ignore[arg-type]
        Finding(at=here, message=3, about=()),  # type: ignore[arg-type]
        Finding(at=here, message=" ", about=()),
        Finding(at=here, message="m", about="abc"),  # type: ignore[arg-type]
        Finding(at=here, message="m", about=(3,)),  # type: ignore[arg-type]
        Finding(at=here, message="m", about=(), level="error"),  # type: ignore[arg-type]
        Finding(at=here, message="m", about=(), related=((here, 3),)),  # type: ignore[arg-type]
        Finding(at=here, message="m", about=(), fixes=(Fix("do", (Edit("/etc/passwd"),)),)),
    ]
    for each in wrong:
        with pytest.raises((TypeError, ValueError)):
            sound(each, {"a.py"})
