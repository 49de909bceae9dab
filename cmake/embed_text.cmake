# cmake -D TEXT_FILE=… -D VARIABLE=… -D SOURCE_FILE=… -P embed_text.cmake
# Writes a C++ source that defines holdfast::program::VARIABLE with the file's text.
file(READ "${TEXT_FILE}" text)
if(text MATCHES "\\)holdfast_text\"")
  message(FATAL_ERROR "${TEXT_FILE} holds the delimiter of the raw string that would enclose it")
endif()
get_filename_component(name "${TEXT_FILE}" NAME)
file(WRITE "${SOURCE_FILE}" "// Generated from ${name}; edit that file instead.
#include <string_view>

namespace holdfast::program {

extern const std::string_view ${VARIABLE};
const std::string_view ${VARIABLE} = R\"holdfast_text(${text})holdfast_text\";

}  // namespace holdfast::program
")
