#!/usr/bin/env python3
"""Checks that the folders of src/tessera are what docs/architecture.md says they are.

Usage: check_layers.py [ROOT]      (ROOT: the repository, by default the one that holds this script)

Faults, one per line as file:line: message, and exit status 1:
- a layer includes a header of a layer that is not in the transitive closure of its USES,
- the USES lists form a cycle or name a layer that does not exist,
- a quoted include does not start with "tessera/<layer>/",
- threads or processes are mentioned outside the layer `parallel` (`#pragma omp simd` is allowed),
- a file is longer than 500 lines.
"""
import pathlib
import re
import sys

MAX_LINES = 500
SOURCES = {".hpp", ".cpp", ".h", ".cc"}
USES = re.compile(r"tessera_layer\s*\(\s*\w+([^)]*)\)", re.S)
LINKED = re.compile(r"target_link_libraries\s*\(([^)]*)\)", re.S)
INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')
PARALLEL = re.compile(
    r"<(omp|mpi)\.h>|<(thread|future|execution)>|#\s*pragma\s+omp\b(?!\s+simd\b)|std::(jthread|thread|async)\b"
    r"|\b_Pragma\s*\(\s*\"omp\b(?!\s+simd\b)|\b(MPI|omp)_\w+\s*\("
)


def read_uses(layer_dir, layers):
    """The layers that a CMakeLists.txt names after USES, or links to as tessera_<layer>."""
    text = re.sub(r"#.*", "", (layer_dir / "CMakeLists.txt").read_text())
    used = []
    for arguments in USES.findall(text):
        words = arguments.split()
        if "USES" in words:
            rest = words[words.index("USES") + 1 :]
            used += rest[: rest.index("LINKS")] if "LINKS" in rest else rest
    for arguments in LINKED.findall(text):
        targets = [word for word in arguments.split()[1:] if word.startswith("tessera_")]
        used += [t.removeprefix("tessera_") for t in targets if t.removeprefix("tessera_") in layers]
    return used


def closure(layer, uses, path=()):
    """All layers below `layer`; raises ValueError that names the cycle."""
    if layer in path:
        raise ValueError(" -> ".join((*path[path.index(layer) :], layer)))
    below = set()
    for used in uses.get(layer, []):
        below |= {used} | closure(used, uses, (*path, layer))
    return below


def check_line(line, layer, allowed, layers):
    """What is wrong with one line of a file of `layer`, or None."""
    include = INCLUDE.match(line)
    if include:
        parts = include.group(1).split("/")
        if len(parts) < 3 or parts[0] != "tessera" or parts[1] not in layers:
            return f'"{include.group(1)}" is not of the form "tessera/<layer>/<file>"'
        if parts[1] not in allowed:
            return f"layer {layer} may not include {include.group(1)}: {parts[1]} is not in its USES"
    if layer != "parallel" and PARALLEL.search(line.split("//")[0]):
        return "threads and processes belong to the layer parallel"
    return None


def check_tree(root):
    """All faults of the tree as strings, and the numbers of files and layers looked at."""
    source = root / "src" / "tessera"
    layers = sorted(d.name for d in source.iterdir() if (d / "CMakeLists.txt").is_file())
    uses = {layer: read_uses(source / layer, layers) for layer in layers}
    faults = [
        f"src/tessera/{layer}/CMakeLists.txt:1: USES names {used}, which is no layer"
        for layer in layers
        for used in uses[layer]
        if used not in layers
    ]
    files = sorted(f for f in source.rglob("*") if f.suffix in SOURCES)
    try:
        below = {layer: closure(layer, uses) for layer in layers}
    except ValueError as cycle:
        return [*faults, f"src/tessera/CMakeLists.txt:1: the layers form a cycle: {cycle}"], len(files), len(layers)
    for file in files:
        name, layer = file.relative_to(root), file.relative_to(source).parts[0]
        if layer not in layers:
            faults.append(f"{name}:1: is in no layer")
            continue
        lines = file.read_text().splitlines()
        if len(lines) > MAX_LINES:
            faults.append(f"{name}:{len(lines)}: {len(lines)} lines, at most {MAX_LINES} are allowed: split by theme")
        for number, line in enumerate(lines, 1):
            fault = check_line(line, layer, below[layer] | {layer}, layers)
            if fault:
                faults.append(f"{name}:{number}: {fault}")
    return faults, len(files), len(layers)


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    if not (root / "src" / "tessera").is_dir():
        print(f"{root}: has no folder src/tessera", file=sys.stderr)
        return 2
    faults, files, layers = check_tree(root)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{files} files in {layers} layers, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
