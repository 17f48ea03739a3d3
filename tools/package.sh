#!/usr/bin/env bash
# Makes a Debian package of the program and the Python package: build/package/skein_VERSION_ARCHITECTURE.deb, for every
# processor of the architecture, or with SKEIN_PROCESSOR=x86-64-v3 for those that g++ calls so, on which it is faster.
set -euo pipefail
cd "$(dirname "$0")/.."

processor=${SKEIN_PROCESSOR:-}
SKEIN_SETUP_OPTIONS=--with-python tools/build.sh package ${processor:+-DCMAKE_CXX_FLAGS=-march=$processor}
rm -f build/package/*.deb
cpack --config build/package/CPackConfig.cmake -B build/package
