#include <holdfast/holdfast.hpp>

#include <iostream>

int main() { std::cout << holdfast::version_string << '\n'; }
