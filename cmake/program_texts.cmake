# The manual page, the completions of command lines and the bill of materials: the program writes
# them itself, so that they have the same source as its --help and --version.

function(holdfast_write_text file)
  add_custom_command(
    OUTPUT ${PROJECT_BINARY_DIR}/texts/${file}
    COMMAND holdfast_executable ${ARGN} > ${PROJECT_BINARY_DIR}/texts/${file}
    DEPENDS holdfast_executable
    COMMENT "Writing ${file}"
    VERBATIM)
endfunction()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/texts)
holdfast_write_text(holdfast.1 manual)
holdfast_write_text(holdfast.bash completion bash)
holdfast_write_text(_holdfast completion zsh)
holdfast_write_text(holdfast.cdx.json bill-of-materials)
add_custom_target(holdfast_texts ALL DEPENDS
  ${PROJECT_BINARY_DIR}/texts/holdfast.1
  ${PROJECT_BINARY_DIR}/texts/holdfast.bash
  ${PROJECT_BINARY_DIR}/texts/_holdfast
  ${PROJECT_BINARY_DIR}/texts/holdfast.cdx.json)

if(HOLDFAST_INSTALL)
  install(FILES ${PROJECT_BINARY_DIR}/texts/holdfast.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${PROJECT_BINARY_DIR}/texts/holdfast.bash
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME holdfast)
  install(FILES ${PROJECT_BINARY_DIR}/texts/_holdfast
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${PROJECT_BINARY_DIR}/texts/holdfast.cdx.json
    DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
