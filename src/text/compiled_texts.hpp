#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

#include "text/text.hpp"

namespace holdfast::program {

/// The files of texts/ (TOML), as they were when the program was built.
extern const std::string_view figures_texts, page_texts, page_style_texts, page_script_texts,
    program_texts, support_texts;

/// The text of a node that is one; its values take the place of @KEY@.
template <class Node>
std::string text_of(const Node& node, const Values& values = {}) {
  return filled(node.template value<std::string>().value(), values);
}

}  // namespace holdfast::program
