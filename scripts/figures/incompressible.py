#!/usr/bin/python3
"""Picture of the pressure in Cook's membrane, nearly incompressible, with the particles' own changes of volume and with means.

    TESSERA=build/release/bin/tessera scripts/figures/incompressible.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "tests" / "verification"), str(HERE)]

import plane_strain  # noqa: E402
import runs  # noqa: E402


def last_frame(volumetric):
    settings = {"output.fields.format": "vtu", "method.volumetric": volumetric}
    return sorted(runs.run("nearly-incompressible/cook.toml", settings).folder.glob("cells_*.vtu"))[-1]


if __name__ == "__main__":
    plane_strain.render(runs.EXAMPLES / "nearly-incompressible/pressure.png", map(last_frame, ("standard", "averaged")),
                        "--size", 800, 460, "--from", 0, 0, 1, "--up", 0, 1, 0, "--quantity", "pressure",
                        "--title", "pressure [Pa]", "--range", -250, 250, "--labels", "standard", "averaged")
