#!/usr/bin/env bash
# The program's verbs and the unit tests under valgrind's memcheck, and one table of what it found.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
Usage: tools/memcheck.sh [options]

Builds skein and the unit tests with the preset memcheck (for x86-64-v3, whose instructions valgrind knows) and runs them
under valgrind: small runs by every method, resumed, verified, measured, and every unit test. An error is a read or a jump
that depends on what was never written, an access outside of what is held, or a block that is definitely lost; what
libraries still hold at the end is not one. The exit code is 0 if there was none.

  --build FOLDER    take the programs that are built there, such as build/openmp on a processor without AVX-512
  --folder FOLDER   runs and valgrind's reports go there (default: build/memcheck_runs)
  --seconds N       a unit test that takes longer is left out, and said to be (default: 300)
  --verbs, --tests  only these
  --only PATTERN    of the unit tests those whose names match, an extended regular expression
  --help            this text
TEXT
}

build=
folder=build/memcheck_runs
seconds=300
only=.
verbs=true
tests=true
while (($#)); do
  case $1 in
    --build | --folder | --seconds | --only)
      (($# > 1)) || {
        echo "memcheck.sh: $1 needs a value." >&2
        exit 1
      }
      declare "${1#--}=$2"
      shift
      ;;
    --verbs) tests=false ;;
    --tests) verbs=false ;;
    -h | --help) usage && exit ;;
    *)
      echo "memcheck.sh: unknown option '$1'; --help lists the options." >&2
      exit 1
      ;;
  esac
  shift
done
command -v valgrind >/dev/null || {
  echo "memcheck.sh: valgrind is not installed; 'apt-get install valgrind' installs it." >&2
  exit 1
}
rm -rf "$folder"
mkdir -p "$folder"
folder=$(realpath "$folder")
if [[ -z $build ]]; then
  build=build/memcheck
  echo "building (messages in $folder/log)" >&2
  SKEIN_SETUP_OPTIONS=--with-tests tools/build.sh memcheck >"$folder/log" 2>&1
fi
bin=$(realpath "$build")/bin

# With these the program does not start itself anew (cli/thread_waiting), and threads do not spin, of which valgrind runs
# one at a time.
export OMP_WAIT_POLICY=passive OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
found=99
kept=0
n_checked=0
n_late=0

# check NAME EXIT_CODE COMMAND...: a row of the table; $limit is in seconds, 0 for none
limit=0
check() {
  local name=$1 expected=$2 code=0 words start=$EPOCHREALTIME report
  report=$folder/$(printf '%s' "$name" | tr -c 'a-z0-9_' _)
  shift 2
  timeout -k 5 "$limit" valgrind --error-exitcode=$found --leak-check=full --errors-for-leak-kinds=definite \
    --show-leak-kinds=definite --num-callers=30 --log-file="$report.valgrind" "$@" \
    >"$report.out" 2>&1 </dev/null || code=$?
  n_checked=$((n_checked + 1))
  case $code in
    "$expected") words=yes ;;
    124 | 137)
      words=late
      n_late=$((n_late + 1))
      ;;
    *)
      words=NO
      kept=1
      ;;
  esac
  printf '%-44s%-6s%8.1f  %s\n' "$name" "$words" "$(awk "BEGIN { print $EPOCHREALTIME - $start }")" \
    "$(sed -nE 's/^==[0-9]+== (ERROR SUMMARY: [0-9]+ errors).*/\1/p' "$report.valgrind" | tail -n 1)"
}

check_verbs() {
  local skein=$bin/skein scene=$folder/scene.toml method
  cp tests/torture/memcheck_scene.toml "$scene"
  printf '0 0.01 0\n0.02 0 0.001\n' >"$folder/points"
  printf '[fiber]\nsections = "many"\n' >"$folder/bad.toml"
  check "defaults" 0 "$skein" defaults
  check "validate" 0 "$skein" validate "$scene"
  check "validate, a bad scene" 78 "$skein" validate "$folder/bad.toml"
  check "run" 0 "$skein" run "$scene" -o "$folder/run"
  for method in bs3 rk4 euler trbdf2; do
    check "run, $method" 0 "$skein" run "$scene" -o "$folder/$method" --set time.method=$method --set time.step=1e-4 \
      --set time.end=0.002 --set output.frame_interval=0.001
  done
  check "run, fast multipole method" 0 "$skein" run "$scene" -o "$folder/fmm" --set hydrodynamics.method=fmm \
    --set hydrodynamics.tolerance=0.01 --set hydrodynamics.leaf_size=3 --set hydrodynamics.check_every=7 \
    --set time.end=0.02 --set output.frame_interval=0.01
  SKEIN_TEST_NAN=force:3 check "run, a force that is no number" 76 "$skein" run "$scene" -o "$folder/nan"
  SKEIN_TEST_KILL=step:8 check "run, killed" 137 "$skein" run "$scene" -o "$folder/killed"
  check "info" 0 "$skein" info "$folder/killed"
  check "resume" 0 "$skein" resume "$folder/killed"
  check "verify" 0 "$skein" verify "$folder/killed"
  check "analyze" 0 "$skein" analyze "$folder/killed"
  check "field, a plane" 0 "$skein" field "$folder/killed" -o "$folder/field.vti" --points 8
  check "field, points of a text" 0 "$skein" field "$folder/fmm" --at "$folder/points" -o "$folder/field.h5"
  cp -r "$folder/killed" "$folder/damaged"
  for name in "$folder"/damaged/segments/*.h5; do printf 'x' | dd of="$name" bs=1 seek=3000 conv=notrunc status=none; done
  check "verify, damaged segments" 65 "$skein" verify "$folder/damaged"
  check "analyze, damaged segments" 65 "$skein" analyze "$folder/damaged"
}

# The programs of the unit tests, with those that a script calls; each with its arguments, between tabs.
list_tests() {
  ctest --test-dir "$build" -L '^unit$' --show-only=json-v1 | python3 -c '
import json, sys
for test in json.load(sys.stdin)["tests"]:
    command = test.get("command", [])
    for word in command:
        path = word.removeprefix("-DPROGRAM=")
        if path.startswith(sys.argv[1] + "/"):
            print(*[path.rsplit("/")[-1], *(command[1:] if word == command[0] else [])], sep="\t")' "$bin" | sort -u |
    awk -F '\t' -v only="$only" '$1 ~ only'
}

printf '%-44s%-6s%8s  %s\n' "under valgrind" "whole" "seconds" "valgrind's own sum"
if $verbs; then check_verbs; fi
if $tests; then
  limit=$seconds
  while IFS=$'\t' read -ra words; do check "${words[0]}" 0 "$bin/${words[0]}" "${words[@]:1}"; done < <(list_tests)
fi
echo "$n_checked programs; $n_late took longer than $seconds s; $( ((kept)) && echo "there were errors: see $folder" || echo "no error")"
exit $kept
