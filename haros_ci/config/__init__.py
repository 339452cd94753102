# SPDX-License-Identifier: Apache-2.0
"""From files and flags to one frozen Settings value."""
