#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/device/span_device.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/wind/modes_in_step.hpp"
#include "holdfast/span/wind/self_damping_law.hpp"
#include "holdfast/span/wind/turbulence.hpp"
#include "holdfast/span/wind/turbulent_wind.hpp"
#include "holdfast/span/wind/wake_oscillator.hpp"
#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast {

/// The setting of a simulation of a span in the wind.
struct WindHistorySetting {
  TautString<double> string;    ///< its damping ratio adds to that of every mode
  double diameter = 0.0;        ///< d (m), > 0
  double rated_strength = 0.0;  ///< RTS (N), > T; used by the law of self-damping only
  std::optional<SelfDampingLaw> self_damping;  ///< its amplitude exponent ≥ 2
  std::vector<SpanDevice> devices;             ///< devices near the supports
  TurbulentWind wind;                          ///< across the span
  /// The model of the force: wake oscillators coupled to the span, or a measured power of the wind.
  std::variant<WakeOscillatorLaw, WindPowerLaw> force;
  double strouhal = 0.2;           ///< St, > 0: vortices are shed at St U/d
  int modes = 100;                 ///< N, sines 1 … N of the span, 1 … 1000
  int stations = 400;              ///< M, number of wakes, N + 1 … 20000; 8 per half-wave suffice
  double initial_amplitude = 0.0;  ///< of the mode nearest to the shedding frequency (m), ≥ 0
  double duration = 0.0;           ///< s, > 0
  int steps_per_cycle = 40;        ///< steps per cycle of the shedding at U, 16 … 1000
  double observed = 0.25;          ///< evaluated share of the duration, at its end, 0.001 … 1
  double place = 0.0;              ///< m from the left support, place of the recorded displacement
  int stride = 10;                 ///< steps between recorded values, ≥ 1

  double shedding_frequency() const { return strouhal * wind.mean_speed / diameter; }  ///< Hz
  /// The number of steps in the duration.
  long steps() const {
    return static_cast<long>(std::ceil(duration * steps_per_cycle * shedding_frequency()));
  }
};

/// The simulated motion of a span in the wind.
struct WindHistory {
  /// The amplitude y (m): √2 times the rms over the observed part, at its maximum along the span;
  /// not finite where devices that supply power let it grow without bound.
  double amplitude;
  double spread;                      ///< standard deviation of y (m) over ten parts of that time
  double antinode;                    ///< place of that maximum (m)
  int mode;                           ///< number of the largest mode
  double frequency;                   ///< of that mode (Hz): rms velocity/(2π rms displacement)
  std::vector<double> times;          ///< s
  std::vector<double> displacements;  ///< recorded displacements (m)
};

/// Rejects a setting outside the ranges stated at its members. With a WindPowerLaw it also rejects
/// a shedding frequency more than half a mode's distance below mode 1 or above mode N.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const WindHistorySetting& setting) {
  validate(setting.string);
  require_positive("diameter", setting.diameter, "m");
  validate(setting.wind);
  require_positive("Strouhal number", setting.strouhal, "");
  require_within("number of modes", setting.modes, "", 1, 1000);
  require_within("number of stations", setting.stations, "", setting.modes + 1, 20000);
  require_non_negative("initial amplitude", setting.initial_amplitude, "m");
  require_positive("duration", setting.duration, "s");
  require_within("steps per cycle", setting.steps_per_cycle, "", 16, 1000);
  require_within("observed part of the duration", setting.observed, "", 1e-3, 1.0);
  require_inside_span(setting.place, setting.string.span);
  require_within("stride of what is written down", setting.stride, "", 1, 1e9);
  const double cycles = setting.observed * setting.duration * setting.shedding_frequency();
  require_within("observed cycles of shedding", cycles, "", 10.0, 1e7);
  require_within("steps", static_cast<double>(setting.steps()), "", 1.0, 1e9);
  if (setting.self_damping) {
    validate(StrandedConductor{setting.string.mass_per_length, setting.diameter,
                               setting.rated_strength, setting.string.tension});
    require_within("amplitude exponent of self-damping", setting.self_damping->amplitude_exponent,
                   "", 2.0, 4.0);
  }
  if (const auto* wakes = std::get_if<WakeOscillatorLaw>(&setting.force)) {
    validate(*wakes);
    return;
  }
  const double turn = 2.0 * pi<double> * setting.shedding_frequency();
  require_within("shedding frequency", turn, "rad/s", setting.string.angular_frequency(0.5),
                 setting.string.angular_frequency(setting.modes + 0.5));
}

/// The damping ratio ζ = Σ artanh(S)/(nπ) of each mode by the devices at both ends, with S of
/// `end_response` at the mode's frequency: the decay of waves that run to and fro along the span.
/// The energy balance's power ½ Z_c ω² y² S gives S/(nπ), which agrees to first order in S. There y
/// is the amplitude at the antinode next to the device; here y is √2 times the rms over the span.
///
/// Outside the table of a measured impedance the devices are assumed to absorb nothing.
/// @param string       tension and mass
/// @param devices      in any order
/// @param frequencies  ω (rad/s) of modes 1, 2 …
/// @throws InvalidParameter where a device is not inside the span
inline std::vector<double> device_damping(const TautString<double>& string,
                                          const std::vector<SpanDevice>& devices,
                                          const std::vector<double>& frequencies) {
  const std::vector<SpanDevice> ordered = in_order(devices, string.span);
  const auto ends = span_ends(ordered, string.span);
  std::vector<double> damping;
  for (std::size_t n = 0; n < frequencies.size(); ++n) {
    double sum = 0.0;
    for (const SpanEnd& end : ends) {
      if (end.devices.empty()) continue;
      const double ratio = end_response(string, end, frequencies[n]).inverse_standing_wave_ratio();
      if (std::isfinite(ratio)) sum += std::atanh(std::min(std::max(ratio, -0.999), 0.999));
    }
    damping.push_back(sum / (static_cast<double>(n + 1) * pi<double>));
  }
  return damping;
}

namespace detail {

/// A simulation run of `wind_history`.
template <class Scalar>
class WindRun {
 public:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
  using Shapes = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// @param setting  setting that passed `validate`; it must outlive this object
  explicit WindRun(const WindHistorySetting& setting)
      : setting_(setting),
        wakes_law_(std::get_if<WakeOscillatorLaw>(&setting.force)),
        mass_(setting.string.mass_per_length +
              (wakes_law_ ? wakes_law_->added_mass_per_length(setting.diameter) : 0.0)),
        step_(1.0 / (setting.steps_per_cycle * setting.shedding_frequency())),
        motion_(frequencies(), step_),
        gusts_(setting.wind, stations(), setting.string.span / setting.stations) {
    set_damping();
    set_start();
    if (!wakes_law_) return;
    wakes_.emplace(*wakes_law_, setting.diameter, setting.strouhal, stations(), setting.wind);
    shapes_.resize(stations(), setting.modes);
    for (int j = 0; j < stations(); ++j)
      shapes_.row(j) = shapes_at((j + 0.5) / stations()).matrix().transpose();
  }

  WindHistory run() {
    const long steps = setting_.steps(), sampled = setting_.steps_per_cycle / 8;
    const long damped = setting_.steps_per_cycle / 4;
    const auto begin = static_cast<long>((1.0 - setting_.observed) * static_cast<double>(steps));
    AmplitudeRecord<Scalar> record(setting_.modes, (steps - begin + sampled - 1) / sampled, 10);
    WindHistory history{};
    const Column here = shapes_at(setting_.place / setting_.string.span);
    for (long k = 0; k < steps; ++k) {
      if (k % damped == 0) motion_.damp(damping());
      if (k % setting_.stride == 0) {
        history.times.push_back(static_cast<double>(k) * step_);
        history.displacements.push_back(static_cast<double>((here * motion_.position).sum()));
      }
      if (k >= begin && (k - begin) % sampled == 0) record.add(motion_);
      motion_.step(force(static_cast<double>(k) * step_));
    }
    record.evaluate();
    history.amplitude = record.amplitude();
    history.spread = record.spread();
    history.antinode = record.antinode() * setting_.string.span;
    history.mode = record.mode();
    history.frequency = record.angular_frequency() / (2.0 * pi<double>);
    return history;
  }

 private:
  int stations() const { return wakes_law_ ? setting_.stations : 1; }

  Column frequencies() const {
    Column omega(setting_.modes);
    const double added = std::sqrt(setting_.string.mass_per_length / mass_);
    for (int n = 0; n < setting_.modes; ++n)
      omega[n] = Scalar(added * setting_.string.angular_frequency(n + 1.0));
    return omega;
  }

  /// The shapes sin(nπx/L) of all modes at x/L.
  Column shapes_at(double place) const {
    Column shapes(setting_.modes);
    for (int n = 0; n < setting_.modes; ++n)
      shapes[n] = Scalar(std::sin((n + 1) * pi<double> * place));
    return shapes;
  }

  /// Sets the damping that does not depend on the amplitude, and the self-damping at y = d.
  void set_damping() {
    const std::vector<double> omega(motion_.frequencies().begin(), motion_.frequencies().end());
    const std::vector<double> devices = device_damping(setting_.string, setting_.devices, omega);
    const double diameter = setting_.diameter;
    const StrandedConductor conductor{setting_.string.mass_per_length, diameter,
                                      setting_.rated_strength, setting_.string.tension};
    const double shedding = 2.0 * pi<double> * setting_.shedding_frequency();
    steady_.resize(setting_.modes);
    self_ = Column::Zero(setting_.modes);
    for (std::size_t n = 0; n < omega.size(); ++n) {
      double sum = setting_.string.damping_ratio + devices[n];
      if (wakes_law_) sum += wakes_law_->stall_damping(diameter, mass_, shedding, omega[n]);
      const auto at = static_cast<Eigen::Index>(n);
      steady_[at] = Scalar(sum);
      if (setting_.self_damping)
        self_[at] = Scalar(
            setting_.self_damping->power(conductor, omega[n] / (2.0 * pi<double>), diameter) /
            damped_power(mass_, 1.0, omega[n], diameter));
    }
  }

  /// Sets all modes to random η of about 10⁻⁴ d, and adds the initial amplitude to mode `nearest_`.
  void set_start() {
    const double shedding = 2.0 * pi<double> * setting_.shedding_frequency();
    (motion_.frequencies() - Scalar(shedding)).abs().minCoeff(&nearest_);
    NormalNumbers numbers(~setting_.wind.seed + 1);
    for (Eigen::Index n = 0; n < motion_.position.size(); ++n)
      motion_.position[n] = Scalar(1e-4 * setting_.diameter * numbers.next());
    motion_.position[nearest_] += Scalar(setting_.initial_amplitude);
  }

  Column damping() const {
    const Column squares = motion_.squared_amplitudes();
    Column ratios = steady_;
    if (setting_.self_damping) {
      const double relative = std::sqrt(static_cast<double>(squares.sum())) / setting_.diameter;
      ratios += self_ * Scalar(std::pow(relative, setting_.self_damping->amplitude_exponent - 2.0));
    }
    if (!wakes_law_) ratios[nearest_] -= fed(std::sqrt(static_cast<double>(squares[nearest_])));
    return ratios;
  }

  /// The decrease of ζ that stands for the measured power, f³ d⁴ F(y/d)/(½ μ ω³ y²), at most 0.05.
  Scalar fed(double amplitude) const {
    const auto omega = static_cast<double>(motion_.frequencies()[nearest_]);
    const WindPowerLaw law =
        in_turbulence(std::get<WindPowerLaw>(setting_.force), setting_.wind.intensity);
    const double diameter = setting_.diameter, least = law.lowest * diameter;
    if (amplitude > law.highest * diameter) return Scalar(0);
    const double power =
        law.power(omega / (2.0 * pi<double>), diameter, std::max(amplitude, least));
    const double given = power * std::min(amplitude / least, 1.0);
    return Scalar(std::min(given / damped_power(mass_, 1.0, omega, amplitude), 0.05));
  }

  /// The modal force ∫ f sin(nπx/L) dx over the modal mass (m/s²), for the step from `time` (s).
  const Column& force(double time) {
    if (!wakes_law_) {
      if (force_.size() == 0) force_ = Column::Zero(setting_.modes);
      return force_;
    }
    const Column& speeds = gusts_.at(time);
    velocities_ = (shapes_ * motion_.velocity.matrix()).array();
    wakes_->step(velocities_, speeds, step_);
    wakes_->lift(speeds, lift_);
    force_ = (shapes_.transpose() * lift_.matrix()).array() * Scalar(2.0 / (mass_ * stations()));
    return force_;
  }

  const WindHistorySetting& setting_;
  const WakeOscillatorLaw* wakes_law_;
  double mass_, step_;  // m with the added mass, h
  ModesInStep<Scalar> motion_;
  GustField<Scalar> gusts_;
  std::optional<WakeOscillators<Scalar>> wakes_;
  Shapes shapes_;  // stations by modes
  Column steady_, self_, velocities_, lift_, force_;
  Eigen::Index nearest_ = 0;
};

}  // namespace detail

/// The motion of a span in the wind, by time steps of its modes and of the wakes at stations along
/// it. It gives the amplitude of aeolian vibration without an energy balance
/// (`balanced_amplitude`).
/// With a WakeOscillatorLaw each station has its own wake, driven by the wind and the motion there;
/// the modes that vibrate and their amplitudes follow from the simulation. With a WindPowerLaw only
/// the mode nearest to the shedding frequency gets power, as a negative damping that depends on its
/// amplitude; all others decay. This run tends to the amplitude of the energy balance and serves to
/// check it. Below the law's smallest amplitude the power is proportional to y; above its largest
/// it is zero. Turbulence multiplies the power by `turbulent_share`.
///
/// The damping of a mode is the sum of the string's ζ, that of the devices (`device_damping`), the
/// stall of the wakes at the mean speed, and self-damping P_self(Y)/(½ m ω³ Y²), which is renewed
/// four times a cycle. Y² is the sum of the squared amplitudes of all modes. For a single mode this
/// is the measured law. With several modes the strands slip under all of them, so that the slip
/// caused by large modes damps small ones too.
///
/// Step: by default 1/40 of a cycle of shedding. A step of the modes is exact for a constant force.
/// A step of the wakes, half a step apart, takes the velocity as constant. The method is of second
/// order, and stable for modes of any frequency. Halving the step changes amplitudes by less than
/// 1 % (tests/span). Cost: two products of an N by M matrix per step.
///
/// Not included are buffeting by the fluctuations themselves, interaction of wakes along the span,
/// inclined wind, and the sag.
/// @throws InvalidParameter as `validate`, and for a device outside the span
template <class Scalar = double>
WindHistory wind_history(const WindHistorySetting& setting) {
  validate(setting);
  return detail::WindRun<Scalar>(setting).run();
}

}  // namespace holdfast
