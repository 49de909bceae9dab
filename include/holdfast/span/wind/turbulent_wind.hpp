#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// A turbulent wind perpendicular to a span.
struct TurbulentWind {
  double mean_speed = 0.0;     ///< U (m/s), > 0
  double intensity = 0.0;      ///< I, standard deviation of the speed over U, 0 … 0.3
  double length_scale = 80.0;  ///< along the wind (m), > 0: the fluctuations last T = length/U
  double span_scale = 30.0;    ///< along the span (m), > 0
  std::uint64_t seed = 1;      ///< seed of the fluctuations
};

/// Rejects a wind outside the ranges stated at its members.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const TurbulentWind& wind) {
  require_positive("mean wind speed U", wind.mean_speed, "m/s");
  require_within("turbulence intensity", wind.intensity, "", 0.0, 0.3);
  require_positive("length scale of the turbulence along the wind", wind.length_scale, "m");
  require_positive("length scale of the turbulence along the span", wind.span_scale, "m");
}

/// Independent normal random numbers of mean 0 and variance 1, by Box and Muller from
/// `std::mt19937_64`. A seed gives the same numbers with every standard library.
class NormalNumbers {
 public:
  /// @param seed  any number
  explicit NormalNumbers(std::uint64_t seed) : engine_(seed) {}

  /// The next random number.
  double next() {
    if (kept_) {
      kept_ = false;
      return other_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - share()));
    const double angle = 2.0 * pi<double> * share();
    other_ = radius * std::sin(angle);
    kept_ = true;
    return radius * std::cos(angle);
  }

 private:
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }  // in [0, 1)

  std::mt19937_64 engine_;
  double other_ = 0.0;
  bool kept_ = false;
};

/// The wind speed at equidistant stations of a span as a function of time: U + u, where u is a
/// Gaussian Markov process in time and along the span,
///
///     ⟨u(x, t) u(x′, t′)⟩ = I² U² e^{−|t − t′|/T} e^{−|x − x′|/Λ},   T = length scale/U
///
/// where Λ is the span scale. u is drawn every T/50 and linear in between, where its variance is up
/// to 1 % smaller. Faster fluctuations are left out. Speeds below U/10 (1 in 700 at I = 0.3) are
/// replaced by U/10.
template <class Scalar = double>
class GustField {
 public:
  using Speeds = Eigen::Array<Scalar, Eigen::Dynamic, 1>;  ///< one for each station (m/s)

  /// @param wind      wind that passed `validate`
  /// @param stations  number of stations, ≥ 1
  /// @param spacing   distance between two stations (m), > 0
  GustField(const TurbulentWind& wind, int stations, double spacing)
      : wind_(wind),
        numbers_(wind.seed),
        interval_(wind.length_scale / wind.mean_speed / 50.0),
        along_(std::exp(-spacing / wind.span_scale)),
        from_(stations),
        to_(stations),
        speeds_(Speeds::Constant(stations, Scalar(wind.mean_speed))) {
    if (!steady()) {
      draw(to_);
      advance();
    }
  }

  /// Whether the wind is steady, I = 0.
  bool steady() const { return wind_.intensity == 0.0; }

  /// The wind speeds at all stations.
  /// @param time  time (s), ≥ that of the last call
  const Speeds& at(double time) {
    if (steady()) return speeds_;
    while (time > static_cast<double>(drawn_ + 1) * interval_) {
      advance();
      ++drawn_;
    }
    const Scalar share(time / interval_ - static_cast<double>(drawn_));
    speeds_ = (Scalar(wind_.mean_speed) + from_ + share * (to_ - from_))
                  .max(Scalar(0.1 * wind_.mean_speed));
    return speeds_;
  }

 private:
  /// Draws fluctuations (m/s) of variance I² U² that form a Markov process along the span.
  void draw(Speeds& fluctuations) {
    const double deviation = wind_.intensity * wind_.mean_speed;
    double number = numbers_.next();
    for (Eigen::Index j = 0; j < fluctuations.size(); ++j) {
      fluctuations[j] = Scalar(deviation * number);
      number = along_ * number + std::sqrt(1.0 - along_ * along_) * numbers_.next();
    }
  }

  void advance() {
    const double kept = std::exp(-1.0 / 50.0);
    from_ = to_;
    draw(speeds_);
    to_ = Scalar(kept) * from_ + Scalar(std::sqrt(1.0 - kept * kept)) * speeds_;
  }

  TurbulentWind wind_;
  NormalNumbers numbers_;
  double interval_, along_;
  long drawn_ = 0;
  Speeds from_, to_, speeds_;
};

}  // namespace holdfast
