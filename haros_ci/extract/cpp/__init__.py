# SPDX-License-Identifier: Apache-2.0
"""The C++ front end over tree-sitter."""
