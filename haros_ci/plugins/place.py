# SPDX-License-Identifier: Apache-2.0
"""Where a module may be imported from: any place but the workspace."""

from __future__ import annotations

import hashlib
import os
import sys
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from pathlib import Path

from haros_ci.errors import UserError
from haros_ci.plugins.stdout import kept_clean

#: Files of a plug-in that are looked at for its digest; what lies beyond is a mistake.
MAX_FILES, MAX_BYTES = 5_000, 200_000_000


def keep_workspace_out(root: Path) -> None:
    """Take what lies in the workspace from ``sys.path``, for good: nothing of it is ever imported.

    What belongs to the interpreter that runs is kept: somebody has already started it from there.
    """
    sys.path[:] = [
        entry for entry in sys.path if os.path.isabs(entry) and (not _is_in(entry, root) or _is_interpreters(entry))
    ]


def located(name: str, root: Path) -> ModuleSpec:
    """Where the module *name* is; UserError if it is nowhere, or in the workspace."""
    keep_workspace_out(root)
    try:
        with kept_clean():  # it imports the packages that the module is in
            spec = find_spec(name)
    except ModuleNotFoundError:
        spec = None
    except (Exception, SystemExit) as err:
        raise failed(name, err) from err
    if spec is None:
        here = (root / name.partition(".")[0]).is_dir() or (root / f"{name}.py").is_file()
        more = "; what the workspace has of that name is never imported" if here else ""
        raise UserError(
            f"plug-in {name}: no such module{more}",
            help="install it where haros-ci is installed, outside the workspace",
        )
    if spec.origin is None or spec.origin in ("built-in", "frozen"):
        raise UserError(
            f"plug-in {name}: not a module of files", help="name a module, or a package with an __init__.py"
        )
    if _is_in(spec.origin, root) and not _is_interpreters(spec.origin):
        raise UserError(
            f"plug-in {name}: it lies in the workspace, of which nothing is ever imported",
            help="install it where haros-ci is installed (not editable), or keep it in another repository",
        )
    return spec


def digest(spec: ModuleSpec) -> str:
    """16 hex digits of the files that a module or package consists of."""
    assert spec.origin is not None
    origin = Path(spec.origin)
    home = origin.parent
    paths = [origin] if not spec.submodule_search_locations else sorted(p for p in home.rglob("*") if p.is_file())
    made, size = hashlib.sha256(), 0
    for path in paths[:MAX_FILES]:
        if "__pycache__" in path.parts:
            continue
        data = path.read_bytes()
        size += len(data)
        if size > MAX_BYTES:
            raise UserError(f"plug-in {spec.name}: more than {MAX_BYTES:,} bytes", help="keep data out of the package")
        made.update(f"{path.relative_to(home).as_posix()}\0{len(data)}\0".encode("utf-8", "surrogateescape"))
        made.update(data)
    return made.hexdigest()[:16]


def _is_in(entry: str, root: Path) -> bool:
    place, base = os.path.realpath(entry), os.path.realpath(root)
    return place == base or place.startswith(base.rstrip(os.sep) + os.sep)


def _is_interpreters(entry: str) -> bool:
    """Whether *entry* lies where the interpreter that runs has its library or its packages."""
    import site
    import sysconfig

    own = {sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")}
    return any(_is_in(entry, Path(place)) for place in (*own, *site.getsitepackages()))


def failed(name: str, err: BaseException) -> UserError:
    return UserError(
        f"plug-in {name}: it cannot be imported: {type(err).__name__}: {err}",
        help=f"see what python -c 'import {name}' says, outside the workspace",
    )
