#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

/// The hardware between plant and computer: a measurement filter F of first order, a drive D that
/// follows its command with a lag, and the presence of a velocity sensor,
///
///     F(s) = ω_f/(s + ω_f),   D(s) = ω_d/(s + ω_d)  or  ω_d²/(s² + 2 ζ_d ω_d s + ω_d²)
///
/// The computer reads the filtered displacement ẑ = F z and its rate. Without a velocity sensor,
/// (ẑ_j − ẑ_{j−1})/τ of samples j replaces the rate. The drive's force is D u for the command u.
struct LoopHardware {
  static constexpr double ideal = std::numeric_limits<double>::infinity();  ///< infinite: no lag

  double measurement_filter = ideal;  ///< cutoff ω_f/2π of the filter (Hz), > 0
  double drive_bandwidth = ideal;     ///< bandwidth ω_d/2π of the drive (Hz), > 0
  double drive_damping = ideal;       ///< damping ratio ζ_d, > 0; infinity: a lag of first order
  bool has_velocity_sensor = true;    ///< false: velocity by backward difference of readings
};

/// Rejects hardware outside the ranges stated at its members.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const LoopHardware& hardware) {
  const auto require = [](const char* name, double value, const char* unit) {
    if (!(value > 0.0)) throw InvalidParameter(name, value, unit, "> 0");
  };
  require("measurement filter", hardware.measurement_filter, "Hz");
  require("drive bandwidth", hardware.drive_bandwidth, "Hz");
  require("drive damping", hardware.drive_damping, "");
}

/// The plant with a filter (`with_measurement_filter`) and a drive with a lag (`with_drive_lag`).
/// @param plant     plant with an ideal drive
/// @param hardware  hardware, which adds up to three states
/// @throws InvalidParameter where the hardware is not admissible
template <class Scalar>
LinearPlant<Scalar> with_hardware(LinearPlant<Scalar> plant, const LoopHardware& hardware) {
  validate(hardware);
  if (hardware.drive_bandwidth != LoopHardware::ideal) {
    const Scalar bandwidth(hardware.drive_bandwidth);
    plant = hardware.drive_damping == LoopHardware::ideal
                ? with_drive_lag(plant, bandwidth)
                : with_drive_lag(plant, bandwidth, Scalar(hardware.drive_damping));
  }
  if (hardware.measurement_filter != LoopHardware::ideal)
    plant = with_measurement_filter(plant, Scalar(hardware.measurement_filter));
  return plant;
}

namespace detail {

/// The poles p of D(s) and of F(s); each lag is the product of −p/(s − p) over its poles.
struct HardwarePoles {
  std::vector<std::complex<double>> drive, filter;

  explicit HardwarePoles(const LoopHardware& hardware) {
    const double turn = 2.0 * pi<double>;
    if (hardware.drive_bandwidth != LoopHardware::ideal) {
      const double rate = turn * hardware.drive_bandwidth, zeta = hardware.drive_damping;
      if (zeta == LoopHardware::ideal) {
        drive = {-rate};
      } else {
        const std::complex<double> half = std::sqrt(std::complex<double>(zeta * zeta - 1.0));
        // Their product is rate²; computing the larger pole first loses no digit of the smaller.
        const std::complex<double> larger = -rate * (zeta + half);
        drive = {larger, rate * rate / larger};
      }
    }
    if (hardware.measurement_filter != LoopHardware::ideal)
      filter = {-turn * hardware.measurement_filter};
    part_equals();
  }

  /// The lag D(s) or F(s) from its poles.
  static std::complex<double> lag(const std::vector<std::complex<double>>& poles,
                                  const std::complex<double>& s) {
    std::complex<double> product(1.0);
    for (const std::complex<double>& p : poles) product *= -p / (s - p);
    return product;
  }

 private:
  /// Separates equal poles, which have no partial fractions, by relative ±ε: 10⁻⁵ for two poles,
  /// 10⁻³ for three. The response changes by a relative ε² and loses a factor 1/ε in accuracy.
  void part_equals() {
    std::vector<std::complex<double>*> all;
    all.reserve(drive.size() + filter.size());
    for (auto* of : {&drive, &filter})
      for (std::complex<double>& p : *of) all.push_back(&p);
    std::sort(all.begin(), all.end(),
              [](const auto* one, const auto* other) { return one->real() < other->real(); });
    const auto within = [](double share, const auto* one, const auto* other) {
      return std::abs(*one - *other) < share * std::abs(*one);
    };
    const bool three = all.size() == 3 && within(1e-3, all[0], all[2]);
    const double apart = three ? 1e-3 : 1e-5;
    for (std::size_t k = 0; k + 1 < all.size(); k += three ? 2 : 1) {
      std::complex<double>&slow = *all[three ? 2 : k + 1], &fast = *all[k];
      if (!within(apart, &fast, &slow)) continue;
      const double middle = 0.5 * (slow + fast).real();
      fast = middle * (1.0 + apart);
      slow = middle * (1.0 - apart);
      if (three) *all[1] = middle;
    }
  }
};

/// The partial fractions of G(s) Π (−p)/(s − p), from the fractions of G(s) and the lags' poles p.
inline std::vector<PlantPole> lagged(std::vector<PlantPole> poles,
                                     const std::vector<std::complex<double>>& lags) {
  for (const std::complex<double>& p : lags) {
    std::complex<double> there(0.0);
    for (PlantPole& pole : poles) {
      pole.residue *= -p / (pole.s - p);
      // −p G(p), each part of which is the lagged residue with the other sign.
      there -= pole.residue;
    }
    poles.push_back({p, there});
  }
  return poles;
}

}  // namespace detail

/// The poles of a plant with hardware, with residues from the command to the measured displacement.
/// The plant's poles come first, then those of drive and filter.
/// @param poles     all `plant_poles` of the plant without hardware
/// @param hardware  hardware; two equal poles of its lags are moved apart by a relative 10⁻⁵, three
///                  by 10⁻³. The response then changes by a relative 10⁻¹⁰ or 10⁻⁶
/// @return no poles where `poles` is empty, or plant and hardware share a pole
/// @throws InvalidParameter where the hardware is not admissible
inline std::vector<PlantPole> with_hardware(const std::vector<PlantPole>& poles,
                                            const LoopHardware& hardware) {
  validate(hardware);
  if (poles.empty()) return {};
  const detail::HardwarePoles lags(hardware);
  auto all = detail::lagged(detail::lagged(poles, lags.drive), lags.filter);
  for (const auto* of : {&lags.drive, &lags.filter})
    for (const std::complex<double>& p : *of)
      for (const PlantPole& pole : poles)
        if (!(std::abs(pole.s - p) > 1e-7 * std::abs(p))) return {};
  return all;
}

}  // namespace holdfast
