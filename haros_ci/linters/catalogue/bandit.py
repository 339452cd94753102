# SPDX-License-Identifier: Apache-2.0
"""The tests of Bandit with the weakness (CWE) and the severity that its own tables give them."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

DOCUMENTATION = "https://bandit.readthedocs.io/en/latest/plugins/index.html"
SUPPRESS = "`# nosec CODE` on the line"

LEVELS = {"H": Level.ERROR, "M": Level.WARNING, "L": Level.NOTE}
#: GitHub's scale: high from 7.0, medium from 4.0.
SEVERITY = {"H": "7.5", "M": "5.0", "L": "3.0"}

#: (id, profile letter and Bandit's severity, CWE, summary)
ROWS: tuple[tuple[str, str, int, str], ...] = (
    ("B101", "-L", 703, "assert as a run-time check, which python -O removes."),
    ("B102", "RM", 78, "Use of exec."),
    ("B103", "RM", 732, "File permissions that let everybody write or execute."),
    ("B104", "SM", 605, "Socket bound to all interfaces."),
    ("B105", "SL", 259, "Password in a string."),
    ("B106", "SL", 259, "Password in an argument."),
    ("B107", "SL", 259, "Password in a default value."),
    ("B108", "SM", 377, "Predictable temporary file name."),
    ("B110", "SL", 703, "Silently ignored exception (pass)."),
    ("B112", "SL", 703, "Silently skipped exception (continue)."),
    ("B113", "SM", 400, "Network request without a timeout."),
    ("B201", "RH", 94, "Flask application with debug=True."),
    ("B202", "SH", 22, "Archive unpacked without a check of its paths."),
    ("B301", "SM", 502, "Untrusted data read by pickle."),
    ("B302", "SM", 502, "Untrusted data read by marshal."),
    ("B303", "SM", 327, "Weak digest: MD2, MD4, MD5 or SHA-1."),
    ("B304", "RH", 327, "Broken cipher (such as RC4 or DES)."),
    ("B305", "RM", 327, "Cipher in ECB mode."),
    ("B306", "RM", 377, "Predictable temporary file name from mktemp."),
    ("B307", "RM", 78, "Use of eval."),
    ("B308", "SM", 79, "Text marked as safe HTML."),
    ("B310", "SM", 22, "URL opened without a check of its scheme."),
    ("B311", "-L", 330, "Random numbers that are not cryptographically secure."),
    ("B312", "RH", 319, "Use of Telnet."),
    ("B313", "-M", 20, "Untrusted XML parsed by cElementTree."),
    ("B314", "-M", 20, "Untrusted XML parsed by ElementTree."),
    ("B315", "-M", 20, "Untrusted XML parsed by expatreader."),
    ("B316", "-M", 20, "Untrusted XML parsed by expatbuilder."),
    ("B317", "-M", 20, "Untrusted XML parsed by sax."),
    ("B318", "-M", 20, "Untrusted XML parsed by minidom."),
    ("B319", "-M", 20, "Untrusted XML parsed by pulldom."),
    ("B321", "RH", 319, "Use of FTP."),
    ("B323", "RM", 295, "TLS context without certificate verification."),
    ("B324", "SH", 327, "MD4, MD5 or SHA-1 used for security."),
    ("B401", "SH", 319, "Import of telnetlib."),
    ("B402", "SH", 319, "Import of ftplib."),
    ("B403", "-L", 502, "Import of pickle."),
    ("B404", "-L", 78, "Import of subprocess."),
    ("B405", "-L", 20, "Import of xml.etree."),
    ("B406", "-L", 20, "Import of xml.sax."),
    ("B407", "-L", 20, "Import of xml.expat."),
    ("B408", "-L", 20, "Import of minidom."),
    ("B409", "-L", 20, "Import of pulldom."),
    ("B411", "-H", 20, "Import of xmlrpc without defusedxml."),
    ("B412", "RH", 284, "CGI script open to httpoxy."),
    ("B413", "SH", 327, "Import of pycrypto, which is no longer maintained."),
    ("B415", "SH", 319, "Import of an IPMI library."),
    ("B501", "RH", 295, "Request without certificate verification."),
    ("B502", "RH", 327, "Broken version of SSL or TLS."),
    ("B503", "RM", 327, "Broken version of SSL or TLS as a default."),
    ("B504", "SL", 327, "TLS socket without a protocol version."),
    ("B505", "RH", 326, "Short cryptographic key."),
    ("B506", "RM", 20, "YAML read by an unsafe loader."),
    ("B507", "RH", 295, "SSH client without host key verification."),
    ("B508", "RM", 319, "SNMP version older than 3."),
    ("B509", "RM", 319, "SNMP without encryption or authentication."),
    ("B601", "SM", 78, "Unchecked input in a command for paramiko."),
    ("B602", "RH", 78, "Process started through a shell (shell=True)."),
    ("B603", "-L", 78, "Process with arguments that may be untrusted."),
    ("B604", "SM", 78, "Function called with shell=True."),
    ("B605", "SH", 78, "Command executed by a shell (os.system, os.popen)."),
    ("B606", "-L", 78, "Process without a shell, with arguments that may be untrusted."),
    ("B607", "-L", 78, "Program started by a partial path."),
    ("B608", "SM", 89, "SQL built from strings."),
    ("B609", "RH", 155, "Wildcard in a shell command."),
    ("B610", "SM", 89, "Unchecked input in Django's extra()."),
    ("B611", "SM", 89, "Unchecked input in Django's RawSQL."),
    ("B612", "RM", 94, "Logging configuration accepted from a socket."),
    ("B613", "RH", 838, "Bidirectional control characters in source text."),
    ("B614", "SM", 502, "Untrusted model loaded by PyTorch without weights_only."),
    ("B615", "SM", 494, "Hugging Face model without a pinned revision."),
    ("B701", "RH", 94, "Jinja2 without HTML escaping."),
    ("B702", "SM", 80, "Mako template without HTML escaping."),
    ("B703", "SM", 80, "Text marked as safe HTML in Django."),
    ("B704", "SM", 79, "Text marked as safe by MarkupSafe."),
)


def rules() -> dict[str, Rule]:
    """The tests of the table by id."""
    return {identifier: _rule(identifier, letters, cwe, summary) for identifier, letters, cwe, summary in ROWS}


def invented(identifier: str) -> Rule:
    """A rule for a test of a newer version or of a plug-in."""
    return _rule(identifier, "-M", 0, f"Bandit's test {identifier} is passed.", "medium")


def _rule(identifier: str, letters: str, cwe: int, summary: str, precision: str = "high") -> Rule:
    advice = "Bandit tells of what may be abused; whether anybody can do so is for you to judge."
    return Rule(
        id=identifier,
        summary=summary,
        level=level_of(letters, LEVELS[letters[1]]),
        help=help_text(identifier, summary, advice, SUPPRESS),
        help_uri=DOCUMENTATION,
        precision="medium" if letters[0] == "-" else precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "bandit", "security"),
        cwe=(cwe,) if cwe else (),
        security_severity=SEVERITY[letters[1]],
    )
