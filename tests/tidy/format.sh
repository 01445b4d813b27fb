#!/bin/sh
# Every C++ file stands as clang-format would write it.
# usage: format.sh CLANG_FORMAT TREE
set -eu
cd "$2"
find core study tests -name '*.h' -o -name '*.cpp' | sort | xargs -P 2 -n 40 "$1" --dry-run --Werror
