# SPDX-License-Identifier: Apache-2.0
"""Completion in a shell: click's script, and the words that it cannot know."""

from __future__ import annotations

from collections.abc import Iterable

import click
from click.shell_completion import get_completion_class

#: Click's own name for the variable by which the script asks the program.
VARIABLE = "_HAROS_CI_COMPLETE"

#: Bash ends words at : and =, of which rules and formats are full. Click's script leaves them in pieces: here they are
#: put together before the program is asked, and what stands before the last piece is taken off the answers.
_BASH = r"""
_haros_ci_completion() {
    local IFS=$'\n' words=() word rest=$COMP_LINE type value
    for word in "${COMP_WORDS[@]:0:$((COMP_CWORD + 1))}"; do
        if [[ -n $word && ${#words[@]} -gt 0 && $rest == "$word"* ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
        rest=${rest#*"$word"}
    done
    word=${COMP_WORDS[COMP_CWORD]}
    [[ $word =~ ^[:=]+$ ]] && word=
    local before=${words[-1]%"$word"}

    COMPREPLY=()
    while IFS=, read -r type value; do
        case $type in
            dir) compopt -o dirnames ;;
            file) compopt -o default ;;
            plain) COMPREPLY+=("${value#"$before"}") ;;
        esac
    done < <(env COMP_WORDS="${words[*]}" COMP_CWORD=$((${#words[@]} - 1)) _HAROS_CI_COMPLETE=bash_complete "$1")
}

complete -o nosort -F _haros_ci_completion haros-ci
"""


def script(command: click.Command, shell: str) -> str:
    """What *shell* (``bash``, ``zsh``, ``fish``) has to read."""
    if shell == "bash":
        return _BASH
    kind = get_completion_class(shell)
    assert kind is not None, "the command offers no other shell"
    return kind(command, {}, "haros-ci", VARIABLE).source()


def words(what: str, incomplete: str) -> list[str]:
    """The words of a kind (``rules``, ``profiles``, ``formats``, ``metrics``, ``tools``) that complete the last one of a comma-separated list."""
    done, comma, begun = incomplete.rpartition(",")
    return [f"{done}{comma}{word}" for word in sorted({*_all(what)}) if word.startswith(begun)]


def _all(what: str) -> Iterable[str]:
    if what == "profiles":
        from haros_ci.config.settings import PROFILES

        return PROFILES
    if what == "formats":
        from haros_ci.commands.output import FOLDERS, FORMATS, PAGES

        return (*FORMATS, *FOLDERS, *PAGES)
    if what == "metrics":
        from haros_ci.measuring.totals import METRICS

        return METRICS
    from haros_ci.registry import built_in

    known = built_in()
    if what == "tools":
        return known.adapters
    return (
        name for tool, rule in known.documented_rules() for name in (tool, rule.id, f"{tool}:{rule.id}", *rule.tags)
    )
