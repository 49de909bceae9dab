# cmake -D CASE_FILE=… -D SOURCE_FILE=… -P embed_case.cmake
# Writes a C++ source that defines holdfast::program::builtin_case_text with the file's text.
file(READ "${CASE_FILE}" text)
if(text MATCHES "\\)holdfast_case\"")
  message(FATAL_ERROR "${CASE_FILE} holds the delimiter of the raw string that would enclose it")
endif()
get_filename_component(name "${CASE_FILE}" NAME)
file(WRITE "${SOURCE_FILE}" "// Generated from ${name}; edit that file instead.
#include \"case/builtin_case.hpp\"

namespace holdfast::program {

const std::string_view builtin_case_text = R\"holdfast_case(${text})holdfast_case\";

}  // namespace holdfast::program
")
