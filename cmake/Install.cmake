# The program, and the layers below it as a package with one component per layer: one export file each, so that a user of
# skein::fibers needs nothing of what skein::io links.
include(CMakePackageConfigHelpers)

install(TARGETS skein RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY include/skein DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(DIRECTORY tools/plots DESTINATION ${CMAKE_INSTALL_DATADIR}/skein COMPONENT program
        FILES_MATCHING PATTERN "*.py" PATTERN "matplotlibrc"
        PATTERN "*.js" PATTERN "*.css" PATTERN "*.html"
        PATTERN skein_package.py EXCLUDE)

# The scripts read runs by the Python package (src/python/CMakeLists.txt installs it), whose place an installed copy names.
set(plots ${CMAKE_INSTALL_DATADIR}/skein/plots)
file(RELATIVE_PATH package /prefix/${plots} /prefix/${SKEIN_PYTHON_FOLDER}/skein)
file(READ tools/plots/skein_package.py text)
string(REGEX REPLACE "\nPACKAGE = [^\n]*" "\nPACKAGE = \"${package}\"  # from here" text "${text}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/skein_package.py CONTENT "${text}" @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/generated/skein_package.py DESTINATION ${plots} COMPONENT program)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/skein COMPONENT program)

# The program writes its own completion and page of the manual. Where it does not start, as one for another machine, there
# are none.
# skein_install_printed(<file> <folder> <arguments>...)
function(skein_install_printed file folder)
  set(printed ${CMAKE_CURRENT_BINARY_DIR}/printed/${file})
  list(JOIN ARGN " " arguments)
  install(CODE "file(MAKE_DIRECTORY \"${CMAKE_CURRENT_BINARY_DIR}/printed\")
execute_process(COMMAND \"$<TARGET_FILE:skein>\" ${arguments} OUTPUT_FILE \"${printed}\" RESULT_VARIABLE failure)
if(failure)
  message(WARNING \"skein does not run here: 'skein ${arguments}' is not installed\")
  file(REMOVE \"${printed}\")
endif()" COMPONENT program)
  install(FILES ${printed} OPTIONAL DESTINATION ${folder} COMPONENT program)
endfunction()
skein_install_printed(skein ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
skein_install_printed(skein.1 ${CMAKE_INSTALL_MANDIR}/man1 help --man)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(SKEIN_COMPONENTS "")
set(SKEIN_COMPONENT_TABLE "")
get_property(layers GLOBAL PROPERTY SKEIN_LAYERS)
foreach(layer IN LISTS layers)
  foreach(property IN ITEMS PROGRAM PUBLIC PRIVATE PACKAGES)
    get_property(layer_${property} GLOBAL PROPERTY SKEIN_LAYER_${layer}_${property})
  endforeach()
  if(layer_PROGRAM)
    continue()
  endif()
  install(TARGETS skein_${layer} EXPORT skein_${layer} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT development)
  install(EXPORT skein_${layer} NAMESPACE skein:: DESTINATION ${package_folder} FILE skein_${layer}.cmake
          COMPONENT development)
  list(APPEND SKEIN_COMPONENTS ${layer})
  # All that stand below, not only those that the rules name.
  set(below_${layer} ${layer_PUBLIC} ${layer_PRIVATE})
  foreach(other IN LISTS layer_PUBLIC layer_PRIVATE)
    list(APPEND below_${layer} ${below_${other}})
  endforeach()
  list(REMOVE_DUPLICATES below_${layer})
  # kokkos of Kokkos::kokkos, xxhash of skein::xxhash
  list(TRANSFORM layer_PACKAGES REPLACE ".*::" "")
  list(REMOVE_DUPLICATES layer_PACKAGES)
  string(APPEND SKEIN_COMPONENT_TABLE "set(skein_${layer}_layers ${below_${layer}})\n"
                                      "set(skein_${layer}_packages ${layer_PACKAGES})\n")
endforeach()

configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/skeinConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/FindLibrary.cmake ${CMAKE_BINARY_DIR}/skeinConfig.cmake ${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)

if(SKEIN_NATIVE)
  install(CODE [[message(WARNING "This skein is compiled for this machine's processor (-march=native); on others it may "
    "stop with an illegal instruction. Configure with -DSKEIN_NATIVE=OFF or --preset release for one that runs on all.")]])
endif()
