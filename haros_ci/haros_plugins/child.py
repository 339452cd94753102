# SPDX-License-Identifier: Apache-2.0
"""The process that one plug-in of HAROS runs in: lines of JSON come in and go out, and nothing it prints is among them.

Started as a script. The first request gives the path of imports, the plug-in and the model; each further one runs a phase.
"""

from __future__ import annotations

import importlib
import json
import os
import pickle
import sys
import traceback
from typing import Any


class Speech:
    """Requests and answers, away from the stdin and stdout that the plug-in and its processes have."""

    def __init__(self) -> None:
        self.requests = os.fdopen(os.dup(0), "rb")
        self.answers = os.fdopen(os.dup(1), "wb")
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, 0)
        os.dup2(2, 1)

    def hear(self) -> Any:
        line = self.requests.readline()
        return json.loads(line) if line else None

    def say(self, answer: dict[str, Any]) -> None:
        """Said at once: what is said stays said if the plug-in crashes."""
        self.answers.write(json.dumps(answer).encode("ascii") + b"\n")
        self.answers.flush()


def main() -> None:
    speech = Speech()
    job = speech.hear()
    sys.path[:] = job["path"]
    from haros_ci.haros_plugins.hosted import Hosted

    with open(job["model"], "rb") as stream:
        model = pickle.load(stream)  # noqa: S301 - written by haros-ci itself, for this process
    hosted = Hosted(job, model, speech.say)
    sys.argv[:] = [job["name"]]
    try:
        module = importlib.import_module(f"{job['name']}.plugin")
    except BaseException as err:
        module = None
        failed(speech, "cannot be imported", err)
    speech.say({"kind": "done"})
    while (request := speech.hear()) is not None:
        try:
            if module is not None:
                hosted.run(module, request)
        except BaseException as err:
            failed(speech, "failed", err)
        speech.say({"kind": "done"})


def failed(speech: Speech, what: str, err: BaseException) -> None:
    """The exception, and where in the plug-in it was raised."""
    frames = traceback.extract_tb(err.__traceback__)
    place = f" ({os.path.basename(frames[-1].filename)}:{frames[-1].lineno})" if frames else ""
    traceback.print_exception(type(err), err, err.__traceback__)
    speech.say({"kind": "failed", "message": f"{what}: {type(err).__name__}: {err}{place}"[:2000]})


if __name__ == "__main__":
    main()
