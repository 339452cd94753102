# SPDX-License-Identifier: Apache-2.0
"""The vocabulary of workspaces: locations, packages, files. Standard library only, no I/O."""
