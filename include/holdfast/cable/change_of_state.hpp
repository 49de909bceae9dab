#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"

namespace holdfast {

/// Stress–strain curves of the wires of one material in a conductor. A stress (Pa) is their force
/// over the area of the whole conductor; a strain ε is the mechanical one, without that of the
/// temperature, and 0 in the unloaded conductor at the reference temperature.
struct WireCurves {
  std::array<double, 5> initial{};  ///< Σ a_k ε^k (Pa), of the first loading within an hour
  std::array<double, 5> creep{};    ///< likewise, after ten years under the stress
  double modulus = 0.0;             ///< dσ/dε (Pa) when unloaded, ≥ 0; 0: no such wires
  double expansion = 0.0;           ///< α (1/K)

  /// Stress (Pa) on a curve, 0 where the wires are slack.
  static double on(const std::array<double, 5>& curve, double strain) {
    if (strain <= 0.0) return 0.0;
    double stress = 0.0;
    for (std::size_t k = curve.size(); k-- > 0;) stress = stress * strain + curve[k];
    return std::max(stress, 0.0);
  }
};

/// Wires that stretch linearly and never creep.
/// @param modulus    E (Pa) of the wires times their share of the conductor's area, ≥ 0
/// @param expansion  α (1/K)
inline WireCurves linear_wires(double modulus, double expansion) {
  return {{0.0, modulus}, {0.0, modulus}, modulus, expansion};
}

/// Stress–strain curves of a conductor.
struct ConductorCurves {
  WireCurves outer;                     ///< which conduct
  WireCurves core;                      ///< may be none
  double reference_temperature = 20.0;  ///< °C, at which both are unstressed together
  double largest_strain = 0.01;         ///< up to which the curves hold
  bool creeps = false;                  ///< initial and creep curves differ
};

/// Curves of ACSR of 26 aluminium and 7 steel wires, "Drake" among them.
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

/// Weather of a span, as far as its tension depends on it.
struct SpanWeather {
  double temperature;        ///< of the conductor (°C)
  double weight_per_length;  ///< w (N/m) across the chord: conductor, ice and wind, > 0
};

/// Tension of a span in one weather.
struct SpanTension {
  double horizontal;   ///< H (N)
  double support;      ///< H cosh(wL/2H) (N), at the supports, the largest
  double sag;          ///< (H/w)(cosh(wL/2H) − 1) (m), in the plane of the load
  double core_share;   ///< of the core in the force, 0 … 1
  double strain;       ///< largest mechanical strain of both materials
  bool within_curves;  ///< that strain is one that the curves hold for
};

/// Sag H/w (cosh(wL/2H) − 1) (m) of a catenary.
inline double catenary_sag(double horizontal_tension, double weight_per_length, double span) {
  const double half = std::sinh(weight_per_length * span / (4.0 * horizontal_tension));
  return 2.0 * horizontal_tension / weight_per_length * half * half;
}

/// How a span was strung.
struct Stringing {
  SpanWeather weather;        ///< in which the tension was read
  double horizontal_tension;  ///< H (N), > 0
  bool is_final = false;      ///< read after creep and heaviest load, not when strung
  std::optional<SpanWeather> heaviest = {};  ///< load that the span has borne, if any
};

/// The change of state of a strung span: its tension at every temperature and load, when new and
/// after years.
///
/// The conductor has the unstressed length L₀. Under the tension H the catenary has the length
/// S = (2H/w) sinh(wL/2H) and the strain ε = S/L₀ − 1, and its wires of area A bear the mean
/// tension:
///
///     A Σ σ_c(ε − α_c (T − T₀)) = H (L/2 + (H/2w) sinh(wL/H))/S
///
/// with c the outer wires and the core; slack wires bear nothing, which gives the knee point. When
/// new, σ_c is the initial curve. Creep for ten years at the temperature of stringing, and the
/// heaviest load, each leave a permanent strain in each material: where its unloading line, of
/// slope `modulus`, comes to zero. The larger one counts; the final σ_c is that line up to the
/// initial curve. Source: the method of experimental plastic elongation; CIGRE Technical Brochure
/// 324, Sag-tension calculation methods for overhead lines, 2016.
class StrungSpan {
 public:
  /// @param curves  of the conductor
  /// @param area    A (m²), > 0
  /// @param span    L (m), > 0; of several spans with swinging insulators the ruling span
  /// @param stringing  the reading, and what the span has borne
  /// @throws InvalidParameter naming what is out of range
  StrungSpan(const ConductorCurves& curves, double area, double span, const Stringing& stringing)
      : curves_(curves), area_(area), span_(span) {
    require_positive("area", area, "m^2");
    require_positive("span L", span, "m");
    require_positive("horizontal tension H", stringing.horizontal_tension, "N");
    require_positive("weight per length", stringing.weather.weight_per_length, "N/m");
    const SpanWeather& then = stringing.weather;
    string_with(unstressed_length(then, stringing.horizontal_tension), stringing);
    if (!stringing.is_final) return;
    // Creep and load lengthen a span, so that it was strung shorter than it is found.
    const double found = length_;
    const auto missing = [&](double shortening) {
      string_with(found * (1.0 - shortening), stringing);
      return final(then).horizontal - stringing.horizontal_tension;
    };
    string_with(found * (1.0 - root(missing, 0.0, curves_.largest_strain)), stringing);
  }

  /// Tension of the new span.
  SpanTension initial(const SpanWeather& weather) const {
    return tension(weather, horizontal_tension(weather, Law::initial), Law::initial);
  }

  /// Tension after creep and the heaviest load.
  SpanTension final(const SpanWeather& weather) const {
    return tension(weather, horizontal_tension(weather, Law::final), Law::final);
  }

  /// Whether the heaviest load, and not creep, left the permanent strain of the outer wires.
  bool load_decides() const { return load_decides_; }

 private:
  enum class Law { initial, creep, final };
  static constexpr double longest_strain = 0.05;  // of a search

  /// Argument between two, at which a function comes to zero.
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

  /// S (m).
  double catenary_length(double horizontal, double weight) const {
    return 2.0 * horizontal / weight * std::sinh(weight * span_ / (2.0 * horizontal));
  }

  /// Mean of the tension along the catenary (N).
  double mean_tension(double horizontal, double weight) const {
    return horizontal *
           (span_ / 2.0 + horizontal / (2.0 * weight) * std::sinh(weight * span_ / horizontal)) /
           catenary_length(horizontal, weight);
  }

  /// L₀ (m) of a conductor that is new and has that tension.
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

  /// Permanent strain of outer wires and core by a state.
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

  /// Permanent strains of a conductor of that unstressed length.
  void string_with(double unstressed, const Stringing& stringing) {
    length_ = unstressed;
    permanent_ = {};
    if (!curves_.creeps) return;
    permanent_ = permanent_by(stringing.weather, Law::creep);
    if (!stringing.heaviest) return;
    const std::array<double, 2> by_load = permanent_by(*stringing.heaviest, Law::initial);
    load_decides_ = by_load[0] > permanent_[0];
    for (std::size_t k = 0; k < by_load.size(); ++k)
      permanent_[k] = std::max(permanent_[k], by_load[k]);
  }

  ConductorCurves curves_;
  double area_, span_;
  double length_ = 0.0;                   // L₀ (m)
  std::array<double, 2> permanent_ = {};  // strains of outer wires and core
  bool load_decides_ = false;
};

}  // namespace holdfast
