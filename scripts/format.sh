#!/usr/bin/env bash
# Formats all C++ files in place, or with --check only says which are not formatted (status 1).
# Status 77 (which CTest counts as skipped) when clang-format 14, the version of Debian 12, is not there.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
  "") mode=(-i) ;;
  --check) mode=(--dry-run -Werror) ;;
  *) echo "usage: format.sh [--check]" >&2; exit 2 ;;
esac

clang_format=
for candidate in clang-format-14 clang-format; do
  if command -v "$candidate" >/dev/null && "$candidate" --version | grep -q 'version 14\.'; then
    clang_format=$candidate
    break
  fi
done
if [ -z "$clang_format" ]; then
  echo "format: SKIPPED, clang-format 14 is not installed (Debian: clang-format)"
  exit 77
fi
find src tests docs benchmarks \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z | xargs -0 "$clang_format" "${mode[@]}"
