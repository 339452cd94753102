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
    ("B101", "-L", 703, "A condition that must hold is not left to assert, which python -O removes."),
    ("B102", "RM", 78, "No text is run as Python by exec."),
    ("B103", "RM", 732, "A file is not made writable or executable for everybody."),
    ("B104", "SM", 605, "A socket is not bound to all interfaces."),
    ("B105", "SL", 259, "No password stands in a text."),
    ("B106", "SL", 259, "No password stands in an argument."),
    ("B107", "SL", 259, "No password stands in a default."),
    ("B108", "SM", 377, "A temporary file gets a name that nobody can guess (tempfile)."),
    ("B110", "SL", 703, "An exception is not passed over in silence."),
    ("B112", "SL", 703, "An exception is not skipped in silence."),
    ("B113", "SM", 400, "A request has a timeout."),
    ("B201", "RH", 94, "A Flask program does not run with its debugger."),
    ("B202", "SH", 22, "What is unpacked from an archive stays in its directory."),
    ("B301", "SM", 502, "What is unpickled is trusted."),
    ("B302", "SM", 502, "What marshal reads is trusted."),
    ("B303", "SM", 327, "A digest is not MD2, MD4, MD5 or SHA-1."),
    ("B304", "RH", 327, "A cipher is not broken."),
    ("B305", "RM", 327, "A cipher does not use the mode ECB."),
    ("B306", "RM", 377, "A temporary file is made by mkstemp rather than named by mktemp."),
    ("B307", "RM", 78, "Texts are not evaluated as Python by eval."),
    ("B308", "SM", 79, "A text is not marked as safe HTML."),
    ("B310", "SM", 22, "An address that is opened begins with http or https."),
    ("B311", "-L", 330, "Secrets are not made by random."),
    ("B312", "RH", 319, "Telnet is not used."),
    ("B313", "-M", 20, "XML from outside is not parsed by cElementTree."),
    ("B314", "-M", 20, "XML from outside is not parsed by ElementTree."),
    ("B315", "-M", 20, "XML from outside is not parsed by expatreader."),
    ("B316", "-M", 20, "XML from outside is not parsed by expatbuilder."),
    ("B317", "-M", 20, "XML from outside is not parsed by sax."),
    ("B318", "-M", 20, "XML from outside is not parsed by minidom."),
    ("B319", "-M", 20, "XML from outside is not parsed by pulldom."),
    ("B321", "RH", 319, "FTP is not used."),
    ("B323", "RM", 295, "A TLS context verifies certificates."),
    ("B324", "SH", 327, "A digest for security is not MD4, MD5 or SHA-1."),
    ("B401", "SH", 319, "telnetlib is not imported."),
    ("B402", "SH", 319, "ftplib is not imported."),
    ("B403", "-L", 502, "The use of pickle is considered."),
    ("B404", "-L", 78, "The use of subprocess is considered."),
    ("B405", "-L", 20, "The use of xml.etree is considered."),
    ("B406", "-L", 20, "The use of xml.sax is considered."),
    ("B407", "-L", 20, "The use of xml.expat is considered."),
    ("B408", "-L", 20, "The use of minidom is considered."),
    ("B409", "-L", 20, "The use of pulldom is considered."),
    ("B411", "-H", 20, "xmlrpc is not imported without protection."),
    ("B412", "RH", 284, "A CGI script is not open to httpoxy."),
    ("B413", "SH", 327, "pycrypto, which nobody maintains, is not imported."),
    ("B415", "SH", 319, "IPMI libraries are not imported."),
    ("B501", "RH", 295, "A request verifies certificates."),
    ("B502", "RH", 327, "TLS is of a version that is not broken."),
    ("B503", "RM", 327, "A default is a version of TLS that is not broken."),
    ("B504", "SL", 327, "A TLS socket names its version."),
    ("B505", "RH", 326, "A key is long enough."),
    ("B506", "RM", 20, "YAML is read by safe_load."),
    ("B507", "RH", 295, "An SSH client verifies the keys of hosts."),
    ("B508", "RM", 319, "SNMP is version 3."),
    ("B509", "RM", 319, "SNMP is encrypted and authenticated."),
    ("B601", "SM", 78, "A command given to paramiko is not made of what comes from outside."),
    ("B602", "RH", 78, "A process is not started through a shell (shell=True)."),
    ("B603", "-L", 78, "The arguments of a process are considered."),
    ("B604", "SM", 78, "A function is not called with shell=True."),
    ("B605", "SH", 78, "A command is not run by a shell (os.system, os.popen)."),
    ("B606", "-L", 78, "The arguments of a process without a shell are considered."),
    ("B607", "-L", 78, "A program is started by its whole path."),
    ("B608", "SM", 89, "SQL is not put together from texts."),
    ("B609", "RH", 155, "A command has no wildcard that names of files can abuse."),
    ("B610", "SM", 89, "Django's extra gets no text from outside."),
    ("B611", "SM", 89, "Django's RawSQL gets no text from outside."),
    ("B612", "RM", 94, "A configuration of logging is not listened for on a socket."),
    ("B613", "RH", 838, "Source has no characters that change the direction of text."),
    ("B614", "SM", 502, "A model that PyTorch loads is trusted, or read with weights_only."),
    ("B615", "SM", 494, "A model from Hugging Face is pinned to a revision."),
    ("B701", "RH", 94, "Jinja2 escapes HTML."),
    ("B702", "SM", 80, "A Mako template escapes HTML."),
    ("B703", "SM", 80, "A text is not marked as safe HTML in Django."),
    ("B704", "SM", 79, "A text is not marked as safe by MarkupSafe."),
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
