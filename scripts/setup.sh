#!/usr/bin/env bash
# Installs the Debian packages that Tessera needs and that are missing.
# Usage: setup.sh [--test] [--list]
#   --test  also what only some tests need
#   --list  print what is missing and change nothing (status 1 when something required is)
# Without the right to install it prints the one line to run; it fails only when a required package is missing.
set -euo pipefail

# The libraries of cmake/TesseraDependencies.cmake, and the tools that build and test.
required=(g++ cmake ninja-build python3 libeigen3-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev
          libfmt-dev libmuparser-dev libcgal-dev voro++-dev libhdf5-dev zlib1g-dev libgtest-dev)
optional=()  # what only some tests need
list_only=no
for argument in "$@"; do
  case "$argument" in
    # Read result files as ParaView does; count instructions; build the benchmarks; mesh surfaces with gmsh.
    --test) optional+=(python3-vtk9 python3-numpy valgrind libbenchmark-dev gmsh) ;;
    --list) list_only=yes ;;
    *) echo "setup.sh: unknown argument '$argument' (allowed: --test, --list)" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg >/dev/null; then
  echo "setup: no dpkg here; nothing was checked. Debian calls what Tessera needs: ${required[*]} ${optional[*]}" >&2
  exit 0
fi

installed() { dpkg -s "$1" 2>/dev/null | grep -q '^Status: install ok installed$'; }
missing_of() { for package in "$@"; do installed "$package" || printf '%s\n' "$package"; done; }
mapfile -t missing_required < <(missing_of "${required[@]}")
mapfile -t missing_optional < <(missing_of "${optional[@]}")
missing=("${missing_required[@]}" "${missing_optional[@]}")

if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all packages are installed"
  exit 0
fi
if [ $list_only = yes ]; then
  printf '%s\n' "${missing[@]}"
  [ ${#missing_required[@]} -eq 0 ]; exit
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo -n)
  else
    echo "setup: these packages are missing; install them with" >&2
    echo "  sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
    [ ${#missing_required[@]} -eq 0 ] && echo "setup: all of them are optional; going on without" >&2
    [ ${#missing_required[@]} -eq 0 ]; exit
  fi
fi

echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
