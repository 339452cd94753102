# SPDX-License-Identifier: Apache-2.0
"""Changes to an input: bytes, words, lines, brackets and indentation, numbers at the edge, and depth."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from random import Random

#: Bytes of an input. A workspace has larger files; what is slow with this many is far slower with those.
LONGEST = 12_000
DEEPEST = 3_000

_TOKEN = re.compile(rb"[A-Za-z_][A-Za-z0-9_]*|[0-9]+(?:\.[0-9]+)?|\s+|[^A-Za-z0-9_\s]")
_NUMBER = re.compile(rb"-?[0-9]+(?:\.[0-9]+)?")
_NUMBERS = (
    *(b"0", b"-1", b"1", b"00", b"255", b"65536", b"2147483648", b"-2147483649", b"9223372036854775808", b"1" * 400),
    *(b"1e999", b"-1e999", b".nan", b"NaN", b".inf", b"Infinity", b"1e-400", b"0x7fffffffffffffffff", b"0b1", b"1_0"),
    *(b"1.7976931348623157e308", b"-0", b"-0.0", b"1" * 5000, b"9" * 30, "\u0661\u0662".encode(), "\u00b2".encode()),
)
_ODD = (
    *(b"\0", b"\r", b"\r\n", b"\n", b"\t", b"\x0b", b"\x0c", b"\x1b[31m", b"\x7f", b"\x85", b"\xff", b"\xed\xa0\x80"),
    *(
        b"\xef\xbb\xbf",
        "\u2028".encode(),
        "\u202e".encode(),
        "\ue000".encode(),
        "\U0010ffff".encode(),
        "\u00a0".encode(),
    ),
    *(
        "\u0130".encode(),
        "\u00df".encode(),
        "e\u0301".encode(),
        "\ufffd".encode(),
        b"\\",
        b'"',
        b"'",
        b"`",
        b"$",
        b"%s",
    ),
    *(b"\\N{DASH}", b"\\ud800", b"\\x00", b"\\0", b"&#0;", b"&#xd800;", b"${", b"$(", b"{{", b"}}", b"*/", b"/*", b"#"),
    *(
        b"../",
        b"/etc/passwd",
        b"file:///",
        b"//",
        b"~",
        b".",
        b"..",
        b"C:\\",
        b"::",
        b"{",
        b"}",
        b"[",
        b"]",
        b"(",
        b")",
    ),
    *(
        b"<",
        b">",
        b"&",
        b",",
        b";",
        b":",
        b"=",
        b"|",
        b"?",
        b"*",
        b"!",
        b"@",
        b"-",
        b"+",
        b" ",
        b"\n\n",
        b"\n ",
        b"\n\t",
    ),
)
_OPENERS = (
    *((b"(", b")"), (b"[", b"]"), (b"{", b"}"), (b"<a>", b"</a>"), (b"{a: ", b"}"), (b'{"a":', b"}"), (b"- ", b"")),
    *(
        (b"not ", b""),
        (b"-", b""),
        (b"*", b""),
        (b"if(", b")"),
        (b"$(", b")"),
        (b"${", b"}"),
        (b"A<", b">"),
        (b"!", b""),
    ),
    *((b"a.", b""), (b"a + ", b""), (b"a, ", b""), (b"/*", b"*/"), (b"{if(1)", b"}"), (b"#if 1\n", b"\n#endif")),
    *(
        (b"lambda: ", b""),
        (b"f(", b")"),
        (b"a ? b : ", b""),
        (b"else if(a){}", b""),
        (b"~", b""),
        (b"<group>", b"</group>"),
    ),
    *((b"namespace a{", b"}"), (b"class a{", b"};"), (b"$<1:", b">"), (b"a[", b"]"), (b"a->", b""), (b"await ", b"")),
)


class Mutator:
    """Makes new inputs out of those that are there; *words* grows as functions of the program are reached."""

    def __init__(self, random: Random, words: Sequence[bytes] = ()) -> None:
        self.random = random
        self.words: dict[bytes, None] = dict.fromkeys(words)
        self._listed: list[bytes] = []
        self._ways: tuple[Callable[[bytes, Sequence[bytes]], bytes], ...] = (
            *(self._byte, self._odd, self._word, self._word, self._swapped_token, self._number, self._without),
            *(
                self._copied,
                self._line,
                self._line,
                self._spliced,
                self._token_of,
                self._deep,
                self._indented,
                self._repeated,
            ),
        )

    def add_words(self, words: Sequence[bytes]) -> None:
        self.words.update(dict.fromkeys(words))

    def mutated(self, data: bytes, others: Sequence[bytes]) -> bytes:
        """*data* after one to eight changes, some of them with parts of *others*."""
        for _ in range(1 << self.random.choice((0, 0, 1, 1, 2, 3))):
            data = self.random.choice(self._ways)(data, others)
        return data[:LONGEST]

    def _place(self, data: bytes) -> int:
        return self.random.randint(0, len(data))

    def _span(self, data: bytes, longest: int = 60) -> tuple[int, int]:
        start = self._place(data)
        return start, min(len(data), start + self.random.randint(1, longest))

    def _token(self, data: bytes) -> tuple[int, int]:
        """A token that begins near a random place."""
        found = _TOKEN.search(data, self._place(data))
        return found.span() if found else (len(data), len(data))

    def _put(self, data: bytes, at: int, new: bytes, end: int | None = None) -> bytes:
        return data[:at] + new + data[at if end is None else end :]

    def _byte(self, data: bytes, _: Sequence[bytes]) -> bytes:
        at = self._place(data)
        return self._put(data, at, bytes((self.random.randrange(256),)), at + self.random.randint(0, 1))

    def _odd(self, data: bytes, _: Sequence[bytes]) -> bytes:
        at, end = self._token(data)
        return self._put(data, at, self.random.choice(_ODD), end if self.random.random() < 0.4 else at)

    def _any_word(self) -> bytes:
        if len(self._listed) != len(self.words):
            self._listed = list(self.words)
        return self.random.choice(self._listed) if self._listed else b"a"

    def _word(self, data: bytes, _: Sequence[bytes]) -> bytes:
        at, end = self._token(data)
        word = self._any_word()
        if self.random.random() < 0.2:
            word = b"%s%s%s" % (
                self.random.choice((b" ", b"\n", b"")),
                word,
                self.random.choice((b" ", b"\n", b"=", b"(", b":")),
            )
        return self._put(data, at, word, end if self.random.random() < 0.6 else at)

    def _swapped_token(self, data: bytes, _: Sequence[bytes]) -> bytes:
        (a, b), (c, d) = sorted((self._token(data), self._token(data)))
        return data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:] if b <= c else data

    def _token_of(self, data: bytes, others: Sequence[bytes]) -> bytes:
        other = self.random.choice(others) if others else data
        start, end = self._token(other)
        if self.random.random() < 0.5:
            end = min(len(other), end + self.random.randint(0, 40))
        at, until = self._token(data)
        return self._put(data, at, other[start:end], until if self.random.random() < 0.6 else at)

    def _number(self, data: bytes, _: Sequence[bytes]) -> bytes:
        found = _NUMBER.search(data, self._place(data)) or _NUMBER.search(data)
        start, end = found.span() if found else self._token(data)
        return self._put(data, start, self.random.choice(_NUMBERS), end)

    def _without(self, data: bytes, _: Sequence[bytes]) -> bytes:
        start, end = self._span(data) if self.random.random() < 0.4 else self._token(data)
        return data[:start] + data[end:]

    def _copied(self, data: bytes, _: Sequence[bytes]) -> bytes:
        start, end = self._span(data, 120)
        return self._put(data, self._place(data), data[start:end])

    def _repeated(self, data: bytes, _: Sequence[bytes]) -> bytes:
        start, end = self._span(data, 30) if self.random.random() < 0.5 else self._token(data)
        times = self.random.choice((2, 3, 10, 100, 1000))
        return self._put(data, end, (data[start:end] * times)[: LONGEST // 2])

    def _line(self, data: bytes, others: Sequence[bytes]) -> bytes:
        """Remove, copy, move or exchange lines; or take one of another input."""
        lines = data.split(b"\n")
        at = self.random.randrange(len(lines))
        way = self.random.randrange(5)
        if way == 0:
            del lines[at : at + self.random.randint(1, 4)]
        elif way == 1:
            lines.insert(self.random.randint(0, len(lines)), lines[at])
        elif way == 2:
            lines.insert(self.random.randrange(len(lines)), lines.pop(at))
        elif way == 3:
            other = self.random.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        else:
            more = (self.random.choice(others) if others else data).split(b"\n")
            start = self.random.randrange(len(more))
            lines[at : at + self.random.randint(0, 1)] = more[start : start + self.random.randint(1, 5)]
        return b"\n".join(lines)

    def _indented(self, data: bytes, _: Sequence[bytes]) -> bytes:
        lines = data.split(b"\n")
        start = self.random.randrange(len(lines))
        for at in range(start, min(len(lines), start + self.random.randint(1, 4))):
            if self.random.random() < 0.5:
                lines[at] = b" " * self.random.choice((1, 2, 4, 8)) + lines[at]
            else:
                lines[at] = lines[at][self.random.choice((1, 2, 4)) :]
        return b"\n".join(lines)

    def _spliced(self, data: bytes, others: Sequence[bytes]) -> bytes:
        other = self.random.choice(others) if others else data
        return data[: self._place(data)] + other[self._place(other) :]

    def _deep(self, data: bytes, _: Sequence[bytes]) -> bytes:
        """Something in so many brackets; seldom, as most such inputs say the same."""
        if self.random.random() < 0.7:
            return self._odd(data, _)
        before, after = self.random.choice(_OPENERS)
        depth = self.random.choice((2, 5, 20, 110, 250, 1100, DEEPEST))
        depth = min(depth, (LONGEST - 200) // (len(before) + len(after)))
        at, end = self._token(data)
        return (
            data[:at]
            + before * depth
            + data[at:end]
            + after * self.random.choice((depth, depth, depth - 1, 0))
            + data[end:]
        )
