#!/usr/bin/env bash
# Installs what linkstudy is built, run and tested with: the one list of Debian packages.
# Time: 1-2 minutes on a fresh Debian 12, under a second where nothing is missing.
# Output: the packages that were missing; nothing where none was.
# As root it installs directly, otherwise through sudo; without either it says what to install.
# usage: jobs/install.sh [--tests]
#        --tests: also what tests/run.sh needs (a Slurm, cpack, a browser, valgrind)
set -euo pipefail

packages=(
  g++ cmake ninja-build git ca-certificates
  openmpi-bin libopenmpi-dev libhdf5-dev hdf5-tools libnlopt-cxx-dev libssl-dev
  libeigen3-dev libboost-dev libboost-program-options-dev
  libtomlplusplus-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libxbyak-dev
  libgtest-dev libgmock-dev libbenchmark-dev clang-format
  libjs-chart.js libjs-three gnuplot-nox
  python3 python3-h5py python3-xarray python3-h5netcdf python3-netcdf4
)
if [ "${1:-}" = --tests ]; then packages+=(slurm-wlm munge dpkg-dev file chromium valgrind); fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$state" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "jobs/install.sh: not root and no sudo here; as root, run" >&2
    echo "  apt-get install -y --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  echo "jobs/install.sh: not root, so this asks sudo"
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}" </dev/null
