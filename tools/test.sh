#!/usr/bin/env bash
# Builds and tests one preset: tools/test.sh [--preset NAME] [arguments for ctest]
set -euo pipefail
cd "$(dirname "$0")/.."

preset=openmp
arguments=()
while (($#)); do
  case $1 in
    --preset)
      (($# > 1)) || {
        echo "test.sh: --preset needs a name." >&2
        exit 1
      }
      preset=$2
      shift
      ;;
    --preset=*) preset=${1#*=} ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

SKEIN_SETUP_OPTIONS=--with-tests tools/build.sh "$preset" -DSKEIN_BUILD_TESTS=ON

# The last thing that runs: its closing lines are the verdict.
exec ctest --preset "$preset" "${arguments[@]}"
