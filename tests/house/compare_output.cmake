# cmake -DPROGRAM=... -DARGUMENTS="words..." -DFILE=... -P compare_output.cmake: fails unless the program prints what the file holds.
separate_arguments(words UNIX_COMMAND "${ARGUMENTS}")
execute_process(COMMAND ${PROGRAM} ${words} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${FILE} expected)
if(NOT printed STREQUAL expected)
  get_filename_component(name ${PROGRAM} NAME)
  message(FATAL_ERROR "${FILE} is out of date: write it anew with `${name} ${ARGUMENTS} > ${FILE}`.")
endif()
