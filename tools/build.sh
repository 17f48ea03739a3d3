#!/usr/bin/env bash
# Sets up, configures and builds one preset:
#   tools/build.sh [openmp|serial|release|package|sanitize|memcheck|fuzz|cuda|hip] [--target=NAME...] [options for cmake]
# Without a target everything is built, tests and benches too.
# With SKEIN_SETUP_OPTIONS in the environment, tools/setup.sh is given those too.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=openmp
if (($#)) && [[ $1 != -* ]]; then
  preset=$1
  shift
fi
case $preset in
  openmp | serial | cuda | hip) backend=$preset ;;
  release | package)
    backend=openmp
    export SKEIN_PROCESSOR=${SKEIN_PROCESSOR:-x86-64} SKEIN_KOKKOS_PREFIX= # a Kokkos of its own, for these processors, too
    ;;
  sanitize) backend=serial ;;
  fuzz)
    backend=serial
    SKEIN_SETUP_OPTIONS="--with-fuzzing${SKEIN_SETUP_OPTIONS:+ $SKEIN_SETUP_OPTIONS}"
    ;;
  memcheck)
    backend=serial
    export SKEIN_PROCESSOR=x86-64-v3 SKEIN_KOKKOS_PREFIX= # for a Kokkos of its own; valgrind knows nothing newer
    ;;
  *)
    echo "build.sh: unknown preset '$preset'; known are openmp, serial, release, package, sanitize, memcheck, fuzz, cuda and hip." >&2
    exit 1
    ;;
esac

targets=()
options=()
while (($#)); do
  case $1 in
    --target=*) targets+=(--target "${1#*=}") ;;
    *) options+=("$1") ;;
  esac
  shift
done

prefix=$(tools/setup.sh --backend "$backend" ${SKEIN_SETUP_OPTIONS:+$SKEIN_SETUP_OPTIONS} --print-kokkos)
export SKEIN_KOKKOS_PREFIX=$prefix
unset Kokkos_ROOT Kokkos_DIR # they would win over the prefix

# Objects are for this processor (-march=native), which ccache does not see in the flags; its home may move to another.
if command -v ccache >/dev/null && [[ ! -v CMAKE_CXX_COMPILER_LAUNCHER ]]; then
  processor=$("${CXX:-c++}" -march=native -E -dM -x c++ /dev/null 2>/dev/null | sha256sum | cut -c 1-12)
  export CMAKE_CXX_COMPILER_LAUNCHER="env;CCACHE_NAMESPACE=skein-$processor;ccache"
fi

# A cached Kokkos_DIR would outlive a change of prefix.
cmake --preset "$preset" -U Kokkos_DIR "${options[@]}"
cmake --build --preset "$preset" "${targets[@]}"
