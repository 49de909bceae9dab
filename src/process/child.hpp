#pragma once

#include <functional>

namespace holdfast::program {

/// Runs some work in a copy of this process, which may crash or become another program without
/// harm to this one, and waits for it. The copy has only the thread that calls.
/// @param work  gives an exit code, 0 to 255; what it throws counts as 255
/// @return the exit code; minus the signal's number where one ended the copy; −1000 where none
///         could be made
int run_in_child(const std::function<int()>& work);

}  // namespace holdfast::program
