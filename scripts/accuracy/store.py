"""Keeps runs of the program, so that a study can be continued: history, summary and processor time of each."""

import json
import os
import pathlib
import resource
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification"))

import runs  # noqa: E402

MODES = pathlib.Path(os.environ.get("TESSERA_MODES", ROOT / "build/release/bin/modes_program"))
FEW_FIELDS = '{ quantities = ["displacement"] }'  # the first and the last frame only


def overrides(settings):
    """As the program takes them, key=value."""
    return [f"{key}={value if isinstance(value, str) else json.dumps(value)}" for key, value in settings.items()]


def timed(command):
    """Runs a command; returns its process and the processor seconds that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.run(command, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return process, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Run:
    """A run that was done, or failed. seconds: processor time of one thread, set-up and output included."""

    def __init__(self, folder):
        cost = json.loads((folder / "cost.json").read_text())
        self.status, self.message, self.seconds = cost["status"], cost["message"], cost["seconds"]
        self.done = self.status == 0
        if (folder / "summary.json").exists():
            self.summary = json.loads((folder / "summary.json").read_text())
            self.history = runs.read_csv(folder / "history.csv")[0]

    @property
    def particles(self):
        return self.summary["particles"]

    @property
    def steps(self):
        return self.summary["steps"]


class Store:
    """Runs by name in a folder; what is there already is used again."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def run(self, name, case, settings):
        folder = self.folder / name
        if not (folder / "cost.json").exists():
            print(f"run {name}", file=sys.stderr, flush=True)
            folder.mkdir(parents=True, exist_ok=True)
            settings = {"output.fields": FEW_FIELDS} | settings
            command = [runs.TESSERA, "run", str(runs.EXAMPLES / case), "-o", str(folder), "-j", "1", "--quiet", "--force"]
            for setting in overrides(settings):
                command += ["--set", setting]
            process, seconds = timed(command)
            if process.returncode not in (0, 5):
                raise SystemExit(f"{name}: {process.stderr.strip()}")
            cost = {"status": process.returncode, "message": process.stderr.strip(), "seconds": seconds}
            (folder / "cost.json").write_text(json.dumps(cost))
        return Run(folder)

    def modes(self, name, case, settings, wanted):
        """What modes_program says about a case."""
        path = self.folder / f"{name}.json"
        if not path.exists():
            print(f"modes {name}", file=sys.stderr, flush=True)
            path.parent.mkdir(parents=True, exist_ok=True)
            command = [str(MODES), str(runs.EXAMPLES / case), str(wanted), *overrides(settings)]
            process = subprocess.run(command, capture_output=True, text=True, check=False)
            if process.returncode != 0:
                raise SystemExit(f"{name}: {process.stderr.strip()}")
            path.write_text(process.stdout)
        return json.loads(path.read_text())
