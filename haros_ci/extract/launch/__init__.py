# SPDX-License-Identifier: Apache-2.0
"""The launch front ends."""
