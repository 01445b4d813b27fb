#!/usr/bin/env bash
# An installed program, as a package and by cmake --install, works away from its clone: it runs a
# shipped study from the installed configs, its manual is there, and its Python module reads the
# results.
# usage: install_test.sh BUILD_DIR PYTHON
set -euo pipefail
build=$1
python=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/by_hand" >/dev/null
if ! (cd "$build" && cpack -B "$work/package") >"$work/cpack.log" 2>&1; then
  cat "$work/cpack.log"
  exit 1
fi
package=$(echo "$work"/package/*.deb)
dpkg-deb -x "$package" "$work/unpacked"

needs=$(dpkg-deb -f "$package" Depends)
for name in openmpi-bin libnlopt0 libhdf5 libboost-program-options libopenmpi3; do
  case $needs in
    *$name*) ;;
    *) echo "the package does not name $name: $needs"; exit 1 ;;
  esac
done

for prefix in "$work/by_hand" "$work/unpacked/usr"; do
  program=$prefix/bin/linkstudy
  share=$prefix/share
  "$program" --version >/dev/null
  "$program" check "$share"/linkstudy/configs/mechanisms/*.toml >/dev/null
  (cd "$work" && "$program" study "$share/linkstudy/configs/studies/rsrrp_stiffness.toml" \
    -s simulation.end_time=0.6 -s 'match.0.window=[0.1, 0.6]' -o "$work/results" --fresh \
    --progress none >"$work/out" 2>"$work/err") || { cat "$work/err"; exit 1; }
  grep -q '^results digest: ' "$work/out"
  grep -q '^\.TH LINKSTUDY 1' "$share/man/man1/linkstudy.1"
  grep -q '^\.TH LINKSTUDY 5' "$share/man/man5/linkstudy.5"
  bash -n "$share/bash-completion/completions/linkstudy"
  [ -x "$share/linkstudy/jobs/mpirun_study.sh" ]
  [ ! -e "$share/linkstudy/jobs/quickstart.sh" ]
  PYTHONPATH=$prefix/lib/python3/dist-packages "$python" -B -c '
import sys, linkstudy
assert linkstudy.__file__.startswith(sys.argv[1]), linkstudy.__file__
assert linkstudy.ok(linkstudy.open(sys.argv[2])).sizes["evaluation"] > 0' "$prefix" "$work/results"
done
