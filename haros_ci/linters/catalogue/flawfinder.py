# SPDX-License-Identifier: Apache-2.0
"""The rules of flawfinder: functions of C by the weakness that their use invites, with flawfinder's own CWE numbers."""

from __future__ import annotations

from dataclasses import dataclass

from haros_ci.linters.catalogue.table import Group, Rule, Table


@dataclass(frozen=True, slots=True)
class Row:
    """One rule: its code, the risk flawfinder gives it (0–5), its CWE numbers, some of its functions, and what is asked."""

    code: str
    risk: int
    cwe: tuple[int, ...]
    functions: str
    summary: str


_DESTINATION = "A copy into a buffer is bounded by the buffer's size."
_FORMAT = "A format string is a constant."
_FILE = "A file is not named again between the check and its use."

ROWS: tuple[Row, ...] = (
    Row("FF1001", 4, (120,), "strcpy", _DESTINATION),
    Row("FF1002", 4, (120,), "strcpyA strcpyW StrCpy lstrcpyA", _DESTINATION),
    Row("FF1003", 4, (120,), "lstrcpy wcscpy", _DESTINATION),
    Row("FF1004", 2, (120,), "memcpy CopyMemory bcopy", "What memcpy() writes fits into its destination."),
    Row("FF1005", 4, (120,), "strcat", _DESTINATION),
    Row("FF1006", 4, (120,), "lstrcat wcscat", _DESTINATION),
    Row("FF1007", 4, (120,), "StrCat StrCatA lstrcatA", _DESTINATION),
    Row("FF1008", 1, (120,), "strncpy", "What strncpy() has written ends with a null."),
    Row("FF1009", 1, (120,), "lstrcpyn wcsncpy", "A bounded copy ends with a null."),
    Row("FF1010", 1, (120,), "strncat", "The size that strncat() gets is that of the room left."),
    Row("FF1011", 1, (120,), "lstrcatn wcsncat", "The size that a bounded append gets is that of the room left."),
    Row("FF1012", 1, (120,), "strccpy strcadd", _DESTINATION),
    Row(
        "FF1013", 2, (119, 120), "char wchar_t TCHAR", "An array of characters of fixed size holds what is put into it."
    ),
    Row("FF1014", 5, (120, 20), "gets _getts", "gets() is not used: it cannot be told the size of its buffer."),
    Row(
        "FF1015",
        4,
        (120,),
        "sprintf vsprintf swprintf vswprintf",
        "Text is printed with a function that knows its buffer's size.",
    ),
    Row("FF1016", 4, (134,), "printf vprintf wprintf", _FORMAT),
    Row("FF1017", 4, (134,), "fprintf vfprintf fwprintf", _FORMAT),
    Row("FF1018", 4, (134,), "syslog", _FORMAT),
    Row("FF1019", 4, (134,), "snprintf vsnprintf", _FORMAT),
    Row("FF1020", 4, (120, 20), "scanf vscanf wscanf", "A %s of scanf() has a width."),
    Row("FF1021", 4, (120, 20), "fscanf sscanf vsscanf", "A %s of fscanf() or sscanf() has a width."),
    Row("FF1022", 1, (126,), "strlen wcslen", "A string whose length is asked for ends with a null."),
    Row("FF1023", 2, (120,), "MultiByteToWideChar", "A length is given in characters where characters are meant."),
    Row("FF1024", 4, (120,), "streadd strecpy", _DESTINATION),
    Row("FF1025", 3, (120,), "strtrns", _DESTINATION),
    Row("FF1026", 3, (120, 785), "realpath", "The buffer that realpath() gets holds any path, or is null."),
    Row(
        "FF1027",
        3,
        (120, 20),
        "getopt getopt_long",
        "Arguments that getopt() reads are of bounded length on old systems.",
    ),
    Row("FF1028", 3, (120, 20), "getwd", "getcwd() is used, which knows its buffer's size."),
    Row("FF1029", 1, (120, 20), "read getchar fgetc getc", "A loop that reads checks the bounds of its buffer."),
    Row("FF1030", 4, (362, 367), "access", _FILE),
    Row("FF1031", 5, (362,), "chown", "fchown() is used, whose file nobody can exchange."),
    Row("FF1032", 5, (362,), "chgrp", "fchown() is used, whose file nobody can exchange."),
    Row("FF1033", 5, (362,), "chmod", "fchmod() is used, whose file nobody can exchange."),
    Row("FF1034", 2, (362,), "vfork", "fork() is used."),
    Row("FF1035", 5, (362, 20), "readlink", "What readlink() tells is not relied on, and is ended with a null."),
    Row("FF1036", 2, (377,), "tmpfile", "A temporary file is one that nobody else can open."),
    Row("FF1037", 3, (377,), "tmpnam tempnam", "mkstemp() makes temporary files."),
    Row("FF1038", 4, (377,), "mktemp", "mkstemp() makes temporary files."),
    Row("FF1039", 2, (377,), "mkstemp", "The mask is set before mkstemp() is called."),
    Row("FF1040", 2, (362,), "fopen open", "A file that is opened is the one that was meant."),
    Row("FF1041", 1, (732,), "umask", "The mask keeps others out."),
    Row("FF1042", 3, (377,), "GetTempFileName", "A temporary file is one that nobody else can open."),
    Row(
        "FF1043",
        4,
        (78,),
        "execl execlp execle execv execvp popen",
        "A program is started without a shell, from a path that nobody can change.",
    ),
    Row("FF1044", 4, (78,), "system", "A program is started without a shell."),
    Row("FF1045", 3, (78,), "CreateProcessAsUser CreateProcessWithLogon", "The path of a program is whole and quoted."),
    Row("FF1046", 3, (78,), "CreateProcess", "The path of a program is whole and quoted."),
    Row("FF1047", 2, (190,), "atoi atol", "A number that is read from text is checked for its range."),
    Row(
        "FF1048",
        3,
        (327,),
        "srand random drand48",
        "Random numbers that have to be secret come from the system's generator.",
    ),
    Row("FF1049", 4, (327,), "crypt crypt_r", "Passwords are hashed with a function made for it."),
    Row("FF1050", 4, (327,), "EVP_des_ecb EVP_des_cbc", "A cipher stronger than DES is used."),
    Row("FF1051", 4, (327,), "EVP_rc4_40 EVP_rc2_40_cbc", "A key has at least 128 bits."),
    Row("FF1052", 3, (250, 22), "chroot", "chroot() is followed by chdir(), and nothing is left open."),
    Row(
        "FF1053", 3, (807, 20), "getenv curl_getenv", "What an environment variable holds is checked before it is used."
    ),
    Row("FF1054", 3, (807, 20), "g_get_home_dir", "What an environment variable holds is checked before it is used."),
    Row("FF1055", 3, (807, 20), "g_get_tmp_dir", "What an environment variable holds is checked before it is used."),
    Row(
        "FF1056",
        4,
        (250,),
        "ImpersonateLoggedOnUser RpcImpersonateClient",
        "A change of rights is checked for success.",
    ),
    Row("FF1057", 3, (248, 400), "InitializeCriticalSection", "InitializeCriticalSectionAndSpinCount() is used."),
    Row("FF1058", 3, (829, 20), "LoadLibrary", "A library is loaded by its whole path."),
    Row("FF1059", 3, (829, 20), "LoadLibraryEx", "A library is loaded by its whole path."),
    Row("FF1060", 5, (732,), "SetSecurityDescriptorDacl", "No list of rights is null, which lets everybody in."),
    Row("FF1061", 3, (732,), "AddAccessAllowedAce", "AddAccessAllowedAceEx() is used."),
    Row("FF1062", 4, (807,), "getlogin", "Who is logged in is asked of getpwuid()."),
    Row("FF1063", 4, (120,), "cuserid", "Who is logged in is asked of getpwuid()."),
    Row("FF1064", 4, (676, 120), "getpw", "getpwuid() is used."),
    Row("FF1065", 4, (676, 120, 20), "getpass", "A password is read into a buffer of the program's own."),
    Row("FF1066", 2, (676,), "gsignal ssignal", "raise() and signal() are used."),
    Row("FF1067", 1, (676,), "memalign", "posix_memalign() is used."),
    Row("FF1068", 1, (676,), "ulimit", "getrlimit() and setrlimit() are used."),
    Row("FF1069", 1, (676,), "usleep", "nanosleep() is used."),
    Row("FF1070", 0, (20,), "recv recvfrom fread", "What comes from outside is checked."),
    Row("FF1071", 1, (126,), "equal mismatch is_permutation", "Both ends of the second range are given."),
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
    return TABLE.rule(identifier, "-n", f"Flawfinder's rule {identifier} finds nothing.", _OTHER)
