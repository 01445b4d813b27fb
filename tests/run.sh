#!/usr/bin/env bash
# Everything that must hold, on a bare Debian 12: installs, builds Release with warnings as errors,
# runs all tests. Time on 2 CPUs: mostly the build. Output: of ctest; its summary comes last.
# usage: tests/run.sh [options of ctest]        LINKSTUDY_BUILD_DIR=... for another build folder
set -euo pipefail
cd "$(dirname "$0")/.."
exec </dev/null

build=${LINKSTUDY_BUILD_DIR:-build-tests}
jobs=$(nproc)

jobs/install.sh
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLINKSTUDY_WERROR=ON
cmake --build "$build" -j "$jobs"

# Open MPI leaves folders behind, and refuses to run as root without being told twice.
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/linkstudy_tests.XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1

ctest --test-dir "$build" -j "$jobs" --output-on-failure "$@"
