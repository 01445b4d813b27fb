#!/usr/bin/env bash
# Prints the speed of the step loop as ratios to the trace formulas, and of the written steps of
# every shipped mechanism as ratios to its general loop, with compiler, flags and CPU, and beside
# Simbody if that is installed (Debian: libsimbody-dev; nothing else wants it).
# usage: tests/bench/run.sh [BUILD_DIRECTORY]      takes about two minutes on a built tree
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$top/build}
cmake -S "$top" -B "$build" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$build" -j 2 --target bench_step_loop bench_mechanisms bench_adaptive_lanes \
  bench_dispatch linkstudy >/dev/null
grep -m1 'model name' /proc/cpuinfo || true
grep -E '^CMAKE_CXX_FLAGS_RELEASE|^CMAKE_CXX_COMPILER:' "$build/CMakeCache.txt"
"$build/tests/bench_step_loop"
"$build/tests/bench_mechanisms"
"$build/tests/bench_adaptive_lanes"
python3 -B "$top/tests/bench/study_against_runs.py" "$build/study/linkstudy" "$top"
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  mpirun -n 2 --oversubscribe --bind-to none "$build/tests/bench_dispatch"

# Not grep -q, which would break the pipe.
if cmake --build "$build" --target help | grep bench_peer_simbody >/dev/null; then
  cmake --build "$build" --target bench_peer_simbody -j 2 >/dev/null
  "$build/tests/bench_peer_simbody"
fi
