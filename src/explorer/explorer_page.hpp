#pragma once

#include <string>

#include "case/case.hpp"
#include "case/case_source.hpp"

namespace holdfast::program {

/// The explorer: one page that computes in a browser, with the program compiled to WebAssembly in
/// it. It is built apart (preset `wasm`) and read when it is asked for; what the program adds is
/// the case.
///
/// @return the page with the case in it, for a file
/// Throws NoAnswer where the page was not built, with what builds it; WrongInput for a case that
/// reads further files, which the page cannot.
std::string explorer_page(const Case& the_case, const CaseSource& source);

/// Whether the page was built and can have the case.
bool can_explore(const Case& the_case);

}  // namespace holdfast::program
