#pragma once

#include <functional>

#include "process/group/process_group.hpp"

namespace holdfast::program {

/// A step that all processes of a group take, and that ends when the last of them has. What one
/// throws ends it in all: where it arose it comes out as it is, elsewhere as ToldElsewhere with the
/// exit code of the first process at fault. All processes call it, in the same order.
void make_collective_call(ProcessGroup& group, const std::function<void()>& step);

}  // namespace holdfast::program
