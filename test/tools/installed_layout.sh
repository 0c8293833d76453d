#!/bin/bash
# Installs the build, moves the installation, and uses it there: the tool must find the program that reads meshes, and CMake
# the libraries, with which the examples are built and run.
# usage: installed_layout.sh BUILD_DIRECTORY LIB_DIRECTORY BIN_DIRECTORY DATA_DIRECTORY
set -euo pipefail
build=$1 lib=$2 bin=$3 data=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "installed_layout: $1" >&2; cat "$work/log" >&2; exit 1; }

# With DESTDIR set, the installation would go elsewhere.
env -u DESTDIR cmake -DCMAKE_INSTALL_PREFIX="$work/first" -P "$build/cmake_install.cmake" > "$work/log" 2>&1 || fail "no install"
mv "$work/first" "$work/moved"
for reader in sdf_ccd_read sdf_ccd_read_with_libraries; do
  [ -x "$work/moved/$lib/sdf_ccd/$reader" ] || fail "$reader is not in $lib/sdf_ccd"
done
tool=$work/moved/$bin/sdf_ccd
export LD_LIBRARY_PATH=$work/moved/$lib:${LD_LIBRARY_PATH:-}

cd /
build_mesh() { "$tool" build --mesh "$data/prism_12.off" --resolution 8 --out "$work/made" > "$work/log" 2>&1; }
build_mesh || fail "the moved tool reads no mesh"
# The reader is found relative to the library's path, also if that path is a relative one.
cd "$work/moved"
LD_LIBRARY_PATH=$lib "$tool" build --mesh "$data/prism_12.off" --resolution 8 --out "$work/made" > "$work/log" 2>&1 ||
  fail "no mesh is read where the library's path is relative"
cd /
mv "$work/moved/$lib/sdf_ccd/sdf_ccd_read" "$work/elsewhere"
status=0; build_mesh || status=$?
[ $status = 2 ] && grep -q "cannot find the helper program sdf_ccd_read in" "$work/log" || fail "status $status without the reader"
SDF_CCD_READER=$work/elsewhere build_mesh || fail "SDF_CCD_READER is not followed"
mv "$work/elsewhere" "$work/moved/$lib/sdf_ccd/sdf_ccd_read"

# The examples' own paths lead to the libraries.
env -u LD_LIBRARY_PATH "$(dirname "${BASH_SOURCE[0]}")/installed_examples.sh" "$work/moved" "$work/examples" > "$work/log" 2>&1 ||
  fail "the examples fail"
echo "installed layout: good"
