# The command-line program: static library holdfast_program (src/) and executable (apps/).

include(${PROJECT_SOURCE_DIR}/cmake/kernels.cmake)

function(holdfast_find_program_packages result)
  set(${result} ON PARENT_SCOPE)
  # package;Debian package
  foreach(pair IN ITEMS "CLI11 libcli11-dev" "tomlplusplus libtomlplusplus-dev"
                        "nlohmann_json nlohmann-json3-dev")
    string(REPLACE " " ";" pair "${pair}")
    list(GET pair 0 package)
    list(GET pair 1 debian_package)
    if(NOT TARGET ${package}::${package})
      find_package(${package} QUIET GLOBAL)
    endif()
    if(NOT TARGET ${package}::${package})
      holdfast_report_missing("program" "${package}" "${debian_package}")
      set(${result} OFF PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# A text that is compiled in as holdfast::program::VARIABLE, and again when its file changes. Gives
# the name of the source.
function(holdfast_embed_text text_file variable result)
  set(source_file ${CMAKE_CURRENT_BINARY_DIR}/generated/${variable}.cpp)
  add_custom_command(
    OUTPUT ${source_file}
    COMMAND ${CMAKE_COMMAND} -D TEXT_FILE=${text_file} -D VARIABLE=${variable}
            -D SOURCE_FILE=${source_file} -P ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake
    DEPENDS ${text_file} ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake
    COMMENT "Embedding ${text_file}"
    VERBATIM)
  set(${result} ${source_file} PARENT_SCOPE)
endfunction()

# Charts as netCDF. The library is loaded when a job asks for it rather than linked, since loading it
# and what it depends on takes longer than a small job does.
function(holdfast_use_netcdf target)
  if(NOT HOLDFAST_WITH_NETCDF)
    return()
  endif()
  find_path(HOLDFAST_NETCDF_INCLUDE_DIR netcdf.h)
  find_library(HOLDFAST_NETCDF_LIBRARY netcdf)
  mark_as_advanced(HOLDFAST_NETCDF_INCLUDE_DIR HOLDFAST_NETCDF_LIBRARY)
  if(NOT HOLDFAST_NETCDF_INCLUDE_DIR OR NOT HOLDFAST_NETCDF_LIBRARY)
    holdfast_report_missing("charts as netCDF" "the netCDF C library" libnetcdf-dev)
    return()
  endif()
  # The link without a version is there only where programs are built.
  file(REAL_PATH ${HOLDFAST_NETCDF_LIBRARY} library)
  target_include_directories(${target} SYSTEM PUBLIC ${HOLDFAST_NETCDF_INCLUDE_DIR})
  target_compile_definitions(${target}
    PUBLIC HOLDFAST_HAS_NETCDF
    PRIVATE HOLDFAST_NETCDF_LIBRARY="${library}")
  target_link_libraries(${target} PRIVATE ${CMAKE_DL_LIBS})
endfunction()

# Stores whose chunks are compressed.
function(holdfast_use_zstd target)
  if(NOT HOLDFAST_WITH_ZSTD)
    return()
  endif()
  find_path(HOLDFAST_ZSTD_INCLUDE_DIR zstd.h)
  find_library(HOLDFAST_ZSTD_LIBRARY zstd)
  mark_as_advanced(HOLDFAST_ZSTD_INCLUDE_DIR HOLDFAST_ZSTD_LIBRARY)
  if(NOT HOLDFAST_ZSTD_INCLUDE_DIR OR NOT HOLDFAST_ZSTD_LIBRARY)
    holdfast_report_missing("compressed stores" "Zstandard" libzstd-dev)
    return()
  endif()
  target_include_directories(${target} SYSTEM PUBLIC ${HOLDFAST_ZSTD_INCLUDE_DIR})
  target_compile_definitions(${target} PUBLIC HOLDFAST_HAS_ZSTD)
  target_link_libraries(${target} PRIVATE ${HOLDFAST_ZSTD_LIBRARY})
endfunction()

# The loops on packs are compiled as the build type says; the rest, which prepares and writes, is no
# faster beyond -O2.
function(holdfast_compile_quickly target)
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<CONFIG:Release>>:-O2>)
endfunction()

function(holdfast_compile_loops_on_packs)
  foreach(source IN LISTS ARGN)
    set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/${source} PROPERTY COMPILE_OPTIONS
      $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<CONFIG:Release>>:-O3>)
  endforeach()
endfunction()

function(holdfast_add_program)
  find_package(Threads REQUIRED)
  file(GLOB_RECURSE library_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*.cpp)
  list(FILTER library_sources EXCLUDE REGEX "/src/kernels/wide/[^/]*$")
  set(loops_on_packs ${PROJECT_SOURCE_DIR}/src/kernels/baseline.cpp)
  list(REMOVE_ITEM library_sources ${loops_on_packs})
  holdfast_join_sources(holdfast_program 8 library_sources)
  file(GLOB_RECURSE job_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/*.cpp)
  list(FILTER job_sources EXCLUDE REGEX "/apps/main.cpp$")
  holdfast_join_sources(holdfast_jobs 8 job_sources)
  holdfast_embed_text(${PROJECT_SOURCE_DIR}/data/kollar2022.toml builtin_case_text source)
  list(APPEND library_sources ${source})
  holdfast_embed_text(${PROJECT_SOURCE_DIR}/data/conductors.toml conductors_text source)
  list(APPEND library_sources ${source})
  foreach(name IN ITEMS figures page page_style page_script program jobs support)
    holdfast_embed_text(${PROJECT_SOURCE_DIR}/texts/${name}.toml ${name}_texts source)
    list(APPEND library_sources ${source})
  endforeach()

  set(library holdfast::holdfast)
  if(TARGET holdfast::compiled)
    set(library holdfast::compiled)
  endif()
  # The longest first, so that it is compiled beside the others rather than behind them.
  add_library(holdfast_program STATIC ${loops_on_packs} ${library_sources})
  target_include_directories(holdfast_program PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(holdfast_program PUBLIC HOLDFAST_VERSION="${PROJECT_VERSION}")
  target_link_libraries(holdfast_program
    PUBLIC ${library} CLI11::CLI11 tomlplusplus::tomlplusplus
           nlohmann_json::nlohmann_json Threads::Threads
    PRIVATE holdfast_warnings)
  foreach(adapter IN ITEMS simd sundials ceres)
    if(TARGET holdfast::${adapter})
      string(TOUPPER ${adapter} name)
      target_compile_definitions(holdfast_program PUBLIC HOLDFAST_HAS_${name})
      target_link_libraries(holdfast_program PRIVATE holdfast::${adapter})
    endif()
  endforeach()

  holdfast_use_netcdf(holdfast_program)
  holdfast_use_zstd(holdfast_program)
  holdfast_use_kernels(holdfast_program)  # last of what is linked

  holdfast_compile_quickly(holdfast_program)
  set_property(SOURCE ${loops_on_packs} PROPERTY COMPILE_OPTIONS
    $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<CONFIG:Release>>:-O3>)

  # The jobs on their command lines: all of the program but its main().
  add_library(holdfast_jobs STATIC ${job_sources})
  target_include_directories(holdfast_jobs PUBLIC ${PROJECT_SOURCE_DIR}/apps)
  target_link_libraries(holdfast_jobs PUBLIC holdfast_program PRIVATE holdfast_warnings)
  holdfast_compile_quickly(holdfast_jobs)
  # The name `holdfast` belongs to the library's target, so the executable's target has another.
  add_executable(holdfast_executable ${PROJECT_SOURCE_DIR}/apps/main.cpp)
  set_target_properties(holdfast_executable PROPERTIES
    OUTPUT_NAME holdfast
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_link_libraries(holdfast_executable PRIVATE holdfast_jobs holdfast_warnings)
endfunction()

holdfast_find_program_packages(HOLDFAST_PROGRAM_PACKAGES_FOUND)
if(HOLDFAST_PROGRAM_PACKAGES_FOUND)
  holdfast_add_program()
  if(EMSCRIPTEN)
    include(${PROJECT_SOURCE_DIR}/cmake/explorer.cmake)
  elseif(NOT CMAKE_CROSSCOMPILING)
    include(${PROJECT_SOURCE_DIR}/cmake/program_texts.cmake)
  endif()
endif()
