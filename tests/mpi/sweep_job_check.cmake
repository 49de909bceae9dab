# A sweep by several processes writes the bytes that one process writes, also where it goes on with
# what that one has left. Run by ctest with PROGRAM, MPIEXEC, NUMPROC_FLAG, FORMATS and WORK;
# `FORMATS` are the endings of the outputs, "csv;nc" where the program writes netCDF.
cmake_minimum_required(VERSION 3.22)

# Unequal numbers of samples, cells that diverge and cells that are not admissible: tiles that take
# unequal times.
set(sweep sweep --quiet --tile 3 --duration 10
  --axis control.sampling_period=0.001,0.004 --axis control.differential_gain=-13,900
  --axis control.processing_delay=0:0.0015:3 --axis backlash.width=0:0.002:7
  --metric steady_peak --metric ratio_to_uncontrolled --metric reversals_per_s
  --metric period_samples --metric verdict --metric outcome)

# With `code` and `messages` of the command.
macro(run_command)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output
    ERROR_VARIABLE messages)
endmacro()

function(require_success way)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${way}: ${code}\n${output}\n${messages}")
  endif()
endfunction()

function(require_same_files way)
  file(GLOB expected RELATIVE ${WORK}/alone ${WORK}/alone/*)
  file(GLOB found RELATIVE ${WORK}/${way} ${WORK}/${way}/*)
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "${way} leaves ${found} in place of ${expected}")
  endif()
  foreach(file IN LISTS expected)
    execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/alone/${file}
      ${WORK}/${way}/${file} RESULT_VARIABLE differs)
    if(differs)
      message(FATAL_ERROR "${file} of ${way} differs from that of one process")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/alone)
foreach(format IN LISTS FORMATS)
  run_command(${PROGRAM} ${sweep} --output ${WORK}/alone/sweep.${format})
  require_success(alone)
endforeach()

foreach(processes IN ITEMS 1 2 3)
  set(way processes_${processes})
  file(MAKE_DIRECTORY ${WORK}/${way})
  foreach(format IN LISTS FORMATS)
    run_command(${MPIEXEC} ${NUMPROC_FLAG} ${processes} ${PROGRAM} ${sweep}
      --output ${WORK}/${way}/sweep.${format})
    require_success(${way})
  endforeach()
  require_same_files(${way})
endforeach()

# Killed at whatever moment that is, even before its first tile or after its last one.
file(MAKE_DIRECTORY ${WORK}/resumed)
foreach(format IN LISTS FORMATS)
  set(output_file ${WORK}/resumed/sweep.${format})
  execute_process(COMMAND ${PROGRAM} ${sweep} --threads 1 --output ${output_file} TIMEOUT 0.2
    RESULT_VARIABLE ignored OUTPUT_QUIET ERROR_QUIET)
  run_command(${MPIEXEC} ${NUMPROC_FLAG} 2 ${PROGRAM} ${sweep} --resume --output ${output_file})
  require_success(resumed)
endforeach()
# What a killed process was writing has a hidden name of its own.
file(GLOB hidden ${WORK}/resumed/.*)
if(hidden)
  file(REMOVE ${hidden})
endif()
require_same_files(resumed)

function(require_refused what)
  if(code EQUAL 0)
    message(FATAL_ERROR "done although ${what}")
  endif()
  string(REPLACE ";" "," messages "${messages}")  # else a list
  string(REGEX MATCHALL "holdfast: [^\n]*${what}" mentions "${messages}")
  list(LENGTH mentions times)
  if(NOT times EQUAL 1)
    message(FATAL_ERROR "${what} is named ${times} times in\n${messages}")
  endif()
endfunction()

# One process speaks for all.
run_command(${MPIEXEC} ${NUMPROC_FLAG} 3 ${PROGRAM} sweep --axis backlash.widht=0:1:2
  --output ${WORK}/refused.csv)
require_refused("backlash.width")
run_command(${MPIEXEC} ${NUMPROC_FLAG} 2 ${PROGRAM} ${sweep})
require_refused("--output")
