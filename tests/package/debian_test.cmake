# Packs the build as a Debian package, unpacks that, and runs what it holds. Run by ctest with the
# variables that tests/package/CMakeLists.txt gives.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
file(REMOVE_RECURSE ${WORK})

run_step(${CPACK} --config ${BUILD}/CPackConfig.cmake -G DEB -C ${CONFIG} -B ${WORK})
file(GLOB package ${WORK}/holdfast_${VERSION}*.deb)
run_step(${DPKG_DEB} -x ${package} ${WORK}/root)
foreach(file IN ITEMS bin/holdfast include/holdfast/holdfast.hpp share/pkgconfig/holdfast.pc
    share/cmake/holdfast/holdfast-config.cmake share/man/man1/holdfast.1.gz
    share/bash-completion/completions/holdfast share/zsh/vendor-completions/_holdfast
    share/holdfast/kollar2022.toml share/doc/holdfast/LICENSE
    share/doc/holdfast/holdfast.cdx.json)
  if(NOT EXISTS ${WORK}/root/usr/${file})
    message(FATAL_ERROR "the package has no /usr/${file}")
  endif()
endforeach()
run_step(${WORK}/root/usr/bin/holdfast --version)
if(NOT step_output MATCHES "^holdfast ${VERSION}\n")
  message(FATAL_ERROR "another version: ${step_output}")
endif()
run_step(${DPKG_DEB} -f ${package} Depends)
if(NOT step_output MATCHES "libc6")
  message(FATAL_ERROR "the package does not say what it depends on: ${step_output}")
endif()
