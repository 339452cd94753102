# SPDX-License-Identifier: Apache-2.0
"""``$(...)`` of ROS 1 launch files: what it becomes, what stays unknown, what roslaunch refuses."""

from __future__ import annotations

import pytest
from roslaunch_kit import launch, told

from haros_ci.substitutions.names import literal, unknown
from haros_ci.substitutions.substitution import SubstitutionSources, substitute

SOURCES = SubstitutionSources(
    args={"one": literal("1"), "word": literal("x"), "yes": literal("true"), "f": literal("1.5"), "u": unknown("why")}
    | {"path": literal("$(find bot)/map.yaml"), "e": literal("shadowed"), "len": literal("9")},
    missing={"needed": 3},
    environment={"HOME": "/home/bot", "EMPTY": ""},
    directory="$(find bot)/launch",
)


@pytest.mark.parametrize(
    ("raw", "text"),
    [
        ("", ""),
        ("plain", "plain"),
        ("costs $5 (each)", "costs $5 (each)"),
        ("$(arg one)", "1"),
        ("a$(arg one)b$(arg word)c", "a1bxc"),
        ("$(arg  one )", "1"),
        ("$$(arg one)", "$1"),
        ("$(arg path)", "$(find bot)/map.yaml"),
        ("$(find bot)/x", "$(find bot)/x"),
        ("$(find  elsewhere )/x", "$(find elsewhere)/x"),
        ("$(env HOME)/x", "/home/bot/x"),
        ("[$(env EMPTY)]", "[]"),
        ("$(optenv HOME d)", "/home/bot"),
        ("$(optenv NONE some default)", "some default"),
        ("[$(optenv NONE)]", "[]"),
        ("$(optenv NONE)", ""),
        ("$(optenv NONE)/arm", "/arm"),
        ("$(find bot)/$(optenv NONE d).launch", "$(find bot)/d.launch"),
        ("$(dirname)/x", "$(find bot)/launch/x"),
        ("$(arg one", "$(arg one"),
        ("$()", "$()"),
        ("$ (arg one)", "$ (arg one)"),
        ("$(eval one + 1)", "2"),
        ("$(eval f * 2)", "3.0"),
        ("$(eval 7 // 2 - -1 % 3)", "1"),
        ("$(eval arg('word') + '_' + str(one))", "x_1"),
        ("$(eval yes and not false)", "True"),
        ("$(eval True or undefined)", "True"),
        ("$(eval 0 or 'second')", "second"),
        ("$(eval 'a' if word == 'y' else 'b')", "b"),
        ("$(eval 1 < one < 3)", "False"),
        ("$(eval word in ['x', 'y'])", "True"),
        ("$(eval word not in ('x', 'y'))", "False"),
        ("$(eval {'x': 'left'}[word])", "left"),
        ("$(eval {'x': 'left'}.get('z', 'none'))", "none"),
        ("$(eval 'abc'[1:])", "bc"),
        ("$(eval word.upper() * 3)", "XXX"),
        ("$(eval 'a,b'.split(',')[1].replace('b', 'c'))", "c"),
        ("$(eval '/'.join(['a', 'b']))", "a/b"),
        ("$(eval '%s-%d' % (word, one))", "x-1"),
        ("$(eval f'{word}{one}')", "x1"),
        ("$(eval int('7') + float('0.5'))", "7.5"),
        ("$(eval list((1, 2)))", "[1, 2]"),
        ("$(eval bool(0) is False)", "True"),
        ("$(eval max(one, 3) - min([4, 2]) + abs(-1))", "2"),
        ("$(eval round(pi, 2))", "3.14"),
        ("$(eval degrees(pi))", "180.0"),
        ("$(eval sqrt(16))", "4.0"),
        ("$(eval round(e, 1))", "2.7"),
        ("$(eval env('HOME'))", "/home/bot"),
        ("$(eval optenv('NONE', 'd') + optenv('NONE'))", "d"),
        ("$(eval find('bot') + '/x' + '.yaml')", "$(find bot)/x.yaml"),
        ("$(eval dirname() + '/x')", "$(find bot)/launch/x"),
        ("$(eval path if one == 1 else '')", "$(find bot)/map.yaml"),
        ("$(eval -(2 ** 10))", "-1024"),
        ("$(eval None)", "None"),
    ],
)
def test_known(raw: str, text: str) -> None:
    made = substitute(raw, SOURCES)
    assert (made.text.raw, made.text.reasons, made.errors, made.missing) == (text, (), (), ())


@pytest.mark.parametrize(
    ("raw", "shown", "reason"),
    [
        ("a$(arg u)b", "a?b", "why"),
        ("$(env NONE)/x", "?/x", "environment variable 'NONE' is not given"),
        ("$(find bot)/$(optenv NONE)_a.launch", "$(find bot)/?_a.launch", "environment variable 'NONE' is not given"),
        ("$(dirname)/$(optenv NONE).yaml", "$(find bot)/launch/?.yaml", "environment variable 'NONE' is not given"),
        ("/maps/$(optenv NONE)/hall.yaml", "/maps/?/hall.yaml", "environment variable 'NONE' is not given"),
        ("$(eval find('bot') + '/' + optenv('NONE') + '.launch')", "?", "environment variable 'NONE' is not given"),
        ("$(anon base.link)", "base_link_?", "$(anon base.link) is chosen anew at each launch"),
        ("$(eval u == 'x')", "?", "argument 'u': why"),
        ("$(eval arg('u'))", "?", "argument 'u': why"),
        ("$(eval env('NONE'))", "?", "environment variable 'NONE' is not given"),
        ("$(eval anon('a'))", "?", "anon('a') is chosen anew at each launch"),
        ("$(eval path == 'x')", "?", "$(eval ...) looks into a path, whose text depends on the machine"),
        ("$(eval 'x' in path)", "?", "$(eval ...) looks into a path, whose text depends on the machine"),
        ("$(eval len(find('bot')))", "?", "$(eval ...) calls len(), which is not interpreted"),
        ("$(eval path[0])", "?", "$(eval ...) looks into a path, whose text depends on the machine"),
        ("$(eval path.upper())", "?", "$(eval ...) looks into a path, whose text depends on the machine"),
        ("$(eval [x for x in 'ab'])", "?", "$(eval ...) uses ListComp, which is not interpreted"),
        ("$(eval (lambda: 1)())", "?", "$(eval ...) uses Call, which is not interpreted"),
        ("$(eval open('/etc/passwd'))", "?", "$(eval ...) calls open(), which is not interpreted"),
        ("$(eval factorial(9))", "?", "$(eval ...) calls factorial(), which is not interpreted"),
        ("$(eval gamma)", "?", "$(eval ...) uses the function gamma of Python's math as a value"),
        ("$(eval str)", "?", "$(eval ...) uses the function str as a value"),
        ("$(eval dict(a=1))", "?", "$(eval ...) uses Call, which is not interpreted"),
        ("$(eval '{}'.format(one))", "?", "$(eval ...) calls .format(), which is not interpreted"),
        ("$(eval '%9999999d' % one)", "?", "$(eval ...) formats text in a way that is not interpreted"),
        ("$(eval 1 << 9999)", "?", "$(eval ...) uses LShift, which is not interpreted"),
        ("$(eval 9**9**9)", "?", "$(eval ...) makes a value too large to follow"),
        ("$(eval 'x' * 99999)", "?", "$(eval ...) makes a value too large to follow"),
        ("$(eval [1] * 99999)", "?", "$(eval ...) makes a value too large to follow"),
        (f"$(eval {'-' * 100}1)", "?", "$(eval ...) is nested too deeply to follow"),
        (f"$(eval '{'x' * 2_000}')", "?", "$(eval ...) is longer than 2000 characters"),
    ],
)
def test_unknown(raw: str, shown: str, reason: str) -> None:
    made = substitute(raw, SOURCES)
    assert (made.text.shown, made.text.reasons, made.errors, made.missing) == (shown, (reason,), (), ())


@pytest.mark.parametrize(
    ("raw", "error"),
    [
        ("$(arg nope)", "argument 'nope' is not declared; declare it above, with <arg name=... default=.../>"),
        ("$(arg)", "'$(arg)' needs exactly one word after arg"),
        ("$(arg a b)", "'$(arg a b)' needs exactly one word after arg"),
        ("$(find)", "'$(find)' needs exactly one word after find"),
        ("$(env A B)", "'$(env A B)' needs exactly one word after env"),
        ("$(anon)", "'$(anon)' needs exactly one word after anon"),
        ("$(optenv)", "$(optenv NAME default) needs the name of an environment variable"),
        ("$(var x)", "unknown substitution '$(var x)'; use one of find, env, optenv, dirname, anon, arg, eval"),
        (
            "$(find $(arg word))/x",
            "substitution arguments do not nest: '$(find $(arg word))/x'; set an arg first, and use that",
        ),
        ("$(arg (x))", "parenthesis inside a substitution argument: '$(arg (x))'"),
        ("x$(eval 1)", "$(eval ...) must be the whole of the text; set an arg with it first, and use that"),
        (
            "$(eval 1)$(eval int('1'))",
            "$(eval 1)$(eval int('1')): not a Python expression; mind quotes and parentheses",
        ),
        ("$(eval word ==)", "$(eval word ==): not a Python expression; mind quotes and parentheses"),
        ("$(eval nope)", "$(eval nope): 'nope' is not an argument declared above"),
        ("$(eval ().__class__)", "$(eval ().__class__): double underscores are not allowed"),
        (
            "$(eval 1 / 0)",
            "$(eval 1 / 0): Python stops with ZeroDivisionError; check the types, args are converted as 'auto'",
        ),
        (
            "$(eval word + 1)",
            "$(eval word + 1): Python stops with TypeError; check the types, args are converted as 'auto'",
        ),
    ],
)
def test_refused(raw: str, error: str) -> None:
    made = substitute(raw, SOURCES)
    assert made.errors == (error,)
    assert not made.text.known


@pytest.mark.parametrize("raw", ["$(arg needed)", "$(eval needed)", "$(eval arg('needed') == 1)"])
def test_a_declared_arg_that_nothing_sets(raw: str) -> None:
    made = substitute(raw, SOURCES)
    assert (made.text.reasons, made.errors, made.missing) == (("argument 'needed' is not set",), (), ("needed",))


def test_texts_do_not_grow_without_end() -> None:
    doubling = '<arg name="a0" value="lollollol!"/>' + "".join(
        f'<arg name="a{n + 1}" value="{f"$(arg a{n})" * 10}"/>' for n in range(12)
    )
    launched = launch(doubling + '<param name="p" type="str" value="$(arg a12)"/>')
    (parameter,) = launched.parameters
    assert (parameter.value, parameter.unknowns[0].reason) == ("?", "longer than 100000 characters")


def test_an_error_is_told_once_per_place() -> None:
    body = '<param name="a" value="$(arg x)"/>\n<param name="b" value="$(arg x)"/>'
    message = "<param>: argument 'x' is not declared; declare it above, with <arg name=... default=.../>"
    assert told(launch(body)) == [message, f"bot/launch/main.launch:2: {message}"]


def test_a_private_use_character_in_a_file_is_no_unknown_part() -> None:
    (parameter,) = launch('<param name="p" value="a\ue000b"/>').parameters
    assert (parameter.value, parameter.unknowns) == ("a\ufffdb", ())
