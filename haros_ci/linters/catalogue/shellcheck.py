# SPDX-License-Identifier: Apache-2.0
"""The codes of ShellCheck as rules: those that matter in words of ours, the others by their number and severity."""

from __future__ import annotations

from haros_ci.linters.catalogue.shellcheck_table import GROUPS
from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "shellcheck",
    "`# shellcheck disable=CODE` on the line before",
    lambda rule: f"https://www.shellcheck.net/wiki/{rule}",
    GROUPS,
)

#: Codes that are not in the table, by ShellCheck's own severity. Of the others, SC1… are errors and the rest warnings.
ERRORS = frozenset(
    """
    2037 2045 2066 2067 2071 2072 2073 2075 2079 2080 2083 2084 2104 2110 2111 2118 2122 2127 2151 2157 2158 2159 2168 2170
    2173 2182 2189 2199 2201 2203 2204 2208 2218 2224 2225 2239 2241 2246 2255 2264 2270 2271 2272 2273 2274 2275 2276 2277
    2278 2279 2280 2281 2282 2284 2285 2286 2287 2289 2296 2297 2298 2299 2300 2301 2304 2316 2325 2326 2328 2330 2332
    """.split()
)
WARNINGS = frozenset("1007 1011 1012 1014 1078 1083 1098 1107 1110 1111 1112 1132".split())
NOTES = frozenset(
    """
    1001 1003 1009 1079 1093 1135 2000 2001 2002 2003 2004 2005 2007 2009 2012 2013 2014 2016 2017 2018 2019 2020 2021 2022
    2023 2025 2026 2028 2029 2030 2031 2032 2035 2059 2094 2095 2102 2116 2117 2119 2126 2129 2143 2153 2160 2161 2175 2185
    2196 2197 2212 2219 2223 2231 2233 2234 2235 2236 2237 2243 2244 2248 2249 2250 2251 2263 2267 2268 2269 2291 2292 2293
    2295 2308 2310 2311 2312 2314 2315 2317 2321 2322 2323 2329 2331 2335
    """.split()
)
_OTHER = Group("The page behind the link tells what is wrong and how to write it instead.", (), (), precision="medium")
_LETTERS = {"e": "Re", "w": "Sw", "n": "Sn"}


def rules() -> dict[str, Rule]:
    """The codes of the table."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A rule for any other code, as severe as ShellCheck finds it."""
    return TABLE.rule(identifier, _LETTERS[severity(identifier)], f"Finding of ShellCheck's rule {identifier}.", _OTHER)


def severity(identifier: str) -> str:
    """ShellCheck's severity of a code that is not in the table: e, w or n (its info and style)."""
    number = identifier.removeprefix("SC")
    if number in NOTES:
        return "n"
    if number in ERRORS or (number.startswith("1") and number not in WARNINGS):
        return "e"
    return "w"
