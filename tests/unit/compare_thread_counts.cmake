# Runs PROGRAM with one thread and with two; stops unless it prints the same but for its first line, "threads <n>".
foreach(count IN ITEMS 1 2)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env OMP_NUM_THREADS=${count} OMP_PROC_BIND=false ${PROGRAM}
    OUTPUT_VARIABLE output
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} with ${count} threads: ${status}")
  endif()
  if(NOT output MATCHES "^threads ([0-9]+)\n(.+)$")
    message(FATAL_ERROR "not what was expected:\n${output}")
  endif()
  set(threads_${count} ${CMAKE_MATCH_1})
  set(hashes_${count} "${CMAKE_MATCH_2}")
endforeach()

if(EXPECT_THREADS AND NOT (threads_1 EQUAL 1 AND threads_2 EQUAL 2))
  message(FATAL_ERROR "OMP_NUM_THREADS=1 and 2 gave ${threads_1} and ${threads_2} threads: nothing is compared")
endif()
if(NOT hashes_1 STREQUAL hashes_2)
  message(FATAL_ERROR "the result depends on the number of threads\none:\n${hashes_1}two:\n${hashes_2}")
endif()
message(STATUS "the same with ${threads_1} and ${threads_2} threads:\n${hashes_1}")
