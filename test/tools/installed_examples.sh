#!/bin/bash
# Builds the examples against an installed sdf_ccd, and runs them; compiles README.md's C++.
# usage: installed_examples.sh PREFIX BUILD_DIRECTORY
set -euo pipefail
prefix=$1 build=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
options=(-DCMAKE_PREFIX_PATH="$prefix")
if command -v ccache > /dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S "$here/../../examples" -B "$build" "${options[@]}"
# Not one that this machine has elsewhere.
grep "^sdf_ccd_DIR:PATH=$(realpath "$prefix")/" "$build/CMakeCache.txt"
make -C "$build" --no-print-directory
cmake -S "$here/readme" -B "$build/readme" "${options[@]}"
make -C "$build/readme" --no-print-directory
cd "$build"
ctest --output-on-failure
