#include "jobs/charts/boundary_names.hpp"

namespace holdfast::program {

const char* name_of(BoundaryCurve curve) {
  switch (curve) {
    case BoundaryCurve::plus_one:
      return "plus_one";
    case BoundaryCurve::minus_one:
      return "minus_one";
    case BoundaryCurve::complex_pair:
      return "complex_pair";
    case BoundaryCurve::zero:
      return "zero";
    case BoundaryCurve::imaginary_pair:
      return "imaginary_pair";
  }
  return "";
}

}  // namespace holdfast::program
