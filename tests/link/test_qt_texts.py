# SPDX-License-Identifier: Apache-2.0
"""Names that are put together as QString: known where each step is, unknown behind every method that is not modelled."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

HEAD = "#include <QString>\n"


def made(code: str, before: str = "", text: str = "q.toStdString()") -> list[str]:
    return names(cpp(f"{code} ADV({text}, 1);", HEAD + before))


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ('QString("a").toStdString()', "/a"),
        ('(QString("a") + "/b").toStdString()', "/a/b"),
        ('QString("a").append("b").toStdString()', "/ab"),
        ('QString("a%1/%2").arg(3).arg("x").toStdString()', "/a3/x"),
        ('QString("%2/a%1/%1").arg("x", "y").toStdString()', "/y/ax/x"),
        ('QString("%1").arg(0.5).toStdString()', "/0.5"),
        ('("a" + QString::number(2)).toStdString()', "/a2"),
        ('QStringLiteral("a").toStdString()', "/a"),
        ('QString::fromStdString(std::string("a")).toUtf8().constData()', "/a"),
        ('qPrintable(QString("a"))', "/a"),
        ('QString::fromUtf8("a").toLatin1().data()', "/a"),
    ],
)
def test_a_text_in_one_expression(text: str, name: str) -> None:
    assert made("", text=text) == [name]


@pytest.mark.parametrize(
    ("code", "name"),
    [
        ('QString q = "a"; q += "b";', "/ab"),
        ('QString q("a"); q.append(QString::number(1)); q.prepend("b");', "/ba1"),
        ('QString q; q = "a"; QString other = q; other.append("b");', "/a"),
        ('QString q("a"); if (q.isEmpty()) { q = "b"; }', "/a"),
        ('QString q("a"); q.arg(1); q.isEmpty(); q.toUtf8();', "/a"),
    ],
)
def test_a_text_in_steps(code: str, name: str) -> None:
    assert made(code) == [name]


def test_a_member_that_a_loop_puts_together() -> None:
    code = 'for (int i = 1; i < 3; i++) { QString q("/agent"); q.append(QString::number(i)); ADV(q.toStdString(), 1); }'
    assert names(cpp(code, HEAD)) == ["/agent1", "/agent2"]


@pytest.mark.parametrize(
    "change",
    [
        "q.chop(1);",
        "q.remove(0, 1);",
        'q.replace("a", "b");',
        "q.truncate(1);",
        "q.setNum(3);",
        'q.push_front("b");',
        "q.fill(c);",
        "q = q.toUpper();",
        "q = q.left(1);",
        "change(q);",
        "q = widget->text();",
        "q = q.arg(1);",
        'q = QString("%1").arg(true);',
        'q = QString("%1").arg(3, 2, 10, c);',
        'q = tr("a");',
        "q = QString::number(3, 16);",
        "edit(&q);",
    ],
)
def test_what_is_not_modelled_is_not_known(change: str) -> None:
    assert made(f'QString q("a"); {change}', "void change(QString& text); void edit(QString* text);\n") == ["/?"]


def test_a_function_of_the_workspace_is_its_own() -> None:
    assert made("", 'std::string qPrintable(const QString& q) { return "own"; }\n', 'qPrintable(QString("a"))') == [
        "/own"
    ]


def test_another_class_of_texts() -> None:
    assert made("Text q = make(); q.isEmpty(); q.prepend(1);") == ["/?"]
