#!/usr/bin/env bash
# Everything a run must survive, and one table of what it did.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
Usage: tools/torture.sh [options]

Builds skein and tries to break its runs: kills, restarts, signals, write errors, damaged checkpoints, bad scenes, numbers
that are none, readers, fuzzers, and all tests under sanitizers. Prints one table; the exit code is 0 if every promise was
kept. Filling a disk needs root.

  --campaign       the larger counts, for a release
  --share NUMBER   of the counts, such as 0.2, each rounded up
  --short          the small counts, those of CTest: a minute, without fuzzers and sanitizers
  --program PATH   torture this skein instead of building one
  --folder PATH    run folders go there (default: build/torture); in memory, as in /dev/shm, no try waits for a disk
  --no-fuzzing, --no-sanitizers
  --help           this text
TEXT
}

size=()
share=1
program=
folder=build/torture
fuzz_seconds=60
fuzzing=true
sanitizers=true
while (($#)); do
  case $1 in
    --campaign)
      size=(--campaign)
      fuzz_seconds=300
      ;;
    --short)
      size=(--short)
      fuzzing=false
      sanitizers=false
      ;;
    --program | --folder | --share)
      (($# > 1)) || {
        echo "torture.sh: $1 needs a value." >&2
        exit 1
      }
      case $1 in
        --program) program=$2 ;;
        --folder) folder=$2 ;;
        --share) share=$2 ;;
      esac
      shift
      ;;
    --no-fuzzing) fuzzing=false ;;
    --no-sanitizers) sanitizers=false ;;
    -h | --help) usage && exit ;;
    *)
      echo "torture.sh: unknown option '$1'; --help lists the options." >&2
      exit 1
      ;;
  esac
  shift
done

mkdir -p "$folder"
log=$folder/log
: >"$log"
if [[ -z $program ]]; then
  echo "building (messages in $log)" >&2
  SKEIN_SETUP_OPTIONS=--with-tests tools/build.sh openmp >>"$log" 2>&1
  program=build/openmp/bin/skein
fi
python=/usr/bin/python3
"$python" -c 'import h5py' 2>/dev/null || python=python3

kept=0
print_row() { printf '%-26s%7s  %-8s%8.1f%13s%s\n' "${@:1:4}" '' "$5"; }

# A row: promise, count, a command, and the remark, which is the last line that the command prints on its stdout.
try() {
  local promise=$1 count=$2 start=$EPOCHREALTIME passed=yes remark
  shift 2
  remark=$("$@" 2>>"$log" | tee -a "$log" | tail -n 1) || {
    passed=NO
    remark="see $log; $remark"
    kept=1
  }
  print_row "$promise" "$count" "$passed" "$(awk "BEGIN { print $EPOCHREALTIME - $start }")" "$remark"
}

fuzz() {
  local name=$1 corpus=$folder/fuzz/$1
  mkdir -p "$corpus"
  "$program" defaults >"$corpus/seed"
  if [[ $name == fuzz_checkpoint ]]; then
    local seed
    seed=$(find "$folder" -name '*.checkpoint' -not -path '*damaged*' | sort | tail -n 1)
    if [[ -n $seed ]]; then cp "$seed" "$corpus/seed"; fi
  fi
  "build/fuzz/bin/$name" -max_total_time="$fuzz_seconds" -timeout=10 -max_len=16384 -print_final_stats=1 \
    -artifact_prefix="$folder/fuzz/$name-" "$corpus" 2>&1 | tee -a "$log" |
    sed -nE 's/^stat::number_of_executed_units: *([0-9]+)/\1 inputs/p'
}

build_fuzzers() {
  SKEIN_SETUP_OPTIONS=--with-tests tools/build.sh fuzz --target=fuzz_scene --target=fuzz_checkpoint
}

run_sanitized_tests() { tools/test.sh --preset sanitize; }

"$python" tests/torture/torture.py "$program" "$folder" "${size[@]}" --share "$share" || kept=1
if $fuzzing; then
  if build_fuzzers >>"$log" 2>&1; then
    try "scene reader fuzzed" "$fuzz_seconds s" fuzz fuzz_scene
    try "checkpoints fuzzed" "$fuzz_seconds s" fuzz fuzz_checkpoint
  else
    print_row "fuzzers" 0 NO 0 "they cannot be built: see $log"
    kept=1
  fi
fi
if $sanitizers; then try "sanitizers, all tests" 1 run_sanitized_tests; fi
exit $kept
