#include "holdfast/holdfast.hpp"

const void* version_seen_by_second_unit();

const void* version_seen_by_second_unit() { return &holdfast::version_string; }
