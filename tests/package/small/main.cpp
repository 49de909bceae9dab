#include <cstdio>
#include <string>

#include "holdfast/core/version.hpp"
#include "holdfast/plant/two_mass.hpp"

int main() {
  const auto matrix = holdfast::kollar2022_plant().state_matrix();
  std::printf("%s %ld\n", std::string(holdfast::version_string).c_str(), long{matrix.rows()});
}
