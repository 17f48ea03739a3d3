# cmake -DPROGRAM=... -DARGUMENTS=... -DFILE=... -P compare_output.cmake: fails unless the program prints what the file holds.
execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${FILE} expected)
if(NOT printed STREQUAL expected)
  get_filename_component(name ${PROGRAM} NAME)
  list(JOIN ARGUMENTS " " words)
  message(FATAL_ERROR "${FILE} is out of date: write it anew with `${name} ${words} > ${FILE}`.")
endif()
