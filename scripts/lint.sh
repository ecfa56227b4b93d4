#!/usr/bin/env bash
# All checks that need no run: layers, format, clang-tidy over a configured build. Usage: lint.sh [BUILD_DIR]
# Tools that are not installed are skipped and named.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
build=${1:-build/dev}
status=0

echo "== layers"
python3 scripts/check_layers.py || status=1

echo "== format"
scripts/format.sh --check
case $? in 0 | 77) ;; *) status=1 ;; esac

echo "== clang-tidy"
if ! command -v clang-tidy >/dev/null; then
  echo "clang-tidy: SKIPPED, not installed (Debian: clang-tidy)"
elif [ ! -f "$build/compile_commands.json" ]; then
  echo "clang-tidy: $build/compile_commands.json is missing; configure first (cmake --preset dev)" >&2
  status=1
else
  python3 scripts/tidy.py "$build" || status=1
fi

[ $status -eq 0 ] && echo "lint: no faults" || echo "lint: FAILED" >&2
exit $status
