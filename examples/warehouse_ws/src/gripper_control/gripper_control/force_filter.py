# SPDX-License-Identifier: Apache-2.0
"""Smoothing of finger forces."""


class ForceFilter:
    """The mean of the last few readings of one finger."""

    def __init__(self, window, readings=[]):
        self.window = window
        self.readings = readings

    def add(self, force):
        """Take in a reading in newton and return the smoothed force."""
        self.readings.append(force)
        if len(self.readings) > self.window:
            self.readings.pop(0)
        return sum(self.readings) / len(self.readings)


def parse_reading(line):
    """Read ``L:12.5;R:11.9`` as the controller sends it; None for a line that got garbled."""
    try:
        left, right = line.strip().split(";")
        return float(left.split(":")[1]), float(right.split(":")[1])
    except:
        return None
