# Libraries that come without CMake files: used by the build and, installed, by the package.
# HDF5 is one of them: CMake's FindHDF5 compiles a C program, and no user of the package should have to enable C for it.

# skein_find_library(<name> HEADER file [NAMES names...] [PATH_SUFFIXES ...]): defines the imported target
# skein::<name>, if header and library are found, and sets skein_<name>_FOUND.
function(skein_find_library name)
  cmake_parse_arguments(arg "" "HEADER" "NAMES;PATH_SUFFIXES" ${ARGN})
  string(TOUPPER "${name}" upper)
  set(suffixes "")
  foreach(suffix IN LISTS arg_PATH_SUFFIXES)
    list(APPEND suffixes ${suffix} include/${suffix} lib/${suffix})
  endforeach()
  set(hints ENV ${upper}_ROOT ENV ${upper}_DIR)
  find_path(SKEIN_${name}_INCLUDE_DIR ${arg_HEADER} HINTS ${hints} PATH_SUFFIXES include ${suffixes})
  find_library(SKEIN_${name}_LIBRARY NAMES ${name} ${arg_NAMES} HINTS ${hints} PATH_SUFFIXES lib ${suffixes})
  mark_as_advanced(SKEIN_${name}_INCLUDE_DIR SKEIN_${name}_LIBRARY)
  if(NOT SKEIN_${name}_INCLUDE_DIR OR NOT SKEIN_${name}_LIBRARY)
    set(skein_${name}_FOUND FALSE PARENT_SCOPE)
    return()
  endif()
  set(skein_${name}_FOUND TRUE PARENT_SCOPE)
  if(NOT TARGET skein::${name})
    add_library(skein::${name} UNKNOWN IMPORTED)
    set_target_properties(
      skein::${name} PROPERTIES IMPORTED_LOCATION "${SKEIN_${name}_LIBRARY}"
                                INTERFACE_INCLUDE_DIRECTORIES "${SKEIN_${name}_INCLUDE_DIR}")
  endif()
endfunction()

macro(skein_find_hdf5)
  skein_find_library(hdf5 HEADER hdf5.h NAMES hdf5_serial PATH_SUFFIXES hdf5/serial)
endmacro()

macro(skein_find_xxhash)
  skein_find_library(xxhash HEADER xxhash.h)
endmacro()
