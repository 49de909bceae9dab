#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

#include "text/text.hpp"

namespace holdfast::program {

/// Contents of the files of texts/ (TOML), embedded when the program was built.
extern const std::string_view figures_texts, page_texts, page_style_texts, page_script_texts,
    program_texts, support_texts;

/// The string in a TOML node, with every @KEY@ replaced by its value. The node must be a string.
template <class Node>
std::string text_of(const Node& node, const Values& values = {}) {
  return filled(node.template value<std::string>().value(), values);
}

}  // namespace holdfast::program
