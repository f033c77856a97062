#!/usr/bin/env python3
"""Makes tests/golden/<control>/coverage.md: every row of the control's checklist, its state, and the tests that point at it.

    tests/support/make_coverage.py CONTROL           writes the file
    tests/support/make_coverage.py --check CONTROL   status 1 when it is stale, or a row has neither test nor reason

Rows come from tests/golden/<control>/checklist.txt, one a line:

    NGC-001 | works | percent signs around a program, end rules
    NGC-099 | not applicable | what the row is about | why it means nothing here

Empty lines and lines that begin with # are left out. A test points at a row by naming its id: a golden case in its
note ("Rows: NGC-001, NGC-002"), other tests anywhere in their sources or READMEs.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STATES = ("works", "partly", "not applicable")
OTHER_TESTS = ("unit", "integration", "differential")
SUFFIXES = (".cpp", ".hpp", ".py", ".md")


def read_rows(path):
    rows = {}
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) not in (3, 4) or cells[1] not in STATES or not all(cells):
            sys.exit(f"{path}:{number}: expected 'ID | {' or '.join(STATES)} | words [| reason]'")
        if cells[0] in rows:
            sys.exit(f"{path}:{number}: {cells[0]} is given twice")
        rows[cells[0]] = {"state": cells[1], "words": cells[2], "reason": cells[3] if len(cells) == 4 else ""}
    return rows


def ids_in(text, rows):
    return [row for row in re.findall(r"\b[A-Z0-9]+(?:-[A-Z0-9]+)+\b", text) if row in rows]


def tests_of(control, rows):
    """Row id -> names of the tests that name it, sorted."""
    found = {row: set() for row in rows}
    for case in (ROOT / "tests/golden" / control).glob("*.golden"):
        note = case.read_text(errors="replace").split("\n-- ", 1)[0]
        for row in ids_in(note, rows):
            found[row].add(f"golden {case.stem}")
    for area in OTHER_TESTS:
        for path in (ROOT / "tests" / area).rglob("*"):
            if path.suffix in SUFFIXES and path.is_file():
                for row in ids_in(path.read_text(errors="replace"), rows):
                    found[row].add(str(path.relative_to(ROOT / "tests")))
    return {row: sorted(names) for row, names in found.items()}


def report(control, rows, tests):
    shown = sum(1 for row in rows if tests[row])
    lines = [f"# Coverage of {control}", "",
             f"Made by `tests/support/make_coverage.py {control}`; do not edit. {len(rows)} rows, {shown} pointed at by tests.", "",
             "| row | what | state | shown by, or why not |", "|---|---|---|---|"]
    for row, facts in rows.items():
        cells = [", ".join(tests[row]), facts["reason"]]
        lines.append(f"| {row} | {facts['words']} | {facts['state']} | {'; '.join(c for c in cells if c)} |")
    return "\n".join(lines) + "\n"


def main(arguments):
    checks = "--check" in arguments
    controls = [each for each in arguments if not each.startswith("--")]
    if len(controls) != 1:
        sys.exit(__doc__)
    control = controls[0]
    folder = ROOT / "tests/golden" / control
    rows = read_rows(folder / "checklist.txt")
    tests = tests_of(control, rows)
    text = report(control, rows, tests)
    coverage = folder / "coverage.md"
    if not checks:
        coverage.write_text(text)
        print(f"{coverage.relative_to(ROOT)}: {len(rows)} rows")
        return 0
    status = 0
    for row, facts in rows.items():
        if not tests[row] and not facts["reason"]:
            print(f"{row} ({facts['words']}): no test names it, and no reason is given")
            status = 1
    if not coverage.exists() or coverage.read_text() != text:
        print(f"{coverage.relative_to(ROOT)} is stale: run tests/support/make_coverage.py {control}")
        status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
