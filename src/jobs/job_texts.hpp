#pragma once

#include <string>
#include <vector>

#include "text/compiled_texts.hpp"

namespace holdfast::program {

/// Contents of texts/jobs.toml, compiled in: names, options and table columns of the jobs.
const toml::table& job_texts();

/// Strings of a TOML array; empty for nullptr.
std::vector<std::string> words_of(const toml::array* texts);

}  // namespace holdfast::program
