# cmake -D WORK=<scratch folder> -P floors_test.cmake
# The floor check is run on small trees: one that keeps the rules, and one for each way to break them.
cmake_minimum_required(VERSION 3.22)

# Runs the check on a tree of one file that holds one line; `result` is its exit code.
function(check_tree file line result messages)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/src/case_file.hpp "#pragma once\n")
  file(WRITE ${WORK}/include/holdfast/core/types.hpp "#pragma once\n#include <Eigen/Core>\n")
  file(WRITE ${WORK}/${file} "#pragma once\n${line}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D ROOT=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/floors.cmake
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(${result} ${code} PARENT_SCOPE)
  set(${messages} "${output}" PARENT_SCOPE)
endfunction()

function(expect_allowed file line)
  check_tree(${file} "${line}" code output)
  if(NOT code EQUAL 0)
    message(SEND_ERROR "refused though allowed: ${file}: ${line}\n${output}")
  endif()
endfunction()

# The refusal must name the file, so that a crash of the check does not count as one.
function(expect_refused file line)
  check_tree(${file} "${line}" code output)
  string(FIND "${output}" "${file}: " position)
  if(code EQUAL 0 OR position EQUAL -1)
    message(SEND_ERROR "not refused: ${file}: ${line}\n${output}")
  endif()
endfunction()

set(here include/holdfast)

expect_allowed(${here}/core/select.hpp "#include \"holdfast/core/types.hpp\"")
expect_allowed(${here}/plant/reduction.hpp "#include <holdfast/cable/modes.hpp>")
expect_allowed(${here}/motion/stepper.hpp "#include \"holdfast/backlash/hysteresis.hpp\"")
expect_allowed(${here}/attractor/basins.hpp "#include \"holdfast/stability/chart.hpp\"")
expect_allowed(${here}/sundials/decay.hpp "#include \"holdfast/sundials/solver.hpp\"")
expect_allowed(${here}/ceres/fit.hpp "#include \"holdfast/cable/elements.hpp\"")
expect_allowed(${here}/holdfast.hpp "#include \"holdfast/sweep/plan.hpp\"")
expect_allowed(${here}/core/errors.hpp "// The text #include \"holdfast/sweep/plan.hpp\" stands here")
expect_allowed(src/report.cpp "#include \"case_file.hpp\"\n#include \"holdfast/holdfast.hpp\"")

expect_allowed(src/cable_decay.cpp "#include \"holdfast/sundials/load_removal.hpp\"")
expect_allowed(src/damping_fit.cpp "#include \"holdfast/ceres/decay_fit.hpp\"")

expect_refused(${here}/core/select.hpp "#include \"holdfast/cable/modes.hpp\"")
expect_refused(${here}/core/select.hpp "  #  include   <holdfast/sweep/plan.hpp>  // [0, 1")
expect_refused(${here}/core/detail/select.hpp "#include \"holdfast/plant/two_dof.hpp\"")
expect_refused(${here}/control/gains.hpp "#include \"holdfast/stability/chart.hpp\"")
expect_refused(${here}/backlash/hysteresis.hpp "#include \"holdfast/cable/modes.hpp\"")
expect_refused(${here}/backlash/hysteresis.hpp "#include \"holdfast/control/gains.hpp\"")
expect_refused(${here}/stability/chart.hpp "#include \"holdfast/backlash/hysteresis.hpp\"")
expect_refused(${here}/stability/chart.hpp "#include \"holdfast/motion/stepper.hpp\"")
expect_refused(${here}/motion/stepper.hpp "#include \"holdfast/stability/chart.hpp\"")
expect_refused(${here}/attractor/basins.hpp "#include \"holdfast/sweep/plan.hpp\"")
expect_refused(${here}/motion/hybrid.hpp "#include \"holdfast/sundials/solver.hpp\"")
expect_refused(${here}/sundials/decay.hpp "#include \"holdfast/ceres/fit.hpp\"")
expect_refused(${here}/holdfast.hpp "#include \"holdfast/ceres/fit.hpp\"")
expect_refused(${here}/plant/two_dof.hpp "#include \"holdfast/holdfast.hpp\"")
expect_refused(${here}/plant/two_dof.hpp "#include \"case_file.hpp\"")
expect_refused(${here}/plant/two_dof.hpp "#include <case_file.hpp>")
expect_refused(${here}/plant/two_dof.hpp "#include \"../../../src/case_file.hpp\"")
expect_refused(${here}/plant/two_dof.hpp "#include \"../core/types.hpp\"")
expect_refused(${here}/attic/new.hpp "#include <vector>")
