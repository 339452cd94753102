# SPDX-License-Identifier: Apache-2.0
"""The Python front end over ast."""
