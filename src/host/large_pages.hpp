#pragma once

#include <cstddef>

namespace holdfast::program {

/// Asks the system to back memory that is about to be written by large pages, of which there are
/// few to be had one after the other: the first touch of megabytes costs as much as a fast kernel
/// does. Without effect where there are none, or the memory is small.
void prefer_large_pages(void* memory, std::size_t bytes);

}  // namespace holdfast::program
