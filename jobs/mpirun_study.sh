#!/usr/bin/env bash
# Runs (or continues) one study or tuning on this machine with plain mpirun.
# Time: that of the study. Ctrl-C or SIGTERM end it resumable (exit 75); the same command goes on.
# Output: the table of the study here, its results in DIR.
# usage: jobs/mpirun_study.sh study|tune FILE DIR [options of linkstudy]
#        RANKS=8 LINKSTUDY=path/to/linkstudy to change the defaults
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: jobs/mpirun_study.sh study|tune FILE DIR [options of linkstudy]" >&2
  exit 2
fi
verb=$1; file=$2; results=$3; shift 3

linkstudy=${LINKSTUDY:-$(dirname "$0")/../build/study/linkstudy}
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
exec mpirun -n "${RANKS:-2}" --oversubscribe --bind-to none \
  "$linkstudy" "$verb" "$file" -o "$results" "$@"
