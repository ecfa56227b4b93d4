#!/usr/bin/python3
"""Pictures of the patch tests, examples/patch-*/body.png: the bodies of test B, coloured by displacement.

    TESSERA=build/release/bin/tessera scripts/figures/patch.py
"""

import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests" / "verification"))

import runs  # noqa: E402

FIELDS = {"output.fields": '{format = "vtu", cells = true, quantities = ["displacement"]}'}
# Example: the frames (settings of a run, label), factor from m, title and range of the colours.
PICTURES = {
    "patch-delaunay": ([({}, "")], 1e6, "Displacement [µm]", (0, 36)),
    "patch-voronoi": ([({}, "")], 1e3, "Displacement [mm]", (0, 2.8)),
    "patch-l-block": ([({}, "Voronoi cells"), ({"method.formulation": "delaunay"}, "tetrahedra")], 1e3,
                      "Displacement [mm]", (0, 16)),
}


def draw(example, frames, factor, title, limits):
    files, folders, labels = [], [], []
    for settings, label in frames:
        result = runs.run(f"{example}/b.toml", FIELDS | settings)
        files.append(sorted(result.folder.glob("cells_*.vtu"))[-1])
        folders.append(result.folder)
        labels.append(label)
    size = ("480", "480") if len(frames) == 1 else ("900", "480")
    subprocess.run([sys.executable, HERE / "render.py", ROOT / "examples" / example / "body.png", *files, "--edges",
                    "--quantity", "displacement", "--scale", str(factor), "--title", title, "--labels", *labels,
                    "--range", *map(str, limits), "--from", "1.3", "-2", "1.2", "--size", *size], check=True)
    for folder in folders:
        shutil.rmtree(folder)


def main():
    for example, picture in PICTURES.items():
        draw(example, *picture)


if __name__ == "__main__":
    main()
