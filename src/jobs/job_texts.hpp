#pragma once

#include "io/text/compiled_texts.hpp"

namespace holdfast::program {

/// texts/jobs.toml, which is compiled in: what the jobs are called and asked, and what they write.
const toml::table& job_texts();

}  // namespace holdfast::program
