#!/usr/bin/env bash
# From a fresh clone on Debian 12 to the answer: installs, builds, and runs the main job over MPI:
# the lowest stiffness of a replacement joint that still gives the force of the exact joint.
# Time on 2 CPUs: some minutes to install and build, under two minutes to run.
# Output: two tables here; results/quickstart_stiffness and results/quickstart_tune, and a page
# with charts and the moving mechanism, for a browser: results/quickstart_tune/report.html.
# usage: jobs/quickstart.sh          RANKS=4 jobs/quickstart.sh for more processes than two
set -euo pipefail
cd "$(dirname "$0")/.."

build=${LINKSTUDY_BUILD_DIR:-build}
ranks=${RANKS:-2}

jobs/install.sh
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build "$build" --target linkstudy
linkstudy=$build/study/linkstudy

if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
launch=(mpirun -n "$ranks" --oversubscribe --bind-to none "$linkstudy")
begin=$SECONDS

printf '\n--- The error of the joint force over the stiffness of the joint\n\n'
"${launch[@]}" study configs/studies/rsrrp_stiffness.toml -o results/quickstart_stiffness --fresh

printf '\n--- The lowest stiffness within 2 %% of the exact joint, with its certificate\n\n'
"${launch[@]}" tune configs/studies/rsrrp_tune.toml -o results/quickstart_tune --fresh

printf '\n--- To look at: '
"$linkstudy" report results/quickstart_tune

printf '\nrun in %d s; next: %s status results/quickstart_tune, README.md\n' \
  $((SECONDS - begin)) "$linkstudy"
