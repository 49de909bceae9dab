#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/span/device/lumped_device.hpp"
#include "holdfast/span/device/measured_impedance.hpp"
#include "holdfast/span/device/span_device.hpp"

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

using Complex = std::complex<double>;

TEST(MeasuredImpedance, RunsStraightBetweenItsRows) {
  const MeasuredImpedance device({{10.0, {1.0, 2.0}}, {20.0, {3.0, 0.0}}, {40.0, {0.0, 8.0}}});
  EXPECT_EQ(device.at(10.0), Complex(1.0, 2.0));
  EXPECT_EQ(device.at(40.0), Complex(0.0, 8.0));
  EXPECT_NEAR(std::abs(device.at(12.5) - Complex(1.5, 1.5)), 0.0, 1e-15);
  EXPECT_TRUE(std::isnan(device.at(9.0).real()));
  EXPECT_TRUE(std::isnan(device.at(41.0).real()));
  EXPECT_EQ(impedance(device, Complex(0.0, -20.0)),
            std::conj(impedance(device, Complex(0.0, 20.0))));
}

TEST(MeasuredImpedance, RefusesWhatWasNotMeasuredSo) {
  EXPECT_THROW(MeasuredImpedance(std::vector<MeasuredImpedance::Row>(1, {10.0, {1.0, 2.0}})),
               InvalidParameter);
  EXPECT_THROW(MeasuredImpedance({{10.0, {1.0, 2.0}}, {10.0, {1.0, 2.0}}}), InvalidParameter);
  EXPECT_THROW(MeasuredImpedance({{10.0, {1.0, 2.0}}, {20.0, {-0.1, 2.0}}}), InvalidParameter);
  EXPECT_THROW(MeasuredImpedance({{10.0, {1.0, 2.0}}, {20.0, {std::nan(""), 2.0}}}),
               InvalidParameter);
}

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
