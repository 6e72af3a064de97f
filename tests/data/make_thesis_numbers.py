"""Writes thesis-numbers.txt: what the thesis numbers, and so what the book must have a claim for.

    python3 make_thesis_numbers.py THESIS.md > thesis-numbers.txt

One line each: `equation N`, the numbers that stand at the end of a displayed formula or as its tag,
with the gaps between the first and the last of a chapter filled (a number whose formula the scan lost
is a number all the same); `cells SECTION COUNT`, the In cells of a section of the notebook in
appendix B; `entry ID`, a row or an entry of a table, or the listing, written down here by hand.
"""

import re
import sys

NUMBER = re.compile(
    r"\((?:\\text\{)?(1|2|A)\.(\d+)\}?\)\s*(?:\\end\{\w+\})?\s*\$*\s*$|\\tag\{(1|2|A)\.(\d+)\}"
)
# The sections of the notebook in their order: `## 1D` stands in it three times.
SECTIONS = ["basic", "1D", "2D", "3D", "1DS", "2DS", "3DS", "os", "1Dos", "2Dos", "3Dos", "export"]
ENTRIES = (
    [f"tab-1.1-{row}" for row in range(1, 6)]
    + [f"tab-2.2-{row}-{column}" for row in ["A", "phi", "I"] for column in ["1D", "2D", "3D"]]
    + ["tab-2.1", "listing-p22"]
)


def equations(lines):
    found = {}
    for line in lines:
        for a, m, b, n in NUMBER.findall(line):
            found.setdefault(a or b, set()).add(int(m or n))
    for chapter in ["1", "2", "A"]:
        for number in range(1, max(found[chapter]) + 1):
            yield f"{chapter}.{number}"


def cells(lines):
    start = next(i for i, line in enumerate(lines) if "Mathematica Code**" in line)
    end = next(i for i, line in enumerate(lines) if line.startswith("# List of Figures"))
    counts, section = {}, None
    for line in lines[start:end]:
        heading = re.match(r"#+ +(Basic Definition|Order Statistic with|[123]D|Export)", line)
        if heading:
            section = 0 if section is None else section + 1
        if section is not None:
            own = counts.setdefault(section, [0, 0])
            own[0] += len(re.findall(r"\bIn\s*\[", line))
            own[1] += len(re.findall(r"\bOut\s*\[", line))
    # The scan lost some heads of cells: an In without its Out, or the other way round.
    return [(SECTIONS[i], max(counts[i])) for i in sorted(counts)]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        lines = file.read().splitlines()
    for equation in equations(lines):
        print(f"equation {equation}")
    for section, count in cells(lines):
        print(f"cells {section} {count}")
    for entry in ENTRIES:
        print(f"entry {entry}")


main()
