#pragma once

#include <filesystem>

#include "case/case.hpp"
#include "case/case_source.hpp"

namespace holdfast::program {

/// Writes the explorer: one page that computes in a browser, with the program compiled to
/// WebAssembly in it. It is built apart (preset `wasm`) and read when it is asked for; what the
/// program adds is the case.
/// @param the_case  its plant settled, and without devices
/// Throws NoAnswer where the page was not built, with what builds it; WrongInput for a recorded
/// force, whose file the page does not have; what OutputFile throws.
void write_explorer_page(const std::filesystem::path& output, const Case& the_case,
                         const CaseSource& source);

/// Another folder of the page: that of a library which the program is part of, for there the
/// executable is somebody else's. Before any job.
void look_for_explorer_page_in(std::filesystem::path folder);

/// Whether the page was built and can have a case without devices.
bool can_explore(const Case& the_case);

}  // namespace holdfast::program
