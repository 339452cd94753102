# SPDX-License-Identifier: Apache-2.0
"""Qt: what threads run, handlers of events and slots that are connected by their names are called by the library (doc.qt.io)."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names, python

ADVERTISE = 'ADV(std::string("t"), 1);'
CPP = "class T : public %s { public: ros::NodeHandle nh; %s { " + ADVERTISE + " } };"
FOUND = [
    pytest.param("QThread", "void run()", "T t; t.start();", id="a thread"),
    pytest.param("QThread", "void run() override", "auto t = new T; t->start();", id="a thread that is new"),
    pytest.param(
        "QThread", "void begin() { start(); } void run()", "T t; t.begin();", id="a thread that starts itself"
    ),
    pytest.param("QRunnable", "void run() override", "QThreadPool::globalInstance()->start(new T);", id="a pool"),
    pytest.param("QObject", "T() { startTimer(50); } void timerEvent(QTimerEvent *)", "T t;", id="a timer"),
    pytest.param("QMainWindow", "void showEvent(QShowEvent *)", "T t; t.show();", id="a window"),
    pytest.param("QGraphicsView", "void mousePressEvent(QMouseEvent *)", "T t; t.show();", id="a mouse"),
    pytest.param("QOpenGLWidget", "void paintGL()", "T t; t.show();", id="a drawing"),
    pytest.param("QMainWindow", "void on_button_clicked()", "T t; t.show();", id="a slot"),
]
NOT = [
    pytest.param("QObject", "void run()", "T t;", id="no thread"),
    pytest.param("QObject", "void publishEvent()", "T t;", id="an event of its own"),
    pytest.param("QObject", "void on_button()", "T t;", id="no signal's name"),
    pytest.param("Other", "void run()", "T t;", id="another library's run"),
    pytest.param("Queue", "void timerEvent(QTimerEvent *)", "T t;", id="another library's class"),
    pytest.param("QThread", "void run()", "", id="no object"),
    pytest.param("QThread", "void run(int times)", "std::vector<T *> all;", id="no object in a container"),
]


@pytest.mark.parametrize(("base", "function", "body"), FOUND)
def test_it_is_called(base: str, function: str, body: str) -> None:
    assert names(cpp(body, CPP % (base, function))) == ["/t"]


@pytest.mark.parametrize(("base", "function", "body"), NOT)
def test_it_is_not_called(base: str, function: str, body: str) -> None:
    assert names(cpp(body, CPP % (base, function))) == []


def test_of_a_base_class() -> None:
    before = CPP % ("QThread", "void run()") + "\nclass U : public T {};"
    assert names(cpp("U u; u.start();", before)) == ["/t"]


PYTHON = "from {0} import {1}\nclass T({1}):\n    def {2}:\n        self.p = PUB('t')\nt = T()\n"


@pytest.mark.parametrize(
    ("module", "base", "method", "expected"),
    [
        ("PyQt5.QtCore", "QThread", "run(self)", ["/t"]),
        ("PySide2.QtCore", "QRunnable", "run(self)", ["/t"]),
        ("python_qt_binding.QtWidgets", "QWidget", "closeEvent(self, event)", ["/t"]),
        ("PyQt5.QtWidgets", "QWidget", "on_button_clicked(self)", ["/t"]),
        ("PyQt5.QtWidgets", "QWidget", "run(self)", []),
        ("PyQt5.QtWidgets", "QWidget", "publishEvent(self)", []),
        ("solvers", "Quadratic", "timerEvent(self, event)", []),
        ("threads", "Thread", "showEvent(self, event)", []),
    ],
)
def test_python(module: str, base: str, method: str, expected: list[str]) -> None:
    found = names(python(PYTHON.format(module, base, method)))
    assert found == expected
