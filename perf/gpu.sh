#!/usr/bin/env bash
# What a GPU must show, in eight minutes, of programs that were built before (tools/build.sh cuda):
#   perf/gpu.sh [folder of the build, build/cuda]
# Every line that is asked for begins with "MUST" and ends with yes, no, or "not run"; the last one counts them. Output of
# the programs themselves is kept in the folder that the first line names. Exit code: 0 where all that was run says yes.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

bin=${1:-build/cuda}/bin
python=${PYTHON:-/usr/bin/python3} # with h5py and numpy
kept=$(mktemp -d "${TMPDIR:-/tmp}/skein_gpu.XXXXXX")
n_yes=0 n_no=0 n_missing=0
SECONDS=0

say() { printf '%s\n' "$*"; }
# must <what> <yes|no|not run>
must() {
  say "MUST $1: $2"
  case $2 in
    yes) n_yes=$((n_yes + 1)) ;;
    no) n_no=$((n_no + 1)) ;;
    *) n_missing=$((n_missing + 1)) ;;
  esac
}
# yes_if command...
yes_if() { if "$@"; then say yes; else say no; fi; }
is_true() { yes_if awk "BEGIN { exit !($1) }"; }
# passes <name> <seconds> command...: its exit code decides; a command that is cut off was not run.
passes() {
  local name=$1 limit=$2 begin=$SECONDS code
  shift 2
  if ((SECONDS + 5 > 470)); then must "$name" "not run"; return; fi
  timeout "$limit" "$@" >"$kept/${name//[^A-Za-z0-9]/_}.log" 2>&1
  code=$?
  if ((code == 124)); then must "$name ($limit s were not enough)" "not run"
  else must "$name ($((SECONDS - begin)) s)" "$(yes_if test "$code" = 0)"; fi
}

say "# $(nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null || say 'no nvidia-smi'), $(date +%F), output in $kept"
"$bin/skein" --version

# Direct sums: pairs/s at least, by nodes and precision; errors at most 3e-7.
timeout 60 "$bin/bench_direct" 1440 5418 23634 94536 378144 >"$kept/direct.csv"
while read -r nodes precision least; do
  row=$(grep "^$nodes,\"general, $precision\"" "$kept/direct.csv" || true)
  if [[ -z $row ]]; then must "direct sum, $nodes nodes, $precision" "not run"; continue; fi
  rate=$(cut -d, -f4 <<<"$row") error=$(cut -d, -f6 <<<"$row")
  must "direct sum, $nodes nodes, $precision: $rate pairs/s, at least $least; error $error" \
    "$(is_true "$rate >= $least && $error <= 3e-7")"
done <<'ROWS'
1440 double 1.3e11
5418 double 4e11
23634 double 5e11
94536 double 5e11
378144 double 5e11
1440 single 1.6e11
5418 single 7e11
23634 single 9.5e11
94536 single 9.5e11
378144 single 9.5e11
ROWS

# The fast multipole method: milliseconds at most, with a new tree (column 9) or one that is kept (column 3).
timeout 60 "$bin/bench_fmm" device >"$kept/fmm.csv"
while read -r shape nodes tolerance column most; do
  row=$(grep "^device,0,[^,]*,$shape,$nodes,$tolerance," "$kept/fmm.csv" || true)
  tree=new
  if [[ $column == 3 ]]; then tree=kept; fi
  name="fast multipole method, $shape, $nodes nodes, $tolerance, $tree tree"
  if [[ -z $row ]]; then must "$name" "not run"; continue; fi
  time=$(cut -d, -f"$column" <<<"$row") error=$(cut -d, -f12 <<<"$row")
  must "$name: $time ms, at most $most; error $error" "$(is_true "$time <= $most && $error <= 2 * $tolerance")"
done <<'ROWS'
straight 23634 0.0001 3 0.6
straight 23634 0.0001 9 1.2
straight 94536 0.0001 3 1.2
suspension 180000 0.0001 3 3
uniform 1000000 0.0001 9 10
uniform 1000000 1e-06 9 20
uniform 1000000 1e-09 9 80
ROWS

# Whole runs, start to end, with frames and checkpoints: seconds at most.
# run <name> <scene> <end> <seconds> key=value...
run() {
  local name=$1 scene=$2 end=$3 most=$4 settings=()
  for setting in "${@:5}"; do settings+=(--set "$setting"); done
  timeout $((2 * most + 10)) "$bin/skein" run "configs/$scene" -o "$kept/$name" --set "time.end=$end" "${settings[@]}" \
    >"$kept/$name.log" 2>&1
}
while read -r name scene end most settings; do
  begin=$(date +%s.%N)
  # shellcheck disable=SC2086  # words, one a setting
  if run "$name" "$scene" "$end" "${most%.*}" $settings; then
    seconds=$(awk "BEGIN { print $(date +%s.%N) - $begin }")
    must "$scene to t = $end in $most s: $seconds s" "$(is_true "$seconds <= $most")"
  else must "$scene to t = $end" "no"; fi
done <<'ROWS'
first lagrone2019_L0139.toml 11 0.5
snake lagrone2019_L0523.toml 26 4.0
coarse lagrone2019_L228.toml 110 60.0
long lagrone2019_L228.toml 110 60.0 hydrodynamics.precision=single fiber.nodes_per_section=18 fiber.sections=1313 fiber.spring_stiffness=0.0112 fiber.blob=0.00225
ROWS
run again lagrone2019_L0139.toml 11 1
passes "two runs are equal to the bit" 20 "$python" tools/compare_runs.py "$kept/first" "$kept/again" --at-most 0

# A run that is killed and goes on.
"$bin/skein" run configs/lagrone2019_L0523.toml -o "$kept/killed" --set time.end=26 >"$kept/killed.log" 2>&1 &
killed=$!
sleep 1.5
kill -KILL "$killed" 2>/dev/null
wait "$killed" 2>/dev/null
"$bin/skein" resume "$kept/killed" >>"$kept/killed.log" 2>&1
passes "a killed run goes on to the same bits" 30 "$python" tools/compare_runs.py "$kept/snake" "$kept/killed" --at-most 0
passes "and is whole" 30 "$bin/skein" verify "$kept/killed"

# Tests, side by side: of direct sums, springs, tree and passes first. Then what a sanitizer says of the kernels.
# together <name> <seconds> command...: begins it; `collect` says what became of all that were begun.
begun=()
together() {
  local name=$1 limit=$2
  shift 2
  begun+=("$name")
  (
    timeout "$limit" "$@" >"$kept/${name//[^A-Za-z0-9]/_}.log" 2>&1
    echo $? >"$kept/${name//[^A-Za-z0-9]/_}.code"
  ) &
}
collect() {
  local name code
  wait
  for name in "${begun[@]}"; do
    code=$(cat "$kept/${name//[^A-Za-z0-9]/_}.code")
    must "$name" "$(if ((code == 124)); then say "not run"; else yes_if test "$code" = 0; fi)"
  done
  begun=()
}
for test in test_launch_counts test_fmm_launches test_node_checks test_machine_rates test_stokeslet_direct \
  test_spring_force test_combination test_sections test_penetration test_octree_lists test_device_fmm \
  test_section_repulsion test_implicit_parts test_restart test_force test_mobility; do
  together "$test" 120 "$bin/$test"
done
collect
for tool in memcheck racecheck; do
  sanitize=(compute-sanitizer --tool "$tool" --error-exitcode 3)
  together "$tool of direct sums" 80 "${sanitize[@]}" "$bin/test_stokeslet_direct" --gtest_filter='StokesletTeams.*'
  together "$tool of springs" 80 "${sanitize[@]}" "$bin/test_spring_force"
  # What the tree shares in fast memory is its sort of few keys; racecheck of all of it takes longer than there is.
  shared_keys='KeySort.IsStableAndLooks*:*AreRightForBadInput*'
  together "$tool of the tree" 80 "${sanitize[@]}" "$bin/test_octree_lists" \
    --gtest_filter="$(if [[ $tool == racecheck ]]; then say "$shared_keys"; else say '*'; fi)"
  together "$tool of the passes" 80 "${sanitize[@]}" "$bin/test_device_fmm" \
    --gtest_filter='*EveryKind*:*SinglePrecision*:*TargetsApart*'
done
collect

# What `auto` takes, beside the best that it could have taken, from 504 nodes to a million and from 1e-3 to 1e-8.
if ((SECONDS < 380)); then
  timeout 90 "$bin/bench_choices" >"$kept/choices.csv"
  worst=$(sed -n 's/^# auto takes at most \([0-9.]*\) times.*/\1/p' "$kept/choices.csv")
  if [[ -z $worst ]]; then must "auto within 1.3 of the best (90 s were not enough)" "not run"
  else must "auto takes at most $worst times as long as the best, 1.3 at most" "$(is_true "$worst <= 1.3")"; fi
fi

# Peaks, shares of them, steps by length; then, where time is left, the rates that choices are made by (src/fmm/machine_rates.cpp).
timeout 90 "$bin/skein" bench machine | tee "$kept/machine.txt"
if ((SECONDS < 440)); then timeout 40 "$bin/bench_rates"; fi
say "# $n_yes yes, $n_no no, $n_missing not run, $SECONDS s"
exit $((n_no > 0))
