# SPDX-License-Identifier: Apache-2.0
"""The bytes of a SARIF file as JSON, within bounds."""

from __future__ import annotations

import json

MAX_BYTES = 64_000_000
#: Brackets and commas in the text bound what the parser can allocate before anything of it is looked at.
_MAX_CONTAINERS = 2_000_000
_MAX_COMMAS = 5_000_000


class SarifError(ValueError):
    """The file is no SARIF log that can be read; the message says why."""


def parse(data: bytes, name: str) -> dict[str, object]:
    """The log that the bytes *data* of the file *name* hold. Raises SarifError."""
    if len(data) > MAX_BYTES:
        raise SarifError(f"{name}: larger than {MAX_BYTES // 1_000_000} MB")
    if data.count(b"{") + data.count(b"[") > _MAX_CONTAINERS or data.count(b",") > _MAX_COMMAS:
        raise SarifError(f"{name}: too many values for a log of this size")
    try:
        log = json.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise SarifError(f"{name}: not UTF-8") from None
    except RecursionError:
        raise SarifError(f"{name}: nested too deeply") from None
    except ValueError as err:
        raise SarifError(f"{name}: not JSON: {str(err)[:200]}") from None
    if not isinstance(log, dict):
        raise SarifError(f"{name}: not a SARIF log: not a JSON object")
    return log
