"""The same case gives the same bits: with one or two threads, and in one go or interrupted and resumed."""

import json
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import runs

FORMULATIONS = ("delaunay", "consistent", "variational", "quasi-static")

# A block that is clamped below and shaken above, with all that a checkpoint has to remember: prescribed velocities,
# viscosity, damping, a step that follows the spectrum, work of loads, and mixed conditions at edges.
SHAKEN = """
[[body]]
shape = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
particles = { spacing = 0.125, jitter = 0.2, seed = 7 }
material = "rubber"
[[material]]
name = "rubber"
young = "1 MPa"
poisson = 0.4
density = 1000
viscosity = { linear = 0.1, quadratic = 0.1 }
[[boundary]]
where = "-z"
condition = "fixed"
[[boundary]]
where = "+z"
velocity = ["0.5*sin(20*t)", 0, "free"]
[[boundary]]
where = "+x"
traction = [0, "1000*sin(9*t)", 0]
[gravity]
acceleration = [0, 0, -9.81]
[time]
end = 1.5
step = "auto-spectral"
safety = 0.15
damping = 0.5
[output]
fields = { every = 0.25, format = "csv" }
history = { every = 0.005 }
checkpoint = { every = 0.1 }
[[probe]]
name = "tool"
type = "reaction"
where = "+z"
"""


def method(formulation):
    if formulation == "delaunay":
        return {"method.formulation": "delaunay"}
    return {"method.formulation": "voronoi", "method.boundary": formulation}


def files(folder):
    """Contents of the tables that a run leaves."""
    return {path.name: path.read_bytes() for path in sorted(pathlib.Path(folder).glob("*.csv"))}


def compare(test, whole, parts):
    test.assertEqual(sorted(whole), sorted(parts))
    for name, content in whole.items():
        test.assertTrue(content == parts[name], f"{name} differs")


class Threads(unittest.TestCase):
    """The cantilever at 16 per metre for some twenty steps. Below 8192 particles one thread would do all."""

    def table(self, formulation, threads, step):
        settings = method(formulation) | {
            "body.0.particles.spacing": 1 / 16, "body.0.particles.jitter": 0.2, "time.step": step, "time.end": 1.5e-3,
            "material.0.viscosity.linear": 0.1, "material.0.viscosity.quadratic": 0.1,
            "output.history.every": 1e-4, "output.fields.every": 1e-3, "output.fields.format": "csv"}
        result = runs.run("cantilever/cantilever.toml", settings, threads)
        self.assertGreater(result.summary["particles"], 8192)
        self.assertGreater(result.summary["steps"], 5)
        content = files(result.folder)
        shutil.rmtree(result.folder)
        return content

    def test_two_threads_give_the_bits_of_one(self):
        for formulation in FORMULATIONS:
            step = "auto-spectral" if formulation in ("consistent", "quasi-static") else "auto"
            with self.subTest(formulation=formulation, step=step):
                one, two = (self.table(formulation, threads, step) for threads in (1, 2))
                self.assertGreater(len(one), 2)
                compare(self, one, two)


class DueWhereItStops(unittest.TestCase):
    """What falls due at the very state of a checkpoint is neither lost nor written twice, however late in its step."""

    def run_to(self, folder, end, *options):
        settings = {"time.step": 1 / 32, "time.end": end, "output.history.every": 0.1, "output.fields.every": 0.1,
                    "output.fields.format": "csv", "output.checkpoint.every": 10}
        command = [runs.TESSERA, "run", str(runs.EXAMPLES / "l-block/l-block.toml"), "-o", folder, "--quiet", *options]
        command += ["--set", *(f"{key}={json.dumps(value)}" for key, value in settings.items())]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return files(folder)

    def test_stop_at_every_step(self):
        """Steps of 1/32 s, rows every 0.1 s: the first is due at 0.125 s, the next at 0.21875 s."""
        with tempfile.TemporaryDirectory(prefix="tessera-") as folder:
            whole = self.run_to(folder + "/whole", 0.5)
            for step in range(1, 16):
                with self.subTest(step=step):
                    parts = folder + f"/{step}"
                    self.run_to(parts, step / 32)
                    compare(self, whole, self.run_to(parts, 0.5, "--resume"))


class Resume(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "shaken.toml").write_text(SHAKEN)

    def command(self, formulation, output, *options):
        overrides = [f"{key}={json.dumps(value)}" for key, value in method(formulation).items()]
        case, target = str(self.folder / "shaken.toml"), str(self.folder / output)
        return [runs.TESSERA, "run", case, "-o", target, "-j", "1", "--quiet",
                "--set", *overrides, *options]

    def complete(self, formulation, output, *options):
        done = subprocess.run(self.command(formulation, output, *options), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return files(self.folder / output)

    def rows(self, output):
        try:
            return (self.folder / output / "history.csv").read_bytes().count(b"\n")
        except FileNotFoundError:
            return 0

    def end_at(self, process, output, row, how):
        """Sends the signal once the history has so many rows; returns the exit status."""
        while process.poll() is None and self.rows(output) < row:
            time.sleep(0.002)
        if process.poll() is None:
            process.send_signal(how)
        return process.wait()

    def test_stopped_by_signal(self):
        """Three times; the last state is written on the way out."""
        for formulation in FORMULATIONS:
            with self.subTest(formulation=formulation):
                whole = self.complete(formulation, f"{formulation}-whole")
                output, stops = f"{formulation}-parts", 0
                for row, options in ((30, ()), (120, ("--resume",)), (210, ("--resume",))):
                    process = subprocess.Popen(self.command(formulation, output, *options), stderr=subprocess.DEVNULL)
                    stops += self.end_at(process, output, row, signal.SIGTERM) == 6
                self.assertGreaterEqual(stops, 1, "every part ended before it could be stopped")
                compare(self, whole, self.complete(formulation, output, "--resume"))

    def test_killed(self):
        """Rows and frames after the last checkpoint are made again."""
        for formulation in ("delaunay", "consistent"):
            with self.subTest(formulation=formulation):
                whole = self.complete(formulation, f"{formulation}-whole")
                process = subprocess.Popen(self.command(formulation, "killed-" + formulation))
                self.assertEqual(self.end_at(process, "killed-" + formulation, 112, signal.SIGKILL), -signal.SIGKILL)
                compare(self, whole, self.complete(formulation, "killed-" + formulation, "--resume"))


if __name__ == "__main__":
    runs.main()
