#!/usr/bin/env bash
# Builds each preset given and runs all its tests, also when an earlier preset failed; ends with one line of numbers
# for each. Usage: test.sh PRESET...
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
[ $# -gt 0 ] || { echo "usage: test.sh PRESET..." >&2; exit 2; }

# attribute NAME FILE: the number in NAME="..." of the first element of a JUnit file.
attribute() { grep -o "$1=\"[0-9]*\"" "$2" | head -n 1 | grep -o '[0-9]*'; }

# Builds and tests one preset; leaves its line of numbers in `said`.
run_preset() {
  local preset=$1 results="$PWD/build/$1/test-results.xml"
  rm -f "$results"
  echo "== $preset: build"
  if ! make --no-print-directory build PRESET="$preset"; then said="$preset: the build FAILED"; return 1; fi
  echo "== $preset: tests"
  # The published cases take minutes and do not depend on the optional components, so only the full build repeats them.
  local left_out=()
  [ "$preset" = minimal ] && left_out=(--label-exclude verification)
  ctest --preset "$preset" "${left_out[@]}" --output-junit "$results"
  local status=$?
  if [ ! -s "$results" ]; then said="$preset: no test ran"; return 1; fi
  local total failed skipped
  total=$(attribute tests "$results") failed=$(attribute failures "$results")
  skipped=$(($(attribute skipped "$results") + $(attribute disabled "$results")))
  said="$preset: $((total - skipped)) tests ran, $failed failed, $skipped skipped"
  [ $status -eq 0 ] && [ "$total" -gt "$skipped" ]
}

status=0
summary=()
for preset in "$@"; do
  run_preset "$preset" || status=1
  summary+=("$said")
done
echo
echo "== summary"
printf '%s\n' "${summary[@]}"
[ $status -eq 0 ] && echo "all tests passed" || echo "FAILED"
exit $status
