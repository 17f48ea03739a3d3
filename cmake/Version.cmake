# The commit goes into every run folder; it is looked up at each build, not once at configuration.
find_package(Git QUIET)
add_custom_target(skein_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DGIT=${GIT_EXECUTABLE} -DVERSION=${PROJECT_VERSION}
          -DBUILD_TYPE=${CMAKE_BUILD_TYPE} -DOUTPUT=${CMAKE_BINARY_DIR}/generated/skein_version.hpp
          -P ${PROJECT_SOURCE_DIR}/cmake/WriteVersion.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/generated/skein_version.hpp
  COMMENT "Looking up the commit")
