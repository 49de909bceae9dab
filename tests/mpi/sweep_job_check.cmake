# A sweep by several processes writes the bytes that one process writes, also where it goes on with
# what that one has left. Run by ctest with PROGRAM, MPIEXEC, NUMPROC_FLAG, FORMATS and WORK;
# `FORMATS` are the endings of the outputs, "csv;nc" where the program writes netCDF.
cmake_minimum_required(VERSION 3.22)

# Unequal numbers of samples, cells that diverge and cells that are not admissible: chunks that
# take unequal times.
set(sweep sweep --quiet --chunk 3 --duration 10
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
  file(GLOB_RECURSE expected RELATIVE ${WORK}/alone ${WORK}/alone/*)
  file(GLOB_RECURSE found RELATIVE ${WORK}/${way} ${WORK}/${way}/*)
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

# Killed at whatever moment that is, even before its first chunk or after its last one.
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

# Processes that have unlike instruction sets compute with the smallest.
file(MAKE_DIRECTORY ${WORK}/unlike)
set(unlike ${sweep} --output ${WORK}/unlike/sweep.csv)
run_command(${MPIEXEC} ${NUMPROC_FLAG} 1 ${PROGRAM} ${unlike} --instructions baseline
  : ${NUMPROC_FLAG} 1 ${PROGRAM} ${unlike})
require_success(unlike)
file(READ ${WORK}/unlike/sweep.csv-metadata.json metadata)
if(NOT metadata MATCHES "\"instructions\": \"baseline\"")
  message(FATAL_ERROR "unlike processes do not compute with the smallest instruction set\n${metadata}")
endif()

# Three processes show what one does.
function(require_one_table)
  run_command(${ARGV})
  require_success("--dry-run of one process")
  set(table "${output}")
  run_command(${MPIEXEC} ${NUMPROC_FLAG} 3 ${ARGV})
  require_success("--dry-run of 3 processes")
  if(NOT output STREQUAL table)
    message(FATAL_ERROR "3 processes show\n${output}\nin place of\n${table}")
  endif()
endfunction()

require_one_table(${PROGRAM} ${sweep} --dry-run)

# One process speaks for all, in one line that names `what`.
function(require_refused processes what)
  run_command(${MPIEXEC} ${NUMPROC_FLAG} ${processes} ${PROGRAM} ${ARGN})
  if(NOT code EQUAL 2)
    message(FATAL_ERROR "exit code ${code} in place of 2 although ${what}\n${messages}")
  endif()
  string(REPLACE ";" "," messages "${messages}")  # else a list
  string(REGEX MATCHALL "(^|\n)holdfast: [^\n]*" lines "${messages}")
  list(LENGTH lines times)
  if(NOT times EQUAL 1 OR NOT lines MATCHES "${what}")
    message(FATAL_ERROR "${what} is to be told in one line, not in ${times} of\n${messages}")
  endif()
endfunction()

require_refused(3 "backlash.width" sweep --quiet --axis backlash.widht=0:1:2
  --output ${WORK}/refused.csv)
require_refused(2 "--output" ${sweep})

# Faults that one process finds when all have come together.
require_refused(3 "absent/sweep.csv" ${sweep} --output ${WORK}/absent/sweep.csv)

# A sweep that is too long to end is killed once it has finished a chunk.
set(kept ${WORK}/kept)
file(MAKE_DIRECTORY ${kept})
set(long_sweep sweep --quiet --chunk 1 --duration 10 --axis backlash.width=0:0.002:1000000)
foreach(seconds IN ITEMS 0.3 1 4 16 64)
  execute_process(COMMAND ${PROGRAM} ${long_sweep} --output ${kept}/sweep.csv TIMEOUT ${seconds}
    RESULT_VARIABLE ignored OUTPUT_QUIET ERROR_QUIET)
  file(GLOB chunks ${kept}/sweep.csv.zarr/steady_peak/c.*)
  if(chunks)
    break()
  endif()
endforeach()
require_refused(3 "--resume" ${long_sweep} --output ${kept}/sweep.csv)
file(GLOB chunks_after ${kept}/sweep.csv.zarr/steady_peak/c.*)
if(NOT chunks OR NOT chunks_after STREQUAL chunks)
  message(FATAL_ERROR "a refused sweep leaves ${chunks_after} in place of ${chunks}")
endif()
file(REMOVE_RECURSE ${kept})
