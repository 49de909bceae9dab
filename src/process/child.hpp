#pragma once

#include <functional>

namespace holdfast::program {

/// Runs a function in a child process and waits for it. The child may crash or become another
/// program without harm to this process. Of all threads only the calling one exists in the child.
/// @param work  function that returns an exit code, 0 to 255; an exception counts as 255
/// @return the child's exit code; minus the signal's number if a signal ended it; −1000 if no child
/// could be created
int run_in_child(const std::function<int()>& work);

}  // namespace holdfast::program
