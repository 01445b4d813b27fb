#!/usr/bin/env bash
# A run on the processor that valgrind makes of this one: AVX2 and FMA by other hands, no AVX-512,
# small numbers not flushed to zero, and code translated that was not there when the program began.
# The time histories of a short run must be those of this machine, to the last digit.
# Time: half a minute. Exit code 77 where there is no valgrind.
# usage: valgrind_test.sh LINKSTUDY TREE
set -euo pipefail
program=$1; model=$2/configs/mechanisms/rsrrp.toml

command -v valgrind >/dev/null || { echo "skipped: valgrind is not installed"; exit 77; }
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

run() {  # NAME COMMAND...
  local csv=$dir/$1.csv
  shift
  "$@" "$program" simulate "$model" -s simulation.end_time=0.05 -s simulation.output_interval=1e-3 \
    --progress none --csv "$csv" >/dev/null
}
run native env
[ "$(wc -l < "$dir/native.csv")" -gt 50 ] || { echo "too few rows"; exit 1; }
for kernels in written general; do
  run $kernels env LINKSTUDY_KERNELS=$kernels valgrind --tool=none --quiet
  cmp "$dir/native.csv" "$dir/$kernels.csv" || { echo "$kernels steps differ"; exit 1; }
done
