#!/usr/bin/env bash
# Two programs share a cache, and one of them is killed at a random moment; over and over. The other
# one ends with the digest of a study without a cache every time, no entry is ever damaged, and what
# both have left serves a last study whole.
#
#   tests/cli/cache_kills.sh PROGRAM [KILLS]     default 1000: takes some minutes
set -euo pipefail

program=$(realpath "$1")
kills=${2:-1000}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >model.toml <<'TOML'
format = 1
kind = "model"
gravity = [0.0, -9.81, 0.0]
[[link]]
name = "arm"
mass = 1.0
center_of_mass = [0.0, -0.5, 0.0]
inertia = [0.02, 0.02, 0.02]
[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "arm"
initial = { position = ["30 deg"] }
[simulation]
end_time = 2.0
step = 1.0e-3
TOML

cat >study.toml <<'TOML'
format = 1
kind = "study"
model = "model.toml"
reference = { set = { "simulation.step" = 5.0e-4 } }
[[vary]]
parameter = "link.arm.mass"
lin = [0.5, 1.5, 60]
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "max"
[[match]]
signal = "joint.A.q"
tolerance = 0.01
TOML

digest() { grep -o 'results digest: [0-9a-f]*' "$1"; }
fail() { echo "cache_kills: $*" >&2; exit 1; }

"$program" study study.toml -o whole >whole.out 2>/dev/null
whole=$(digest whole.out)

for ((i = 1; i <= kills; ++i)); do
  # Every fourth time both begin with nothing.
  if ((i % 4 == 1)); then rm -rf cache; fi
  "$program" study study.toml -o killed --fresh --cache cache >/dev/null 2>&1 &
  victim=$!
  "$program" study study.toml -o other --fresh --cache cache >other.out 2>other.err &
  other=$!
  sleep "0.$(printf '%03d' $((RANDOM % 250)))"
  kill -KILL $victim 2>/dev/null || true
  wait $victim 2>/dev/null || true
  wait $other || fail "kill $i: the other program failed: $(cat other.err)"
  [[ $(digest other.out) == "$whole" ]] || fail "kill $i: another digest"
  if grep -q damaged other.err; then fail "kill $i: $(grep damaged other.err)"; fi
done

"$program" study study.toml -o last --cache cache >last.out 2>last.err
[[ $(digest last.out) == "$whole" ]] || fail "the last study has another digest"
grep -q 'cache cache: 60 rows and 1 reference run taken$' last.err || fail "$(cat last.err)"
echo "$kills kills, every digest as without a cache, no entry damaged"
