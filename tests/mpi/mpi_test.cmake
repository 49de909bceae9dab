# Run by ctest with the variables that tests/mpi/CMakeLists.txt gives.
cmake_minimum_required(VERSION 3.22)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(COMMAND ${LAUNCHER} ${CHECK} ${SCENARIO} ${WORK}/all_drawn
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT code STREQUAL CODE)
  message(FATAL_ERROR "expected exit code ${CODE}, not ${code}\n${output}")
endif()
# Processes that part in agreement have no need of MPI's violence.
string(FIND "${output}" "MPI_ABORT" abort_position)
if(SCENARIO MATCHES "^(cooperate|rest|give_up|fail_together)$" AND NOT abort_position EQUAL -1)
  message(FATAL_ERROR "the processes were aborted\n${output}")
endif()
if(MESSAGE)
  string(REGEX MATCHALL "${MESSAGE}" said "${output}")
  list(LENGTH said times)
  if(NOT times EQUAL COUNT)
    message(FATAL_ERROR "said ${times} times, expected ${COUNT}: ${MESSAGE}\n${output}")
  endif()
endif()
