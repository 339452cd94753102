# SPDX-License-Identifier: Apache-2.0
"""Follows the CMake of a package: blocks, functions, scopes and files. Commands are in ``cmake_commands``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType

from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex
from haros_ci.workspace.cmake_choices import is_choice
from haros_ci.workspace.cmake_commands import COMMANDS, SUMMARIES, UNREMARKABLE, note_unknown
from haros_ci.workspace.cmake_conditions import decide
from haros_ci.workspace.cmake_loops import foreach_turns, while_turns
from haros_ci.workspace.cmake_parse import ParsedCommand
from haros_ci.workspace.cmake_start import start_values
from haros_ci.workspace.cmake_state import MAX_CALLS, CMakeBudgetExhausted, CMakeState, Doubt, condition_text
from haros_ci.workspace.cmake_words import (
    BINARY_ROOT,
    absolute,
    bare,
    cleaned,
    inside,
    is_certain,
    join_list,
    merge,
    place,
    split_list,
)
from haros_ci.workspace.tree import PathTree

#: How a block ends: at its end, by break(), continue(), return(), or dead by an error it reports.
END, BREAK, CONTINUE, RETURN, DEAD = "", "break", "continue", "return", "dead"

#: Blocks and calls within each other.
MAX_DEPTH = 150
#: What is made where one of these holds belongs to tests.
_TESTING = ("BUILD_TESTING", "CATKIN_ENABLE_TESTING")
#: A condition may ask for the value of a variable in place of its name: ``if(${BUILD_TESTING})``.
_BRACES = regex(r"\A\$\{(\w+)\}\Z")


def follow(tree: PathTree, package: Package) -> CMakeState:
    """What the CMakeLists.txt of *package* leads to; never raises, what it cannot follow is in ``problems``."""
    state = CMakeState(tree, package)
    state.cache.update(start_values(package))
    path = "CMakeLists.txt" if package.path == "." else f"{package.path}/CMakeLists.txt"
    state.seen_files.add(path)
    if package.ros is not None:
        state.environment["ROS_VERSION"] = state.cache["ROS_VERSION"] = str(package.ros)
    try:
        run_file(state, path)
    except CMakeBudgetExhausted:
        message = "its CMake takes too long to follow (a loop that does not end?); targets after this point are missing"
        state.problems[Problem(state.file or path, message)] = None
    except RecursionError:
        state.problems[Problem(path, "its CMake is nested too deeply to follow; simplify it")] = None
    return state


def run_file(state: CMakeState, path: str) -> str:
    """Run the commands of a file in the current scope; DEAD if it reports an error that ends the build."""
    if state.calls >= MAX_CALLS:
        raise CMakeBudgetExhausted
    script = state.tree.script(path)
    for line, message in script.errors:
        state.problem(Location(path, line), message)
    before, doubts = state.file, len(state.doubts)
    names = ("CMAKE_CURRENT_LIST_FILE", "CMAKE_CURRENT_LIST_DIR")
    saved = [state.get(name) for name in names]
    state.put(names[0], absolute(path))
    state.put(names[1], absolute(path.rpartition("/")[0] or "."))
    state.file = path
    state.calls += 1
    signal = run_block(state, script.commands, None)
    state.calls -= 1
    state.file = before
    del state.doubts[doubts:]
    for name, value in zip(names, saved, strict=True):
        state.put(name, value)
    return signal if signal == DEAD else END


def run_block(state: CMakeState, body: Iterable[ParsedCommand], macro: dict[str, str] | None) -> str:
    """Run commands until one ends the block."""
    if state.depth >= MAX_DEPTH:
        raise CMakeBudgetExhausted
    state.depth += 1
    signal = END
    for command in body:
        signal = _run(state, command, macro)
        if signal:
            break
    state.depth -= 1
    return signal


def _run(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """Run one command; how the block ends with it, END if it goes on."""
    name = command.name
    if name in _BLOCKS:
        return _BLOCKS[name](state, command, macro)
    if name in (BREAK, CONTINUE, RETURN):
        if name == RETURN and macro is None:
            _propagate(state, command)
        return name
    if name == "message":  # outside of branches that may not be taken, which have a journal, it is ours
        is_fatal = bool(command.arguments) and command.arguments[0].text == "FATAL_ERROR"
        return DEAD if is_fatal and state.journal is not None else END
    run = COMMANDS.get(name) or (None if name in state.functions else SUMMARIES.get(name))
    if run is not None:
        call = state.expand(command, command.arguments, macro)
        if name not in UNREMARKABLE:
            state.keep(call)
        run(state, call)
        return _extras(state) if state.pending else END
    if name in state.functions:
        return _call(state, command, macro)
    call = state.expand(command, command.arguments, macro)
    state.keep(call)
    note_unknown(state, command, call)
    return END


def _if(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """Run the branch that holds; all that may hold where that is not known."""
    possible: list[tuple[ParsedCommand, list[ParsedCommand]]] = []
    is_complete = False
    is_choosing = is_choice(command)
    for opener, body in command.branches:
        verdict = True if opener.name == "else" else _verdict(state, opener, macro, is_choosing)
        if verdict is not False:
            possible.append((opener, body))
        if verdict:
            is_complete = True
            break
    if not possible:
        return END
    if is_complete and len(possible) == 1:
        opener, body = possible[0]
        is_testing = any(_BRACES.sub(r"\1", argument.text) in _TESTING for argument in opener.arguments)
        state.testing += is_testing
        signal = run_block(state, body, macro)
        state.testing -= is_testing
        return signal
    bodies = [body for _, body in possible]
    if not is_complete:
        bodies.append([])
    return _fork(state, possible[0][0], bodies, macro)


def _verdict(state: CMakeState, opener: ParsedCommand, macro: dict[str, str] | None, is_choosing: bool) -> bool | None:
    """Whether the condition of *opener* holds; None where only a build knows."""
    state.is_choosing = is_choosing
    try:
        call = state.expand(opener, opener.arguments, macro)
        return decide(state, list(zip(call.words, call.quoted, strict=True)))
    finally:
        state.is_choosing = False


def _fork(
    state: CMakeState, opener: ParsedCommand, bodies: list[list[ParsedCommand]], macro: dict[str, str] | None
) -> str:
    """Run each body from the same beginning, then continue with what they agree on; see ``cmake_words.merge``."""
    doubt = Doubt(state.file, opener.line, condition_text(opener))
    outer = state.journal
    ends = []
    for body in bodies:
        state.journal = []
        state.branches += 1
        state.doubts.append(replace(doubt, branch=state.branches))
        depth = len(state.doubts)
        try:
            signal = run_block(state, body, macro)
        finally:
            del state.doubts[depth - 1 :]
            after = state.roll_back(state.journal)
            state.journal = outer
        ends.append((signal, after))
    alive = [end for end in ends if end[0] != DEAD] or ends
    going = [end for end in alive if end[0] == END]
    if not going:
        going = alive
    elif len(going) < len(alive):
        exits = {signal for signal, _ in alive}
        leaving = next(signal for signal in (RETURN, BREAK, CONTINUE) if signal in exits)
        state.branches += 1
        state.doubts.append(replace(doubt, leaving=leaving, branch=state.branches))
    for key in dict.fromkeys(key for _, after in alive for key in after):
        scope, name, _ = next(after[key] for _, after in alive if key in after)
        state.spend()
        before = state.seen_from(scope, name)
        state.put(name, merge([after[key][2] if key in after else before for _, after in alive]), scope)
    signals = [end[0] for end in going]
    is_of_all = all(signal == signals[0] for signal in signals) and (signals[0] != DEAD or outer is not None)
    return signals[0] if is_of_all else END


def _loop(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """foreach and while. A while whose condition is not known runs once, in doubt."""
    doubts = len(state.doubts)
    signal = END
    body = command.branches[0][1]
    for is_certain_turn in (foreach_turns if command.name == "foreach" else while_turns)(state, command, macro):
        state.spend()
        state.doubts[doubts:] = [doubt for doubt in state.doubts[doubts:] if doubt.leaving != CONTINUE]
        signal = run_block(state, body, macro) if is_certain_turn else _fork(state, command, [body, []], macro)
        if signal in (BREAK, RETURN, DEAD):
            break
    state.doubts[doubts:] = [doubt for doubt in state.doubts[doubts:] if doubt.leaving == RETURN]
    return signal if signal in (RETURN, DEAD) else END


def _define(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    words = state.expand(command, command.arguments, macro).words
    if words:
        state.functions[words[0].lower()] = (command, state.file)
    return END


def _call(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """Call a function in a new scope, or a macro in this one."""
    definition, file = state.functions[command.name]
    call = state.expand(command, command.arguments, macro)
    if state.calls >= MAX_CALLS:
        raise CMakeBudgetExhausted
    parameters = [argument.text for argument in definition.arguments[1:]]
    rest = join_list(call.words[len(parameters) :])
    values = {name: call.words[i] if i < len(call.words) else "" for i, name in enumerate(parameters)}
    values |= {"ARGC": str(len(call.words)), "ARGV": join_list(call.words), "ARGN": rest}
    values |= {f"ARGV{number}": word for number, word in enumerate(call.words)}
    site, before, doubts = state.site, state.file, len(state.doubts)
    state.site, state.calls = call.location, state.calls + 1
    body = definition.branches[0][1]
    signal = END
    if definition.name == "macro":
        signal = run_block(state, body, values)
    else:
        state.file = file
        state.scopes.append({**values, "CMAKE_CURRENT_FUNCTION_LIST_DIR": absolute(file.rpartition("/")[0] or ".")})
        if run_block(state, body, None) == DEAD:
            signal = DEAD
        state.scopes.pop()
        del state.doubts[doubts:]
    state.site, state.file, state.calls = site, before, state.calls - 1
    return signal


def _block(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    words = state.expand(command, command.arguments, macro).words
    state.scopes.append({})
    signal = run_block(state, command.branches[0][1], macro)
    scope = state.scopes.pop()
    names = words[words.index("PROPAGATE") + 1 :] if "PROPAGATE" in words else []
    for name in names:
        if name in scope:
            state.put(name, scope[name])
    return signal


def _propagate(state: CMakeState, command: ParsedCommand) -> None:
    """return(PROPAGATE ...)."""
    words = [argument.text for argument in command.arguments]
    if words[:1] == ["PROPAGATE"] and len(state.scopes) > 1:
        for name in words[1:]:
            state.put(name, state.get(name), state.scopes[-2])


def _subdirectory(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """Run the CMakeLists.txt of a directory in a scope of its own."""
    call = state.expand(command, command.arguments, macro)
    if not call.words:
        return END
    path = inside(place(bare(call.words[0]), state.source_directory())) if is_certain(bare(call.words[0])) else None
    file = None if path is None else ("CMakeLists.txt" if path == "." else f"{path}/CMakeLists.txt")
    if file is None or path is None or not state.tree.is_file(file):
        why = "no CMakeLists.txt there" if is_certain(call.words[0]) else "only known in a build"
        state.missing(call, f"add_subdirectory({call.words[0]}): {why}; what it would add is missing")
        return END
    if file in state.seen_files:
        return END
    state.seen_files.add(file)
    output = call.words[1] if len(call.words) > 1 and is_certain(call.words[1]) else call.words[0]
    binary = place(output, state.get("CMAKE_CURRENT_BINARY_DIR") or BINARY_ROOT)
    state.scopes.append({"CMAKE_CURRENT_SOURCE_DIR": absolute(path), "CMAKE_CURRENT_BINARY_DIR": binary})
    signal = run_file(state, file)
    state.scopes.pop()
    return signal


def _include(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> str:
    """Run a file of the workspace in this scope; modules of CMake itself change nothing here."""
    call = state.expand(command, command.arguments, macro)
    if not call.words or not is_certain(bare(call.words[0])):
        return END
    word = bare(call.words[0])
    if word.endswith(".cmake") or "/" in word:
        candidates = [place(word, state.source_directory())]
    else:
        directories = split_list(state.get("CMAKE_MODULE_PATH") or "")
        candidates = [place(f"{d}/{word}.cmake", state.source_directory()) for d in directories if is_certain(d)]
    for candidate in candidates:
        path = inside(candidate)
        if path is not None and state.tree.is_file(path):
            return END if path in state.guarded else run_file(state, path)
    if word.endswith(".cmake") and "OPTIONAL" not in call.words and candidates and inside(candidates[0]) is not None:
        state.missing(call, f"include({cleaned(word)}): no such file in the workspace; what it defines is missing")
    return END


def _extras(state: CMakeState) -> str:
    """Run what packages of the workspace that were just found offer to those who find them."""
    files, state.pending = state.pending, []
    for path, directory, name in files:
        state.put(f"{name}_DIR", absolute(directory))
        if run_file(state, path) == DEAD:
            return DEAD
    return END


_Block = Callable[[CMakeState, ParsedCommand, "dict[str, str] | None"], str]
_BLOCKS: Mapping[str, _Block] = MappingProxyType(
    {
        "if": _if,
        "foreach": _loop,
        "while": _loop,
        "function": _define,
        "macro": _define,
        "block": _block,
        "add_subdirectory": _subdirectory,
        "include": _include,
    }
)
