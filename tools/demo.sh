#!/usr/bin/env bash
# Builds skein, lets one fiber tumble in shear flow and plots it.
set -euo pipefail
cd "$(dirname "$0")/.."

scene=configs/tumbling.toml
run=runs/tumbling
times=()
export LC_NUMERIC=C # EPOCHREALTIME with a point

# timed LABEL COMMAND...
timed() {
  local label=$1 start=$EPOCHREALTIME
  shift
  "$@"
  times+=("$(awk -v t0="$start" -v t1="$EPOCHREALTIME" -v l="$label" 'BEGIN { printf "%-10s %7.1f s", l, t1 - t0 }')")
}

timed build tools/build.sh openmp --target=skein
timed simulate build/openmp/bin/skein run "$scene" -o "$run" --overwrite
timed plot build/openmp/bin/skein plot "$run"

echo
printf '%s\n' "${times[@]}"
echo "Pictures:"
find "$run" -name '*.png' | sort | sed 's/^/  /'
