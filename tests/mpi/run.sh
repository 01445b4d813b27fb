#!/bin/sh
# Runs test_mpi over N processes and holds the exit code of every one of them.
# usage: run.sh TEST_MPI N checks                   all sentences hold
#        run.sh TEST_MPI N stop RANK                that rank gets SIGTERM: all exit 75
#        run.sh TEST_MPI N pass-on                  mpirun gets SIGUSR1, passes it on: all exit 75
#        run.sh TEST_MPI N end                      mpirun gets SIGTERM: rank 0 has time to sync
#        run.sh TEST_MPI N die                      rank 1 is killed: rank 0 has time to sync
#        run.sh TEST_MPI N abandon                  two SIGUSR1, minutes of work left: all exit 75
#        run.sh TEST_MPI N cancel                   SIGUSR2, minutes in flight: all exit 75
#        run.sh TEST_MPI N serial-copies            another library's launcher: explained, exit 2
#        run.sh TEST_MPI N measure                  prints throughput
set -u
program=$1; ranks=$2; check=$3; argument=${4:-}
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/mpi.XXXXXX"); export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1
export OMPI_MCA_orte_abort_on_non_zero_status=0

fail() {
  echo "FAILED: $*"
  [ -z "${job:-}" ] || kill -KILL "$job" 2>/dev/null
  exit 1
}

# Each rank leaves its exit code in a file: mpirun itself tells only one.
launch() {
  [ -z "${unwrapped:-}" ] ||
    exec mpirun -n "$ranks" --oversubscribe --bind-to none "$program" "$@"
  exec mpirun -n "$ranks" --oversubscribe --bind-to none sh -c '
    trap "" TERM USR1 USR2 INT
    "$@" & child=$!
    wait $child; echo $? >"$TMPDIR/code.$OMPI_COMM_WORLD_RANK"' - "$program" "$@"
}

wait_for_file() {
  tries=0
  until [ -e "$1" ]; do
    tries=$((tries + 1)); [ $tries -le 600 ] || fail "no work under way after 60 s"
    sleep 0.1
  done
}

expect_codes() {
  rank=0
  while [ $rank -lt "$ranks" ]; do
    code=$(cat "$TMPDIR/code.$rank" 2>/dev/null || echo none)
    [ "$code" = "$1" ] || fail "rank $rank exits with $code, not $1"
    rank=$((rank + 1))
  done
  echo "ok: $ranks ranks exit with $1"
}

case $check in
  checks | measure)
    launch "$check" & wait $! || fail "mpirun exits with $?"
    expect_codes 0 ;;
  stop)
    launch stop "$argument" 15 "$TMPDIR/marker" & wait $!
    expect_codes 75 ;;
  pass-on)
    launch stop -1 0 "$TMPDIR/marker" & job=$!
    wait_for_file "$TMPDIR/marker"
    kill -USR1 $job; wait $job
    expect_codes 75 ;;
  end)
    # Once one rank has gone, this mpirun kills the rest: of the others no code is due.
    launch stop -1 0 "$TMPDIR/marker" & job=$!
    wait_for_file "$TMPDIR/marker"
    kill -TERM $job; wait $job && fail "an ended mpirun exits with 0"
    [ -e "$TMPDIR/marker.synced" ] || fail "rank 0 was killed before it could sync"
    if cat "$TMPDIR"/code.* 2>/dev/null | grep -qv 75; then fail "a rank fails on its way out"; fi
    echo "ok: synced" ;;
  die)
    OMPI_MCA_orte_abort_on_non_zero_status=1
    unwrapped=yes
    launch stop 1 9 "$TMPDIR/marker" & wait $! && fail "a dead rank goes unnoticed"
    [ -e "$TMPDIR/marker.synced" ] || fail "rank 0 was killed before it could sync"
    echo "ok: synced" ;;
  abandon)
    launch abandon "$TMPDIR/marker" & job=$!
    wait_for_file "$TMPDIR/marker"
    kill -USR1 $job; sleep 1; kill -USR1 $job; wait $job
    expect_codes 75 ;;
  cancel)
    launch cancel "$TMPDIR/marker" & job=$!
    wait_for_file "$TMPDIR/marker"
    kill -USR2 $job; wait $job
    expect_codes 75 ;;
  serial-copies)
    PMI_SIZE=$ranks PMI_RANK=0 "$program" checks >"$TMPDIR/out" 2>&1
    [ $? -eq 2 ] || fail "a serial copy goes on"
    grep -q "started $ranks processes, but this one sees 1" "$TMPDIR/out" || fail "no explanation"
    echo "ok: explained, exit 2" ;;
  *) fail "unknown check '$check'" ;;
esac
