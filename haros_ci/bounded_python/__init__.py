# SPDX-License-Identifier: Apache-2.0
"""Expressions of Python of unknown origin, within limits: computed over their syntax trees, never run.

``evaluation`` is the one evaluator; ``language`` says what may differ between xacro, roslaunch and launch: which syntax, names,
functions, operators and attributes there are, and what an unknown value makes unknown. ``limits`` and ``functions`` hold for all.
"""
