#pragma once

#include <string>
#include <vector>

#include "text/compiled_texts.hpp"

namespace holdfast::program {

/// texts/jobs.toml, which is compiled in: what the jobs are called and asked, and what they write.
const toml::table& job_texts();

/// The texts of an array; none where it is none.
std::vector<std::string> words_of(const toml::array* texts);

}  // namespace holdfast::program
