# SPDX-License-Identifier: Apache-2.0
"""One HTML file that shows a run: its findings, the running systems, packages, metrics and what a change does.

Data, code and style are in the file; nothing is fetched (docs/report.md, decision 0026).
"""
