# holdfast::compiled: what is heavy in the headers, compiled once. A target that links it is spared
# the same work in each of its own files; the results are those of the headers alone.
file(GLOB holdfast_compiled_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/*.cpp)
add_library(holdfast_compiled STATIC ${holdfast_compiled_sources})
add_library(holdfast::compiled ALIAS holdfast_compiled)
set_target_properties(holdfast_compiled PROPERTIES EXPORT_NAME compiled)
# The headers' `extern template` lines count where this is set.
target_compile_definitions(holdfast_compiled PUBLIC HOLDFAST_EXTERN_TEMPLATES)
target_link_libraries(holdfast_compiled PUBLIC holdfast::holdfast)
# Not linked, since what a static library links is exported with it.
target_compile_options(holdfast_compiled PRIVATE
  $<TARGET_PROPERTY:holdfast_warnings,INTERFACE_COMPILE_OPTIONS>)
# The level at which these solvers are measured, whatever the build type says; Debug is for finding
# faults. Beyond it GCC takes twice the time for the same speed.
target_compile_options(holdfast_compiled PRIVATE
  $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<NOT:$<CONFIG:Debug>>>:-O2>)
