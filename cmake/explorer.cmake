# The explorer: the whole program as a module of WebAssembly, and one page around it.
target_sources(holdfast_executable PRIVATE ${PROJECT_SOURCE_DIR}/explorer/engine.cpp)
# Where Debian keeps what emscripten's optimiser reads; a Node.js from elsewhere does not look there.
set_property(TARGET holdfast_executable PROPERTY RULE_LAUNCH_LINK
  "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
target_link_options(holdfast_executable PRIVATE
  -O3 -sMODULARIZE -sEXPORT_NAME=createHoldfast -sENVIRONMENT=worker -sINVOKE_RUN=0 -sEXIT_RUNTIME=0
  -sALLOW_MEMORY_GROWTH -sTOTAL_STACK=8MB -sFORCE_FILESYSTEM
  -sEXPORTED_RUNTIME_METHODS=callMain,FS,ccall
  -sEXPORTED_FUNCTIONS=_main,_malloc,_free,_holdfast_stable_cells,_holdfast_amplitudes,_holdfast_save_case)

# The page is put together by Node.js, which emscripten needs too.
find_program(HOLDFAST_NODE NAMES node nodejs)
find_file(HOLDFAST_D3 d3.min.js
  PATHS /usr/share/nodejs/d3/dist /usr/local/share/nodejs/d3/dist NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
mark_as_advanced(HOLDFAST_NODE HOLDFAST_D3)
if(NOT HOLDFAST_NODE OR NOT HOLDFAST_D3)
  message(FATAL_ERROR "the explorer's page needs D3 5 (Debian package node-d3) and Node.js (nodejs)")
endif()
file(GLOB holdfast_page_sources CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/explorer/page/* ${PROJECT_SOURCE_DIR}/explorer/assemble.mjs)
set(holdfast_engine ${PROJECT_BINARY_DIR}/bin/holdfast)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/explorer.html
  COMMAND ${HOLDFAST_NODE} ${PROJECT_SOURCE_DIR}/explorer/assemble.mjs ${PROJECT_SOURCE_DIR}/explorer/page
          ${HOLDFAST_D3} ${holdfast_engine}.js ${holdfast_engine}.wasm ${PROJECT_BINARY_DIR}/explorer.html
  DEPENDS holdfast_executable ${holdfast_page_sources}
  COMMENT "Putting the explorer's page together"
  VERBATIM)
add_custom_target(holdfast_explorer ALL DEPENDS ${PROJECT_BINARY_DIR}/explorer.html)
