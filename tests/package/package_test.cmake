# Run by ctest with the variables that tests/package/CMakeLists.txt gives.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})

run_step(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${prefix})
# An installed file that names the source folder would work on this machine alone.
file(GLOB_RECURSE package_files ${prefix}/*.cmake ${prefix}/*.hpp)
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  string(FIND "${text}" "${SOURCE}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} refers to ${SOURCE}")
  endif()
endforeach()

run_step(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Debug)
run_step(${CMAKE_COMMAND} --build ${WORK}/build)
run_step(${WORK}/build/consumer)
expect_output("${VERSION}\n")
