# cmake -D TEXT_FILE=… -D VARIABLE=… -D SOURCE_FILE=… -P embed_text.cmake
# Writes a C++ source that defines holdfast::program::VARIABLE with the file's text.
file(READ "${TEXT_FILE}" text)
if(text MATCHES "\\)holdfast_text\"")
  message(FATAL_ERROR "${TEXT_FILE} holds the delimiter of the raw string that would enclose it")
endif()
get_filename_component(name "${TEXT_FILE}" NAME)

# Compilers need not take a literal of more than 65536 characters: longer texts are put together from
# several, each of whole lines.
set(parts "")
set(most 60000)
string(LENGTH "${text}" length)
while(length GREATER most)
  string(SUBSTRING "${text}" 0 ${most} part)
  string(FIND "${part}" "\n" end REVERSE)
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${text}" 0 ${end} part)
  string(SUBSTRING "${text}" ${end} -1 text)
  string(LENGTH "${text}" length)
  string(APPEND parts "std::string(R\"holdfast_text(${part})holdfast_text\") + ")
endwhile()
if(parts STREQUAL "")
  set(definition "const std::string_view ${VARIABLE} = R\"holdfast_text(${text})holdfast_text\";")
else()
  set(definition "static const std::string ${VARIABLE}_whole = ${parts}R\"holdfast_text(${text})holdfast_text\";
const std::string_view ${VARIABLE} = ${VARIABLE}_whole;")
endif()

file(WRITE "${SOURCE_FILE}" "// Generated from ${name}; edit that file instead.
#include <string>
#include <string_view>

namespace holdfast::program {

extern const std::string_view ${VARIABLE};
${definition}

}  // namespace holdfast::program
")
