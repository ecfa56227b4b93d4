#!/usr/bin/env python3
"""Runs clang-tidy on all sources of a configured build and says how far it is. Usage: tidy.py BUILD_DIR [PART...]
Files whose path holds one of the PARTs are looked at, all without. What was found free of faults is not looked at again
until it, a header that it includes, its compile command, .clang-tidy or clang-tidy itself has changed; BUILD_DIR/tidy
remembers. JOBS is the number of files at a time."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def included_files(build):
    """The headers of each object as the last build recorded them; an object that was not built has none."""
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=False).stdout
    headers, current = {}, None
    for line in listing.splitlines():
        if line.startswith("    "):
            headers[current].append(line.strip())
        elif ": #deps" in line:
            current = line.split(": #deps")[0]
            headers[current] = []
    return headers


def project_headers():
    return sorted(str(path) for path in (ROOT / "src").rglob("*.hpp"))


def digest_of(build, entry, headers, constants):
    """Of all that the result depends on; headers of the system are taken to stay as they are."""
    digest = hashlib.sha256(constants)
    digest.update(entry["command"].encode())
    made = re.search(r" -o (\S+)", entry["command"])
    names = headers.get(made[1] if made else "") or project_headers()
    for name in [entry["file"], *(name for name in names if not name.startswith("/usr/"))]:
        path = pathlib.Path(build, name).resolve()
        if path.is_relative_to(ROOT) and path.is_file():
            digest.update(path.read_bytes())
    return digest.hexdigest()


def examine(build, file):
    command = ["clang-tidy", "-p", build, "--quiet", "--warnings-as-errors=*", file]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def main():
    build, parts = sys.argv[1], sys.argv[2:]
    entries = [e for e in json.loads(pathlib.Path(build, "compile_commands.json").read_text())
               if pathlib.Path(e["file"]).is_relative_to(ROOT / "src")
               and (not parts or any(part in e["file"] for part in parts))]
    constants = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    for path in [ROOT / ".clang-tidy", *sorted((ROOT / "src").rglob(".clang-tidy"))]:
        constants += path.read_bytes()
    headers = included_files(build)
    stamps = pathlib.Path(build, "tidy")
    stamps.mkdir(exist_ok=True)
    waiting = [(e["file"], stamps / digest_of(build, e, headers, constants)) for e in entries]
    waiting = [(file, stamp) for file, stamp in waiting if not stamp.exists()]
    print(f"clang-tidy: {len(waiting)} of {len(entries)} files to look at", flush=True)
    faulty = 0
    jobs = int(os.environ.get("JOBS", os.cpu_count()))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        runs = {pool.submit(examine, build, file): (file, stamp) for file, stamp in waiting}
        for number, run in enumerate(concurrent.futures.as_completed(runs), 1):
            file, stamp = runs[run]
            result = run.result()
            if result.returncode == 0:
                stamp.touch()
            else:
                faulty += 1
                print(result.stdout + result.stderr, flush=True)
            if result.returncode != 0 or number % 10 == 0 or number == len(waiting):
                print(f"clang-tidy: {number}/{len(waiting)} {pathlib.Path(file).relative_to(ROOT)}", flush=True)
    if faulty:
        print(f"clang-tidy: {faulty} files with faults", file=sys.stderr)
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
