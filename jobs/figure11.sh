#!/usr/bin/env bash
# The data of figure 11 of [Urbas16]: force in the spherical joint, force and moment in the revolute
# joint of the RSRRP linkage over 15 s, for the cut joint and for both replacement joints, and the
# differences. Needs the program (jobs/quickstart.sh builds it).
# Time: some seconds. Output: results/figure11_spherical.csv and results/figure11_revolute.csv; rows
# "reference" are the cut joint, rows "evaluation_0" the replacement joint.
set -euo pipefail
cd "$(dirname "$0")/.."

linkstudy=${LINKSTUDY:-build/study/linkstudy}
mkdir -p results
for joint in spherical revolute; do
  "$linkstudy" study "configs/studies/rsrrp_figure11_$joint.toml" \
    -o "results/figure11_$joint" --fresh
  "$linkstudy" export "results/figure11_$joint" --traces --format csv \
    -o "results/figure11_$joint.csv"
  echo "results/figure11_$joint.csv"
done
