# Small functions that the project's own CMake files share.

# Says that a part is left out because a package is missing, and the reason that the package itself
# gave, if one follows; fails instead where HOLDFAST_REQUIRE_PACKAGES is on, so that no check passes
# by having been skipped.
function(holdfast_report_missing part what debian_package)
  set(text "${part}: not built, because ${what} is missing (Debian package ${debian_package})")
  if(ARGN)
    string(APPEND text ". Reason given: ${ARGN}")
  endif()
  if(HOLDFAST_REQUIRE_PACKAGES)
    message(FATAL_ERROR "${text}")
  endif()
  message(STATUS "${text}")
endfunction()

# Target holdfast_warnings: the warnings for the project's own code. It is never exported, so that
# a user of the library keeps the choice of warnings.
function(holdfast_add_warnings)
  add_library(holdfast_warnings INTERFACE)
  target_compile_options(holdfast_warnings INTERFACE
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wsign-conversion;-Wshadow>)
  if(HOLDFAST_WARNINGS_AS_ERRORS)
    target_compile_options(holdfast_warnings INTERFACE
      $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Werror>)
  endif()
  if(EMSCRIPTEN)  # its lists are no longer than its 32 bits of memory
    target_compile_options(holdfast_warnings INTERFACE -Wno-shorten-64-to-32)
  endif()
endfunction()

# Compiles a target for one of the levels of x86-64 beyond the compiler's own: x86-64-v3 (AVX2),
# x86-64-v4 (AVX-512).
function(holdfast_compile_for target architecture)
  target_compile_options(${target} PRIVATE -march=${architecture}
    # GCC 12 warns of its own AVX-512 intrinsics (GCC bug 105593); and of loads behind the end of
    # vectors of at most 20 numbers, which Eigen's unrolled sums hold and no such vector comes to.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-array-bounds>)
endfunction()

# The same for a target that is linked with units of the baseline. All have to agree on how numbers of
# Eigen are aligned, and on who aligns them: malloc of x86-64 does so to 16 bytes, where a wider set
# would have Eigen do it, and free what it did not allocate.
function(holdfast_compile_kernels_for target architecture)
  holdfast_compile_for(${target} ${architecture})
  target_compile_definitions(${target} PRIVATE
    EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)
endfunction()

# Makes the target holdfast::<adapter> where the option HOLDFAST_WITH_<ADAPTER> is on and its package
# is there; says what is left out otherwise.
macro(holdfast_add_adapter adapter part what debian_package)
  string(TOUPPER ${adapter} holdfast_adapter_option)
  if(HOLDFAST_WITH_${holdfast_adapter_option})
    cmake_language(CALL holdfast_find_${adapter})
    if(NOT TARGET holdfast::${adapter} AND HOLDFAST_TOP_LEVEL)
      holdfast_report_missing("${part}" "${what}" ${debian_package} ${${what}_NOT_FOUND_MESSAGE})
    endif()
  endif()
endmacro()

# Compiles with ccache where it is installed. It sees every path relative to the project, so that a
# clone in another folder finds what this one has compiled. A launcher that was asked for stays.
function(holdfast_compile_with_cache)
  find_program(HOLDFAST_CCACHE ccache)
  find_program(HOLDFAST_ENV env)
  mark_as_advanced(HOLDFAST_CCACHE HOLDFAST_ENV)
  if(HOLDFAST_CCACHE AND HOLDFAST_ENV AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER
      ${HOLDFAST_ENV} CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true ${HOLDFAST_CCACHE}
      PARENT_SCOPE)
  endif()
endfunction()

# The files of a room read much the same headers: `count` neighbours in the list make one unit, where
# HOLDFAST_JOIN_SOURCES is on. CMake's own units name their files by absolute paths, which no cache of
# another clone would know again.
function(holdfast_join_sources target count sources_variable)
  if(NOT HOLDFAST_JOIN_SOURCES)
    return()
  endif()
  set(units "")
  set(text "")
  set(joined 0)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/units/${target})
  foreach(source IN LISTS ${sources_variable} ITEMS "")
    if(source)
      get_filename_component(source ${source} ABSOLUTE)
      file(RELATIVE_PATH source ${folder} ${source})
      string(APPEND text "#include \"${source}\"\n")
      math(EXPR joined "${joined} + 1")
    endif()
    if(text AND (joined EQUAL count OR NOT source))
      list(LENGTH units number)
      file(CONFIGURE OUTPUT ${folder}/unit_${number}.cpp CONTENT "${text}" @ONLY)
      list(APPEND units ${folder}/unit_${number}.cpp)
      set(text "")
      set(joined 0)
    endif()
  endforeach()
  set(${sources_variable} ${units} PARENT_SCOPE)
endfunction()
