# SPDX-License-Identifier: Apache-2.0
"""What the functions of xacro make of a file, as data: the text that its command would print, by its file and arguments.

What counts is xacro/__init__.py of ros/xacro: ``process_file(path, mappings=…)`` and ``process(path, mappings=…)``, ``parse(file)`` and
``process_doc(document, mappings=…)``, and of the document ``toxml``, ``toprettyxml`` and ``documentElement``. Nothing of it is run here.
"""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    LaunchObject,
    LibraryCall,
    Native,
    Opened,
    PartialText,
    PathValue,
    Unknown,
    Value,
    phrase,
    text_of,
    why,
)
from haros_ci.model.launch_actions import Phrase, Substitution
from haros_ci.model.location import Location

DOCUMENT = "xacro.Document"
MADE = "a robot description made by xacro"
_MOST = 500


def described(run: ScriptEvaluation, path: Value, mappings: Value, place: Location) -> Value:
    """The text that xacro makes of the file at *path* with the arguments in *mappings*; Unknown where these are not known."""
    arguments: list[Phrase] = []
    if not isinstance(path, (str, PartialText, PathValue)):
        return run.unknown(MADE, place)
    if mappings is not None:
        if not isinstance(mappings, dict) or len(mappings) > _MOST or not all(isinstance(key, str) for key in mappings):
            return run.unknown(MADE, place)
        arguments = [(f"{name}:=", *phrase(value)) for name, value in mappings.items()]
    return text_of((Substitution("xacro", (phrase(path), *arguments), place),))


def process(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``xacro.process(path, mappings={…})``, and ``launch_param_builder.load_xacro(path, mappings)``: a text."""
    bound = call.bind("input_file_name just_deps xacro_ns verbosity mappings")
    if call.unknown or bound.get("just_deps") not in (None, False):
        return run.unknown(MADE, call.location)
    return described(run, bound.get("input_file_name"), bound.get("mappings"), call.location)


def load_xacro(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("file_path mappings")
    if call.unknown:
        return run.unknown(MADE, call.location)
    return described(run, bound.get("file_path"), bound.get("mappings"), call.location)


def process_file(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``xacro.process_file(path, mappings={…})``: a document."""
    bound = call.bind("input_file_name")
    if call.unknown:
        return run.unknown(MADE, call.location)
    text = described(run, bound.get("input_file_name"), bound.get("mappings"), call.location)
    return text if isinstance(text, Unknown) else LaunchObject(DOCUMENT, call.location, {"text": text})


def parse(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``xacro.parse(open(path))``: a document that nothing has been made of yet; of a text it is not known."""
    source = call.bind("inp filename").get("inp")
    if call.unknown or not isinstance(source, Opened):
        return run.unknown(MADE, call.location)
    return LaunchObject(DOCUMENT, call.location, {"path": source.path})


def process_doc(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``xacro.process_doc(document, mappings={…})``: the document is another one afterwards."""
    bound = call.bind("doc")
    document = bound.get("doc")
    if not isinstance(document, LaunchObject) or document.name != DOCUMENT:
        return run.unknown(MADE, call.location)
    run.heap.touch(document.fields)
    first = "path" in document.fields and "text" not in document.fields and not call.unknown
    document.fields["text"] = (
        described(run, document.fields["path"], bound.get("mappings"), call.location)
        if first
        else run.unknown(MADE, call.location)
    )
    return None


def document_attribute(run: ScriptEvaluation, document: LaunchObject, name: str, place: Location) -> Value:
    """An attribute of a *document*: its text, however it is laid out."""
    if name == "documentElement":
        return document
    if name not in ("toxml", "toprettyxml"):
        return run.unknown(f"{name} of what xacro makes is not followed", place)
    text = document.fields.get("text", Unknown(MADE, place))
    return Native(name, lambda run, call: text if not isinstance(text, Unknown) else run.unknown(why(text), place))


SUMMARIES: dict[str, Summary] = {
    "launch_param_builder.load_xacro": load_xacro,
    "xacro.process_file": process_file,
    "xacro.process": process,
    "xacro.parse": parse,
    "xacro.process_doc": process_doc,
}
