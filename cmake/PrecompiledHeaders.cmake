# The headers that most sources read first and that nobody changes, compiled once: Kokkos alone takes as long to read as a
# small source takes in all. Every file still includes what it uses; tests/house compiles each header alone.

option(SKEIN_PRECOMPILED_HEADERS "Compile headers of other projects once (g++ and clang, not for GPUs)" ON)

set(skein_precompiles FALSE)
if(SKEIN_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT CMAKE_CXX_COMPILER MATCHES "nvcc_wrapper"
   AND NOT skein_has_device)
  set(skein_precompiles TRUE)
endif()

# ccache holds nothing that used a precompiled header unless it is told to trust the header's #defines and time.
if(skein_precompiles AND CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

# skein_add_precompiled(<name> HEADERS <"fmt/format.h">... [LIBRARIES targets...]): headers compiled with the options of the
# layers; position independent like these, for the compiler rejects a precompiled header that is not.
function(skein_add_precompiled name)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBRARIES" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${name}.cpp CONTENT "// CMake hangs precompiled headers on a source.\n")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${name} PRIVATE skein_compiler_options ${arg_LIBRARIES})
  list(TRANSFORM arg_HEADERS REPLACE "(.+)" "<\\1>")
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

set(text_headers algorithm cmath filesystem fmt/format.h functional memory span string string_view vector)
if(skein_precompiles)
  skein_add_precompiled(skein_text_headers HEADERS ${text_headers} LIBRARIES fmt::fmt)
  skein_add_precompiled(skein_kokkos_headers HEADERS Kokkos_Core.hpp ${text_headers} LIBRARIES Kokkos::kokkos fmt::fmt)
  skein_add_precompiled(skein_loop_headers HEADERS Kokkos_Core.hpp ${text_headers}
                        LIBRARIES Kokkos::kokkos fmt::fmt skein_loop_options)
endif()

# skein_precompile(<target> <skein_text_headers | skein_kokkos_headers | skein_loop_headers>)
function(skein_precompile target headers)
  if(skein_precompiles)
    target_precompile_headers(${target} REUSE_FROM ${headers})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()
