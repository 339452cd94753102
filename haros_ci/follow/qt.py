# SPDX-License-Identifier: Apache-2.0
"""What Qt calls of an object of the workspace: slots that it connects, handlers of events, and what its threads run.

doc.qt.io: QObject, QMetaObject::connectSlotsByName, QThread::run, QWidget, QGraphicsItem, QOpenGLWidget, QWindow; the same names in PyQt and PySide.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import callbacks, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.regex import regex
from haros_ci.syntax import Expression
from haros_ci.values.abstract import NONE, Object, Value

#: The macros that name a signal or slot (QObject).
MACROS = frozenset(("SLOT", "SIGNAL"))
#: A class of Qt, with its module or namespace, and a slot that is connected by its name.
_CLASS, _SLOT = regex(r"(?:.*[.:])?(Q[A-Z]\w{1,60})"), regex(r"on_\w{1,80}_[a-z]\w{1,40}")
#: Classes of which a thread calls ``run``.
_THREADS = frozenset(("QThread", "QRunnable"))
#: What is called when something happens: virtual functions of these classes that do nothing, or the usual thing, where they are not overridden.
_HANDLERS = frozenset(
    (
        *"event eventFilter timerEvent childEvent customEvent".split(),
        *"actionEvent changeEvent closeEvent contextMenuEvent dragEnterEvent dragLeaveEvent dragMoveEvent dropEvent enterEvent".split(),
        *"focusInEvent focusOutEvent hideEvent inputMethodEvent keyPressEvent keyReleaseEvent leaveEvent mouseDoubleClickEvent".split(),
        *"mouseMoveEvent mousePressEvent mouseReleaseEvent moveEvent nativeEvent paintEvent resizeEvent showEvent tabletEvent".split(),
        *"wheelEvent viewportEvent exposeEvent hoverEnterEvent hoverLeaveEvent hoverMoveEvent sceneEvent touchEvent".split(),
        *"initializeGL resizeGL paintGL".split(),
    )
)


def signature(walk: Walk, frame: Frame, macro: str, written: tuple[Expression, ...]) -> Value:
    """``SLOT(method(types))`` and ``SIGNAL(...)`` call nothing: a slot of the object is called by a signal later (QObject)."""
    named: Expression = written[0] if len(written) == 1 else syntax.Null()
    if macro == "SLOT" and frame.this is not None and type(named) is syntax.Call and type(named.callee) is syntax.Name:
        callbacks.register(walk, methods.method_of(walk, frame.this, named.callee.name) or NONE)
    return walk.opaque(f"what {macro} is", frame)


def called(walk: Walk, this: Object) -> None:
    """Register the methods of *this* that Qt calls; none of an object of another library's class."""
    if this.definition is None:
        return
    key = ("qt", this.definition[1].name, this.definition[0].path)
    if key not in walk.found:
        walk.found[key] = _called(walk, this)
    for name in walk.found[key]:
        callbacks.register(walk, methods.method_of(walk, this, name) or NONE)


def _called(walk: Walk, this: Object) -> list[str]:
    assert this.definition is not None
    source, definition = this.definition
    bases = {found[1] for base in methods.library_bases(walk, source, definition) if (found := _CLASS.fullmatch(base))}
    if not bases:
        return []
    owner = f"{definition.name}{source.separator}"
    own = sorted(name[len(owner) :] for name in dict.keys(walk.index.functions) if name.startswith(owner))
    inherited = [*_HANDLERS, *(["run"] if bases & _THREADS else [])]
    handlers = [name for name in sorted(inherited) if methods.method_of(walk, this, name) is not None]
    return [*handlers, *(name for name in own if _SLOT.fullmatch(name))]
