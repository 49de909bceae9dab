# Run by cpack on what it is about to pack: where Debian's zsh looks, and how Debian keeps manual pages.
set(share ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
execute_process(COMMAND gzip -9n ${share}/man/man1/holdfast.1 COMMAND_ERROR_IS_FATAL ANY)
