"""Runs the program on example cases and reads what it leaves. Standard library only."""

import atexit
import bisect
import csv
import glob
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
TESSERA = os.environ.get("TESSERA", str(ROOT / "build/release/bin/tessera"))
RESULTS = pathlib.Path(os.environ.get("TESSERA_RESULTS", ROOT / "build/release/verification"))


class Result:
    """What one run left in its folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = json.loads((self.folder / "summary.json").read_text())
        self.history, self.units = read_csv(self.folder / "history.csv")

    def frame(self, number=-1):
        """Columns of one CSV frame (the case writes fields as csv)."""
        frames = sorted(glob.glob(str(self.folder / "fields_*.csv")))
        return read_csv(frames[number])[0]


def read_csv(path):
    """Columns by name, and their units, of a table whose header reads name[unit]."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    names = [h.split("[")[0] for h in rows[0]]
    units = {h.split("[")[0]: h.split("[")[1].rstrip("]") for h in rows[0] if "[" in h}
    values = [[float(v) for v in row] for row in rows[1:]]
    return {name: [row[i] for row in values] for i, name in enumerate(names)}, units


def execute(case, settings=None, threads=1, arguments=()):
    """Runs examples/<case> with overrides {key: value} in a temporary folder that lasts as long as the
    calling script; returns (process, folder)."""
    folder = tempfile.mkdtemp(prefix="tessera-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    command = [TESSERA, "run", str(EXAMPLES / case), "-o", folder, "-j", str(threads), "--quiet", *arguments]
    for key, value in (settings or {}).items():
        command += ["--set", f"{key}={value if isinstance(value, str) else json.dumps(value)}"]
    return subprocess.run(command, capture_output=True, text=True), folder


def run(case, settings=None, threads=1):
    """As execute(), but the run must succeed; returns its Result."""
    process, folder = execute(case, settings, threads)
    if process.returncode != 0:
        raise AssertionError(f"{case} {settings}: status {process.returncode}: {process.stderr.strip()}")
    return Result(folder)


def interpolate(t, times, values):
    """Linear interpolation in a table of ascending times."""
    i = min(max(bisect.bisect_left(times, t), 1), len(times) - 1)
    w = (t - times[i - 1]) / (times[i] - times[i - 1])
    return values[i - 1] + w * (values[i] - values[i - 1])


def order(coarse, fine, ratio=2.0):
    """Order of convergence from the errors on two spacings."""
    return math.log(coarse / fine) / math.log(ratio)


def record(case, rows):
    """Keeps numbers for the table of results. Each row: quantity, where the paper says it, the paper's number, ours,
    and the bound that is tested (None: reported only)."""
    RESULTS.mkdir(parents=True, exist_ok=True)
    fields = ("quantity", "source", "published", "ours", "bound")
    data = [dict(zip(fields, row, strict=True)) for row in rows]
    (RESULTS / f"{case}.json").write_text(json.dumps({"case": case, "rows": data}, indent=1) + "\n")


def main():
    """Runs the tests of the calling script; status 1 on failures."""
    unittest.main(module=sys.modules["__main__"], verbosity=2)
