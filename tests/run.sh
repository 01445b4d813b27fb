#!/usr/bin/env bash
# Everything that must hold, on a bare Debian 12: installs, builds Release with warnings as errors,
# runs all tests. Time on 2 CPUs: mostly the build. Output: of ctest; its summary comes last.
# With --sanitize: AddressSanitizer and UndefinedBehaviorSanitizer watch, and a finding fails its
# test. That build takes many times as long: a minute a source with Eigen, 1.5 GB a compiler.
# usage: tests/run.sh [--sanitize] [options of ctest]
#        LINKSTUDY_BUILD_DIR=... for another build folder
set -euo pipefail
cd "$(dirname "$0")/.."
exec </dev/null

build=build-tests
options=(-DCMAKE_BUILD_TYPE=Release -DLINKSTUDY_WERROR=ON)
if [ "${1:-}" = --sanitize ]; then
  shift
  build=build-sanitize
  options=(-DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1"
           -DLINKSTUDY_SANITIZE=ON -DLINKSTUDY_BENCH=OFF)
  # Open MPI does not free all it takes. The build runs programs, too.
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
fi
build=${LINKSTUDY_BUILD_DIR:-$build}
jobs=$(nproc)

jobs/install.sh --tests
cmake -S . -B "$build" -G Ninja "${options[@]}"
cmake --build "$build" -j "$jobs"

# Open MPI leaves folders behind, and refuses to run as root without being told twice.
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/linkstudy_tests.XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1

ctest --test-dir "$build" -j "$jobs" --output-on-failure "$@"
