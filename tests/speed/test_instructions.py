"""Guards the step against getting slower: counts its instructions, which repeat where times do not.

Usage: test_instructions.py PROGRAM [--update]. Runs PROGRAM (step_program) under callgrind with few and with more steps;
the difference is what steps cost. It must not be above the number in instructions.json by more than the tolerance, nor so
far below that the number has lost its meaning. --update writes the numbers of now: do so together with the change that
explains them, and say in the commit why. Numbers belong to one instruction set (valgrind knows AVX2); elsewhere, or
without valgrind, the test is skipped (status 77).
"""

import json
import pathlib
import platform
import re
import shutil
import subprocess
import sys

RECORD = pathlib.Path(__file__).with_name("instructions.json")
FEW, MORE = 2, 7
SKIPPED = 77


def run(program, formulation, steps):
    """Instructions and particles of one run."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, formulation, str(steps)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed with status {done.returncode}:\n{done.stderr}")
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1)), int(done.stdout)


def instructions_per_particle_step(program, formulation):
    few, particles = run(program, formulation, FEW)
    more, _ = run(program, formulation, MORE)
    return (more - few) / (MORE - FEW) / particles


def has_avx2():
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    return platform.machine() == "x86_64" and cpuinfo.exists() and " avx2 " in cpuinfo.read_text(encoding="ascii")


def main():
    if shutil.which("valgrind") is None or not has_avx2():
        print("skipped: needs valgrind and a processor with AVX2")
        return SKIPPED
    program = sys.argv[1]
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    now = {name: round(instructions_per_particle_step(program, name)) for name in record["instructions_per_particle_step"]}
    if "--update" in sys.argv:
        record["instructions_per_particle_step"] = now
        RECORD.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
        print(f"recorded {now}")
        return 0
    failed = False
    for name, recorded in record["instructions_per_particle_step"].items():
        print(f"{name}: {now[name]} instructions a particle and step, recorded {recorded}")
        failed |= abs(now[name] - recorded) > record["tolerance"] * recorded
    if failed:
        print(f"more than {record['tolerance']:.0%} away from the record; if the change is meant, run with --update")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
