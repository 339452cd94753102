# SPDX-License-Identifier: Apache-2.0
"""Words that sscanf() reads without a width, into memory that is large enough and that may not be."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted


def may_crash(body: str, head: str = "void parse(std::string line)") -> bool:
    text = f"{head}\n{{\n{body}\n}}\n"
    line = text[: text.index("scanf")].count("\n") + 1
    said = "sscanf() without field width limits can crash with huge input data."
    return not is_refuted("invalidscanf", said, line, text)


@pytest.mark.parametrize(
    "body",
    [
        '  char word[line.size() + 1];\n  sscanf(line.c_str(), "%s", word);',
        '  char word [line.length()+1];\n  if (sscanf(line.data(), "%*s %s", word) == 1) {}',
        '  char word[msg->data.size() + 2];\n  std::sscanf(msg->data.c_str(), "%s", word);',
        '  char word[line.size() + 1], rest[line.size() + 1];\n  sscanf(line.c_str(), "%s %s",\n    word, rest);',
        '  char text[2000];\n  char word[2000];\n  int n;\n  sscanf(text, "%s%n", word, &n);',
        '  char text[200];\n  char word[256];\n  float x;\n  sscanf(text, "%f %[a-z]", &x, word);',
        '  char text[LENGTH], word[LENGTH];\n  sscanf(text, "%s", word);',
        '  char word[line.size() + 1], end[3];\n  sscanf(line.c_str(), "%s %2s", word, end);',
        '  char word[line.size() + 1];\n  sscanf(line.c_str(), "%s" " %%", &word[0]);',
    ],
)
def test_there_is_room(body: str) -> None:
    assert not may_crash(body)


@pytest.mark.parametrize(
    "body",
    [
        '  char word[20];\n  sscanf(line.c_str(), "%s", word);',
        '  char word[line.size()];\n  sscanf(line.c_str(), "%s", word);',
        '  char word[line.size() - 1];\n  sscanf(line.c_str(), "%s", word);',
        '  char word[other.size() + 1];\n  sscanf(line.c_str(), "%s", word);',
        '  char word[line.size() + 1], rest[9];\n  sscanf(line.c_str(), "%s %s", word, rest);',
        '  char text[1024];\n  char word[20];\n  sscanf(text, "%s", word);',
        '  char text[BIG], word[SMALL];\n  sscanf(text, "%s", word);',
        '  char * text = read();\n  char word[2000];\n  sscanf(text, "%s", word);',
        '  char * word = new char[9];\n  sscanf(line.c_str(), "%s", word);',
        '  // char word[line.size() + 1];\n  sscanf(line.c_str(), "%s", word);',
        "  char word[line.size() + 1];\n  sscanf(line.c_str(), FORMAT, word);",
        '  char word[line.size() + 1];\n  sscanf(line.c_str(), "%s");',
        '  char word[line.size() + 1];\n  sscanf(line.c_str(), "%s", words[3]);',
        '  char word[line.size() + 1];\n  fscanf(file, "%s", word);',
        '  char word[line.size() + 1];\n  sscanf(line.c_str(), "%s", word',
    ],
)
def test_there_may_be_too_little(body: str) -> None:
    assert may_crash(body)


def test_the_text_of_the_caller() -> None:
    body = '  char word[2000];\n  sscanf(text, "%s", word);'
    assert may_crash(body, "void other()\n{\n  char text[100];\n}\nvoid parse(char* text)")
