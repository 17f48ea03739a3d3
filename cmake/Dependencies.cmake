# The packages skein stands on. A missing one stops the configuration and names itself; nothing is switched off quietly.

# Stops unless `found`; `package` is what Debian calls `what`.
function(skein_require found what package)
  if(NOT found)
    message(FATAL_ERROR "${what} is not found: run tools/setup.sh or install Debian's ${package}.")
  endif()
endfunction()

# skein_find(<Debian package> <arguments of find_package>...)
function(skein_find package name)
  find_package(${name} QUIET ${ARGN})
  skein_require("${${name}_FOUND}" ${name} ${package})
endfunction()

# Stops when the Kokkos found is too old, too new or lacks the backend that the preset is for.
function(skein_check_kokkos)
  set(this "Kokkos ${Kokkos_VERSION} in ${Kokkos_DIR}")
  if(Kokkos_VERSION VERSION_LESS 3.4 OR Kokkos_VERSION VERSION_GREATER_EQUAL 6)
    message(FATAL_ERROR "${this} is outside 3.4 to 5.x: run tools/setup.sh or install Debian's libkokkos-dev.")
  endif()

  # Before 4.1 Kokkos refuses C++20 with nvcc; clang as the CUDA compiler is not concerned.
  if("CUDA" IN_LIST Kokkos_DEVICES)
    if(Kokkos_VERSION VERSION_LESS 4.1 AND NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
      message(FATAL_ERROR "${this} takes no C++20 with nvcc: use Kokkos 4.1 or newer, with CUDA 13 4.7 or newer.")
    endif()
    # 4.6 passes: built with CUDA 13, it was patched. There cudaMemPrefetchAsync and cudaMemAdvise take a
    # cudaMemLocation, and cudaGraphAddDependencies takes the data of its edges.
    if(CUDAToolkit_VERSION VERSION_GREATER_EQUAL 13 AND Kokkos_VERSION VERSION_LESS 4.6)
      message(FATAL_ERROR
        "${this} does not know CUDA ${CUDAToolkit_VERSION}, in which three functions changed (cudaMemPrefetchAsync, "
        "cudaMemAdvise, cudaGraphAddDependencies): use Kokkos 4.7 or newer. The default_arch of an older nvcc_wrapper, "
        "sm_70, is unknown to CUDA 13, too: set one with NVCC_WRAPPER_DEFAULT_ARCH or Kokkos' own options.")
    endif()
  endif()

  if(NOT SKEIN_EXPECT_BACKEND)
    return()
  endif()
  list(JOIN Kokkos_DEVICES ", " backends)
  string(TOLOWER "${SKEIN_EXPECT_BACKEND}" name)
  set(remedy "set SKEIN_KOKKOS_PREFIX to what tools/setup.sh --backend ${name} prints")
  if(NOT SKEIN_EXPECT_BACKEND IN_LIST Kokkos_DEVICES)
    message(FATAL_ERROR "${this} has the backends ${backends}, not ${SKEIN_EXPECT_BACKEND}: ${remedy}.")
  endif()
  # Any Kokkos may have Serial, but it is the default execution space only when alone.
  if(SKEIN_EXPECT_BACKEND STREQUAL "SERIAL" AND NOT Kokkos_DEVICES STREQUAL "SERIAL")
    message(FATAL_ERROR "${this} has the backends ${backends}, so Serial is not its default: ${remedy}.")
  endif()
endfunction()

# Sets SKEIN_PYTHON to an interpreter for the plots and checks. Debian's comes first: it is the one whose packages
# tools/setup.sh installs, and another python3 may hide it on PATH.
function(skein_find_python)
  find_program(path_python python3 NO_CACHE)
  foreach(python IN ITEMS ${SKEIN_PYTHON} /usr/bin/python3 ${path_python})
    execute_process(COMMAND "${python}" -I -c "import h5py, matplotlib" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0)
      set(SKEIN_PYTHON "${python}" CACHE FILEPATH "Python 3 with h5py and matplotlib" FORCE)
      return()
    endif()
  endforeach()
  skein_require(FALSE "A python3 with h5py and matplotlib" "python3-h5py and python3-matplotlib")
endfunction()

# Not through skein_find: the variables of Kokkos are needed here, and its version file rejects ranges.
find_package(Kokkos CONFIG QUIET)
if(NOT Kokkos_FOUND)
  message(FATAL_ERROR "Kokkos is not found: run tools/setup.sh and set SKEIN_KOKKOS_PREFIX as it prints, or install "
                      "libkokkos-dev where Debian has it.")
endif()
skein_check_kokkos()
set(skein_has_device FALSE)
if(Kokkos_DEVICES MATCHES "CUDA|HIP|SYCL|OPENMPTARGET|OPENACC")
  set(skein_has_device TRUE)
endif()

skein_find(libeigen3-dev Eigen3 CONFIG)
skein_find(libcli11-dev CLI11 CONFIG)
skein_find(libtomlplusplus-dev tomlplusplus CONFIG)
skein_find(libfmt-dev fmt CONFIG)
include(${CMAKE_CURRENT_LIST_DIR}/FindLibrary.cmake)
skein_find_hdf5()
skein_require("${skein_hdf5_FOUND}" HDF5 libhdf5-dev)
skein_find_xxhash()
skein_require("${skein_xxhash_FOUND}" xxHash libxxhash-dev)
skein_find_python()

if(SKEIN_BUILD_TESTS)
  skein_find(libgtest-dev GTest CONFIG)
  skein_find(librapidcheck-dev rapidcheck CONFIG)
endif()
if(SKEIN_BUILD_PERF)
  skein_find(libbenchmark-dev benchmark CONFIG)
endif()

message(STATUS "Kokkos ${Kokkos_VERSION} in ${Kokkos_DIR}: ${Kokkos_DEVICES}")
