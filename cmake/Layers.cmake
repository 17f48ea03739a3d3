# One static library per layer, linked to the layers it may use and to nothing else.

function(skein_layer name)
  cmake_parse_arguments(layer "" "" "PUBLIC;PRIVATE;EXTERNAL" ${ARGN})
  set_property(GLOBAL PROPERTY SKEIN_LAYER_${name}_PUBLIC "${layer_PUBLIC}")
  set_property(GLOBAL PROPERTY SKEIN_LAYER_${name}_PRIVATE "${layer_PRIVATE}")
  set_property(GLOBAL APPEND PROPERTY SKEIN_LAYERS ${name})
endfunction()
include(${CMAKE_CURRENT_LIST_DIR}/LayerRules.cmake)

# skein_add_layer(<name> FILES files... [LIBRARIES third-party targets...] [PUBLIC_LIBRARIES ...])
function(skein_add_layer name)
  cmake_parse_arguments(arg "" "" "FILES;LIBRARIES;PUBLIC_LIBRARIES" ${ARGN})
  get_property(public_layers GLOBAL PROPERTY SKEIN_LAYER_${name}_PUBLIC)
  get_property(private_layers GLOBAL PROPERTY SKEIN_LAYER_${name}_PRIVATE)
  add_library(skein_${name} STATIC ${arg_FILES})
  add_library(skein::${name} ALIAS skein_${name})
  set_target_properties(skein_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(skein_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                  $<INSTALL_INTERFACE:include>)
  foreach(layer IN LISTS public_layers)
    target_link_libraries(skein_${name} PUBLIC skein_${layer})
  endforeach()
  foreach(layer IN LISTS private_layers)
    target_link_libraries(skein_${name} PRIVATE skein_${layer})
  endforeach()
  target_link_libraries(skein_${name} PUBLIC ${arg_PUBLIC_LIBRARIES} PRIVATE skein_compiler_options ${arg_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY SKEIN_LAYER_TARGETS skein_${name})
endfunction()

# What the pair loops need to vectorize and to fuse multiplications with additions. Never -ffast-math: split single
# precision differences depend on the order in which they are written, and NaN must stay NaN.
function(skein_compile_as_kernels)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS
    "$<$<CXX_COMPILER_ID:GNU,Clang>:-O3;-fno-math-errno;-fno-trapping-math;-ffp-contract=fast>")
endfunction()

foreach(layer IN ITEMS core scene fibers arrays)
  add_subdirectory(src/${layer})
endforeach()
add_subdirectory(kernels)
foreach(layer IN ITEMS fmm physics solvers dynamics io analysis runs studies cli)
  add_subdirectory(src/${layer})
endforeach()
