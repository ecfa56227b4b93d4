#!/usr/bin/python3
"""Picture of examples/plate-with-hole: ligament.png, and the numbers of its table on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/plate_with_hole.py

takes about a minute.
"""

import pathlib
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402
import test_plate_with_hole as case  # noqa: E402


def main():
    blocks = {"kirsch": [(r / 50, sum(case.shapes(0.0, case.RADIUS * r / 50))) for r in range(50, 151)]}
    curves = ["$kirsch with lines linecolor 'black' title 'Kirsch'"]
    for i, spacing in enumerate(case.SPACINGS):
        rows = case.ligament(case.result("kirsch", spacing), spacing)
        name = f"h{round(1e3 * spacing)}"
        blocks[name] = sorted((y / case.RADIUS, s) for _, y, s in rows)
        curves.append(f"${name} with points pointtype 7 pointsize {1.3 - 0.3 * i} linecolor {i + 1} "
                      f"title 'a / {case.RADIUS / spacing:.3g}'")
        r = case.result("kirsch", spacing)
        print(f"kirsch {spacing:g} m: {r.summary['particles']} particles, error {100 * case.error(r):.3g}%, "
              f"ligament {case.stress_error(rows):.3g}, concentration {case.concentration(rows):.3f}", flush=True)
    for spacing in (0.02, 0.01):
        print(f"strip {spacing:g} m: {case.concentration(case.ligament(case.result('strip', spacing), spacing)):.3f}", flush=True)
    gnuplot.plot(runs.EXAMPLES / "plate-with-hole/ligament.png", blocks, f"""set xlabel 'distance from the centre of the hole / a'
set ylabel 'stress along the tension / tension'
set xrange [0.95:3.05]
set yrange [0.9:3.2]
plot {", ".join(curves)}""", size=(640, 420))


if __name__ == "__main__":
    main()
