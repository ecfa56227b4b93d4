#!/usr/bin/env bash
# Runs the punch example and says what to look at. Usage: demo.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/bin/tessera}
out=demo.out

"$program" run examples/punch-voronoi/punch.toml -o "$out" --force
echo
echo "The result is in $out/:"
echo "  fields    paraview $out/fields.hdf.series"
echo "  cells     paraview $out/cells.pvd"
echo "  history   $out/history.csv   (energies, momenta, the force on the punch)"
# The reaction of the probe "punch" in the last row; columns are found by their names in the header.
awk -F, '
  NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
  { last = $0 }
  END {
    if (!("punch.fy[N]" in column) || last == "") { print "demo: no punch force in history.csv" > "/dev/stderr"; exit 1 }
    split(last, v, ",")
    printf "Force on the punch at t = %g s: (%.6g, %.6g, %.6g) N\n", v[column["t[s]"]], v[column["punch.fx[N]"]],
           v[column["punch.fy[N]"]], v[column["punch.fz[N]"]]
  }' "$out/history.csv"
