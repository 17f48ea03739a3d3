#!/usr/bin/env bash
# Installs what skein needs on Debian 12 and provides a Kokkos: one already there, or 3.4.1 from Debian's sources.
set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build make git ccache
  # libraries
  libeigen3-dev libhdf5-dev libcli11-dev libtomlplusplus-dev libfmt-dev libxxhash-dev
  # tests and benchmarks
  libgtest-dev librapidcheck-dev libbenchmark-dev
  # the way to Kokkos' source
  dpkg-dev xz-utils
)
# Plots, and checks of the files written: installed while Kokkos is fetched and built, which needs none of them.
plot_packages=(python3 python3-h5py python3-matplotlib python3-numpy)
# What only running the tests needs; ParaView brings VTK with its XDMF readers, which python3-vtk9 lacks. Other versions of
# clang-format format otherwise.
test_packages=(python3-paraview strace clang-format-14 clang-tidy-14)
# The compiled part of the Python package, and what its tests compute with.
python_packages=(pybind11-dev python3-dev python3-scipy)
mpi_packages=(libopenmpi-dev openmpi-bin)
fuzzing_packages=(clang-14 libclang-rt-14-dev)
movie_packages=(ffmpeg)
viewer_packages=(libjs-three)
browser_packages=(chromium)
# Pages as a site: Sphinx with its theme and MyST, Doxygen for C++, KaTeX for formulas.
site_packages=(python3-sphinx furo python3-myst-parser doxygen libjs-katex libjs-three)

usage() {
  cat <<'TEXT'
Usage: tools/setup.sh [options]

Installs the missing Debian packages and provides Kokkos. A Kokkos found through SKEIN_KOKKOS_PREFIX, CMAKE_PREFIX_PATH,
Kokkos_ROOT, Kokkos_DIR or the system's own paths is used when it is 3.4 to 5.x and has the backend; otherwise Kokkos is
built once into ${XDG_CACHE_HOME:-~/.cache}/skein. CXX chooses the compiler, SKEIN_PROCESSOR for which processor (g++'s
-march; default: native).

  --backend NAME   openmp, serial, cuda or hip (default: whichever parallel backend is found, else openmp is built)
  --serial         the same as --backend serial: a Kokkos whose only backend is Serial
  --with-tests     also install what only running the tests needs (ParaView, strace, clang-format and clang-tidy 14), and
                   what --with-python, --with-mpi, --with-viewer and --with-site do
  --with-python    also install pybind11, Python's headers and SciPy: for `import skein`, which runs and computes
  --with-mpi       also install Open MPI, with which `mpirun -n 4 skein run ...` shares a run between processes
  --with-fuzzing   also install clang 14 with libFuzzer, which only tools/torture.sh needs
  --with-movies    also install ffmpeg, which only `skein plot --movie` needs
  --with-viewer    also install three.js, which `skein view` and `skein report` put into their pages
  --with-browser   also install Chromium (120 MB), in which the tests then open such a page
  --with-site      also install Sphinx, furo, MyST, Doxygen and KaTeX, which only tools/site.sh needs
  --print-kokkos   print nothing but Kokkos' prefix on stdout; messages go to stderr
  --help           this text

The last line on stdout is 'export SKEIN_KOKKOS_PREFIX=...', the variable the CMake presets read.
TEXT
}

fail() {
  echo "setup.sh: $*" >&2
  exit 1
}

say() { echo "$*" >&3; }

# --- Packages ---

as_root() {
  if ((EUID == 0)); then env DEBIAN_FRONTEND=noninteractive "$@"; else sudo env DEBIAN_FRONTEND=noninteractive "$@"; fi
}

can_be_root() { ((EUID == 0)) || command -v sudo >/dev/null; }

# Another apt may hold the lock of the package lists, for which apt-get has no waiting option.
update_package_lists() {
  local try
  for try in 1 2 3 4 5; do
    as_root apt-get update -qq >&2 && return
    ((try < 5)) && sleep 10
  done
  fail "apt-get update failed."
}

missing_packages() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
  done
}

has_lists=false
# install_packages NAME...
install_packages() {
  if ! command -v apt-get >/dev/null; then
    say "No apt-get here. Needed, by their Debian names: $*"
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  if ((${#missing[@]} == 0)); then
    say "Packages: all $# are installed."
    return
  fi
  can_be_root || fail "neither root nor sudo is available to install the missing packages: ${missing[*]}"
  say "Packages: installing ${missing[*]}"
  $has_lists || update_package_lists
  has_lists=true
  as_root apt-get install -qq -y --no-install-recommends -o DPkg::Lock::Timeout=900 "${missing[@]}" >&2
}

# --- A Kokkos that is already there ---

# Prints "prefix|version|devices" of the Kokkos that CMake finds, or nothing. A target links it, for a broken package
# (Debian 12's libtrilinos-kokkos-dev) is found and fails only there.
probe_kokkos() {
  mkdir "$scratch/probe"
  cat >"$scratch/probe/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(probe LANGUAGES CXX)
set(CMAKE_CXX_EXTENSIONS OFF)
find_package(Kokkos CONFIG QUIET)
if(Kokkos_FOUND)
  string(REGEX REPLACE "/(lib[^/]*|share)(/[^/]+)?/cmake/Kokkos$" "" prefix "${Kokkos_DIR}")
  file(WRITE "${CMAKE_BINARY_DIR}/kokkos" "${prefix}|${Kokkos_VERSION}|${Kokkos_DEVICES}\n")
  file(WRITE "${CMAKE_BINARY_DIR}/empty.cpp" "")
  add_executable(probe "${CMAKE_BINARY_DIR}/empty.cpp")
  target_link_libraries(probe PRIVATE Kokkos::kokkos)
endif()
CMAKE
  if CMAKE_PREFIX_PATH="${SKEIN_KOKKOS_PREFIX:-}${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}" \
    cmake -S "$scratch/probe" -B "$scratch/probe/build" -G Ninja >"$scratch/probe/log" 2>&1 &&
    [[ -f $scratch/probe/build/kokkos ]]; then
    cat "$scratch/probe/build/kokkos"
  fi
}

# Is "version" with "devices" (a;b;c) what $backend asks for?
is_usable() {
  local version=$1 devices=";${2^^};"
  local major=${version%%.*} minor=${version#*.}
  minor=${minor%%.*}
  ((major >= 4 && major <= 5 || major == 3 && 10#$minor >= 4)) || return 1
  case $backend in
    any) [[ $devices =~ \;(OPENMP|CUDA|HIP)\; ]] ;;
    serial) [[ $devices == ";SERIAL;" ]] ;;
    *) [[ $devices == *";${backend^^};"* ]] ;;
  esac
}

# --- Kokkos from Debian's sources ---

# What decides whether a cached Kokkos fits: the compiler, the processor (both through the macros of -march) and
# the options. Sets compiler, options and cache_key.
describe_build() {
  local flags='' processor=${SKEIN_PROCESSOR:-native} name hash
  compiler=${CXX:-c++}
  command -v "$compiler" >/dev/null || fail "the compiler '$compiler' is not found; set CXX or install g++."
  if "$compiler" -march="$processor" -E -x c++ /dev/null >/dev/null 2>&1; then flags=-march=$processor; fi
  options=(
    -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_STANDARD=20
    "-DCMAKE_CXX_FLAGS=$flags" # Kokkos 3.4 has no Kokkos_ARCH_NATIVE
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON
    -DBUILD_SHARED_LIBS=OFF
    -DKokkos_CXX_STANDARD=20
    -DKokkos_ENABLE_SERIAL=ON
    -DKokkos_ENABLE_TESTS=OFF
  )
  if [[ $backend != serial ]]; then options+=(-DKokkos_ENABLE_OPENMP=ON); fi

  name=$(printf '#ifdef __clang__\nclang-__clang_major__.__clang_minor__.__clang_patchlevel__\n#else\n%s\n#endif\n' \
    'gcc-__GNUC__.__GNUC_MINOR__.__GNUC_PATCHLEVEL__' | "$compiler" -E -P -x c++ - | tr -d ' \n')
  # shellcheck disable=SC2086 # flags may be empty
  hash=$({
    "$compiler" $flags -E -dM -x c++ /dev/null
    printf '%s\n' "${options[@]}"
  } | sha256sum)
  cache_key=$name-${hash:0:12}
}

cached_kokkos() {
  local prefix
  for prefix in "$cache"/kokkos-*-"$cache_key"; do
    if [[ -d $prefix ]]; then echo "$prefix"; fi
  done | tail -n 1
}

# The addresses that apt uses for the distribution's own packages, from its package lists.
distribution_uris() {
  local origin
  # shellcheck disable=SC1091
  origin=$(. /etc/os-release && echo "${ID^}")
  # shellcheck disable=SC2016 # apt expands REPO_URI
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Origin: $origin" | sed 's:/*$::' | sort -u
}

# Writes the system's own entries for its distribution into the folder $1, as source entries with their options kept.
# Other vendors' entries are left out: many have no sources.
write_source_entries() {
  local uris list='' parts='' file
  uris=$(distribution_uris)
  if [[ -z $uris ]]; then
    can_be_root || fail "apt's package lists are empty; run 'apt-get update' as root first."
    update_package_lists
    uris=$(distribution_uris)
  fi
  [[ -n $uris ]] || fail "apt has no entry of this distribution's own, from which Kokkos' source could come."

  eval "$(apt-config shell list Dir::Etc::SourceList/f parts Dir::Etc::SourceParts/d)"
  for file in "$list" "$parts"/*.list; do
    if [[ -f $file ]]; then sed -nE 's/^[[:space:]]*deb[[:space:]]+/deb-src /p' "$file"; fi
  done | grep -F "$uris" >"$1/system.list" || true
  for file in "$parts"/*.sources; do
    if [[ ! -f $file ]]; then continue; fi
    awk -v RS= -v uris="$uris" '
      /(^|\n)Enabled:[ \t]*no/ { next }
      {
        n = split(uris, uri, "\n")
        for (i = 1; i <= n; i++) if (index($0, uri[i])) break
        if (i > n) next
        gsub(/(^|\n)#[^\n]*/, "")
        sub(/(^|\n)Types:[^\n]*/, "\nTypes: deb-src")
        print $0 "\n"
      }' "$file"
    echo
  done >"$1/system.sources"
}

# Leaves Kokkos' source tree in $scratch/kokkos. Of the source package trilinos only the upstream archive is fetched,
# with package lists of our own beside the system's, and only Kokkos is unpacked.
#
# It is kept for other backends and compilers, some ten MB: the download takes longer than the build.
fetch_kokkos_source() {
  local apt=$scratch/apt archive kept=$cache/kokkos-source
  if [[ -d $kept ]]; then
    say "Kokkos: the source fetched before is used"
    cp -r "$kept" "$scratch/kokkos"
    return
  fi
  mkdir -p "$apt"/{entries,lists/partial,cache/archives/partial,download} "$scratch/kokkos"
  write_source_entries "$apt/entries"
  if ((EUID == 0)) && id _apt >/dev/null 2>&1; then
    chmod 711 "$scratch" # lets apt's unprivileged downloader in
    chown _apt "$apt/download"
  fi
  local own_state=(
    -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$apt/entries"
    -o Dir::State::lists="$apt/lists" -o Dir::Cache="$apt/cache"
    -o Acquire::Languages=none -o Acquire::Retries=3
  )
  say "Kokkos: fetching the source package trilinos (170 MB, of which packages/kokkos is used)"
  apt-get "${own_state[@]}" update -qq >&2
  (cd "$apt/download" && apt-get "${own_state[@]}" source -qq --download-only --tar-only trilinos >&2)
  archive=$(find "$apt/download" -name 'trilinos_*.orig.tar.*')
  [[ -f $archive ]] || fail "the source package trilinos came without its upstream archive."
  tar -xf "$archive" -C "$scratch/kokkos" --strip-components=3 --wildcards '*/packages/kokkos'
  rm -rf "$apt"
  mkdir -p "$cache"
  staging=$(mktemp -d "$cache/unfinished.XXXXXX")
  cp -r "$scratch/kokkos/." "$staging"
  mv -T "$staging" "$kept" 2>/dev/null || rm -rf "$staging"
}

# Builds into a temporary name beside the final one: a cache entry is whole or absent.
#
# All sources of a library are compiled as one, in a seventh of the time: but for Kokkos_Error.cpp, in which names mean
# other things behind the headers of the others. Where that fails, as it may with other versions, each by itself.
build_kokkos() {
  local source=$scratch/kokkos build=$scratch/build log=$scratch/log version prefix as_one
  fetch_kokkos_source
  version=$(sed -nE 's/^set\(Kokkos_VERSION_(MAJOR|MINOR|PATCH) 0*([0-9]+)\)/\2/Ip' "$source/CMakeLists.txt")
  version=${version//$'\n'/.}
  [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "the version of Kokkos in the source package is not readable."
  prefix=$cache/kokkos-$version-$cache_key
  say "Kokkos: building $version in $prefix"
  mkdir -p "$cache"
  staging=$(mktemp -d "$cache/unfinished.XXXXXX")
  cat >"$scratch/by_itself.cmake" <<'CMAKE'
cmake_language(DEFER CALL set_source_files_properties "${CMAKE_CURRENT_SOURCE_DIR}/core/src/impl/Kokkos_Error.cpp"
               DIRECTORY core/src PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
CMAKE
  for as_one in ON OFF; do
    if {
      cmake -S "$source" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_INSTALL_PREFIX="$prefix" \
        -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_UNITY_BUILD=$as_one -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 \
        -DCMAKE_PROJECT_Kokkos_INCLUDE="$scratch/by_itself.cmake" "${options[@]}" &&
        cmake --build "$build"
    } >"$log" 2>&1; then break; fi
  done
  if ! DESTDIR=$staging cmake --install "$build" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "Kokkos did not build; the end of its output is above."
  fi
  # Another set-up may have finished first; its result is as good.
  mv -T "$staging$prefix" "$prefix" 2>/dev/null || [[ -d $prefix ]] || fail "cannot write $prefix."
  kokkos=$prefix
}

# --- Main ---

backend=any
only_prefix=false
while (($#)); do
  case $1 in
    --backend)
      (($# > 1)) || fail "--backend needs a name."
      backend=$2
      shift
      ;;
    --backend=*) backend=${1#*=} ;;
    --serial) backend=serial ;;
    --with-tests)
      packages+=("${test_packages[@]}" "${python_packages[@]}" "${mpi_packages[@]}" "${viewer_packages[@]}" "${site_packages[@]}")
      ;;
    --with-python) packages+=("${python_packages[@]}") ;;
    --with-mpi) packages+=("${mpi_packages[@]}") ;;
    --with-fuzzing) packages+=("${fuzzing_packages[@]}") ;;
    --with-movies) packages+=("${movie_packages[@]}") ;;
    --with-viewer) packages+=("${viewer_packages[@]}") ;;
    --with-browser) packages+=("${browser_packages[@]}") ;;
    --with-site) packages+=("${site_packages[@]}") ;;
    --print-kokkos) only_prefix=true ;;
    -h | --help) usage && exit ;;
    *) fail "unknown option '$1'; --help lists the options." ;;
  esac
  shift
done
[[ $backend =~ ^(any|openmp|serial|cuda|hip)$ ]] || fail "--backend takes openmp, serial, cuda or hip, not '$backend'."
if $only_prefix; then exec 3>&2; else exec 3>&1; fi

scratch=$(mktemp -d)
cache=${XDG_CACHE_HOME:-~/.cache}/skein
staging=
trap 'rm -rf "$scratch" ${staging:+"$staging"}' EXIT

install_packages "${packages[@]}"
install_packages "${plot_packages[@]}" &
plots=$!

case $backend in
  any) wanted="OpenMP, CUDA or HIP" ;;
  serial) wanted="Serial alone" ;;
  *) wanted=${backend^^} ;;
esac
IFS='|' read -r kokkos version devices < <(probe_kokkos) || true
if [[ -n $kokkos ]] && is_usable "$version" "$devices"; then
  say "Kokkos: $version in $kokkos (${devices//;/, }) is used."
elif [[ $backend =~ ^(cuda|hip)$ ]] || ! command -v apt-get >/dev/null; then
  fail "no Kokkos 3.4 to 5.x with $wanted is found; install one and name it in CMAKE_PREFIX_PATH."
else
  describe_build
  kokkos=$(cached_kokkos)
  if [[ -n $kokkos ]]; then
    say "Kokkos: ${kokkos##*/} was built before; nothing to do."
  else
    build_kokkos
  fi
fi

wait "$plots" || fail "the packages that draw plots are not installed."
if $only_prefix; then echo "$kokkos"; else printf 'export SKEIN_KOKKOS_PREFIX=%q\n' "$kokkos"; fi
