# One static library per layer, linked to the layers it may use and to nothing else.

function(skein_layer name)
  cmake_parse_arguments(layer "HOST;PROGRAM" "" "PUBLIC;PRIVATE;EXTERNAL" ${ARGN})
  foreach(property IN ITEMS HOST PROGRAM PUBLIC PRIVATE)
    set_property(GLOBAL PROPERTY SKEIN_LAYER_${name}_${property} "${layer_${property}}")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY SKEIN_LAYERS ${name})
endfunction()
include(${CMAKE_CURRENT_LIST_DIR}/LayerRules.cmake)

# Writes down, for tests/house, which compiler is to have which source.
function(skein_note_sources compiler)
  foreach(file IN LISTS ARGN)
    get_filename_component(path ${file} ABSOLUTE)
    set_property(GLOBAL APPEND_STRING PROPERTY SKEIN_SOURCES_BY_COMPILER "${compiler} ${path}\n")
  endforeach()
endfunction()

# How a device's compiler is told that a source is for the host alone; empty in builds for hosts.
set(skein_host_only)
if(CMAKE_CXX_COMPILER MATCHES "nvcc_wrapper")
  set(skein_host_only "--host-only")
elseif("HIP" IN_LIST Kokkos_DEVICES)
  set(skein_host_only -x c++)
endif()

# In a build for a device these sources are compiled for the host alone: nvcc is slow, it and clang's HIP stumble over
# toml++'s templates, and there is nothing to do where no header of Kokkos is included.
function(skein_compile_on_host)
  skein_note_sources(host ${ARGN})
  if(ARGN AND skein_host_only)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS ${skein_host_only})
  endif()
endfunction()

# skein_unite_for_device(<target> [sources that stay by themselves...]): for devices, where most time goes into reading Kokkos,
# what holds no device code of its own is one translation unit.
function(skein_unite_for_device target)
  if(skein_host_only OR SKEIN_UNITE_LAYERS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    if(ARGN)
      set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endif()
endfunction()

option(SKEIN_UNITE_SOURCES "Compile the sources of most layers a dozen at a time" ON)

# For hosts: what a dozen sources include and instantiate alike is compiled once, which saves a quarter of a whole build and
# costs some seconds where one file changes. Not the pair loops, whose files are large, and not core, which knows the commit.
function(skein_unite_for_host name)
  if(SKEIN_UNITE_SOURCES AND NOT skein_host_only AND NOT name MATCHES "^(core|fmm|analysis|mpi)$")
    set_target_properties(skein_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 13)
  endif()
endfunction()

# What all targets of a layer have in common: a library and, where it has pair loops, the objects of these.
function(skein_set_up_layer target name)
  foreach(property IN ITEMS HOST PUBLIC PRIVATE)
    get_property(layer_${property} GLOBAL PROPERTY SKEIN_LAYER_${name}_${property})
  endforeach()
  list(TRANSFORM layer_PUBLIC PREPEND skein_)
  list(TRANSFORM layer_PRIVATE PREPEND skein_)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${layer_PUBLIC} ${arg_PUBLIC_LIBRARIES}
                                  PRIVATE ${layer_PRIVATE} ${arg_LIBRARIES} fmt::fmt)
  foreach(header_target IN ITEMS skein_compiler_options ${arg_HEADERS})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${header_target}>)
  endforeach()
endfunction()

# Objects of a layer that are compiled with the options of pair loops: skein_<name>_<part>. What set_up_layer reads of the
# layer's own arguments must be there.
macro(skein_add_loops name part)
  add_library(skein_${name}_${part} OBJECT ${ARGN})
  skein_set_up_layer(skein_${name}_${part} ${name})
  target_link_libraries(skein_${name}_${part} PRIVATE skein_loop_options)
  target_include_directories(skein_${name}_${part} PRIVATE $<TARGET_PROPERTY:skein_${name},INCLUDE_DIRECTORIES>)
  skein_precompile(skein_${name}_${part} skein_loop_headers)
endmacro()

# skein_add_layer(<name> [UNITE] [FILES sources...] [KERNEL_FILES pair loops...] [HOST_LOOPS pair loops of hosts alone...]
#                 [HOST_FILES sources that do not see Kokkos...]
#                 [DEVICE_FILES loops of a device's own path...] [WITHOUT_DEVICE sources in their place...]
#                 [LIBRARIES third-party targets that users must link, too...]
#                 [PUBLIC_LIBRARIES ... whose headers they include, too...] [HEADERS header-only targets of its sources...])
# Every layer links fmt, with which errors are written. In a HOST layer no source sees Kokkos; tests/house holds HOST and
# HOST_FILES to what is included. In a build for hosts DEVICE_FILES are no part of the layer but objects by themselves,
# skein_<name>_device, which tests and benches link.
function(skein_add_layer name)
  cmake_parse_arguments(arg "UNITE" "" "FILES;KERNEL_FILES;HOST_LOOPS;HOST_FILES;DEVICE_FILES;WITHOUT_DEVICE;LIBRARIES;PUBLIC_LIBRARIES;HEADERS" ${ARGN})
  set(loops ${arg_KERNEL_FILES} ${arg_HOST_LOOPS})
  if(skein_has_device)
    list(APPEND loops ${arg_DEVICE_FILES})
    set(arg_WITHOUT_DEVICE "")
  endif()
  add_library(skein_${name} STATIC ${arg_FILES} ${arg_HOST_FILES} ${arg_WITHOUT_DEVICE})
  add_library(skein::${name} ALIAS skein_${name})
  set_target_properties(skein_${name} PROPERTIES EXPORT_NAME ${name})
  skein_set_up_layer(skein_${name} ${name})
  get_property(is_host GLOBAL PROPERTY SKEIN_LAYER_${name}_HOST)
  if(is_host)
    skein_compile_on_host(${arg_FILES})
  else()
    skein_compile_on_host(${arg_HOST_FILES})
    skein_note_sources(device ${arg_KERNEL_FILES} ${arg_DEVICE_FILES})
    skein_note_sources(united-${name}_loops ${arg_HOST_LOOPS})
    if(arg_UNITE)
      skein_unite_for_device(skein_${name} ${arg_HOST_FILES})
      skein_note_sources(united-${name} ${arg_FILES})
    else()
      skein_note_sources(device ${arg_FILES})
    endif()
  endif()
  skein_unite_for_host(${name})
  # Layers above arrays get Kokkos' options (-fopenmp) from it, whether or not they include Kokkos.
  get_property(below GLOBAL PROPERTY SKEIN_LAYER_${name}_PUBLIC)
  if(is_host AND NOT "arrays" IN_LIST below)
    skein_precompile(skein_${name} skein_text_headers)
  else()
    skein_precompile(skein_${name} skein_kokkos_headers)
  endif()
  if(arg_KERNEL_FILES)
    skein_add_loops(${name} loops ${loops})
    skein_unite_for_device(skein_${name}_loops ${arg_KERNEL_FILES} ${arg_DEVICE_FILES})
    target_sources(skein_${name} PRIVATE $<TARGET_OBJECTS:skein_${name}_loops>)
  endif()
  if(arg_DEVICE_FILES AND skein_has_device)
    add_library(skein_${name}_device INTERFACE)
  elseif(arg_DEVICE_FILES)
    skein_add_loops(${name} device ${arg_DEVICE_FILES})
    set_target_properties(skein_${name}_device PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  set(packages ${arg_PUBLIC_LIBRARIES} ${arg_LIBRARIES} fmt::fmt)
  set_property(GLOBAL PROPERTY SKEIN_LAYER_${name}_PACKAGES "${packages}")
endfunction()

foreach(layer IN ITEMS core scene fibers arrays ranks)
  add_subdirectory(src/${layer})
endforeach()
add_subdirectory(kernels)
foreach(layer IN ITEMS fmm physics solvers dynamics io analysis runs mpi studies cli python)
  add_subdirectory(src/${layer})
endforeach()

get_property(sources GLOBAL PROPERTY SKEIN_SOURCES_BY_COMPILER)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/sources_by_compiler.txt CONTENT "${sources}")
