// The change of state of a strung span beside published tables and a second route.

#include "holdfast/cable/change_of_state.hpp"

#include <array>
#include <cmath>

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double foot = 0.3048, pound_force = 4.4482216152605;
constexpr double drake_area = 0.7264 * 0.0254 * 0.0254;           // m²
constexpr double drake_weight = 1.094 * pound_force / foot;       // N/m
constexpr double with_thick_ice = 5.961 * pound_force / foot;     // N/m, 1.5 in
constexpr double with_ice_and_wind = 2.509 * pound_force / foot;  // N/m, 0.5 in and 4 lb/ft²

double celsius(double fahrenheit) { return (fahrenheit - 32.0) / 1.8; }

void expect_close(double found, double wanted, double relative) {
  EXPECT_NEAR(found, wanted, relative * std::abs(wanted));
}

/// @param tension_lbf  as printed: the mean of that at the supports and its horizontal part
void expect_state(const SpanTension& found, double sag_ft, double tension_lbf) {
  expect_close(0.5 * (found.horizontal + found.support) / pound_force, tension_lbf, 0.005);
  expect_close(found.sag / foot, sag_ft, 0.005);
  EXPECT_TRUE(found.within_curves);
}

/// H (N) of a printed mean tension and its sag.
double horizontal_of(double tension_lbf, double sag_ft, double weight) {
  return tension_lbf * pound_force - 0.5 * weight * sag_ft * foot;
}

SpanWeather bare_at(double fahrenheit) { return {celsius(fahrenheit), drake_weight}; }

/// Sags (ft) and tensions (lbf) of the bare span, from the coldest to the hottest.
struct PrintedYear {
  std::array<double, 8> sags, tensions;
};

template <class Tension>
void expect_year(const Tension& tension, const PrintedYear& printed) {
  constexpr std::array<double, 8> fahrenheit = {-20.0, 0.0, 30.0, 60.0, 90.0, 120.0, 167.0, 212.0};
  for (std::size_t k = 0; k < fahrenheit.size(); ++k)
    expect_state(tension(bare_at(fahrenheit[k])), printed.sags[k], printed.tensions[k]);
}

// Aluminum Company of America, sag and tension data, chart 1-537, span 700 ft, creep is a factor.
TEST(StrungSpan, HasThePublishedTensionsOfASpanThatCreeps) {
  const StrungSpan span(acsr_26_7_curves(), drake_area, 700.0 * foot,
                        {bare_at(60.0), horizontal_of(6300.0, 10.65, drake_weight), false,
                         SpanWeather{celsius(0.0), with_ice_and_wind}});
  expect_year([&](const SpanWeather& bare) { return span.final(bare); },
              {{8.22, 9.19, 10.75, 12.36, 13.96, 15.52, 16.97, 18.04},
               {8161.0, 7301.0, 6242.0, 5429.0, 4809.0, 4330.0, 3960.0, 3728.0}});
  expect_year([&](const SpanWeather& bare) { return span.initial(bare); },
              {{7.60, 8.26, 9.39, 10.65, 11.99, 13.37, 15.53, 17.52},
               {8824.0, 8115.0, 7142.0, 6300.0, 5596.0, 5020.0, 4326.0, 3837.0}});
}

// The same source, span 1000 ft, extra heavy load: creep is not a factor.
TEST(StrungSpan, HasThePublishedTensionsOfASpanThatBoreIce) {
  const SpanWeather ice{celsius(0.0), with_thick_ice}, less{celsius(0.0), with_ice_and_wind};
  const StrungSpan span(acsr_26_7_curves(), drake_area, 1000.0 * foot,
                        {bare_at(60.0), horizontal_of(4721.0, 29.09, drake_weight), false, ice});
  expect_state(span.final(ice), 41.11, 18287.0);
  expect_state(span.initial(less), 31.53, 10000.0);
  expect_state(span.final(less), 34.86, 9054.0);
  expect_year([&](const SpanWeather& bare) { return span.final(bare); },
              {{30.11, 31.25, 32.77, 33.63, 34.49, 35.33, 36.64, 37.87},
               {4564.0, 4399.0, 4197.0, 4091.0, 3990.0, 3896.0, 3759.0, 3638.0}});
}

TEST(StrungSpan, OfOneMaterialMissesThePublishedTensionWhereTheCoreIsAlone) {
  const StrungSpan linear({linear_wires(69.6e9, 18.9e-6), {}}, drake_area, 700.0 * foot,
                          {bare_at(-20.0), horizontal_of(8161.0, 8.22, drake_weight)});
  const double hot = linear.final(bare_at(212.0)).support / pound_force;
  EXPECT_LT(hot, 0.92 * 3728.0);  // 9 % too little
}

/// H (N) of one material by the parabola: H³ + H² (EA (wL)²/(24 H₀²) + EA α ΔT − H₀) = EA (wL)²/24.
double tension_by_parabola(double stiffness, double expansion, double before, double weight_before,
                           double after, double rise, double span) {
  const double sagging = stiffness * span * span / 24.0;
  const double slack = sagging * weight_before * weight_before / (before * before) +
                       stiffness * expansion * rise - before;
  double tension = before;
  for (int k = 0; k < 100; ++k) {
    const double value = tension * tension * (tension + slack) - sagging * after * after;
    tension -= value / (3.0 * tension * tension + 2.0 * tension * slack);
  }
  return tension;
}

// A ground wire of steel, 3/8 in EHS: the change-of-state equation of the parabola, which line
// engineers solve by hand, is right to the square of the slope.
TEST(StrungSpan, OfOneMaterialFollowsTheParabolicEquation) {
  const double modulus = 180e9, area = 51.1e-6, weight = 4.0, expansion = 11.5e-6, span = 300.0;
  const double strung = 13e3;
  const StrungSpan wire({linear_wires(modulus, expansion), {}}, area, span,
                        {{15.0, weight}, strung});
  for (const double temperature : {-30.0, 0.0, 40.0, 80.0})
    for (const double load : {weight, 3.0 * weight}) {
      const double by_hand = tension_by_parabola(modulus * area, expansion, strung, weight, load,
                                                 temperature - 15.0, span);
      EXPECT_NEAR(wire.initial({temperature, load}).horizontal, by_hand, 0.002 * by_hand)
          << temperature << " degC, " << load << " N/m";
    }
}

TEST(StrungSpan, StrungByItsFinalTensionIsTheSpanThatLeavesIt) {
  const SpanWeather ice{celsius(0.0), with_thick_ice};
  for (const bool has_ice : {false, true}) {
    Stringing strung{bare_at(60.0), 21e3};
    if (has_ice) strung.heaviest = ice;
    const StrungSpan span(acsr_26_7_curves(), drake_area, 300.0, strung);
    Stringing found = strung;
    found.is_final = true;
    found.horizontal_tension = span.final(bare_at(60.0)).horizontal;
    const StrungSpan again(acsr_26_7_curves(), drake_area, 300.0, found);
    for (const double fahrenheit : {-20.0, 60.0, 212.0}) {
      expect_close(again.initial(bare_at(fahrenheit)).horizontal,
                   span.initial(bare_at(fahrenheit)).horizontal, 1e-9);
      expect_close(again.final(bare_at(fahrenheit)).horizontal,
                   span.final(bare_at(fahrenheit)).horizontal, 1e-9);
    }
  }
}

TEST(StrungSpan, RefusesWhatNoSpanHas) {
  EXPECT_THROW(StrungSpan(acsr_26_7_curves(), 0.0, 300.0, {bare_at(60.0), 2e4}), InvalidParameter);
  EXPECT_THROW(StrungSpan(acsr_26_7_curves(), 1e-4, 0.0, {bare_at(60.0), 2e4}), InvalidParameter);
  EXPECT_THROW(StrungSpan(acsr_26_7_curves(), 1e-4, 300.0, {bare_at(60.0), 0.0}), InvalidParameter);
  // Ten times what breaks it.
  const StrungSpan tight(acsr_26_7_curves(), drake_area, 300.0, {bare_at(60.0), 1.4e6});
  EXPECT_FALSE(tight.initial(bare_at(60.0)).within_curves);
}

}  // namespace
}  // namespace holdfast
