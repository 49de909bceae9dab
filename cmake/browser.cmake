# Compiling for the browser: what the program needs of other libraries is headers alone, read from
# where the system keeps them without its C library beside them, which is another than emscripten's.

# The flags of every unit: packs of 128 bits, through emscripten's headers of SSE2, which xsimd takes
# for a processor's; exceptions of WebAssembly itself.
set(HOLDFAST_BROWSER_FLAGS -msimd128 -msse2 -fwasm-exceptions)
add_compile_options(${HOLDFAST_BROWSER_FLAGS})
add_link_options(${HOLDFAST_BROWSER_FLAGS})

set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
# MMX has no counterpart in WebAssembly, and nothing uses it.
file(WRITE ${headers}/mmintrin.h "#pragma once\n")

# A target of headers that stand in `folder` of one of the system's include folders.
function(holdfast_headers_for_browser target folder debian_package)
  find_path(HOLDFAST_${folder}_PARENT ${folder} PATHS /usr/local/include /usr/include
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
  if(NOT HOLDFAST_${folder}_PARENT)
    message(FATAL_ERROR "the explorer needs the headers ${folder} (Debian package ${debian_package})")
  endif()
  file(CREATE_LINK ${HOLDFAST_${folder}_PARENT}/${folder} ${headers}/${folder} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE
    ${EMSCRIPTEN_SYSROOT}/include/compat ${headers})
endfunction()

holdfast_headers_for_browser(Eigen3::Eigen eigen3 libeigen3-dev)
target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${headers}/eigen3)
# Eigen's own packets of SSE2 are partly written in the processor's assembler.
target_compile_definitions(Eigen3::Eigen INTERFACE EIGEN_DONT_VECTORIZE)
holdfast_headers_for_browser(CLI11::CLI11 CLI libcli11-dev)
holdfast_headers_for_browser(tomlplusplus::tomlplusplus toml++ libtomlplusplus-dev)
holdfast_headers_for_browser(nlohmann_json::nlohmann_json nlohmann nlohmann-json3-dev)
holdfast_headers_for_browser(holdfast::simd xsimd libxsimd-dev)
target_link_libraries(holdfast::simd INTERFACE holdfast)
