#pragma once

#include <filesystem>

#include "case/case.hpp"
#include "case/case_source.hpp"

namespace holdfast::program {

/// Writes the explorer: an HTML page with the program compiled to WebAssembly, which computes in a
/// browser. The page is built separately (preset `wasm`); this function inserts the case.
/// @param the_case  case with its plant computed and without devices
/// Throws NoAnswer if the page was not built, with the command that builds it; WrongInput for a
/// recorded force, whose file the page lacks; and the exceptions of OutputFile.
void write_explorer_page(const std::filesystem::path& output, const Case& the_case,
                         const CaseSource& source);

/// Sets the folder of the page, for a library that contains the program. Call before any job.
void look_for_explorer_page_in(std::filesystem::path folder);

/// Whether the page was built and the case has no recorded force; devices are not checked.
bool can_explore(const Case& the_case);

}  // namespace holdfast::program
