# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The catalogue of hard cases as a Markdown table, from the rows that its tests recorded.

    catalogue.py FOLDER          prints the table; fails if README.md has other cases or bounds
    catalogue.py FOLDER --write  writes it into README.md
"""

import sys
from pathlib import Path

PAGE = Path(__file__).with_name("README.md")
BEGIN, END = "<!-- catalogue begin -->\n", "<!-- catalogue end -->\n"
AREAS = ("material", "scale", "mesh", "edges", "thin", "supports", "capacitance", "masks", "stiffness",
         "half-space", "shells", "identification", "files")
HEAD = ("area", "case", "what could go wrong", "quantity", "measured", "bound")
MEASURED = HEAD.index("measured")


def recorded(folder):
    """The rows by area, then in the order of the tests."""
    rows = [tuple(path.read_text().rstrip("\n").split("\t")) for path in sorted(folder.glob("*.tsv"))]
    for row in rows:
        if len(row) != len(HEAD) or row[0] not in AREAS:
            raise SystemExit(f"not a row of the catalogue: {row}")
    return sorted(rows, key=lambda row: AREAS.index(row[0]))


def markdown(rows):
    lines = [HEAD, ("---",) * len(HEAD)] + [[field.replace("|", "\\|") for field in row] for row in rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def stated(table):
    """What of a table is not measured."""
    cells = [line.strip("| \n").split(" | ") for line in table.splitlines()]
    return [tuple(row[:MEASURED] + row[MEASURED + 1:]) for row in cells]


def main(folder, *options):
    table = markdown(recorded(Path(folder)))
    before, rest = PAGE.read_text().split(BEGIN)
    written, after = rest.split(END)
    if "--write" in options:
        PAGE.write_text(before + BEGIN + table + END + after)
        return
    print(table)
    here, there = stated(table), stated(written)
    for row in here:
        if row not in there:
            print("not in README.md:", " | ".join(row), file=sys.stderr)
    for row in there:
        if row not in here:
            print("in README.md alone:", " | ".join(row), file=sys.stderr)
    if here != there:
        raise SystemExit("README.md is not the catalogue as tested: see there how it is written anew")


if __name__ == "__main__":
    main(*sys.argv[1:])
