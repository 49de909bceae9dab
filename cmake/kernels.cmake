# The kernels on packs (src/kernels) for the instruction sets beyond the baseline that the compiler
# takes by itself: a static library each, chosen from when the program runs.
#
# What a unit compiled for a wider set holds beside its kernels, such as a function of the standard
# library that was not inlined, may have the name of one in the baseline's units. The linker keeps
# the first one, and so these libraries come after everything else of the program and ask for
# nothing that it would have to look for there again. tests/architecture/instructions_test.cmake
# looks at the result.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)

# Where the flags given ask for AVX themselves, they are the program's one instruction set.
check_cxx_source_compiles("
#if !defined(__x86_64__) || defined(__AVX__)
#error \"no baseline of x86-64\"
#endif
int main() {}" HOLDFAST_BASELINE_IS_X86_64)

function(holdfast_add_kernels target level architecture)
  check_cxx_compiler_flag(-march=${architecture} HOLDFAST_COMPILES_FOR_${level})
  if(NOT HOLDFAST_COMPILES_FOR_${level})
    return()
  endif()
  set(kernels holdfast_kernels_${level})
  add_library(${kernels} STATIC ${PROJECT_SOURCE_DIR}/src/kernels/wide/${level}.cpp)
  target_include_directories(${kernels} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${kernels} PRIVATE holdfast::simd holdfast_warnings)
  holdfast_compile_kernels_for(${kernels} ${architecture})
  string(TOUPPER ${level} name)
  target_compile_definitions(${target} PRIVATE HOLDFAST_HAS_${name})
  target_link_libraries(${target} PRIVATE ${kernels})
endfunction()

# To be called when all else that the target links is said.
function(holdfast_use_kernels target)
  if(NOT HOLDFAST_BASELINE_IS_X86_64 OR NOT TARGET holdfast::simd)
    return()
  endif()
  holdfast_add_kernels(${target} avx2 x86-64-v3)
  holdfast_add_kernels(${target} avx512 x86-64-v4)
endfunction()
