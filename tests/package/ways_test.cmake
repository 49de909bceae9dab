# The ways to use the library from outside other than an installed CMake package with everything:
# add_subdirectory, the build folder, pkg-config. Run by ctest with the variables that
# tests/package/CMakeLists.txt gives.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
file(REMOVE_RECURSE ${WORK})

function(expect_small_program way)
  run_step(${CMAKE_COMMAND} -S ${SMALL} -B ${WORK}/${way} -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Debug ${ARGN})
  run_step(${CMAKE_COMMAND} --build ${WORK}/${way})
  run_step(${WORK}/${way}/small)
  expect_output("${VERSION} 4\n")
endfunction()

expect_small_program(subdirectory -D HOLDFAST_SOURCE=${SOURCE})
# Of a project that wants the headers, no package is looked for but Eigen; of one that asks, that one.
function(expect_looked_for way expected)
  file(STRINGS ${WORK}/${way}/CMakeCache.txt found REGEX "^(Ceres|SUNDIALS|xsimd)_DIR:")
  list(TRANSFORM found REPLACE "_DIR:.*" "")
  if(NOT "${found}" STREQUAL "${expected}")
    message(FATAL_ERROR "${way}: looked for '${found}', not '${expected}'")
  endif()
endfunction()
expect_looked_for(subdirectory "")
expect_small_program(with_ceres -D HOLDFAST_SOURCE=${SOURCE} -D HOLDFAST_WITH_CERES=ON)
expect_looked_for(with_ceres "Ceres")
expect_small_program(build_folder -D holdfast_DIR=${BUILD})

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  set(prefix ${WORK}/prefix)
  run_step(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${prefix})
  set(ENV{PKG_CONFIG_PATH} ${prefix}/share/pkgconfig)
  run_step(${PKG_CONFIG} --modversion holdfast)
  expect_output("${VERSION}\n")
  run_step(${PKG_CONFIG} --cflags holdfast)
  separate_arguments(flags UNIX_COMMAND "${step_output}")
  run_step(${COMPILER} ${flags} ${SMALL}/main.cpp -o ${WORK}/by_pkg_config)
  run_step(${WORK}/by_pkg_config)
  expect_output("${VERSION} 4\n")

  # The compiled part, where this build has one, in the folder of libraries.
  file(GLOB_RECURSE compiled ${prefix}/*/holdfast-compiled.pc)
  if(compiled)
    get_filename_component(folder ${compiled} DIRECTORY)
    set(ENV{PKG_CONFIG_PATH} ${prefix}/share/pkgconfig:${folder})
    run_step(${PKG_CONFIG} --cflags --libs holdfast-compiled)
    separate_arguments(flags UNIX_COMMAND "${step_output}")
    run_step(${COMPILER} ${SMALL}/compiled.cpp ${flags} -o ${WORK}/compiled_by_pkg_config)
    run_step(${WORK}/compiled_by_pkg_config)
    expect_output("4\n")
  endif()
endif()
