#!/bin/bash
# Configures the core as packagers do: their flags must win, asserts stay, and tests are only built by the target `tests`.
# usage: packagers_build.sh SOURCE_DIRECTORY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "packagers_build: $1" >&2; cat "$work/log" >&2; exit 1; }

# configure OPTION ...: leaves the commands that compile C++ in $work/commands
configure() {
  rm -rf "$work/build"
  cmake -S "$source" -B "$work/build" -DSDF_CCD_ROS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" > "$work/log" 2>&1 || fail "$* fails"
  grep '"command": .*c++ ' "$work/build/compile_commands.json" > "$work/commands"
}

configure -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS="-fstack-protector" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DNDEBUG" \
  -DCMAKE_CXX_STANDARD=20
grep -q -- '-fstack-protector -O1 -g1' "$work/commands" || fail "flags are not the packager's"
! grep -q -- '-O3\|-DNDEBUG\|std=c++17' "$work/commands" || fail "flags are not the packager's, or asserts are off"

configure -DCMAKE_BUILD_TYPE=None
! grep -q -- '-O[0-9]' "$work/commands" || fail "the build type None has flags"

configure
grep -q -- '-O3' "$work/commands" || fail "a plain build is slow"
! grep -q -- '-DNDEBUG' "$work/commands" || fail "a plain build has no asserts"
make -C "$work/build" -kn all > "$work/log" 2>&1 || true  # nothing is made, so that some of it is missed
! grep -q 'test_allocations' "$work/log" || fail "tests are part of all"
make -C "$work/build" -kn tests > "$work/log" 2>&1 || true  # nothing is made, so that some of it is missed
grep -q 'test_allocations' "$work/log" || fail "the target tests builds none"

configure -DCATKIN_ENABLE_TESTING=OFF
! grep -q '_test\.cpp' "$work/commands" || fail "CATKIN_ENABLE_TESTING=OFF has tests"
echo "packager's build: good"
