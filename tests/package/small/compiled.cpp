// What the compiled library holds: without it this is compiled, but not linked.
#include <cstdio>

#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/plant/two_mass.hpp"

int main() {
  const auto matrix = holdfast::kollar2022_plant().state_matrix();
  std::printf("%ld\n", long{holdfast::eigenvalues(matrix).size()});
}
