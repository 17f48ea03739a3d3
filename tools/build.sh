#!/usr/bin/env bash
# Sets up, configures and builds one preset: tools/build.sh [openmp|serial|sanitize|cuda|hip] [options for cmake]
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
  sanitize) backend=serial ;;
  *)
    echo "build.sh: unknown preset '$preset'; known are openmp, serial, sanitize, cuda and hip." >&2
    exit 1
    ;;
esac

prefix=$(tools/setup.sh --backend "$backend" ${SKEIN_SETUP_OPTIONS:+$SKEIN_SETUP_OPTIONS} --print-kokkos)
export SKEIN_KOKKOS_PREFIX=$prefix
unset Kokkos_ROOT Kokkos_DIR # they would win over the prefix

# Objects are for this processor (-march=native), which ccache does not see in the flags; its home may move to another.
if command -v ccache >/dev/null && [[ ! -v CMAKE_CXX_COMPILER_LAUNCHER ]]; then
  processor=$("${CXX:-c++}" -march=native -E -dM -x c++ /dev/null 2>/dev/null | sha256sum | cut -c 1-12)
  export CMAKE_CXX_COMPILER_LAUNCHER="env;CCACHE_NAMESPACE=skein-$processor;ccache"
fi

# A cached Kokkos_DIR would outlive a change of prefix.
cmake --preset "$preset" -U Kokkos_DIR "$@"
cmake --build --preset "$preset"
