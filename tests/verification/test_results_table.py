"""The table of results (scripts/results_table.py), from records made up here."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "results_table.py"


def record(case, *rows):
    fields = ("quantity", "source", "published", "ours", "bound")
    return {"case": case, "rows": [dict(zip(fields, row, strict=True)) for row in rows]}


class ResultsTable(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def table(self, *records):
        for i, r in enumerate(records):
            (self.folder / f"{i}.json").write_text(json.dumps(r))
        return subprocess.run([sys.executable, "-B", SCRIPT, self.folder], capture_output=True, text=True)

    def rows(self, *records):
        lines = self.table(*records).stdout.splitlines()
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")][2:]

    def test_a_row(self):
        rows = self.rows(record("made-up", ("tip [m]", "[D 8.4]", None, 0.123456, "2 m"), ("b", "[V 1]", 2, 1e-9, None)))
        self.assertEqual(rows, [["made-up", "tip [m]", "[D 8.4]", "–", "0.123", "2 m"],
                                ["", "b", "[V 1]", "2", "1e-09", "–"]])

    def test_cases_in_the_order_of_the_papers(self):
        cases = ["zebra", "apple", "swinging-cube-voronoi", "patch-delaunay"]
        names = [row[0] for row in self.rows(*(record(c, ("q", "s", 1, 2, 3)) for c in cases))]
        self.assertEqual([name.split("]")[0].lstrip("[") for name in names],
                         ["patch-delaunay", "swinging-cube-voronoi", "apple", "zebra"])
        self.assertIn("(../examples/patch-delaunay/README.md)", names[0])

    def test_bars_do_not_split_cells(self):
        self.assertIn("a \\| b", self.table(record("made-up", ("a | b", "s", 1, 2, 3))).stdout)

    def test_no_results(self):
        process = self.table()
        self.assertEqual(process.returncode, 1)
        self.assertIn("no results", process.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
