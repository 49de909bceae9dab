#include "holdfast/holdfast.hpp"

const void* version_seen_by_second_unit();

// Two units that include everything must link, and share one copy of each inline variable.
int main() { return version_seen_by_second_unit() == &holdfast::version_string ? 0 : 1; }
