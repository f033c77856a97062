#!/usr/bin/env python3
"""Makes the man pages from what the programs say of themselves, so that a page never lags behind.

    deploy/man/make_pages.py BIN OUT     BIN: the folder of dnc, dncd and dncgw; OUT: gets dnc.1 ...

dnc(1) has all verbs; dncd(8) and dncgw(8) their options; dripline.toml(5) the keys of the daemons' settings files,
which are the options without the dashes. What is not in a help (files, environment, signals) is beside this script in sections.txt.
"""
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
# Of the help of CLI11: "  -o,--output FILE [-]      Text", the text after two or more blanks or on lines of its own.
ROW = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")
COLUMN = 28  # of the text, after the two blanks
HEADINGS = {"Positionals", "Options", "Subcommands"}


def text_of(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout


def quoted(text):
    """Text that troff takes as it is."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.MULTILINE)


class Help:
    """One help text in its parts."""

    def __init__(self, program, *words):
        self.about, self.usage, self.rows, self.rest = [], "", {}, []
        heading = "about"
        for line in text_of(program, *words, "--help").splitlines():
            if line.startswith("Usage: "):
                self.usage, heading = line.removeprefix("Usage: "), ""
            elif re.fullmatch(r"[A-Z][^.:]*:", line) and (line[:-1] in HEADINGS or heading in self.rows):
                heading = line[:-1]
                self.rows[heading] = []
            elif heading in self.rows and line.startswith("   ") and self.rows[heading]:
                row = self.rows[heading][-1]
                row[1] = f"{row[1]} {line.strip()}".strip()
            elif heading in self.rows and (row := ROW.match(line)):
                self.rows[heading].append([row[1], row[2] or ""])
            elif heading == "about":
                self.about.append(line)
            elif heading in self.rows and not line:
                heading = ""
            else:
                heading = "rest"
                self.rest.append(line)
        for row in (row for rows in self.rows.values() for row in rows if not row[1]):
            if row[0][COLUMN - 1 : COLUMN] == " ":  # a name that fills the column has one blank before its text
                row[:] = row[0][:COLUMN].strip(), row[0][COLUMN:]

    def verbs(self):
        return [row[0].split()[0] for row in self.rows.get("Subcommands", [])]

    def options(self):
        """The rows but for the verbs, and what every program has."""
        rows = [row for heading, rows in self.rows.items() if heading != "Subcommands" for row in rows]
        return [row for row in rows if not row[0].startswith(("-h,", "--version"))]


def rows_of(rows):
    return [line for name, text in rows for line in (".TP", f"\\fB{quoted(name)}\\fR", quoted(text))]


def verbatim(lines):
    text = "\n".join(lines).strip("\n")
    return [".nf", quoted(text), ".fi"] if text else []


def sections():
    """The sections of sections.txt by page: `== dnc.1 FILES` and lines of troff after it."""
    found, lines = {}, []
    for line in (HERE / "sections.txt").read_text().splitlines():
        if line.startswith("== "):
            page, heading = line[3:].split(" ", 1)
            lines = []
            found.setdefault(page, []).append((heading, lines))
        else:
            lines.append(line)
    return found


def page(name, number, summary, version, body):
    head = [f'.TH {name.upper()} {number} "" "dripline {version}" "Dripline"', ".SH NAME", f"{name} \\- {quoted(summary)}"]
    own = [line for heading, lines in sections().get(f"{name}.{number}", []) for line in (f".SH {heading}", *lines)]
    return "\n".join([*head, *body, *own]) + "\n"


def simple_page(program):
    help_ = Help(program)
    return [".SH SYNOPSIS", quoted(help_.usage), ".SH DESCRIPTION", quoted("\n".join(help_.about)),
            ".SH OPTIONS", *rows_of(help_.options()), *verbatim(help_.rest)]


def verb_parts(program, words):
    help_ = Help(program, *words)
    if help_.verbs():
        return [line for verb in help_.verbs() for line in verb_parts(program, [*words, verb])]
    lines = [f".SS {quoted(' '.join(['dnc', *words]))}", quoted(" ".join(help_.about)), ".PP", quoted(help_.usage),
             *rows_of(help_.options())]
    return [*lines, ".PP", *verbatim(help_.rest)]


def dnc_page(program):
    help_ = Help(program)
    body = [".SH SYNOPSIS", quoted(help_.usage), ".SH DESCRIPTION", quoted("\n".join(help_.about)),
            ".SH OPTIONS", *rows_of(help_.options()), *verbatim(help_.rest), ".SH VERBS"]
    return body + [line for verb in help_.verbs() for line in verb_parts(program, [verb])]


def keys_of(program):
    """An option `--dds-domain NUMBER` is the key `dds-domain`."""
    rows = [row for row in Help(program).options() if not row[0].startswith(("--config", "--begin-empty", "--recover-admin"))]
    return rows_of([[name.removeprefix("--"), text] for name, text in rows])


def settings_page(bin_):
    return [".SH DESCRIPTION", quoted("Settings of dncd and dncgw in TOML: dncd --config FILE, dncgw --config FILE. Each key is an option of "
            "the daemon without its dashes; an option on the command line takes precedence. An unknown key is an error that names its line."),
            ".SH KEYS OF DNCD", *keys_of(f"{bin_}/dncd"), ".SH KEYS OF DNCGW", *keys_of(f"{bin_}/dncgw")]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    bin_, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    version = text_of(bin_ / "dnc", "--version").split()[-1]
    out.mkdir(parents=True, exist_ok=True)
    pages = {
        ("dnc", 1, "manage NC programs, machines, runs and reports"): dnc_page(bin_ / "dnc"),
        ("dncd", 8, "networked DNC server"): simple_page(bin_ / "dncd"),
        ("dncgw", 8, "gateway of one machine"): simple_page(bin_ / "dncgw"),
        ("dripline.toml", 5, "settings of dncd and dncgw"): settings_page(bin_),
    }
    for (name, number, summary), body in pages.items():
        (out / f"{name}.{number}").write_text(page(name, number, summary, version, body))


if __name__ == "__main__":
    main()
