#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosed_norm.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/proof/contracting_forms.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"
#include "holdfast/orbit/proof/event_passage.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"
#include "holdfast/orbit/proof/recorded_contacts.hpp"
#include "holdfast/orbit/proof/segment_of_loops.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The proof of a periodic motion of the sampled loop whose contact changes between the samples.
/// The states of the computed orbit are given. Let B be a ball around the first of them, with the
/// same contact. If the outcome is `proved`, exactly one motion from B has the given period. This
/// motion differs from the given states by at most the error bounds; its multipliers have moduli ≤
/// `multiplier_bound`. All other motions from B tend to it, with the same contact changes in the
/// same sampling periods. If the orbit stays in its gap, the gap has the given position.
struct EventOrbitProof : ProvedBounds {
  /// Largest distance, over all samples, between the exact motion one sample after a given state
  /// and the next given state, relative to the largest values of the states (StateScale).
  double miss = 0.0;
  double instant_error = 0.0;  ///< error bound of the recorded instants of contact changes (s)
  /// The least certain inequality (least decided_by()); for `near_surface` the unproved inequality.
  ContactTest nearest;
  /// Radius (m) of the ball B, in the norm and weights of AttractionBall; ∞ without backlash. The
  /// ball contains only states that the contact of the first given state allows. In stick, Δż is 0
  /// and Δz is at the gap's end. The gap's position is fixed while engaged and for an orbit that
  /// stays in its gap. u_{j−1} is fixed without processing delay.
  double radius = 0.0;
};

namespace detail {

/// The prover of one orbit that switches between the samples. States are in plant_scaling() units.
///
/// Each sample has an ellipsoid {x̂_j + X_j y, |y| ≤ r_j} about the proposed state x̂_j. All motions
/// in it are followed to the next sample (EventPassage). With D_j the derivative of the image on
/// the ellipsoid and μ_j the difference of the centre's image from x̂_{j+1},
///
///     r_{j+1} = ‖X_{j+1}⁻¹ D_j X_j‖ r_j + |X_{j+1}⁻¹ μ_j|.
///
/// The map over one period maps the first ellipsoid into itself and contracts there if r_N ≤ r_0
/// and the product of the norms is below 1.
template <class Number>
class EventOrbitProver {
 public:
  EventOrbitProver(const EnclosedModes<Number>& modes, const RecordedContacts& path, double delay)
      : modes_(modes), path_(path), delay_(delay), nodes_(path.samples.size()) {}

  /// Proves the motion, without a ball of attraction.
  /// @param log_modulus   ln of the largest multiplier, an estimate
  /// @param largest_miss  largest allowed difference of a proposed state's image from the next
  ///                      proposed state, as a share of the states' extent
  EventOrbitProof prove(double log_modulus, double largest_miss) {
    proof_.outcome = OrbitProofOutcome::other_contacts;
    if (!path_.repeats || !path_.is_plain) return proof_;
    std::vector<Matrix<double, 6>> maps;
    if (!linearise(largest_miss, maps)) return proof_;
    proof_.outcome = OrbitProofOutcome::not_contracting;
    if (!make_axes(maps, log_modulus)) return proof_;
    // Ellipsoids of radius 0, followed over one period, give the least possible first radius.
    const auto look_away = [](std::size_t, const Set&, const Passage&) {};
    Passage points(modes_, path_, delay_);
    const Turn once = turn(0.0, points, look_away);
    if (!(once.contraction < 1.0)) return proof_;
    first_radius_ =
        (Number(1.1) * Number(once.radius) / (Number(1.0) - Number(once.contraction))).upper();
    Passage passage(modes_, path_, delay_);
    proof_.displacement_error = proof_.velocity_error = 0.0;
    const Turn small =
        turn(first_radius_, passage, [&](std::size_t sample, const Set& set, const Passage& at) {
          note_errors(sample, set, at);
        });
    if (!small.is_decided) {
      fails(passage);
      return proof_;
    }
    if (!(small.radius <= first_radius_ && small.contraction < 1.0)) return proof_;
    proof_.nearest = passage.nearest();
    proof_.instant_error = passage.instant_error();
    proof_.multiplier_bound = small.contraction;
    proof_.outcome = OrbitProofOutcome::proved;
    return proof_;
  }

  /// Proves the motion and the largest provable ball of attraction.
  /// @param weights  deviation_weights(); the last one is 1
  EventOrbitProof prove_with_ball(double log_modulus, const Vector<double, 6>& weights,
                                  double largest_miss) {
    if (prove(log_modulus, largest_miss).outcome == OrbitProofOutcome::proved && !attract(weights))
      proof_.outcome = OrbitProofOutcome::no_ball;
    return proof_;
  }

 private:
  using Passage = EventPassage<Number>;
  using Set = SetOfStates<Number>;
  using Six = Vector<Number, 6>;
  using Map = Matrix<Number, 6>;

  struct Node {
    Matrix<double, 6> axes = Matrix<double, 6>::Identity();     // X
    Matrix<double, 6> inverse = Matrix<double, 6>::Identity();  // approximately X⁻¹
    Number inverse_error;  // |X⁻¹ w| ≤ |inverse w| times this
  };
  /// The result of following the first ellipsoid over one period.
  struct Turn {
    bool is_decided;     // every contact is decided
    double radius;       // r_N
    double contraction;  // the product of the norms
  };

  std::size_t after(std::size_t sample) const {
    return sample + 1 == nodes_.size() ? 0 : sample + 1;
  }

  /// Records the reason for which a passage stopped. @return false
  bool fails(const Passage& passage) {
    proof_.outcome = passage.is_undecided() ? OrbitProofOutcome::near_surface
                                            : OrbitProofOutcome::other_contacts;
    proof_.nearest = passage.nearest();
    return false;
  }

  /// Computes, in doubles, the derivatives of the maps between successive proposed states.
  bool linearise(double largest_miss, std::vector<Matrix<double, 6>>& maps) {
    Passage passage(modes_, path_, delay_);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      Set set = passage.ball(k, nodes_[k].axes, 0.0);
      if (!passage.pass(k, set)) return fails(passage);
      maps.push_back(Passage::deviations(set).template cast<double>());
      proof_.miss = std::max(proof_.miss, share_of_extent(missed(k, set)));
      if (proof_.miss <= largest_miss) continue;
      proof_.outcome = OrbitProofOutcome::not_closed;
      return false;
    }
    return true;
  }

  /// Computes axes X with X Xᵀ = P⁻¹ from the forms P of contracting_forms(). With Q = I,
  /// ellipsoids are short in directions of slow decay and long in those of fast decay. A second
  /// pass with Q = P⁻¹ makes them rounder, so that they contain larger balls.
  bool make_axes(const std::vector<Matrix<double, 6>>& maps, double log_modulus) {
    if (!(log_modulus < 0.0)) return false;
    using Form = Matrix<double, 6>;
    const double rate = contracting_rate(log_modulus, maps.size());
    const auto forms_of = [&](const std::vector<Form>& rests) {
      return contracting_forms<6>(
          maps.size(), [&](std::size_t k) -> const Form& { return maps[k]; },
          [&](std::size_t k) -> const Form& { return rests[k]; }, rate);
    };
    std::vector<Form> rests(maps.size(), Form::Identity());
    auto forms = forms_of(rests);
    if (!forms) return false;
    for (std::size_t k = 0; k < rests.size(); ++k)
      rests[k] = (*forms)[k].llt().solve(Form::Identity());
    forms = forms_of(rests);
    if (!forms) return false;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      Node& node = nodes_[k];
      const Eigen::LLT<Form> factor((*forms)[k]);
      node.inverse = factor.matrixU();
      node.axes = factor.matrixU().solve(Form::Identity());
      const Map product = node.inverse.template cast<Number>() * node.axes.template cast<Number>();
      const Map identity = Map::Identity();
      const double wrong = spectral_norm_bound<6>(Map(identity - product));
      if (!(wrong < 0.5)) return false;
      node.inverse_error = Number((Number(1.0) / (Number(1.0) - Number(wrong))).upper());
    }
    return true;
  }

  /// The difference of the image of the ellipsoid's centre from the next sample's proposed state.
  Six missed(std::size_t sample, const Set& set) const {
    const Passage passage(modes_, path_, delay_);
    const Vector<double, 6> proposed = passage.proposed(after(sample));
    Six miss;
    for (Eigen::Index i = 0; i < 6; ++i)
      miss[i] = set.centre[Passage::place(i)] - Number(proposed[i]);
    return miss;
  }

  /// The size of a difference's displacements and velocities, as a share of the states' extent.
  double share_of_extent(const Six& miss) const {
    StateScale extent;
    for (const RecordedSample& sample : path_.samples) extent.include(sample.state);
    Vector<double, 4> most;
    for (Eigen::Index i = 0; i < 4; ++i) most[i] = miss[i].magnitude() * modes_.units()[i];
    return extent.share_of(most);
  }

  /// Follows the ellipsoid of the first sample over one period.
  template <class Look>
  Turn turn(double radius, Passage& passage, const Look& look) const {
    Number contraction(1.0);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (contraction.upper() > 2.0) return {false, radius, contraction.upper()};
      Set set = passage.ball(k, nodes_[k].axes, radius);
      look(k, set, passage);
      if (!passage.pass(k, set)) return {false, radius, contraction.upper()};
      const Node& next = nodes_[after(k)];
      const Map inverse = next.inverse.template cast<Number>();
      const Number factor =
          Number(spectral_norm_bound<6>(Map(inverse * Passage::deviations(set)))) *
          next.inverse_error;
      const Six miss = inverse * missed(k, set);
      Number squared;
      for (const Number& entry : miss) squared += square(entry);
      radius = (factor * Number(radius) + sqrt(squared) * next.inverse_error).upper();
      contraction *= Number(factor.upper());
    }
    return {true, radius, contraction.upper()};
  }

  /// Records the largest distances of the set's motions from the given state of a sample.
  void note_errors(std::size_t sample, const Set& set, const Passage& passage) {
    const Vector<double, 6> given = passage.proposed(sample);
    for (const Eigen::Index i : {0, 1, 2, 3}) {
      const Number here = set.range(EnclosedModes<Number>::unit(i)) - Number(given[i]);
      double& most = i % 2 == 0 ? proof_.displacement_error : proof_.velocity_error;
      most = std::max(most, here.magnitude() * modes_.units()[i]);
    }
  }

  /// Finds the largest first ellipsoid that is proved to return into itself, and a ball inside.
  bool attract(const Vector<double, 6>& weights) {
    if (modes_.guards(ContactMode::engaged, 1.0).empty()) {
      proof_.radius = std::numeric_limits<double>::infinity();
      return true;
    }
    const auto holds = [&](double radius) {
      Passage passage(modes_, path_, delay_);
      const Turn once = turn(radius, passage, [](std::size_t, const Set&, const Passage&) {});
      return once.is_decided && once.radius <= radius && once.contraction < 1.0;
    };
    double proved = first_radius_, refused = proved;
    do {
      proved = refused;
      refused *= 64.0;
    } while (holds(refused));
    for (int halving = 0; halving < 6; ++halving) {
      const double between = std::sqrt(proved * refused);
      (holds(between) ? proved : refused) = between;
    }
    proof_.radius = weighted(proved, weights);
    return farthest_in_first(weights) < proof_.radius;
  }

  /// The radius, in the weighted norm, of the largest ball of allowed states in the ellipsoid.
  double weighted(double radius, const Vector<double, 6>& weights) const {
    const Node& first = nodes_.front();
    const Passage passage(modes_, path_, delay_);
    Matrix<double, 6> identity = Matrix<double, 6>::Identity();
    Map allowed = Passage::deviations(passage.ball(0, identity, radius));
    for (Eigen::Index i = 0; i < 6; ++i) allowed.col(i) /= weight(i, weights);
    const Map length = first.inverse.template cast<Number>() * allowed;
    const Number longest = Number(spectral_norm_bound<6>(length)) * first.inverse_error;
    return (Number(radius) / longest).lower();
  }

  /// An upper bound of the weighted distance of the motion's first state from the given one.
  double farthest_in_first(const Vector<double, 6>& weights) const {
    Map lengths = nodes_.front().axes.template cast<Number>();
    for (Eigen::Index i = 0; i < 6; ++i) lengths.row(i) *= weight(i, weights);
    return (Number(spectral_norm_bound<6>(lengths)) * Number(first_radius_)).upper();
  }

  /// The weight of a coordinate times the coordinate's unit.
  Number weight(Eigen::Index coordinate, const Vector<double, 6>& weights) const {
    const double unit = coordinate < 5 ? modes_.units()[coordinate] : 1.0;
    return Number(weights[coordinate]) * Number(unit);
  }

  const EnclosedModes<Number>& modes_;
  const RecordedContacts& path_;
  double delay_;
  std::vector<Node> nodes_;
  double first_radius_ = 0.0;  // r_0 of the small ellipsoid that contains the motion
  EventOrbitProof proof_;
};

}  // namespace detail

/// Proves by interval arithmetic that an orbit with contact changes between samples exists.
/// The proof covers all loops whose numbers round to the given doubles, with f τ exactly p/q.
///
///     const auto found = find_event_orbit(event_motion(implemented, state));
///     const EventOrbitProof proof = prove_event_orbit(loop, *found.orbit, *found.point);
///     if (proof.outcome == OrbitProofOutcome::proved) use(proof.radius);
///
/// Here `implemented` is implemented_loop(loop) with Switching::exact: the drive has the exact play
/// of DriveContact. A guard is a function whose zero ends a contact mode. The proof encloses every
/// instant of a contact change and shows that it is the first zero of its guard. It shows, by
/// Taylor series with enclosed coefficients, that all other guards are positive until that instant.
/// @param loop          the loop, its numbers in doubles
/// @param orbit         the orbit to be proved: its states, period and multipliers are used
/// @param first         complete state before the orbit's first sample, at phase 0 of the forcing
/// @param largest_miss  largest allowed EventOrbitProof::miss, else the outcome is `not_closed`
/// @throws InvalidParameter where the loop is not admissible, its f τ is not the orbit's p/q, or
///         the orbit's number of samples is no multiple of q
/// Work: about 20 passes through the period, each 0.1 ms per sample and 1 ms per contact change.
template <class Scalar>
EventOrbitProof prove_event_orbit(const IdealLoop<Scalar>& loop, const EventOrbit& orbit,
                                  const StroboscopicState<DriveContact<>>& first,
                                  double largest_miss = 1e-10) {
  validate(loop);
  const std::int64_t samples = orbit.period_samples(), q = orbit.ratio.denominator;
  if (samples <= 0 || samples % q != 0 || first.phase != 0 || orbit.multipliers.empty())
    throw InvalidParameter(
        "samples of the orbit", static_cast<double>(samples), "",
        "a multiple of q (f tau = p/q); the orbit must begin at phase 0 and have multipliers");
  detail::validate_ratio(loop, orbit.ratio);
  ImplementedLoop switching = implemented_loop(loop);
  switching.switching = Switching::exact;
  const RepeatingMotion<DriveContact<>> motion(event_motion(switching, first.state), q);
  detail::RecordedContacts path =
      detail::recorded_contacts(motion, first, static_cast<std::size_t>(samples));
  for (std::size_t j = 0; j < path.samples.size(); ++j)
    path.samples[j].state.head<4>() = orbit.states[j];
  const detail::EnclosedModes<Enclosure> modes(enclosed(loop), orbit.ratio);
  return detail::EventOrbitProver<Enclosure>(modes, path, loop.sampling.processing_delay)
      .prove_with_ball(orbit.multipliers.front().log_modulus, deviation_weights(loop),
                       largest_miss);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template EventOrbitProof prove_event_orbit(const IdealLoop<double>&, const EventOrbit&,
                                                  const StroboscopicState<DriveContact<>>&, double);
#endif

}  // namespace holdfast
