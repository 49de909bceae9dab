#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/gram_schmidt.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/roots/pole_sum_roots.hpp"
#include "holdfast/motion/modal/modal_deviations.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"

namespace holdfast {

/// The maps over one sampling period, engaged or in the backlash, of a loop with a conductor given
/// by its modes. The state is [Re ξ; Im ξ of the conjugate pairs; u_{j−1}] with the complex
/// amplitudes ξ of the natural motions e^{st} (NaturalMotion) and the last command u_{j−1}.
class ModalItineraryMaps {
 public:
  using State = Eigen::VectorXd;  ///< state [Re ξ; Im ξ of the pairs; u_{j−1}]
  using Map = Eigen::MatrixXd;    ///< product of the maps of several successive samples
  using System = CyclicSystem<double, Eigen::Dynamic>;  ///< linear solver for a periodic motion

  /// @param loop   the loop; its backlash width is not used
  /// @param poles  all `plant_poles` of the loop's modes and absorber
  /// @param ratio  forcing frequency × sampling period, f τ = p/q, from forcing_ratio()
  /// @param watch  if set, called from time to time in long computations; it may throw to end them
  /// @throws InvalidParameter unless 1 ≤ q ≤ 10⁹
  ModalItineraryMaps(const ModalLoop& loop, const std::vector<PlantPole>& poles,
                     const Rational& ratio, const std::function<void()>& watch = {})
      : ModalItineraryMaps(loop, NaturalMotions(loop, poles), ratio) {
    watch_ = watch;
  }

  /// Calls the function `watch` given to the constructor, if any.
  void look() const {
    if (watch_) watch_();
  }

  /// The propagator of scaled deviations. To use it, copy it and call begin() of the copy.
  const ModalDeviations& deviations() const { return deviations_; }
  /// The units by which deviations are divided for scaling, one for each entry of the state.
  const Eigen::VectorXd& units() const { return deviations_.units(); }
  /// The state of rest, all zero.
  State rest() const { return State::Zero(units().size()); }

  /// The complex amplitudes ξ of all natural motions in a state.
  Eigen::VectorXcd amplitudes(const State& state) const {
    Eigen::VectorXcd all = state.head(decay_.size()).cast<std::complex<double>>();
    all.head(pairs_).imag() = state.segment(decay_.size(), pairs_);
    return all;
  }

  /// The observed part [z, ż, z₂, ż₂; u_{j−1}] of a state: motion of the conductor at the absorber
  /// (m, m/s), motion of the absorber (m, m/s), last command (N).
  Vector<double, 5> seen(const State& state) const {
    const Eigen::Index count = decay_.size();
    Vector<double, 5> read;
    read << read_.real() * state.head(count) -
                read_.leftCols(pairs_).imag() * state.segment(count, pairs_),
        state[count + pairs_];
    return read;
  }

  /// The state, at phase 0 of the forcing, of the steady harmonic motion with the drive always
  /// engaged. Not finite where e^{iωτ} is one of the roots(); ω is the forcing's angular frequency.
  State steady() const {
    using Phasors = Eigen::ArrayXcd;
    const std::complex<double> i(0.0, 1.0), back = std::conj(turn_);
    const double force = phases_.front().real();
    const Phasors a_per = 0.5 / (turn_ - decay_.array()), b_per = 0.5 / (back - decay_.array());
    const Phasors a_driven = a_per * (present_ + past_ * back).array();
    const Phasors b_driven = b_per * (present_ + past_ * turn_).array();
    const Phasors a_forced = force * a_per * (cosine_ - i * sine_).array();
    const Phasors b_forced = force * b_per * (cosine_ + i * sine_).array();
    const Phasors command =
        (gains_.proportional * read_.row(0) + gains_.differential * read_.row(1)).transpose();
    const auto phasor = [&](const Phasors& a, const Phasors& b) {
      return (command * a).sum() + std::conj((command * b).sum());
    };
    // The phasor of the force, u_j = Re(U e^{iωτj}).
    const std::complex<double> u = phasor(a_forced, b_forced) / (1.0 - phasor(a_driven, b_driven));
    const Phasors first = a_driven * u + a_forced + b_driven * std::conj(u) + b_forced;
    State state(units().size());
    state << first.real(), first.head(pairs_).imag(), (u * back).real();
    return state;
  }

  /// The factors e^{sτ} of all natural motions: one for each conjugate pair, then the real ones.
  const Eigen::VectorXcd& decay() const { return decay_; }
  /// The number of conjugate pairs of natural motions; a pair counts as one natural motion.
  Eigen::Index pairs() const { return pairs_; }

  /// The correction of the first state of a period of `samples` samples in the backlash. It removes
  /// the closure error `gap`, last state minus first state.
  State correction_in_backlash(const State& gap, std::size_t samples) const {
    const Eigen::Index count = decay_.size();
    const Eigen::ArrayXcd natural =
        amplitudes(gap).array() / (1.0 - decay_.array().pow(static_cast<double>(samples)));
    State correction = gap;
    correction.head(count + pairs_) << natural.real(), natural.head(pairs_).imag();
    return correction;
  }

  /// The characteristic roots (eigenvalues of the map over one sampling period) of the loop with
  /// the drive always engaged. Empty where the roots cannot be separated numerically.
  std::vector<std::complex<double>> roots() const {
    PoleSum<double> loop;
    for (Eigen::Index k = 0; k < decay_.size(); ++k) {
      const std::complex<double> read =
          gains_.proportional * read_(0, k) + gains_.differential * read_(1, k);
      const double share = k < pairs_ ? 0.5 : 1.0;  // the read of a pair counts for both
      const PoleSum<double>::Part part{decay_[k] - 1.0, share * read * present_[k],
                                       share * read * past_[k]};
      loop.parts.push_back(part);
      if (k < pairs_)
        loop.parts.push_back(
            {std::conj(part.increment), std::conj(part.present), std::conj(part.past)});
    }
    return pole_sum_roots(loop, past_.cwiseAbs().maxCoeff() > 0.0);
  }

  /// Computes the motion with the contacts of an itinerary, and the observed part of each state.
  /// @param first      the state at the first sample
  /// @param itinerary  contact at each sample, the first sample at phase 0 of the forcing
  /// @param states     filled with [z, ż, z₂, ż₂; u_{j−1}]; must have one entry for each sample
  /// @return the state one sampling period after the last sample
  State follow(const State& first, const Itinerary& itinerary,
               std::vector<Vector<double, 5>>& states) const {
    State state = first;
    for (std::size_t j = 0; j < itinerary.size(); ++j) {
      if (j % 4096 == 0) look();
      states[j] = seen(state);
      step(state, states[j], itinerary[j] != 0, phases_[j % phases_.size()]);
    }
    return state;
  }

 private:
  ModalItineraryMaps(const ModalLoop& loop, const NaturalMotions& motions, const Rational& ratio)
      : gains_(loop.gains),
        deviations_(motions, loop.gains),
        pairs_(static_cast<Eigen::Index>(motions.pairs())) {
    require_within("denominator of f tau", static_cast<double>(ratio.denominator), "", 1.0, 1e9);
    const auto count = static_cast<Eigen::Index>(motions.size());
    for (Eigen::VectorXcd* part : {&decay_, &present_, &past_, &cosine_, &sine_})
      part->resize(count);
    read_.resize(4, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const NaturalMotion& of = motions[static_cast<std::size_t>(k)];
      decay_[k] = of.decay;
      present_[k] = of.present;
      past_[k] = of.past;
      cosine_[k] = of.cosine;
      sine_[k] = of.sine;
      read_.col(k) << of.z, of.v, of.z2, of.v2;
    }
    phases_.resize(static_cast<std::size_t>(ratio.denominator));
    turn_ = std::polar(1.0, 2.0 * pi<double> * static_cast<double>(ratio.numerator) /
                                static_cast<double>(ratio.denominator));
    std::int64_t turned = 0;  // p k modulo q
    for (std::complex<double>& force : phases_) {
      force = std::polar(loop.excitation.amplitude, 2.0 * pi<double> * static_cast<double>(turned) /
                                                        static_cast<double>(ratio.denominator));
      turned = (turned + ratio.numerator) % ratio.denominator;
    }
  }

  /// Advances a state by one sample; `seen` is the observed part of the state.
  /// @param force  F_m e^{iωt_j}
  void step(State& state, const Vector<double, 5>& seen, bool engaged,
            const std::complex<double>& force) const {
    const double u = engaged ? gains_.proportional * seen[0] + gains_.differential * seen[1] : 0.0;
    const Eigen::VectorXcd natural = decay_.cwiseProduct(amplitudes(state)) + present_ * u +
                                     past_ * seen[4] + cosine_ * force.real() +
                                     sine_ * force.imag();
    state << natural.real(), natural.head(pairs_).imag(), u;
  }

  PdGains<double> gains_;
  ModalDeviations deviations_;
  Eigen::Index pairs_;
  Eigen::VectorXcd decay_, present_, past_, cosine_, sine_;
  Eigen::Matrix<std::complex<double>, 4, Eigen::Dynamic> read_;
  std::vector<std::complex<double>> phases_;
  std::complex<double> turn_;  // e^{iωτ}
  std::function<void()> watch_;
};

/// Whether the drive transmits at no sample of an itinerary; natural motions then are uncoupled.
inline bool is_idle(const Itinerary& itinerary) {
  return std::all_of(itinerary.begin(), itinerary.end(), [](auto contact) { return contact == 0; });
}

/// The periodic solution for an itinerary in which the drive never transmits (is_idle()). nullopt
/// for any other itinerary, or if the solution is not finite.
inline std::optional<PeriodicSolution<ModalItineraryMaps>> solution_without_blocks(
    const ModalItineraryMaps& maps, const Itinerary& itinerary) {
  if (!is_idle(itinerary)) return std::nullopt;
  auto solution =
      detail::refined_solution(maps, itinerary, [&](const ModalItineraryMaps::State& open) {
        return maps.correction_in_backlash(open, itinerary.size());
      });
  return solution.first.allFinite() ? std::optional(solution) : std::nullopt;
}

/// The products of the maps of an itinerary, one for each block of samples, scaled by maps.units().
/// A block ends at most sixteen samples after an entry of its product has reached 1000. Work per
/// sample: 2 n² multiply-adds, n being the number of entries of a state.
/// @return the products; empty for a drive that never transmits (solution_without_blocks()). Empty
///         also if more than 64 blocks are needed: no orbit can then be computed
inline std::vector<Eigen::MatrixXd> maps_of_blocks(const ModalItineraryMaps& maps,
                                                   const Itinerary& itinerary) {
  constexpr std::size_t between_looks = 16, most = 64;
  if (is_idle(itinerary)) return {};
  ModalDeviations flow = maps.deviations();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(flow.order(), flow.order());
  std::vector<Eigen::MatrixXd> blocks;
  flow.begin(unit);
  for (std::size_t j = 0; j < itinerary.size(); ++j) {
    flow.advance(itinerary[j] != 0);
    const bool last = j + 1 == itinerary.size(), looks = j % between_looks == 0;
    if (looks) maps.look();
    if (!last && (!looks || flow.columns().cwiseAbs().maxCoeff() < 1e3)) continue;
    if (blocks.size() == most) return {};
    blocks.push_back(flow.columns());
    flow.begin(unit);
  }
  return blocks;
}

/// The `most` multipliers of largest modulus in a list, in descending order of their moduli.
inline std::vector<Multiplier> largest_of(std::vector<Multiplier> all, Eigen::Index most) {
  std::stable_sort(all.begin(), all.end(), Multiplier::is_larger);
  all.resize(std::min(all.size(), static_cast<std::size_t>(most)));
  return all;
}

/// The `most` largest Floquet multipliers e^{sτN} of a period of N = `samples` samples in the
/// backlash, s being the plant's poles; one more multiplier, of the last command, is 0.
inline std::vector<Multiplier> idle_multipliers(const ModalItineraryMaps& maps, std::size_t samples,
                                                Eigen::Index most) {
  std::vector<Multiplier> found;
  const auto times = static_cast<double>(samples);
  for (Eigen::Index k = 0; k < maps.decay().size(); ++k) {
    const double size = times * std::log(std::abs(maps.decay()[k]));
    const double turn = std::remainder(times * std::arg(maps.decay()[k]), 2.0 * pi<double>);
    found.push_back({size, turn});
    if (k < maps.pairs()) found.push_back({size, -turn});
  }
  found.push_back({-std::numeric_limits<double>::infinity(), 0.0});  // the last command
  return largest_of(std::move(found), most);
}

/// The ten largest Floquet multipliers of one period, or all where there are fewer.
///
/// If the period is one block, they are the eigenvalues of its map, provided that all ten exceed
/// rounding. Otherwise they come from an orthogonal iteration of sixteen deviations over the
/// period. This method also resolves strong contraction.
/// @param maps       maps of the loop
/// @param itinerary  contacts of one period
/// @param blocks     maps_of_blocks() of the itinerary
template <class Maps, std::enable_if_t<std::is_same_v<Maps, ModalItineraryMaps>, int> = 0>
std::vector<Multiplier> multipliers_of(const Maps& maps, const Itinerary& itinerary,
                                       const std::vector<typename Maps::Map>& blocks) {
  constexpr Eigen::Index leading = 10, beside = 6;
  constexpr std::size_t between = 8, most_samples = 40000, most_turns = 20;
  if (is_idle(itinerary)) return idle_multipliers(maps, itinerary.size(), leading);
  ModalDeviations flow = maps.deviations();
  const Eigen::Index order = flow.order(), count = std::min(order, leading + beside);
  const auto shown = std::min(count, leading);
  if (blocks.size() == 1) {
    std::vector<Multiplier> found;
    for (const std::complex<double>& value : eigenvalues(blocks.front()))
      found.push_back({std::log(std::abs(value)), std::arg(value)});
    found = largest_of(std::move(found), shown);
    if (found.back().log_modulus > std::log(1e-9 * blocks.front().norm())) return found;
  }
  const auto most = std::max(most_turns * itinerary.size(), most_samples);
  auto basis = detail::generic_columns<Eigen::MatrixXd>(order, count);
  orthonormalise(basis);
  Eigen::MatrixXd turn;
  detail::ScaledTriangle<double, Eigen::Dynamic> triangle(count);
  bool spans = false;
  for (std::size_t turns = 0, fewest = count < order ? 3 : 5;
       turns * itinerary.size() < most && !(spans && turns >= fewest); ++turns) {
    const Eigen::MatrixXd before = basis;
    triangle = detail::ScaledTriangle<double, Eigen::Dynamic>(count);
    flow.begin(basis);
    for (std::size_t j = 0; j < itinerary.size(); ++j) {
      flow.advance(itinerary[j] != 0, 1);
      if ((j + 1) % between != 0 && j + 1 != itinerary.size()) continue;
      if (j % 4096 == 0) maps.look();
      basis = flow.columns();
      const double size = basis.norm();
      triangle.multiply_from_left(orthonormalise(basis), size);
      flow.begin(basis);
    }
    turn = before.transpose() * basis;
    spans = (basis.leftCols(shown) - before * turn.leftCols(shown)).norm() < 1e-9 &&
            (count < order || detail::settled(turn, triangle.rank));
  }
  return largest_of(detail::multipliers_of_turn(turn, triangle), shown);
}

}  // namespace holdfast
