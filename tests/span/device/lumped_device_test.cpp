#include "holdfast/span/device/lumped_device.hpp"

#include <cmath>
#include <complex>

#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TEST(LumpedDevice, OfOneMassIsThatMass) {
  const Complex s(-0.3, 40.0);
  const LumpedDevice rigid{{{1e9, 1e12, 0.0, 3.0}}, 2.0};
  EXPECT_NEAR(std::abs(impedance(rigid, s) - 5.0 * s), 0.0, 1e-4);
  // Far above its resonances a damper is its clamp and its dashpots; far below, its whole mass.
  const LumpedDevice stock = stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4});
  const Complex slow(0.0, turn_of(0.05)), fast(0.0, turn_of(1e5));
  EXPECT_NEAR(std::abs(impedance(stock, slow) / (4.4 * slow) - 1.0), 0.0, 1e-4);
  EXPECT_NEAR(impedance(stock, fast).imag() / (0.4 * fast.imag()), 1.0, 1e-4);
}

TEST(LumpedDevice, RefusesWhatIsNoDevice) {
  EXPECT_THROW(validate(LumpedDevice{{{-1.0}}, 0.0}), InvalidParameter);
  EXPECT_THROW(validate(LumpedDevice{{{1.0, 0.0, 0.0, 0.0}}, 0.0}), InvalidParameter);
  EXPECT_THROW(validate(LumpedDevice{{}, -1.0}), InvalidParameter);
  EXPECT_THROW(stockbridge({4.0, {9.0, 24.0}, {0.15, 0.0}}), InvalidParameter);
  EXPECT_THROW(stockbridge({4.0, {9.0, 24.0}, {0.15, 0.1}, 1.5}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
