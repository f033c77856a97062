#!/usr/bin/env python3
"""Checks what the documents name, and prints each finding as file:line: message.

    tests/support/check_docs.py            every Markdown file of the tree
    tests/support/check_docs.py FILE ...   these

  path   `server/api/router.hpp`: the file, or the folder, exists
  name   `router.hpp`, `impl/reader.hpp`: a source file somewhere in the tree ends so
  test   `EndToEnd.ARunKeepsTheRevisionItBeganWith`: a test of this name exists
  link   [text](page.md): the file exists
  map    in a row of a table that begins with a folder: the files named after it are in that folder
  table  in a README, a column headed `file` or `files`: `router`, `impl/reader`, `tnc_*` are files or folders below the README's

Exit status: 0 nothing found, 1 findings.
"""
import fnmatch
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
AREAS = ("protocol", "storage", "gateway", "server", "clients", "tests", "deploy")
PATH = re.compile(rf"(?:{'|'.join(AREAS)})(?:/[\w.\-]+)+/?")
FOLDER = re.compile(r"\| `([\w/]+)` \|")
NAME = re.compile(r"[\w\-/]+\.(?:hpp|cpp|py|idl)")
TEST = re.compile(r"[A-Z]\w+\.[A-Z]\w+")
DEFINITION = re.compile(r"^(?:TYPED_)?(?:TEST|RC_GTEST)(?:_F|_P|_PROP|_FIXTURE_PROP)?\(\s*(\w+)\s*,\s*(\w+)", re.M)


def names_of_tests():
    return {".".join(names) for path in (ROOT / "tests").rglob("*.cpp") for names in DEFINITION.findall(path.read_text(errors="replace"))}


def source_files():
    return {f"/{path.relative_to(ROOT)}" for area in AREAS for path in (ROOT / area).rglob("*") if path.suffix in (".hpp", ".cpp", ".py", ".idl")}


def names_below(folder):
    """What a table may call the files below a folder: path or name, with or without the last suffix."""
    found = set()
    for path in folder.rglob("*"):
        if not {"node_modules", "build"} & set(path.parts):
            found |= {path.name, path.stem, str(path.relative_to(folder)), str(path.relative_to(folder).with_suffix(""))}
    return found


def table_findings(page):
    """Of the columns that name files."""
    below, columns = None, []
    for number, line in enumerate(page.read_text().splitlines(), 1):
        cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
        if any(cell in ("file", "files") for cell in cells):
            columns = [i for i, cell in enumerate(cells) if cell in ("file", "files")]
            below = below or names_below(page.parent)
        elif not cells:
            columns = []
        for cell in (cells[i] for i in columns if i < len(cells)):
            for name in re.findall(r"`([a-z][a-z0-9_*/.]*)`", cell):
                if not any(fnmatch.fnmatchcase(known, name) for known in below):
                    yield number, f"no file {name} below {page.parent.relative_to(ROOT)}"


def findings_in(page, tests, sources):
    if page.name == "README.md":
        yield from table_findings(page)
    for number, line in enumerate(page.read_text().splitlines(), 1):
        for name in re.findall(r"`([^`]+)`", line):
            if "000N" in name:  # any number
                continue
            if PATH.fullmatch(name) and not (ROOT / name).exists():
                yield number, f"no file {name}"
            elif NAME.fullmatch(name) and not any(source.endswith("/" + name) for source in sources):
                yield number, f"no file ends in {name}"
            if TEST.fullmatch(name) and name not in tests:
                yield number, f"no test {name}"
        folder = FOLDER.match(line)
        for name in re.findall(r"`([\w/]+\.\w+)`", line) if folder and (ROOT / folder[1]).is_dir() else ():
            if not (ROOT / folder[1] / name).exists() and not (ROOT / name).exists():
                yield number, f"no file {name} in {folder[1]}"
        for target in re.findall(r"\]\(([^)#\s]+)", "" if line.startswith("    ") else line):
            if "://" not in target and not (page.parent / target).exists():
                yield number, f"no file {target}, to which a link leads"


def pages():
    return [*ROOT.glob("*.md"), *(path for area in AREAS for path in (ROOT / area).rglob("*.md") if "node_modules" not in path.parts)]


def main():
    tests, sources = names_of_tests(), source_files()
    found = False
    for page in [pathlib.Path(name).resolve() for name in sys.argv[1:]] or sorted(pages()):
        for number, message in findings_in(page, tests, sources):
            print(f"{page.relative_to(ROOT)}:{number}: {message}")
            found = True
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
