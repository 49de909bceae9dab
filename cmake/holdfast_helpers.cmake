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
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow>)
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
