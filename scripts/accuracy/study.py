#!/usr/bin/python3
"""The study of accuracy: runs every integration on every case and writes the tables and plots of docs/accuracy.md.

    scripts/accuracy/study.py RUNS [--largest N] [--only TABLE ...]

RUNS is a folder that keeps the runs; what is there already is used again. --largest leaves out runs with more particles per
metre. All of it takes about 40 minutes of one core, a half of them for the modes at 8 per metre. Each table stands in
docs/accuracy.md between <!-- NAME --> and <!-- end --> and is replaced; the text around them is written by hand.
"""

import argparse
import pathlib
import re
import sys

import cases
import store

sys.path.insert(0, str(store.ROOT / "scripts" / "figures"))

import gnuplot  # noqa: E402
import modes  # noqa: E402

PAGE = store.ROOT / "docs" / "accuracy.md"
IMAGES = store.ROOT / "docs" / "images"
JITTERS = (0.0, 0.2)
CONTACT = (0.03, 0.1, 0.3, 1.0, 3.0)  # xi


def percent(value):
    if value is None:
        return "fails"
    return f"{100 * value:.1f}%" if abs(value) >= 0.0995 else f"{100 * value:.2g}%"


def signed(value):
    return f"{100 * value:+.2f}%"


def plain(value):
    """Two digits, without an exponent."""
    return f"{float(f'{value:.2g}'):g}"


def seconds(cost):
    if cost is None:
        return "–"
    value, extrapolated = cost
    return f"{plain(value)}{'*' if extrapolated else ''}"


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def kind(jitter):
    return "20% jitter" if jitter else "regular"


class Study:
    def __init__(self, folder, largest, methods):
        self.store = store.Store(folder)
        self.largest = largest
        self.methods = methods
        self.main_methods = [m for m in methods if m[0] != "variational"]  # which is consistent on regular particles

    def densities(self, *wanted):
        return [n for n in wanted if n <= self.largest]

    def errors_and_cost(self, case, densities, methods):
        """One row a method and jitter: errors, processor seconds, and seconds to one per cent."""
        head = ["", *(f"{n} per metre" for n in densities), "steps, seconds at the last", "seconds to 1%"]
        rows = []
        for method in methods:
            for jitter in JITTERS:
                last = case.result(method, densities[-1], jitter)
                cost = f"{last.steps}, {plain(last.seconds)}" if last.done else "–"
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}",
                             *(percent(case.error(method, n, jitter)) for n in densities), cost,
                             seconds(case.seconds_to(method, jitter, densities))])
        return table(head, rows)

    def draw_cost(self, case, densities, output, title):
        """Error against processor seconds, both arrangements."""
        blocks, plots = {}, ["1 with lines linecolor rgb '#999999' dashtype 3 notitle"]
        for i, method in enumerate(self.methods):
            for jitter, dash, marker in ((0.0, 2, 6), (0.2, 1, 7)):
                rows = [(case.result(method, n, jitter).seconds, case.error(method, n, jitter)) for n in densities]
                block = f"{'_'.join(method).replace('-', '_')}_{int(10 * jitter)}"
                blocks[block] = [(s, 100 * e) for s, e in rows if e is not None]
                label = f"title '{cases.name_of(method)}'" if jitter else "notitle"
                plots.append(f"${block} with linespoints linecolor {i + 1} dashtype {dash} pointtype {marker} {label}")
        gnuplot.plot(IMAGES / output, blocks, f"""set logscale xy
set linetype 7 linecolor rgb '#d070a0'
set xlabel 'processor seconds'
set ylabel '{title} [%]'
set key outside right center
plot {", ".join(plots)}""", size=(900, 460))

    def cantilever(self):
        case, densities = cases.Cantilever(self.store), self.densities(2, 4, 8, 16)
        self.draw_cost(case, densities, "accuracy-cantilever.png", "error of the path over 0..1 s")
        return self.errors_and_cost(case, densities, self.methods)

    def clamp(self):
        """Error of the path with the layer of cells at the clamp divided, regular particles."""
        parts = (1, 2, 3, 4)
        rows = []
        for method in [m for m in self.methods if m[0] == "consistent" and m[1] != "nodal"]:
            for n in self.densities(4, 8):
                runs_of = [cases.DividedClamp(self.store, k) for k in parts]
                rows.append([f"{cases.name_of(method)}, {n} per metre", *(self.error_and_size(c, method, n) for c in runs_of)])
        return table(["error (particles)", *(f"{k}³" if k > 1 else "whole" for k in parts)], rows)

    def graded(self):
        """Error of the path and steps with relaxed particles that are finer towards the clamp, by second order."""
        sizes = ("1", "min(1, 0.4 + 1.5*X)", "min(1, 0.25 + 1.5*X)")
        method, densities = ("consistent", "second-order"), self.densities(4, 8)
        rows = []
        for label, size in enumerate(sizes):
            case = cases.RelaxedCantilever(self.store, label, size)
            rows.append([f"`{size}`", *(self.error_and_steps(case, method, n) for n in densities)])
        return table(["`size`", *(f"{6 * n**3} particles: error, steps" for n in densities)], rows)

    @staticmethod
    def error_and_steps(case, method, per_metre):
        run = case.result(method, per_metre, 0.0)
        return f"{percent(case.error(method, per_metre, 0.0))}, {run.steps}" if run.done else "fails"

    @staticmethod
    def error_and_size(case, method, per_metre):
        run = case.result(method, per_metre, 0.0)
        if not run.done:
            return "fails"
        return f"{percent(case.error(method, per_metre, 0.0))} ({run.particles})"

    def pure_bending(self):
        """Errors of the strain energy in the exact field and of all energy at rest, and the bonds' share of that."""
        case, densities = cases.PureBending(self.store), self.densities(4, 8)
        head = ["", *(f"{n} per metre: {what}" for n in densities for what in ("exact field", "at rest", "bonds"))]
        rows = []
        for method in self.methods:
            for jitter in JITTERS:
                errors = [case.errors(method, n, jitter) for n in densities]
                cells = [cell for field, rest, bonds in errors for cell in (signed(field), signed(rest), percent(bonds))]
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}", *cells])
        return table(head, rows)

    def others(self):
        """RMS error of x3 at 4 and 8 per metre, beside other programs."""
        case = cases.Cantilever(self.store)
        rows = [["total-Lagrangian SPH, LAMMPS", "", "0.33 m"], ["total-Lagrangian SPH, SPHinXsys", "", "0.35 m"],
                ["explicit finite elements C3D8, CalculiX", "", "0.028 m"]]
        for method in self.methods:
            cells = []
            for n in self.densities(4, 8):
                values = [case.rms(method, n, jitter) for jitter in JITTERS]
                cells.append(", ".join("fails" if v is None else f"{v:.3f}" for v in values) + " m")
            rows.append([cases.name_of(method), *cells])
        return table(["", "4 per metre: regular, jitter", "8 per metre: regular, jitter"], rows)

    def swinging_cube(self):
        case, densities = cases.SwingingCube(self.store), self.densities(4, 8, 16)
        head = ["", *(f"{n} per metre" for n in densities), "order of the last two"]
        rows = []
        for method in self.methods:
            for jitter in JITTERS:
                errors = [case.error(method, n, jitter) for n in densities]
                order = "–" if None in errors[-2:] or len(errors) < 2 else f"{cases.runs.order(*errors[-2:]):.2f}"
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}", *map(percent, errors), order])
        return table(head, rows)

    def twisting_column(self):
        text = ""
        for poisson in (0.3, 0.45):
            case = cases.TwistingColumn(self.store, poisson)
            text += f"ν = {poisson}:\n\n"
            text += self.errors_and_cost(case, self.densities(2, 4, 8, 16), self.main_methods) + "\n"
        return text

    def spinning_cube(self):
        case, densities = cases.SpinningCube(self.store), self.densities(4, 8)
        head = ["", *(f"{n} per metre" for n in densities), "changes at the last: angular momentum, energy"]
        rows = []
        for method in self.main_methods:
            for jitter in JITTERS:
                errors = [percent(case.error(method, n, jitter)) for n in densities]
                done = case.result(method, densities[-1], jitter).done
                changes = ", ".join(f"{c:.0e}" for c in case.changes(method, densities[-1], jitter)) if done else "–"
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}", *errors, changes])
        return table(head, rows)

    def l_block(self):
        case, densities = cases.LBlock(self.store), (1, 2)
        head = ["", *(f"{n} per metre: drift, energy" for n in densities)]
        rows = []
        for method in self.main_methods:
            for jitter in JITTERS:
                cells = []
                for n in densities:
                    drift = case.error(method, n, jitter)
                    cells.append("fails" if drift is None else f"{drift:.1e}, {case.energy(method, n, jitter):.4g} J")
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}", *cells])
        return table(head, rows)

    def cook(self):
        case, densities = cases.Cook(self.store), (250, 500, 1000)
        head = ["", *(f"{1000 // n} mm" for n in densities)]
        voronoi = [m for m in self.methods if m[0] != "delaunay"]
        rows = [[cases.name_of(m), *("fails" if (e := case.error(m, n, 0.0)) is None else signed(e) for n in densities)]
                for m in voronoi]
        return table(head, rows)

    def beam_modes(self, method, per_metre, jitter, condition, more=None):
        label = "".join(f"-{value}" for value in (more or {}).values()).replace(" ", "")
        name = f"modes/{'-'.join(method)}-{per_metre}-{jitter:g}-{condition}{label}"
        settings = modes.method(*method) | modes.beam(condition, per_metre, jitter) | (more or {})
        return self.store.modes(name, modes.BEAM, settings, modes.ENOUGH[condition])

    def modes(self):
        """Errors of the frequencies at 4 and 8 per metre."""
        return "".join(f"At {n} per metre:\n\n{self.modes_at(n)}\n" for n in self.densities(4, 8))

    def modes_at(self, per_metre):
        head = ["", "free: bending", "torsion", "second bending", "clamped: bending", "torsion", "second bending",
                "stable step"]
        rows = []
        for method in self.methods:
            for jitter in JITTERS:
                found = {c: self.beam_modes(method, per_metre, jitter, c) for c in ("free", "fixed")}
                errors = [e for c in found for e in modes.errors(found[c], c).values()]
                rows.append([f"{cases.name_of(method)}, {kind(jitter)}", *map(signed, errors),
                             f"{modes.relative_step(found['free']):.2f}"])
        return table(head, rows)

    def contact(self):
        """What the stiffness of the bonds does: modes at 4, path at 8 per metre, 20% jitter."""
        head = ["", "ξ", "free bending", "torsion", "clamped bending", "path at 4", "path at 8", "steps at 8",
                "share of the bonds at 8"]
        pairs = [(xi, xi) for xi in CONTACT] + [(1.0, 0.1), (0.1, 1.0)]
        rows = []
        for method in self.main_methods:
            for normal, tangential in pairs:
                rows.append(self.contact_row(method, normal, tangential))
        return table(head, rows)

    def contact_row(self, method, normal, tangential):
        case = cases.Contact(self.store, normal, tangential)
        found = {c: self.beam_modes(method, 4, 0.2, c, case.bonds) for c in ("free", "fixed")}
        free, fixed = (modes.errors(found[c], c) for c in ("free", "fixed"))
        last = case.result(method, 8, 0.2)
        label = f"{normal:g}" if normal == tangential else f"normal {normal:g}, tangential {tangential:g}"
        return [cases.name_of(method), label, signed(free["bending"]), signed(free["torsion"]),
                signed(fixed["bending"]), percent(case.error(method, 4, 0.2)), percent(case.error(method, 8, 0.2)),
                str(last.steps) if last.done else "–",
                percent(last.summary["energy"]["largest_contact_share"]) if last.done else "–"]

    def choice(self):
        """Every method in one row, regular and 20% jitter: cantilever, its cost, and pure bending."""
        case, bending, densities = cases.Cantilever(self.store), cases.PureBending(self.store), self.densities(4, 8, 16)
        head = ["regular, jitter", *(f"path, {n} per metre" for n in densities), "seconds to 1%", "bending, 8 per metre"]
        rows = []
        for method in self.methods:
            both = [[percent(case.error(method, n, j)) for j in JITTERS] for n in densities]
            both.append([seconds(case.seconds_to(method, j, self.densities(2, 4, 8, 16))) for j in JITTERS])
            both.append([signed(bending.errors(method, 8, j)[1]) for j in JITTERS])
            rows.append([cases.name_of(method), *map(", ".join, both)])
        return table(head, rows)

    def masses(self):
        """Errors of the modes with the inertia that masses at points leave out, regular particles."""
        head = ["", "free: bending", "torsion", "clamped: bending", "torsion"]
        rows = []
        measures = (("", modes.frequency), (", with the cells' inner motion", modes.with_motion_inside))
        for method in [m for m in self.methods if m[0] == "consistent"]:
            for n in self.densities(4, 8):
                for label, measure in measures:
                    found = {c: modes.errors(self.beam_modes(method, n, 0.0, c), c, measure) for c in ("free", "fixed")}
                    rows.append([f"{cases.name_of(method)}, {n} per metre{label}",
                                 *(signed(found[c][name]) for c in found for name in ("bending", "torsion"))])
        return table(head, rows)


BLOCKS = ("cantilever", "clamp", "graded", "others", "pure_bending", "modes", "swinging_cube", "twisting_column", "spinning_cube",
          "l_block", "cook", "masses", "contact", "choice")


def replace(text, name, content):
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end -->)", re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"{PAGE}: no block <!-- {name} -->")
    return pattern.sub(lambda found: found.group(1) + "\n" + content.rstrip() + "\n\n" + found.group(2), text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=pathlib.Path)
    parser.add_argument("--largest", type=int, default=16, help="particles per metre")
    parser.add_argument("--only", nargs="+", choices=BLOCKS, default=BLOCKS, help="these tables")
    parser.add_argument("--integrations", nargs="+", help="these alone")
    options = parser.parse_args()
    methods = [m for m in cases.known_methods() if not options.integrations or m[1] in options.integrations]
    study = Study(options.runs, options.largest, methods)
    for name in options.only:
        content = getattr(study, name)()
        PAGE.write_text(replace(PAGE.read_text(), name, content))


if __name__ == "__main__":
    main()
