#include "holdfast/span/device/span_device.hpp"

#include <complex>
#include <vector>

#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(SpanDevice, HasTheImpedanceOfWhatItIs) {
  const std::complex<double> s(-0.3, 40.0);
  const LumpedDevice stock = stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4});
  EXPECT_EQ((SpanDevice{1.2, stock}.impedance(s)), impedance(stock, s));
}

TEST(SpanDevice, ThoseOfOnePlaceKeepTheirOrder) {
  const auto ordered =
      in_order({{2.0, dashpot_of(1.0)}, {1.0, dashpot_of(2.0)}, {2.0, dashpot_of(3.0)}}, 300.0);
  const std::complex<double> s(0.0, 40.0);
  const std::vector<double> coefficients = {2.0, 1.0, 3.0};
  for (std::size_t k = 0; k < ordered.size(); ++k)
    EXPECT_NEAR(ordered[k].impedance(s).real(), coefficients[k], 1e-9) << k;
}

TEST(SpanDevice, IsInsideTheSpan) {
  for (const double position : {0.0, 300.0, -1.0})
    EXPECT_THROW(in_order({{position, dashpot_of(1.0)}}, 300.0), InvalidParameter) << position;
}

}  // namespace
}  // namespace holdfast
