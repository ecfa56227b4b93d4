#!/usr/bin/python3
"""Pictures of examples/thick-walled and torsion-bar: errors.png of both, and the numbers on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/elasticity.py
"""

import pathlib
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402

CASES = {
    "thick-walled": {"sphere": (0.2, 0.1, 0.05), "cylinder": (0.2, 0.1, 0.05)},
    "torsion-bar": {"torsion-bar": (0.05, 0.1 / 3, 0.02)},
}
TORQUE = 3866.5  # [N m]


def error(result):
    return next(iter(result.summary["errors"].values()))["displacement_l2"]


def main():
    for example, cases in CASES.items():
        blocks, curves = {}, []
        for case, spacings in cases.items():
            for formulation in ("voronoi", "delaunay"):
                rows = []
                for spacing in spacings:
                    r = runs.run(f"{example}/{case}.toml", {"method.formulation": formulation,
                                                            "body.0.particles.spacing": spacing})
                    rows.append((1e3 * spacing, 100 * error(r)))
                    torque = f", torque {r.history['tool.tz'][-1]:.1f} N m" if "tool.tz" in r.history else ""
                    print(f"{case} {formulation} {spacing:.3g} m: {r.summary['particles']} particles, "
                          f"error {100 * error(r):.3g}%{torque}", flush=True)
                name = f"{case}_{formulation}".replace("-", "_")
                blocks[name] = rows
                curves.append(f"${name} with linespoints pointtype 7 linetype {len(curves) + 1} title '{case}, {formulation}'")
        corner = max(rows[0] for rows in blocks.values())
        blocks["second_order"] = [(x, 0.4 * corner[1] * (x / corner[0]) ** 2) for x in (0.25 * corner[0], corner[0])]
        curves.append("$second_order with lines dashtype 2 linecolor rgb '#777777' title 'second order'")
        gnuplot.plot(runs.EXAMPLES / example / "errors.png", blocks, "set logscale xy\nset key bottom right\n"
                     "set xlabel 'spacing [mm]'\nset ylabel 'relative L2 error of the displacement [%]'\n"
                     f"set grid\nplot {', '.join(curves)}", size=(640, 420))


if __name__ == "__main__":
    main()
