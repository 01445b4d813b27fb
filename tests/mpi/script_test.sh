#!/usr/bin/env bash
# jobs/mpirun_study.sh as a user meets it: keys, signals, mistakes. Waits for states.
# usage: script_test.sh LINKSTUDY TREE
set -u
program=$(readlink -f "$1"); script=$(readlink -f "$2")/jobs/mpirun_study.sh
dir=$(mktemp -d "${TMPDIR:-/tmp}/script_test.XXXXXX"); export TMPDIR=$dir
trap 'rm -rf "$dir"' EXIT
export OMPI_MCA_pml=ob1 LINKSTUDY_LANES=1
fail() { echo "FAILED: $*"; cat "$dir/err"; [ -z "${job:-}" ] || kill -TERM "$job"; exit 1; }
wait_until() {
  local what=$1 end=$((SECONDS + 60)); shift
  until "$@"; do [ $SECONDS -lt $end ] || fail "not within 60 s: $what"; sleep 0.1; done
}

cp "$(dirname "$script")/../configs/mechanisms/rsrrp.toml" "$dir/model.toml"
write_study() {  # FILE END_TIME
  cat >"$dir/$1" <<END
format = 1
kind = "study"
model = "model.toml"
base = { set = { "closure.S.model" = "sde", "simulation.step" = 1e-4, "simulation.end_time" = $2 } }
[[vary]]
parameter = "closure.S.sde.stiffness"
values = [1e4, 2e4, 3e4, 4e4, 5e4, 6e4, 7e4, 8e4]
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "last"
END
}
write_study short.toml 150.0
write_study endless.toml 2e5
mkdir "$dir/elsewhere"; cd "$dir/elsewhere" || exit 1

has_finished() { "$program" status "$dir/$1" --json | grep -q '"finished":[1-9]'; }
is_working() { grep -q " left" "$dir/$1/linkstudy.log" 2>/dev/null; }
start() {  # FILE DIR
  LINKSTUDY=$program bash -c 'trap - INT; exec "$@"' - "$script" study "$dir/$1" "$dir/$2" \
    >"$dir/out" 2>"$dir/err" & job=$!
  wait_until "the study has begun" is_working "$2"
}
expect_75() {
  wait "$job"; local code=$?
  [ $code -eq 75 ] || fail "$1: exit code $code"
  echo "ok: $1 exits with 75"
}

for signal in TERM HUP; do
  start endless.toml "$signal"
  kill -s $signal "$job"
  expect_75 "$signal, with long evaluations in flight,"
done
start endless.toml keys
kill -USR1 "$job"
wait_until "the first is understood" grep -q "once more cancels it" "$dir/err"
kill -USR1 "$job"
expect_75 "the second Ctrl-C, with long evaluations in flight,"
start short.toml finish
wait_until "the first is done" has_finished finish
kill -USR1 "$job"
expect_75 "the first Ctrl-C"
"$program" status "$dir/finish" --json | grep -q '"finished":[1-7],' ||
  fail "what was in flight is not finished"
LINKSTUDY=$program "$script" study "$dir/short.toml" "$dir/finish" >"$dir/out" 2>"$dir/err" ||
  fail "the same command does not go on"
grep -q "^results digest: " "$dir/out" || fail "no digest at the end"
mkdir "$dir/folder"; cp "$dir/model.toml" "$dir/folder"
write_study folder/short.toml 150.0
LINKSTUDY=$program "$script" queue "$dir/folder" --json >"$dir/out" 2>"$dir/err" ||
  fail "a folder is not run"
grep -q '"state":"done".*"digest":"'"$("$program" status "$dir/finish" --json |
  sed -n 's/.*"digest":"\([0-9a-f]*\)".*/\1/p')"'"' "$dir/out" || fail "another digest in a folder"
"$script" queue 2>"$dir/err" && fail "a folder that is not named"
grep -q "queue FOLDER" "$dir/err" || fail "no usage"
LINKSTUDY=$dir/nowhere "$script" study "$dir/short.toml" "$dir/none" 2>"$dir/err"
[ $? -eq 2 ] && grep -q "there is no program $dir/nowhere" "$dir/err" ||
  fail "a missing program is not named"
echo "ok: goes on, runs a folder, and names a program that is missing"
