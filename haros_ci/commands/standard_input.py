# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check - --stdin-filename FILE``: what an editor has of one file, in the place of what is on disk."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.workspace import Buffer

Flags = Mapping[str, Any]

#: Options that work on files as they lie on disk, or on more than one.
_NOT_WITH = ("fix", "diff", "watch", "shard", "trust_config", "baseline_rev")


def settled(flags: Flags) -> Flags:
    """*flags* with the name of the buffer as the one path, if standard input is asked for, else as they are.

    UserError where the arguments do not fit together.
    """
    name = flags.get("stdin_filename")
    if "-" not in flags["paths"]:
        if name is not None:
            raise UserError("--stdin-filename is for standard input", help="give - as the one path")
        return flags
    if name is None:
        raise UserError("- needs a name", help="--stdin-filename says which file of the workspace the text is of")
    if len(flags["paths"]) > 1:
        raise UserError("- is the only path of a run", help="a file with that name is ./-")
    for option in _NOT_WITH:
        if flags.get(option):
            raise UserError(
                f"--{option.replace('_', '-')} does not go with -", help="save the file, and give its name as the path"
            )
    if not Path(name).absolute().parent.is_dir() or Path(name).is_dir():
        raise UserError(f"--stdin-filename {name}: no file can have this name", help="name a file of the workspace")
    return {**flags, "paths": (name,), "is_buffer": True}


def with_buffer(settings: Settings, flags: Flags) -> Settings:
    """*settings* with what standard input has, where *flags* ask for it. UserError if it cannot be read, or is too large."""
    if not flags.get("is_buffer"):
        return settings
    limit = settings.max_file_size
    try:
        data = _read(limit + 1)
    except (OSError, ValueError) as err:
        raise UserError(f"standard input cannot be read: {err}", help="pipe the text of the file into it") from err
    if len(data) > limit:
        raise UserError(f"standard input has more than {limit} bytes", help="max-file-size in the project file")
    return replace(settings, buffer=Buffer(settings.paths[0], data))


def _read(most: int) -> bytes:
    """Up to *most* bytes."""
    parts, size = [], 0
    while size < most and (part := os.read(sys.stdin.fileno(), min(1 << 20, most - size))):
        parts.append(part)
        size += len(part)
    return b"".join(parts)
