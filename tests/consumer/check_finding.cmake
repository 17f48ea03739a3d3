# cmake -DSOURCE_DIR=... -DBINARY_DIR=... -DGENERATOR=... -DMAKE_PROGRAM=... -DOPTIONS=...
#   -P check_finding.cmake
# Configures tests/consumer/finding once for each case, where PATH has a compiler's tools and nothing else: no Python.
cmake_minimum_required(VERSION 3.22)

file(REMOVE_RECURSE ${BINARY_DIR})
file(MAKE_DIRECTORY ${BINARY_DIR}/tools)
foreach(tool IN ITEMS as ld ar ranlib nm)
  find_program(${tool}_path ${tool} REQUIRED)
  file(CREATE_LINK ${${tool}_path} ${BINARY_DIR}/tools/${tool} SYMBOLIC)
endforeach()
set(in_bare_environment ${CMAKE_COMMAND} -E env --unset=CMAKE_CXX_COMPILER_LAUNCHER --unset=CXX PATH=${BINARY_DIR}/tools)

# try(<case> [<what the failed configuration must say>])
function(try case)
  execute_process(
    COMMAND ${in_bare_environment} ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${BINARY_DIR}/${case} -G ${GENERATOR}
            -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} ${OPTIONS} -DCASE=${case}
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(ARGC EQUAL 1 AND failed)
    message(SEND_ERROR "${case}: ${said}")
  elseif(ARGC GREATER 1 AND NOT failed)
    message(SEND_ERROR "${case}: found, though it should not be")
  elseif(ARGC GREATER 1 AND NOT said MATCHES "${ARGV1}")
    message(SEND_ERROR "${case}: the message lacks \"${ARGV1}\": ${said}")
  else()
    message(STATUS "${case}: as it should be")
  endif()
endfunction()

try(all)
try(host_only)
try(unknown_component "skein has no component 'ropes'; it has core, scene, fibers")
try(missing_package "component 'physics' needs kokkos, which is not found")
try(quiet)
try(optional)
try(own_targets)

execute_process(COMMAND ${in_bare_environment} ${CMAKE_COMMAND} --build ${BINARY_DIR}/host_only COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${BINARY_DIR}/host_only/program COMMAND_ERROR_IS_FATAL ANY)
