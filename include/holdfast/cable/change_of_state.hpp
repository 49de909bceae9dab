#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"

namespace holdfast {

/// Stress–strain curves σ = a₀ + a₁ε + … + a₄ε⁴ of one material's wires in a conductor. The stress
/// σ (Pa) is the wires' force over the area of the whole conductor. The strain ε is mechanical: it
/// excludes thermal expansion and is 0 in the unloaded conductor at the reference temperature.
struct WireCurves {
  std::array<double, 5> initial{};  ///< a₀ … a₄ (Pa) of new wires that are loaded for one hour
  std::array<double, 5> creep{};    ///< a₀ … a₄ (Pa) after ten years of creep
  double modulus = 0.0;             ///< slope dσ/dε (Pa) on unloading, ≥ 0; 0: no such wires
  double expansion = 0.0;           ///< coefficient of thermal expansion α (1/K)

  /// Stress σ (Pa) of the curve `initial` or `creep` at a strain ε; 0 if the wires are slack.
  static double on(const std::array<double, 5>& curve, double strain) {
    if (strain <= 0.0) return 0.0;
    double stress = 0.0;
    for (std::size_t k = curve.size(); k-- > 0;) stress = stress * strain + curve[k];
    return std::max(stress, 0.0);
  }
};

/// Curves of linearly elastic wires that do not creep.
/// @param modulus    Young's modulus (Pa) times the wires' fraction of the conductor's area, ≥ 0
/// @param expansion  coefficient of thermal expansion α (1/K)
inline WireCurves linear_wires(double modulus, double expansion) {
  return {{0.0, modulus}, {0.0, modulus}, modulus, expansion};
}

/// Stress–strain curves of a conductor.
struct ConductorCurves {
  WireCurves outer;                     ///< curves of the outer, conducting wires
  WireCurves core;                      ///< curves of the core; modulus 0: no core
  double reference_temperature = 20.0;  ///< temperature (°C) at which both materials are unstressed
  double largest_strain = 0.01;         ///< largest strain for which the curves are valid
  bool creeps = false;                  ///< whether creep and load leave a permanent strain
};

/// Stress–strain curves of ACSR conductors of 26 aluminium and 7 steel wires, such as "Drake".
/// Source: Aluminum Company of America, stress–strain–creep chart 1-537 (psi over percent, 70 °F).
inline ConductorCurves acsr_26_7_curves() {
  constexpr double psi = 6894.757293168361, percent = 0.01, fahrenheit = 5.0 / 9.0;
  const auto curve = [=](std::array<double, 5> printed) {
    double scale = psi;
    for (double& coefficient : printed) {
      coefficient *= scale;
      scale /= percent;
    }
    return printed;
  };
  return {{curve({-1213.0, 44308.1, -14004.4, -37618.0, 30676.0}),
           curve({-544.8, 21426.8, -18842.2, 5495.0, 0.0}), 64000.0 * psi / percent,
           12.8e-6 / fahrenheit},
          {curve({-69.3, 38629.0, 3998.1, -45713.0, 27892.0}),
           curve({47.1, 36211.3, 12201.4, -72392.0, 46338.0}), 37000.0 * psi / percent,
           6.4e-6 / fahrenheit},
          (70.0 - 32.0) * fahrenheit,
          0.005,
          true};
}

/// Temperature and load of a span, on which its tension depends.
struct SpanWeather {
  double temperature;        ///< temperature of the conductor (°C)
  double weight_per_length;  ///< load w (N/m) across the chord: conductor, ice and wind, > 0
};

/// Tension, sag and strain of a span at one temperature and load, see SpanWeather.
struct SpanTension {
  double horizontal;   ///< horizontal tension H (N)
  double support;      ///< largest tension H cosh(wL/2H) (N), at the supports; L (m) is the span
  double sag;          ///< sag (H/w)(cosh(wL/2H) − 1) (m), in the plane of the load w
  double core_share;   ///< fraction of the force that the core carries, 0 … 1
  double strain;       ///< larger mechanical strain of outer wires and core, see WireCurves
  bool within_curves;  ///< whether the stress–strain curves are valid at `strain`
};

/// Sag (H/w)(cosh(wL/2H) − 1) (m) of a catenary of span L (m), weight w (N/m), tension H (N).
inline double catenary_sag(double horizontal_tension, double weight_per_length, double span) {
  const double half = std::sinh(weight_per_length * span / (4.0 * horizontal_tension));
  return 2.0 * horizontal_tension / weight_per_length * half * half;
}

/// Measured tension of a strung span, with the heaviest load on the span so far.
struct Stringing {
  SpanWeather weather;        ///< weather during the measurement
  double horizontal_tension;  ///< measured horizontal tension H (N), > 0
  bool is_final = false;      ///< whether H was measured after ten years of creep and `heaviest`
  std::optional<SpanWeather> heaviest = {};  ///< heaviest load so far; none: only creep acts
};

/// The change of state of a strung span: its tension at every temperature and load, when new and
/// after ten years of creep and the heaviest load.
///
/// The conductor of unstressed length L₀ hangs in a span L. Under the load w and the horizontal
/// tension H its catenary has the length S = (2H/w) sinh(wL/2H) and the strain ε = S/L₀ − 1. At the
/// temperature T the stresses balance the mean tension:
///
///     A Σ_c σ_c(ε − α_c (T − T₀)) = H (L/2 + (H/2w) sinh(wL/H))/S
///
/// The sum is over the materials c: outer wires and core. A is the conductor's cross section, α_c
/// the thermal expansion, T₀ the reference temperature. Slack wires have no stress. In a new
/// conductor σ_c is the initial curve. Creep over ten years, in the weather of the measurement,
/// leaves a permanent strain in each material. The heaviest load leaves one too; the larger counts.
/// The final σ_c rises from zero at this strain with the slope `modulus`, up to the initial curve.
/// Without `creeps` there is no permanent strain. Source: experimental plastic elongation method;
/// CIGRE Technical Brochure 324, Sag-tension calculation methods for overhead lines, 2016.
class StrungSpan {
 public:
  /// @param curves  stress–strain curves of the conductor
  /// @param area    cross section A (m²), > 0
  /// @param span    span L (m), > 0; the ruling span of several spans with swinging insulators
  /// @param stringing  measured tension, and the heaviest load so far
  /// @throws InvalidParameter naming the parameter that is out of range
  StrungSpan(const ConductorCurves& curves, double area, double span, const Stringing& stringing)
      : curves_(curves), area_(area), span_(span) {
    require_positive("area", area, "m^2");
    require_positive("span L", span, "m");
    require_positive("horizontal tension H", stringing.horizontal_tension, "N");
    require_positive("weight per length", stringing.weather.weight_per_length, "N/m");
    const SpanWeather& then = stringing.weather;
    string_with(unstressed_length(then, stringing.horizontal_tension), stringing);
    if (!stringing.is_final) return;
    // Creep and load lengthen a span: when strung it was shorter than when measured.
    const double found = length_;
    const auto missing = [&](double shortening) {
      string_with(found * (1.0 - shortening), stringing);
      return final(then).horizontal - stringing.horizontal_tension;
    };
    string_with(found * (1.0 - root(missing, 0.0, curves_.largest_strain)), stringing);
  }

  /// Tension of the new span, without permanent strain, at a given temperature and load.
  SpanTension initial(const SpanWeather& weather) const {
    return tension(weather, horizontal_tension(weather, Law::initial), Law::initial);
  }

  /// Tension after ten years of creep and the heaviest load, at a given temperature and load.
  SpanTension final(const SpanWeather& weather) const {
    return tension(weather, horizontal_tension(weather, Law::final), Law::final);
  }

 private:
  enum class Law { initial, creep, final };
  static constexpr double longest_strain = 0.05;  // of a search

  template <class Function>
  static double root(const Function& function, double lower, double upper) {
    const double at_lower = function(lower), at_upper = function(upper);
    return bracketing_root<double>(function, {lower, upper, at_lower, at_upper}, 1e-15).lower;
  }

  double mechanical(const WireCurves& wires, double strain, double temperature) const {
    return strain - wires.expansion * (temperature - curves_.reference_temperature);
  }

  double stress(const WireCurves& wires, double permanent, double strain, Law law) const {
    if (law == Law::creep) return WireCurves::on(wires.creep, strain);
    const double first = WireCurves::on(wires.initial, strain);
    if (law == Law::initial) return first;
    return std::min(std::max(wires.modulus * (strain - permanent), 0.0), first);
  }

  double outer_stress(double strain, double temperature, Law law) const {
    return stress(curves_.outer, permanent_[0], mechanical(curves_.outer, strain, temperature),
                  law);
  }
  double core_stress(double strain, double temperature, Law law) const {
    return stress(curves_.core, permanent_[1], mechanical(curves_.core, strain, temperature), law);
  }
  double stress(double strain, double temperature, Law law) const {
    return outer_stress(strain, temperature, law) + core_stress(strain, temperature, law);
  }

  double catenary_length(double horizontal, double weight) const {
    return 2.0 * horizontal / weight * std::sinh(weight * span_ / (2.0 * horizontal));
  }

  double mean_tension(double horizontal, double weight) const {
    return horizontal *
           (span_ / 2.0 + horizontal / (2.0 * weight) * std::sinh(weight * span_ / horizontal)) /
           catenary_length(horizontal, weight);
  }

  /// Unstressed length L₀ (m) of a new conductor with a given horizontal tension (N).
  double unstressed_length(const SpanWeather& weather, double horizontal) const {
    const double wanted = mean_tension(horizontal, weather.weight_per_length) / area_;
    const auto excess = [&](double strain) {
      return stress(strain, weather.temperature, Law::initial) - wanted;
    };
    return catenary_length(horizontal, weather.weight_per_length) /
           (1.0 + root(excess, -longest_strain, longest_strain));
  }

  double horizontal_tension(const SpanWeather& weather, Law law) const {
    const double weight = weather.weight_per_length, whole = weight * span_;
    const auto excess = [&](double logarithm) {
      const double horizontal = std::exp(logarithm);
      const double strain =
          std::min(catenary_length(horizontal, weight) / length_ - 1.0, longest_strain);
      return area_ * stress(strain, weather.temperature, law) - mean_tension(horizontal, weight);
    };
    const double stiffest = area_ * (curves_.outer.modulus + curves_.core.modulus);
    return std::exp(root(excess, std::log(0.1 * whole), std::log(whole + stiffest)));
  }

  SpanTension tension(const SpanWeather& weather, double horizontal, Law law) const {
    const double weight = weather.weight_per_length, temperature = weather.temperature;
    const double strain = catenary_length(horizontal, weight) / length_ - 1.0;
    const double core = core_stress(strain, temperature, law);
    const double largest =
        std::max(mechanical(curves_.outer, strain, temperature),
                 curves_.core.modulus > 0.0 ? mechanical(curves_.core, strain, temperature) : 0.0);
    const double sag = catenary_sag(horizontal, weight, span_);
    return {horizontal, horizontal + weight * sag,
            sag,        core / (core + outer_stress(strain, temperature, law)),
            largest,    largest <= curves_.largest_strain};
  }

  /// Permanent strains that the tension in one weather leaves in outer wires and core.
  std::array<double, 2> permanent_by(const SpanWeather& weather, Law law) const {
    const double horizontal = horizontal_tension(weather, law);
    const double strain = catenary_length(horizontal, weather.weight_per_length) / length_ - 1.0;
    std::array<double, 2> permanent{};
    const std::array<const WireCurves*, 2> parts = {&curves_.outer, &curves_.core};
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double stretched = mechanical(*parts[k], strain, weather.temperature);
      if (parts[k]->modulus > 0.0)
        permanent[k] = stretched - stress(*parts[k], 0.0, stretched, law) / parts[k]->modulus;
    }
    return permanent;
  }

  /// Sets the unstressed length (m), and the permanent strains by creep and by the heaviest load.
  void string_with(double unstressed, const Stringing& stringing) {
    length_ = unstressed;
    permanent_ = {};
    if (!curves_.creeps) return;
    permanent_ = permanent_by(stringing.weather, Law::creep);
    if (!stringing.heaviest) return;
    const std::array<double, 2> by_load = permanent_by(*stringing.heaviest, Law::initial);
    for (std::size_t k = 0; k < by_load.size(); ++k)
      permanent_[k] = std::max(permanent_[k], by_load[k]);
  }

  ConductorCurves curves_;
  double area_, span_;
  double length_ = 0.0;                   // L₀ (m)
  std::array<double, 2> permanent_ = {};  // strains of outer wires and core
};

}  // namespace holdfast
