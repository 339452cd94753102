# SPDX-License-Identifier: Apache-2.0
"""What launch files say besides what they start, recorded while they are evaluated, for checks."""
