#!/usr/bin/env python3
"""Makes the man pages from the built programs and checks that they hold what the programs have: man_test.py BIN"""
import pathlib
import re
import subprocess
import sys
import tempfile

MAKE = pathlib.Path(__file__).resolve().parents[3] / "deploy/man/make_pages.py"


def plain(page):
    """The text of a page without its fonts."""
    return re.sub(r"\\f[BRI]|\\&", "", page.read_text()).replace("\\-", "-").replace("\\e", "\\")


def main():
    bin_ = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        subprocess.run([MAKE, bin_, out], check=True)
        pages = {page.name: plain(page) for page in out.iterdir()}
    assert set(pages) == {"dnc.1", "dncd.8", "dncgw.8", "dripline.toml.5"}, pages.keys()
    for words in (["program", "push"], ["run", "restart"], ["port", "monitor"], ["completion"]):
        assert f".SS {' '.join(['dnc', *words])}\n" in pages["dnc.1"], words
    for program, page in (("dncd", "dncd.8"), ("dncgw", "dncgw.8")):
        help_ = subprocess.run([bin_ / program, "--help"], capture_output=True, text=True, check=True).stdout
        options = re.findall(r"^  --([a-z][a-z-]+)", help_, re.M)
        assert len(options) > 15, options
        for option in set(options) - {"version"}:
            assert re.search(rf"^\.TP\n--{option}\b.*\n\S", pages[page], re.M), (page, option)
            if option not in ("config", "begin-empty", "recover-admin"):  # of the command line alone
                assert re.search(rf"^\.TP\n{option}\b.*\n\S", pages["dripline.toml.5"], re.M), option
        assert ".SH SIGNALS" in pages[page]
    print(f"man pages: {sum(len(page) for page in pages.values())} characters")


if __name__ == "__main__":
    main()
