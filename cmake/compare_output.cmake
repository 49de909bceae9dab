# cmake -D PROGRAM=… -D EXPECTED=… -D ACTUAL=… -P compare_output.cmake
# Runs PROGRAM, keeps its standard output in ACTUAL and fails unless that equals EXPECTED exactly.
execute_process(COMMAND ${PROGRAM} OUTPUT_FILE ${ACTUAL} RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${code}")
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -E compare_files ${EXPECTED} ${ACTUAL} RESULT_VARIABLE differs)
if(differs)
  execute_process(COMMAND diff -u ${EXPECTED} ${ACTUAL})
  message(FATAL_ERROR "the output is not that of ${EXPECTED}")
endif()
