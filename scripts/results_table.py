#!/usr/bin/python3
"""Makes docs/results.md from what the verification tests measured: the numbers of the papers next to ours.

    scripts/results_table.py BUILD/verification [OUT.md]

Reads every CASE.json in the folder (written by record() of tests/verification/runs.py) and prints one table, grouped by
case, to OUT.md or else to stdout.
"""

import json
import pathlib
import sys

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"
# The order of the papers; other cases follow by name.
ORDER = ("patch-delaunay", "patch-voronoi", "patch-l-block", "swinging-cube-delaunay", "swinging-cube-voronoi")
HEAD = """# Results

Made by `make results` from what the verification tests measured (`scripts/results_table.py`); not written by hand.
[D] and [V] are the papers named in [theory.md](theory.md). The bound is what the test demands of our number; where there
is none the number is only reported. A dash under *published* means that the paper gives no number.

| case | quantity | source | published | ours | bound |
|---|---|---|---|---|---|
"""


def shown(value):
    """A cell of the table: numbers with three digits, text as it is."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return f"{value:.3g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(shown(v) for v in value)
    return str(value).replace("|", "\\|").replace("\n", " ")


def place(case):
    """Sorts the cases: first those of ORDER."""
    return (ORDER.index(case), "") if case in ORDER else (len(ORDER), case)


def label(case):
    """The case's name, with a link where it is an example."""
    return f"[{case}](../examples/{case}/README.md)" if (EXAMPLES / case / "README.md").exists() else case


def lines_of(record):
    columns = ("quantity", "source", "published", "ours", "bound")
    for i, row in enumerate(record["rows"]):
        cells = [label(record["case"]) if i == 0 else ""] + [shown(row[c]) for c in columns]
        yield "| " + " | ".join(cells) + " |"


def table(records):
    ordered = sorted(records, key=lambda record: place(record["case"]))
    return HEAD + "".join(line + "\n" for record in ordered for line in lines_of(record))


def read(folder):
    records = [json.loads(path.read_text()) for path in sorted(pathlib.Path(folder).glob("*.json"))]
    if not records:
        raise SystemExit(f"{folder}: no results; run the verification tests first (ctest -L verification)")
    return records


def main(arguments):
    if len(arguments) not in (1, 2):
        raise SystemExit(__doc__.strip())
    text = table(read(arguments[0]))
    if len(arguments) == 2:
        pathlib.Path(arguments[1]).write_text(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main(sys.argv[1:])
