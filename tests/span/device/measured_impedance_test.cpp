#include "holdfast/span/device/measured_impedance.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "support/testing.hpp"

namespace holdfast {
namespace {

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

}  // namespace
}  // namespace holdfast
