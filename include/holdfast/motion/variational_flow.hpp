#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/structural_rank.hpp"
#include "holdfast/motion/contact_tangent.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/saltation.hpp"
#include "holdfast/motion/taylor_step.hpp"

namespace holdfast {

/// The derivative of a HybridMotion from one sample to the next, changes of contact included.
///
///     X_j = [z₁, ż₁, z₂, ż₂; u_{j−1}; g; z₁ as read at sample j − 1],   δX_{j+1} = map · δX_j
///
/// g is the Δz at which the drive last reversed: the ends of its gap lie at g and g ∓ r₀. While the
/// contact does not change, δz follows e^{A t} and the held commands; commands change at given
/// times, which adds nothing. At a change of contact at a surface h the deviation of [z; g] is
/// multiplied by the saltation matrix (saltation.hpp), the guards being
///
///     engaged → gap, stick:   h = Δż,        g ← Δz,   f⁺ − f⁻ = −b u, b (s − u)
///     gap → engaged:          h = Δz − g,    g ← 0,    f⁺ − f⁻ = b u
///     a stop is met or left:  h = Δz ∓ r₀/2,           f⁺ − f⁻ from the stop's damper and u
///
/// Nothing is added where stick ends: at a surface the transmitted force is continuous, and a
/// command jumps at a given time. While the drive sticks, δΔż = 0 and δg = δΔz are kept exactly;
/// where it does so at sample j, the columns are for deviations that have them. What is not used is
/// zero: the row of g while engaged, and the row of z₁ as read unless the velocity is the
/// difference of unrounded displacements.
///
///     HybridTangent<ExactBacklash> tangent(motion);
///     motion.sense();
///     tangent.begin_sample(motion);
///     motion.advance(tangent);
///     tangent.map();
///
/// A crossing that touches has no derivative; the entries are not finite then.
/// Work per sample: 140 multiply-adds for each of its two parts; per change of contact 1500 more,
/// most of them for a matrix exponential. Nothing is allocated.
/// @tparam Contact  of the motion; contact_tangent.hpp tells what it has to offer
template <class Contact>
class HybridTangent {
 public:
  /// Goes on from the sample that the motion has come to.
  explicit HybridTangent(const HybridMotion<Contact>& motion)
      : sticking_(sticking_mode(motion.contact())),
        sample_rank_(inputs(motion)),
        rank_(inputs(motion)) {
    const Sampling<double>& sampling = motion.loop().sampling;
    lengths_ = {sampling.processing_delay, sampling.period - sampling.processing_delay};
    for (int mode = 0; mode < Contact::modes; ++mode) {
      dynamics_[at(mode)] = motion.dynamics(mode);
      anchored_[at(mode)] = is_anchored(motion.contact(), mode);
      for (std::size_t part = 0; part < 2; ++part)
        steps_[part][at(mode)] = exponential(mode, lengths_[part]);
    }
  }

  /// To be called after `sense()` and before `advance(tangent)`.
  void begin_sample(const HybridMotion<Contact>& motion) {
    const DigitalLimits& limits = motion.controller().limits();
    const bool takes_effect = detail::transmits_command(motion.contact(), 0);
    const ControllerSlope slope = takes_effect ? motion.controller().slope() : ControllerSlope{};
    const bool reads =
        limits.velocity == VelocitySensing::difference && limits.displacement_quantum == 0.0;
    period_ = motion.period();
    open_length_ = 0.0;
    map_.setIdentity();
    enter(motion.contact().mode());
    pending_ = slope.displacement * map_.row(0) + slope.velocity * map_.row(1) +
               slope.previous_displacement * map_.row(read_row);
    map_.row(read_row) = reads ? map_.row(0).eval() : RowVector<double, 7>::Zero().eval();
    sample_rank_ = StructuralRank(inputs(motion));
    const int mode = motion.contact().mode();
    on_ranks([&](StructuralRank& rank) {
      if (!carries_anchor(mode)) rank.end(Carried::anchor);
      rank.pass(directions(mode));
      note_sample(rank, slope, reads);
      rank.pass(directions(mode));
    });
  }

  // The observer of HybridMotion::advance.

  /// Notes a stretch of one mode, `begin` (s) counting from the sample; it enters the map with the
  /// next change, or at the end of the period.
  void flowed(int mode, double begin, double length) {
    if (!(length > 0.0)) return;
    if (open_length_ == 0.0) open_begin_ = begin;
    open_mode_ = mode;
    open_length_ = begin + length - open_begin_;
    if (begin + length >= period_ * (1.0 - same_length)) close_flow();
  }

  /// δu_j takes the place of δu_{j−1}.
  void commanded() {
    close_flow();
    map_.row(command_row) = pending_;
    on_ranks([](StructuralRank& rank) {
      rank.end(Carried::in_force);
      rank.become(Carried::pending, Carried::in_force);
    });
  }

  /// Multiplies by the saltation matrix where a guard was reached outside stick; a jump of force or
  /// command, guard −1, adds nothing.
  void switched(int from, int to, int guard, const ContactInstant& instant) {
    close_flow();
    if (guard >= 0 && from != sticking_) cross(from, to, instant);
    enter(to);
    on_ranks([&](StructuralRank& rank) {
      if (!carries_anchor(to)) rank.end(Carried::anchor);
      rank.pass(directions(to));
    });
  }

  /// The derivative over the sample just advanced, 7 × 7.
  const Matrix<double, 7>& map() const { return map_; }

  /// Its structural rank: that of almost every map with the same zeros.
  int rank() const { return sample_rank_.rank(); }

  /// The structural rank of the product of all maps since this tangent was made.
  int rank_of_product() const { return rank_.rank(); }

 private:
  using Step = HeldStep<double, 4, 1>;
  static constexpr int command_row = 4, anchor_row = 5, read_row = 6;
  /// Parts of the period whose lengths differ by less, in periods, are the same: the sum of several
  /// steps of the motion rounds.
  static constexpr double same_length = 1e-13;

  static constexpr std::size_t at(int mode) { return static_cast<std::size_t>(mode); }
  int directions(int mode) const { return mode == sticking_ ? 3 : 4; }

  static unsigned inputs(const HybridMotion<Contact>& motion) {
    const unsigned always =
        static_cast<unsigned>(Carried::in_force) | static_cast<unsigned>(Carried::reading);
    return is_anchored(motion.contact(), motion.contact().mode())
               ? always | static_cast<unsigned>(Carried::anchor)
               : always;
  }

  /// Whether g is not a function of z.
  bool carries_anchor(int mode) const { return anchored(mode) && mode != sticking_; }

  bool anchored(int mode) const { return anchored_[at(mode)]; }

  /// By z: of Δz − g where the mode is anchored and of Δz for stops; of Δż while a drive whose gap
  /// moves is engaged.
  Vector<double, 4> gradient(int from) const {
    return sticking_ < 0 || anchored(from) ? displacement_row() : velocity_row();
  }

  template <class Note>
  void on_ranks(const Note& note) {
    note(sample_rank_);
    note(rank_);
  }

  /// The command depends on z and on what was read, which is then read anew.
  static void note_sample(StructuralRank& rank, const ControllerSlope& slope, bool reads) {
    if (slope.displacement != 0.0 || slope.velocity != 0.0) rank.begin(Carried::pending);
    if (slope.previous_displacement != 0.0) rank.become(Carried::reading, Carried::pending);
    rank.end(Carried::reading);
    if (reads) rank.begin(Carried::reading);
  }

  Step exponential(int mode, double length) const {
    const AffineDynamics& dynamics = dynamics_[at(mode)];
    return zero_order_hold<double, 4, 1>(dynamics.state, dynamics.command, length);
  }

  /// δz over what has flowed since the last change of anything.
  void close_flow() {
    if (open_length_ == 0.0) return;
    for (std::size_t part = 0; part < 2; ++part) {
      if (std::abs(open_length_ - lengths_[part]) > same_length * period_) continue;
      return close_flow(steps_[part][at(open_mode_)]);
    }
    close_flow(exponential(open_mode_, open_length_));
  }

  void close_flow(const Step& step) {
    const Matrix<double, 4, 7> state = map_.template topRows<4>();
    map_.template topRows<4>() = step.transition * state + step.input * map_.row(command_row);
    open_length_ = 0.0;
    enter(open_mode_);
    const bool transmits = !dynamics_[at(open_mode_)].command.isZero(0.0);
    on_ranks([&](StructuralRank& rank) {
      if (transmits) rank.act(Carried::in_force);
      rank.pass(directions(open_mode_));
    });
  }

  /// Keeps to what a mode holds: Δż = 0 and Δz = g in stick, no g while engaged.
  void enter(int mode) {
    if (mode == sticking_) {
      map_.row(3) = map_.row(1).eval();
      map_.row(anchor_row) = map_.row(2) - map_.row(0);
    }
    if (!anchored(mode)) map_.row(anchor_row).setZero();
  }

  void cross(int from, int to, const ContactInstant& instant) {
    if (from == to && anchored(from)) return anchor_anew();
    SurfaceCrossing<5> crossing;
    crossing.before << rate(from, instant), 0.0;
    crossing.after << rate(to, instant), 0.0;
    crossing.gradient << gradient(from).transpose(), anchored(from) ? -1.0 : 0.0;
    if (anchored(from)) {
      on_ranks([](StructuralRank& rank) { rank.act(Carried::anchor); });
    } else if (anchored(to)) {
      crossing.reset.row(4) << displacement_row().transpose(), 0.0;
    }
    Matrix<double, 5, 7> rows;
    rows << map_.template topRows<4>(), map_.row(anchor_row);
    rows = saltation_matrix(crossing) * rows.eval();
    map_.template topRows<4>() = rows.template topRows<4>();
    map_.row(anchor_row) = rows.row(4);
  }

  /// From one gap into another that begins at Δz: the rates agree.
  void anchor_anew() {
    map_.row(anchor_row) = map_.row(2) - map_.row(0);
    on_ranks([](StructuralRank& rank) { rank.end(Carried::anchor); });
  }

  /// ż in a mode.
  Vector<double, 4> rate(int mode, const ContactInstant& instant) const {
    const AffineDynamics& dynamics = dynamics_[at(mode)];
    return dynamics.state * instant.state + dynamics.drift + dynamics.command * instant.command +
           dynamics.force * instant.force;
  }

  int sticking_;                               // the mode in which Δż = 0; −1: none
  std::array<bool, Contact::modes> anchored_;  // whether the gap lies where the drive reversed
  std::array<AffineDynamics, Contact::modes> dynamics_;
  std::array<double, 2> lengths_;  // of the parts of the period before and after t_j + δ
  std::array<std::array<Step, Contact::modes>, 2> steps_;  // over them
  Matrix<double, 7> map_ = Matrix<double, 7>::Identity();
  RowVector<double, 7> pending_ = RowVector<double, 7>::Zero();  // δu_j of δX_j
  double period_ = 0.0;
  int open_mode_ = 0;
  double open_begin_ = 0.0, open_length_ = 0.0;  // what has flowed, but is not in the map yet
  StructuralRank sample_rank_, rank_;
};

}  // namespace holdfast
