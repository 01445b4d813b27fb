#!/usr/bin/env bash
# Runs (or continues) one file, or a folder of them, on this machine with plain mpirun.
# Time: that of the work. The first Ctrl-C (or SIGUSR1) lets evaluations in flight finish; a second
# one, SIGTERM and SIGHUP cancel them at once. All end resumable: exit 75, the same command goes on.
# Output: the table here, results in DIR, or of FOLDER in FOLDER/results.
# usage: jobs/mpirun_study.sh study|tune|calibrate|converge FILE DIR [options of linkstudy]
#        jobs/mpirun_study.sh queue FOLDER [options of linkstudy]
#        RANKS=8 LINKSTUDY=path/to/linkstudy to change the defaults
set -euo pipefail
if [ "${1:-}" = queue ] && [ $# -ge 2 ]; then
  work=(queue "$2"); shift 2
elif [ "${1:-}" != queue ] && [ $# -ge 3 ]; then
  work=("$1" "$2" -o "$3"); shift 3
else
  echo "usage: jobs/mpirun_study.sh study|tune|calibrate|converge FILE DIR [options]" >&2
  echo "       jobs/mpirun_study.sh queue FOLDER [options of linkstudy]" >&2
  exit 2
fi

linkstudy=${LINKSTUDY:-$(dirname "$(readlink -f "$0")")/../build/study/linkstudy}
for program in "$linkstudy" mpirun; do
  command -v "$program" >/dev/null && continue
  echo "mpirun_study.sh: there is no program $program; build it (jobs/quickstart.sh) or set" \
    "LINKSTUDY=path" >&2
  exit 2
done
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi

# Rank 0 makes this file once all ranks are up: a signal before that would end mpirun itself.
ready_folder=$(mktemp -d)
trap 'rm -rf "$ready_folder"' EXIT
export LINKSTUDY_READY=$ready_folder/ready

# What the program is to be asked for; mpirun passes on SIGUSR1 (finish) and SIGUSR2 (cancel) and
# exits with the code of its ranks. SIGTERM and Ctrl-C it would turn into a kill and exit code 1, so
# it gets a process group of its own, away from the keys of the terminal.
wanted=; passed=
ask_to_finish() {
  if [ -z "$wanted" ]; then
    wanted=USR1
    echo "mpirun_study.sh: what is in flight ends; once more cancels it" >&2
  else
    wanted=USR2
  fi
}
trap ask_to_finish INT USR1
trap 'wanted=USR2' TERM HUP USR2

set -m
mpirun -n "${RANKS:-2}" --oversubscribe --bind-to none \
  "$linkstudy" "${work[@]}" "$@" </dev/null &
job=$!
set +m

while kill -0 "$job" 2>/dev/null; do
  if [ "$wanted" = "$passed" ]; then
    wait "$job" || true  # a trapped signal ends it early
  elif [ -e "$LINKSTUDY_READY" ]; then
    passed=$wanted
    kill -s "$wanted" "$job" 2>/dev/null || true
  else
    sleep 0.1
  fi
done
code=0; wait "$job" || code=$?
exit "$code"
