#!/usr/bin/env bash
# Objects with step loops for a wide instruction set must hold no function that the linker may take
# in the place of another object's: every weak symbol must carry the name of the set.
# usage: symbols.sh NM ARCHIVE...
set -euo pipefail
nm=$1
shift
status=0
seen=0
for set in Avx2 Avx512; do
  lower=${set,,}
  for archive in "$@"; do
    for object in $(ar t "$archive" | grep "_$lower\.cpp"); do
      seen=$((seen + 1))
      shared=$(ar p "$archive" "$object" > "${TMPDIR:-/tmp}/symbols_$$.o" &&
               "$nm" -C "${TMPDIR:-/tmp}/symbols_$$.o" | grep -E ' W ' | grep -v "$set" || true)
      rm -f "${TMPDIR:-/tmp}/symbols_$$.o"
      if [[ -n $shared ]]; then
        echo "$archive($object) shares with other instruction sets:"
        echo "$shared"
        status=1
      fi
    done
  done
done
((seen >= 2)) || { echo "no objects for avx2 or avx512 found in: $*"; status=1; }
exit $status
