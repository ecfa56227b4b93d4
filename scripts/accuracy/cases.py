"""The cases of the study: settings of a method, and what is measured."""

import math
import re
import subprocess

import store  # puts tests/verification on the path
import modes
import runs
import test_cantilever
import test_momentum
import test_swinging_cube

METHODS = (("delaunay", "nodal"), ("delaunay", "cell"), ("consistent", "nodal"), ("consistent", "cell"),
           ("consistent", "second-order"), ("variational", "nodal"), ("variational", "cell"))
WANTED = 0.01  # the error whose cost is compared
FAR = 4.0  # factor between a wanted error and the nearest measured one beyond which nothing is extrapolated
SPECTRAL = {"time.step": "auto-spectral", "time.safety": 0.8}  # the default, where an example has the papers' step


def known_methods():
    """Those whose integration the program knows."""
    text = subprocess.run([runs.TESSERA, "describe", "method.integration"], capture_output=True, text=True, check=True)
    choices = re.findall(r'"([a-z-]+)"', text.stdout)
    return [method for method in METHODS if method[1] in choices]


def name_of(method):
    return " ".join(method)


def lattice(per_metre, jitter):
    return {"body.0.particles.spacing": 1.0 / per_metre, "body.0.particles.jitter": jitter}


class Case:
    """A case of the study: runs of all methods, and the error of each (None where the run failed)."""

    def __init__(self, runs_kept):
        self.store = runs_kept

    def result(self, method, per_metre, jitter):
        name = f"{self.name}/{'-'.join(method)}-{per_metre}-{jitter:g}"
        return self.store.run(name, self.case(method), self.settings(method, per_metre, jitter))

    def case(self, method):
        return self.example

    def settings(self, method, per_metre, jitter):
        return modes.method(*method) | lattice(per_metre, jitter)

    def error(self, method, per_metre, jitter):
        run = self.result(method, per_metre, jitter)
        return self.measure(run, method, per_metre) if run.done else None

    def seconds_to(self, method, jitter, densities, wanted=WANTED):
        """Processor seconds for a wanted error: on the straight line in the logarithms of error and seconds between
        the two rows around it, or beyond them; and whether it lies beyond. None where errors do not fall."""
        rows = [(self.error(method, n, jitter), self.result(method, n, jitter).seconds) for n in densities]
        rows = [row for row in rows if row[0] is not None]
        return cost_of(rows, wanted)


def cost_of(rows, wanted):
    """rows: (error, seconds), coarse to fine."""
    if len(rows) < 2:
        return None
    pairs = list(zip(rows, rows[1:]))
    inside = [(a, b) for a, b in pairs if a[0] >= wanted >= b[0]]
    (e1, s1), (e2, s2) = inside[0] if inside else pairs[0] if rows[0][0] < wanted else pairs[-1]
    if e2 >= e1 or wanted * FAR < e2 or wanted > FAR * e1:
        return None
    w = math.log(wanted / e1) / math.log(e2 / e1)
    return math.exp(math.log(s1) + w * math.log(s2 / s1)), not inside


class Cantilever(Case):
    """Relative L2 error of the tip's path over 0..1 s against the converged reference."""

    name, example = "cantilever", test_cantilever.CASE

    def settings(self, method, per_metre, jitter):
        formulation, integration = method
        return SPECTRAL | test_cantilever.settings(formulation, per_metre, jitter) | modes.method(formulation, integration)

    def measure(self, run, method, per_metre):
        return test_cantilever.path_error(run.history, method[0], per_metre)

    def rms(self, method, per_metre, jitter):
        """RMS error of x3 over 0..1 s [m]."""
        run = self.result(method, per_metre, jitter)
        return test_cantilever.rms_height(run.history, method[0], per_metre) if run.done else None


class DividedClamp(Cantilever):
    """The regular cantilever with the layer of cells at the clamp divided, each into parts^3 cubes."""

    length = 6.0

    def __init__(self, runs_kept, parts):
        super().__init__(runs_kept)
        self.parts = parts
        if parts > 1:
            self.name = f"cantilever-clamp-{parts}"

    @staticmethod
    def block(first, last, h):
        """Centres of cubes of edge h of the beam from x = first to last."""
        along, across = round((last - first) / h), round(1.0 / h)
        return [(first + (i + 0.5) * h, (j + 0.5) * h - 0.5, (k + 0.5) * h - 0.5)
                for i in range(along) for j in range(across) for k in range(across)]

    def points(self, per_metre):
        """The particles' positions, written as a file."""
        path = self.store.folder / self.name / f"points-{per_metre}.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        h = 1.0 / per_metre
        rows = [f"{x!r},{y!r},{z!r}" for x, y, z in self.block(0.0, h, h / self.parts) + self.block(h, self.length, h)]
        path.write_text("\n".join(["x,y,z", *rows]) + "\n")
        return path.resolve()

    def settings(self, method, per_metre, jitter):
        values = super().settings(method, per_metre, jitter)
        if self.parts == 1:
            return values
        values = {key: value for key, value in values.items() if not key.startswith("body.0.particles.")}
        return values | {"body.0.particles": f'{{ file = "{self.points(per_metre)}" }}'}


class RelaxedCantilever(Cantilever):
    """As many relaxed particles as the regular cantilever has, finer towards the clamp: their local size, a formula."""

    def __init__(self, runs_kept, label, size):
        super().__init__(runs_kept)
        self.name, self.size = f"cantilever-relaxed-{label}", size

    def settings(self, method, per_metre, jitter):
        values = super().settings(method, per_metre, jitter)
        values = {key: value for key, value in values.items() if not key.startswith("body.0.particles.")}
        particles = f'{{ count = {6 * per_metre**3}, arrangement = "relaxed", size = "{self.size}", seed = 1 }}'
        return values | {"body.0.particles": particles}


class Contact(Cantilever):
    """The cantilever with other stiffnesses of the bonds."""

    def __init__(self, runs_kept, normal, tangential):
        super().__init__(runs_kept)
        self.bonds = {"material.0.contact.normal": normal, "material.0.contact.tangential": tangential}
        if (normal, tangential) != (1.0, 1.0):
            self.name = f"contact-{normal:g}-{tangential:g}"

    def settings(self, method, per_metre, jitter):
        return super().settings(method, per_metre, jitter) | self.bonds


class SwingingCube(Case):
    """Relative L2 error of the displacement against the exact standing wave of small amplitude, nu = 0.45, 5 ms."""

    name, example = "swinging-cube", "swinging-cube-voronoi/swinging-cube.toml"
    factor = 0.01  # of the papers' amplitude, so that the exact solution is exact enough

    def settings(self, method, per_metre, jitter):
        return super().settings(method, per_metre, jitter) | test_swinging_cube.scaled_by(self.factor, 0.45)

    def measure(self, run, method, per_metre):
        return run.summary["errors"]["exact"]["displacement_l2"]


class TwistingColumn(Case):
    """Relative L2 error of the path of the free end's corner over 0..0.2 s against the finest run."""

    example, end = "twisting-column/twisting-column.toml", 0.2

    def __init__(self, runs_kept, poisson):
        super().__init__(runs_kept)
        self.poisson, self.name = poisson, f"twisting-column-{poisson:g}"
        self.reference = runs.read_csv(store.ROOT / "tests/data/reference/twisting_column.csv")[0]

    def settings(self, method, per_metre, jitter):
        return super().settings(method, per_metre, jitter) | {"material.0.poisson": self.poisson, "time.end": self.end}

    def measure(self, run, method, per_metre):
        target = list(zip(*(self.reference[f"{axis}_nu{self.poisson:g}"] for axis in "xyz")))
        path = [[runs.interpolate(t, run.history["t"], run.history[f"corner.{axis}"]) for axis in "xyz"]
                for t in self.reference["t"]]
        way = sum(math.dist(x, target[0]) ** 2 for x in target)
        return math.sqrt(sum(math.dist(a, b) ** 2 for a, b in zip(path, target)) / way)


class SpinningCube(Case):
    """Relative L2 error of the path of a corner of the free spinning cube over 0..2 s against the finest run."""

    name, example = "spinning-cube", "spinning-cube/spinning-cube.toml"
    finest = (("consistent", "second-order"), 12)

    def settings(self, method, per_metre, jitter):
        probe = '[{ name = "corner", type = "point", at = [0.5, 0.5, 0.5] }]'
        return super().settings(method, per_metre, jitter) | {"probe": probe}

    @staticmethod
    def path(run):
        return list(zip(*(run.history[f"corner.{axis}"] for axis in "xyz")))

    def measure(self, run, method, per_metre):
        target = self.path(self.result(*self.finest, 0.0))
        way = sum(math.dist(x, target[0]) ** 2 for x in target)
        return math.sqrt(sum(math.dist(a, b) ** 2 for a, b in zip(self.path(run), target)) / way)

    def changes(self, method, per_metre, jitter):
        """Largest changes of angular momentum and of energy, relative."""
        h = self.result(method, per_metre, jitter).history
        return (f(self.name, h) for f in (test_momentum.angular_change, test_momentum.energy_change))


class LBlock(Case):
    """Largest change of the energy after the loads, relative; particles per metre 1, 2."""

    name, example = "l-block", "l-block/l-block.toml"

    def measure(self, run, method, per_metre):
        return test_momentum.energy_change("l-block", run.history)

    def energy(self, method, per_metre, jitter):
        """Energy that the loads leave in the block [J]."""
        h = self.result(method, per_metre, jitter).history
        return test_momentum.total_energy(h)[test_momentum.first_free_row("l-block", h)]


class Cook(Case):
    """Relative error of the rise of Cook's membrane under a small load; particles per millimetre 1/4, 1/2, 1."""

    name, example = "cook", "plane-strain/cook.toml"
    load, edge, modulus, reference = 100.0, 0.016, 1e6, 23.9642

    def settings(self, method, per_metre, jitter):
        traction = [0, f"{self.load}*min(t/0.02, 1)"]
        return super().settings(method, per_metre, jitter) | {"boundary.1.traction": traction}

    def measure(self, run, method, per_metre):
        return (run.history["C.y"][-1] - 0.052) / (self.reference * self.load * self.edge / self.modulus) - 1.0


class PureBending(Case):
    """Errors of the strain energy of a uniformly bent beam between ends that follow the exact field."""

    name, example = "pure-bending", store.ROOT / "scripts/accuracy/pure-bending.toml"
    energy = 17e6 / 12.0 * 1e-8 / 2.0 * 2.0  # E I k^2 / 2 times the length [J]

    def errors(self, method, per_metre, jitter):
        """Of the strain energy in the exact field, and of all energy at rest; the share of the bonds in that."""
        h = self.result(method, per_metre, jitter).history
        at_rest = h["internal"][-1] + h["contact"][-1]
        return h["internal"][0] / self.energy - 1.0, at_rest / self.energy - 1.0, h["contact"][-1] / at_rest
