#!/usr/bin/env python3
"""What writing all fields every hundred steps costs, as a share of the run without it.

Usage: output_cost.py TESSERA [--side N] [--threads T] [--steps S] [--repeats R]

Runs a jittered block of N^3 particles in turn with and without frames of all quantities and compares the best of R
repeats: the wall-clock time of steps and output, and the processor time of the whole process, which other work on the
machine disturbs less. What steps take of the latter is the difference to a run of a single step. All runs set up the same and
write a first and a last frame; those of the runs without hold little more than positions. The first frame also
compresses the constants and makes memory ready; so a frame is what is beyond the difference of two runs of one step,
with and without. On a busy machine wall-clock times say little: the load is printed beside them.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile

CASE = """
[method]
integration = "nodal"
[[body]]
shape = {{ box = {{ min = [0, 0, 0], max = [1, 1, 1] }} }}
particles = {{ lattice = "cubic", counts = [{side}, {side}, {side}], jitter = 0.25, seed = 3 }}
material = "rubber"
[[material]]
name = "rubber"
young = "1 MPa"
poisson = 0.4
density = 1000
[[boundary]]
where = "-z"
condition = "fixed"
[[boundary]]
where = "+z"
velocity = ["0.5*sin(20*t)", 0, "free"]
[gravity]
acceleration = [0, 0, -9.81]
[time]
end = {end}
step = {dt}
[output]
fields = {{ every = {every}, quantities = {quantities} }}
history = {{ every = {end} }}
"""
ALL = ["position", "displacement", "velocity", "force", "internal_force", "contact_force", "external_force",
       "deformation_gradient", "first_piola_kirchhoff", "cauchy_stress", "von_mises", "pressure", "volume", "J", "mass",
       "energy_density", "body", "material", "particle_id"]


def run(tessera, folder, arguments, frames, steps):
    dt = 4.6e-3 / arguments.side
    end = dt * steps
    case = pathlib.Path(folder) / "case.toml"
    case.write_text(CASE.format(side=arguments.side, dt=dt, end=end, every=100 * dt if frames else 2 * end,
                                quantities=json.dumps(ALL if frames else ["mass"])))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([tessera, "run", case, "-o", f"{folder}/out", "--force", "--quiet", "-j", str(arguments.threads)],
                   check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads(pathlib.Path(f"{folder}/out/summary.json").read_text())
    wall = summary["wall_seconds"]
    size = sum(path.stat().st_size for path in pathlib.Path(f"{folder}/out").glob("fields_*.hdf"))
    return {"wall": wall["steps"] + wall["output"], "steps": wall["steps"], "size": size,
            "processor": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "memory": summary["peak_memory_bytes"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tessera")
    parser.add_argument("--side", type=int, default=46)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--steps", type=int, default=600, help="a multiple of 100, at least 200")
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    if arguments.steps % 100 or arguments.steps < 200:
        parser.error("--steps must be a multiple of 100 and at least 200")
    kinds = {"setup": (False, 1), "first": (True, 1), "without": (False, arguments.steps),
             "frames": (True, arguments.steps)}
    runs = {kind: [] for kind in kinds}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(arguments.repeats):
            for kind, (frames, steps) in kinds.items():
                runs[kind].append(run(arguments.tessera, folder, arguments, frames, steps))
    best = {kind: {key: min(r[key] for r in results) for key in results[0]} for kind, results in runs.items()}
    particles, count = arguments.side**3, arguments.steps // 100

    def of_a_frame(key):
        return (best["frames"][key] - best["without"][key] - best["first"][key] + best["setup"][key]) / (count - 1)

    def of_steps(key):
        return (best["without"][key] - best["setup"][key]) / count

    wall = [f"{r['wall']:.2f}" for kind in ("without", "frames") for r in runs[kind]]
    print(f"particles {particles}, threads {arguments.threads}, load {os.getloadavg()[0]:.1f}")
    print(f"wall-clock of steps and output [s]: without {wall[:arguments.repeats]}, with {wall[arguments.repeats:]}")
    for key, name in (("wall", "wall-clock time"), ("processor", "processor time")):
        frame, steps = of_a_frame(key), of_steps(key)
        print(f"{name}: frame {1e6 * frame / particles:.2f} us a particle, 100 steps {1e6 * steps / particles:.2f} us "
              f"a particle: {100 * frame / steps:.1f} %")
    print(f"file {best['frames']['size'] / (count + 1) / particles:.0f} bytes a particle; peak memory "
          f"{(best['frames']['memory'] - best['without']['memory']) / particles:+.0f} bytes a particle")


if __name__ == "__main__":
    main()
