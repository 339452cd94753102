# SPDX-License-Identifier: Apache-2.0
"""The rules of flawfinder: functions of C by the weakness that their use invites, with flawfinder's own CWE numbers."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class FlawfinderRow:
    """One rule: its code, the risk flawfinder gives it (0–5), its CWE numbers, some of its functions, and what is asked."""

    code: str
    risk: int
    cwe: tuple[int, ...]
    functions: str
    summary: str


_DESTINATION = "Copy without a bound on the buffer's size."
_FORMAT = "Format string that is not constant."
_FILE = "Race between the check of a file name and its use."

ROWS: tuple[FlawfinderRow, ...] = (
    FlawfinderRow("FF1001", 4, (120,), "strcpy", _DESTINATION),
    FlawfinderRow("FF1002", 4, (120,), "strcpyA strcpyW StrCpy lstrcpyA", _DESTINATION),
    FlawfinderRow("FF1003", 4, (120,), "lstrcpy wcscpy", _DESTINATION),
    FlawfinderRow(
        "FF1004", 2, (120,), "memcpy CopyMemory bcopy", "memcpy() without a check of the destination's size."
    ),
    FlawfinderRow("FF1005", 4, (120,), "strcat", _DESTINATION),
    FlawfinderRow("FF1006", 4, (120,), "lstrcat wcscat", _DESTINATION),
    FlawfinderRow("FF1007", 4, (120,), "StrCat StrCatA lstrcatA", _DESTINATION),
    FlawfinderRow("FF1008", 1, (120,), "strncpy", "strncpy() without a terminating null."),
    FlawfinderRow("FF1009", 1, (120,), "lstrcpyn wcsncpy", "Bounded copy without a terminating null."),
    FlawfinderRow("FF1010", 1, (120,), "strncat", "strncat() with the wrong size."),
    FlawfinderRow("FF1011", 1, (120,), "lstrcatn wcsncat", "Bounded append with the wrong size."),
    FlawfinderRow("FF1012", 1, (120,), "strccpy strcadd", _DESTINATION),
    FlawfinderRow("FF1013", 2, (119, 120), "char wchar_t TCHAR", "Character array of fixed size that may overflow."),
    FlawfinderRow("FF1014", 5, (120, 20), "gets _getts", "Use of gets(), which cannot limit its input."),
    FlawfinderRow(
        "FF1015",
        4,
        (120,),
        "sprintf vsprintf swprintf vswprintf",
        "Output function without a buffer size (sprintf).",
    ),
    FlawfinderRow("FF1016", 4, (134,), "printf vprintf wprintf", _FORMAT),
    FlawfinderRow("FF1017", 4, (134,), "fprintf vfprintf fwprintf", _FORMAT),
    FlawfinderRow("FF1018", 4, (134,), "syslog", _FORMAT),
    FlawfinderRow("FF1019", 4, (134,), "snprintf vsnprintf", _FORMAT),
    FlawfinderRow("FF1020", 4, (120, 20), "scanf vscanf wscanf", "scanf() %s without a width."),
    FlawfinderRow("FF1021", 4, (120, 20), "fscanf sscanf vsscanf", "fscanf() or sscanf() %s without a width."),
    FlawfinderRow("FF1022", 1, (126,), "strlen wcslen", "Length of a string without a terminating null."),
    FlawfinderRow("FF1023", 2, (120,), "MultiByteToWideChar", "Length in bytes where characters are expected."),
    FlawfinderRow("FF1024", 4, (120,), "streadd strecpy", _DESTINATION),
    FlawfinderRow("FF1025", 3, (120,), "strtrns", _DESTINATION),
    FlawfinderRow("FF1026", 3, (120, 785), "realpath", "realpath() with a buffer that may be too small."),
    FlawfinderRow(
        "FF1027",
        3,
        (120, 20),
        "getopt getopt_long",
        "getopt() with arguments of unbounded length.",
    ),
    FlawfinderRow("FF1028", 3, (120, 20), "getwd", "Use of getwd(), which does not know its buffer's size."),
    FlawfinderRow("FF1029", 1, (120, 20), "read getchar fgetc getc", "Reading loop without a bounds check."),
    FlawfinderRow("FF1030", 4, (362, 367), "access", _FILE),
    FlawfinderRow("FF1031", 5, (362,), "chown", "Use of chown() or lchown(), open to a race on the file name."),
    FlawfinderRow("FF1032", 5, (362,), "chgrp", "Use of chown() or lchown(), open to a race on the file name."),
    FlawfinderRow("FF1033", 5, (362,), "chmod", "Use of chmod(), open to a race on the file name."),
    FlawfinderRow("FF1034", 2, (362,), "vfork", "Use of vfork()."),
    FlawfinderRow(
        "FF1035", 5, (362, 20), "readlink", "Use of readlink(): race on the file name and no terminating null."
    ),
    FlawfinderRow("FF1036", 2, (377,), "tmpfile", "Temporary file that other users can open."),
    FlawfinderRow("FF1037", 3, (377,), "tmpnam tempnam", "Predictable temporary file name."),
    FlawfinderRow("FF1038", 4, (377,), "mktemp", "Predictable temporary file name."),
    FlawfinderRow("FF1039", 2, (377,), "mkstemp", "mkstemp() without umask()."),
    FlawfinderRow("FF1040", 2, (362,), "fopen open", "Opened file that may not be the intended one."),
    FlawfinderRow("FF1041", 1, (732,), "umask", "umask() that permits other users."),
    FlawfinderRow("FF1042", 3, (377,), "GetTempFileName", "Temporary file that other users can open."),
    FlawfinderRow(
        "FF1043",
        4,
        (78,),
        "execl execlp execle execv execvp popen",
        "Program started through a shell or from a path that others can change.",
    ),
    FlawfinderRow("FF1044", 4, (78,), "system", "Program started through a shell."),
    FlawfinderRow(
        "FF1045",
        3,
        (78,),
        "CreateProcessAsUser CreateProcessWithLogon",
        "Program started by a partial or unquoted path.",
    ),
    FlawfinderRow("FF1046", 3, (78,), "CreateProcess", "Program started by a partial or unquoted path."),
    FlawfinderRow("FF1047", 2, (190,), "atoi atol", "Number read from text without a range check."),
    FlawfinderRow(
        "FF1048",
        3,
        (327,),
        "srand random drand48",
        "Random numbers that are not cryptographically secure.",
    ),
    FlawfinderRow("FF1049", 4, (327,), "crypt crypt_r", "Password hashed by crypt(), which is weak."),
    FlawfinderRow("FF1050", 4, (327,), "EVP_des_ecb EVP_des_cbc", "Weak cipher (DES)."),
    FlawfinderRow("FF1051", 4, (327,), "EVP_rc4_40 EVP_rc2_40_cbc", "Key shorter than 128 bits."),
    FlawfinderRow("FF1052", 3, (250, 22), "chroot", "chroot() without chdir(), or with open files."),
    FlawfinderRow("FF1053", 3, (807, 20), "getenv curl_getenv", "Environment variable used without a check."),
    FlawfinderRow("FF1054", 3, (807, 20), "g_get_home_dir", "Environment variable used without a check."),
    FlawfinderRow("FF1055", 3, (807, 20), "g_get_tmp_dir", "Environment variable used without a check."),
    FlawfinderRow(
        "FF1056",
        4,
        (250,),
        "ImpersonateLoggedOnUser RpcImpersonateClient",
        "Change of user rights without a check for success.",
    ),
    FlawfinderRow("FF1057", 3, (248, 400), "InitializeCriticalSection", "Use of InitializeCriticalSection()."),
    FlawfinderRow("FF1058", 3, (829, 20), "LoadLibrary", "Library loaded by a partial path."),
    FlawfinderRow("FF1059", 3, (829, 20), "LoadLibraryEx", "Library loaded by a partial path."),
    FlawfinderRow(
        "FF1060", 5, (732,), "SetSecurityDescriptorDacl", "Null access control list, which permits everybody."
    ),
    FlawfinderRow("FF1061", 3, (732,), "AddAccessAllowedAce", "Use of AddAccessAllowedAce()."),
    FlawfinderRow("FF1062", 4, (807,), "getlogin", "Unreliable user name from cuserid() or getlogin()."),
    FlawfinderRow("FF1063", 4, (120,), "cuserid", "Unreliable user name from cuserid() or getlogin()."),
    FlawfinderRow("FF1064", 4, (676, 120), "getpw", "Use of getpw(), which may overflow its buffer."),
    FlawfinderRow("FF1065", 4, (676, 120, 20), "getpass", "Use of getpass(), which is obsolete."),
    FlawfinderRow("FF1066", 2, (676,), "gsignal ssignal", "Use of ssignal() or gsignal()."),
    FlawfinderRow("FF1067", 1, (676,), "memalign", "Use of memalign()."),
    FlawfinderRow("FF1068", 1, (676,), "ulimit", "Use of ulimit()."),
    FlawfinderRow("FF1069", 1, (676,), "usleep", "Use of usleep()."),
    FlawfinderRow("FF1070", 0, (20,), "recv recvfrom fread", "Unchecked input."),
    FlawfinderRow(
        "FF1071",
        1,
        (126,),
        "equal mismatch is_permutation",
        "std::equal or std::mismatch without the end of the second range.",
    ),
)

#: Risk to profile and severity. The lower ones are said of any call, whatever stands around it.
LETTERS = {5: "Rw", 4: "Rw", 3: "Sn", 2: "-n", 1: "-n", 0: "-n"}
SEVERITY = {5: "6.9", 4: "6.0", 3: "4.0", 2: "3.0", 1: "2.0", 0: "1.0"}
ADVICE = (
    "flawfinder looks at names, not at what is computed: read the call, and where what it is warned of cannot happen say so in"
    " a comment. The functions that it names instead are safe by their interface."
)


def _group(codes: tuple[int, ...], precision: str) -> Group:
    rows = tuple((row.code, LETTERS[row.risk], row.summary) for row in ROWS if row.risk in codes)
    return Group(ADVICE, ("flawfinder", "cwe"), rows, precision=precision)


TABLE = Table(
    "flawfinder",
    "`// Flawfinder: ignore` on the line",
    lambda rule: "https://dwheeler.com/flawfinder/",
    (_group((5, 4), "medium"), _group((3, 2, 1, 0), "low")),
    cwe={row.code: row.cwe for row in ROWS},
    security={row.code: SEVERITY[row.risk] for row in ROWS},
    aliases={row.code: tuple(f"flawfinder:{name}" for name in row.functions.split()) for row in ROWS},
)
_OTHER = Group(ADVICE, ("cwe",), (), precision="low")


def rules() -> dict[str, Rule]:
    """The rules by code."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A rule that a newer flawfinder has."""
    return TABLE.rule(identifier, "-n", f"Finding of flawfinder's rule {identifier}.", _OTHER)
