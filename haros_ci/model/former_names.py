# SPDX-License-Identifier: Apache-2.0
"""Names that say that a file is no longer used: former versions, and directories of such."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: A superseded copy: ``pick_old.py`` beside ``pick.py``, or beside ``pick_fast.py``.
_SUPERSEDED = regex(
    r"(?P<a>.+?)[_-](?:old|backup|bak|copy|orig|original|deprecated|unused|obsolete|legacy)\d*"
    r"|(?:old|backup|bak|deprecated|unused|obsolete)[_-](?P<b>.+)"
    # what editors and file managers call a copy: "main copy 2", "main - Copy (3)", "main (2)", "Copy of main"
    r"|(?P<c>.+?)(?: (?:- )?[Cc]opy(?: ?\(?\d{1,3}\)?)?| ?\((?:copy|\d{1,3})\))|[Cc]opy of (?P<d>.+)"
)
#: Words of directories whose names say in passing that what they hold is not used: ``unneeded_scripts``.
_PUT_ASIDE = frozenset("uneeded unneeded unused".split())
#: Directories of what is no longer used.
_ARCHIVES = frozenset(
    "archive archived archives attic backup backups bak deprecated graveyard legacy obsolete old trash unused".split()
)
#: Such directories with a word of what they hold: ``legacy_ros1``, ``old_scripts``, ``old version``, ``launch_old``.
_FORMER = "deprecated|legacy|obsolete|old|unused"
_HELD = r"code|files?|launch|modules?|nodes?|ros[12]?|scripts?|src|stuff|versions?|v?\d{1,8}"
_ARCHIVE_OF = regex(rf"(?:{_FORMER})[_ -]?(?:{_HELD})|(?:{_HELD})[_ -](?:{_FORMER})|(?:former|previous)[_ -]?versions?")

#: Directories whose names say that what they hold is not used: ``not_used``, ``pkg_not_use``, ``no usado``.
_NOT_USED = regex(
    r"(?:.*[_ .-])?(?:(?:not|never|don'?t|do[_ -]not)[_ -]?(?:in[_ -])?(?:used?|needed)|un-?used|no[_ -]us(?:ado|ada|ar)|sin[_ -]usar|n[aã]o[_ -]usad[oa])(?:[_ .-].*)?"
)


def superseded(stem: str) -> str:
    """What a file was called of which this one, by its name without its ending, is a former version: ``arm`` for ``arm_old``; "" for others."""
    found = _SUPERSEDED.fullmatch(stem)
    return "" if found is None else found["a"] or found["b"] or found["c"] or found["d"]


def is_archived(path: str) -> bool:
    """Whether the file at *path* is in a directory of what is no longer used, by its name."""
    folders = path.rpartition("/")[0].lower().split("/")
    return not _ARCHIVES.isdisjoint(folders) or any(
        _ARCHIVE_OF.fullmatch(folder) is not None
        or not _PUT_ASIDE.isdisjoint(re.split(r"[^a-z0-9]+", folder))
        or is_not_used(folder)
        for folder in folders
    )


def is_not_used(folder: str) -> bool:
    """Whether the name of a directory says that what it holds is not used: in English, Spanish or Portuguese."""
    return _NOT_USED.fullmatch(folder.lower()) is not None


def mention(path: str, stem: str) -> str:
    """The pattern of what names the file at *path* by its *stem*, a word; of an archived one, not as a module or file of another directory (``demo.walk`` for ``old/walk.py``)."""
    name, folder = re.escape(stem), re.escape(path.rpartition("/")[0].rpartition("/")[2])
    if not folder or not is_archived(path):
        return rf"(?<!\w){name}(?!\w)"
    return rf"(?:(?<![\w./])|(?<=\W[./])|(?<={folder}[./])){name}(?!\w)"
