#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"
#include "holdfast/orbit/proof/guard_series.hpp"
#include "holdfast/orbit/proof/recorded_contacts.hpp"
#include "holdfast/orbit/proof/set_of_states.hpp"

namespace holdfast {

/// A strict inequality, value > 0, by which the proof of an orbit decides a contact. The value is a
/// guard (a function whose zero ends a contact mode), a time derivative of a guard with the sign
/// that the contact requires, or the time left until the next sample.
struct ContactTest {
  ContactSurface surface = ContactSurface::reversal;  ///< surface on which the guard is zero
  int order = 0;             ///< order of the guard's time derivative; 0: the guard itself
  std::int64_t sample = -1;  ///< sample j, counted from the orbit's first; −1: no test
  double instant = 0.0;      ///< time since sample j (s)
  double distance = std::numeric_limits<double>::infinity();  ///< tested value (SI), > 0 if proved
  double error = 0.0;                                         ///< error bound of `distance`

  /// The ratio of the tested value to its error; above 1 if the inequality is proved.
  double decided_by() const { return distance / error; }
};

namespace detail {

/// The passage of a set of motions to the next sample: follows all of them through the same changes
/// of contact and proves that no other change occurs.
///
/// Just after a contact change the motion is close to an end of its gap. The ball at the next
/// sample then extends beyond this end, although no motion does. A guard may then be proved
/// positive on a second set of all motions (witness): the set after the last change, propagated.
template <class Number>
class EventPassage {
 public:
  using Modes = EnclosedModes<Number>;
  using Set = SetOfStates<Number>;
  using Row = FlowRow<Number>;
  /// Six deviations of [z₁, ż₁, z₂, ż₂, u_{j−1}, g], in the units of Modes.
  using Deviations = Matrix<Number, 6>;

  /// @param delay  processing delay δ (s), in doubles
  EventPassage(const Modes& modes, const RecordedContacts& path, double delay)
      : modes_(modes), path_(path), delay_(delay), moves_gap_(path.switches()) {}

  /// The proposed state at the beginning of a sample, in the units of Modes.
  Vector<double, 6> proposed(std::size_t sample) const {
    Vector<double, 6> state = path_.samples[sample].state;
    for (Eigen::Index i = 0; i < 5; ++i) state[i] /= modes_.units()[i];
    if (!is_late()) state[4] = 0.0;
    return state;
  }
  /// The set {proposed + axes · y, |y| ≤ radius} at a sample, with the constraints of the contact.
  Set ball(std::size_t sample, const Matrix<double, 6>& axes, double radius) const {
    Set set;
    set.radius = radius;
    const Vector<double, 6> state = proposed(sample);
    for (Eigen::Index i = 0; i < 6; ++i) {
      set.centre[place(i)] = Number(state[i]);
      set.spread.row(place(i)) = axes.row(i).template cast<Number>();
    }
    prepare(path_.samples[sample].before.mode, set);
    return set;
  }
  /// The index in w (FlowPlace) of a coordinate of [z₁, ż₁, z₂, ż₂, u_{j−1}, g].
  static Eigen::Index place(Eigen::Index coordinate) {
    return coordinate == 5 ? FlowPlace::gap : coordinate;
  }
  /// The derivative of [z₁, ż₁, z₂, ż₂, u_{j−1}, g] with respect to the position y in the ball.
  static Deviations deviations(const Set& set) {
    Deviations all;
    for (Eigen::Index i = 0; i < 6; ++i) all.row(i) = set.spread.row(place(i));
    return all;
  }

  /// Moves a set from a sample to the next one.
  /// @return false where an inequality, `nearest()`, is not proved or the contacts are not allowed
  bool pass(std::size_t sample, Set& set) {
    sample_ = sample;
    const RecordedSample& here = path_.samples[sample];
    take_command(set);
    if (witness_) take_command(*witness_);
    const bool continues = mode_ == here.before.mode && sign_ == here.before.sign;
    if (has_begun_ && !continues) return false;  // a change of contact without an event
    if (!continues) begin(here.before, 0);
    has_begun_ = true;
    zeros_ = 0;
    if (guards().empty() && mode_ != ContactMode::engaged) return false;  // there is no backlash
    if (!jump(here.from, set)) return false;
    std::size_t next = 0;
    if (!pass_part(0, next, set)) return false;
    set.assign(FlowPlace::command, Modes::unit(FlowPlace::pending));
    if (witness_) witness_->assign(FlowPlace::command, Modes::unit(FlowPlace::pending));
    if (next < here.switches.size() && here.switches[next].guard < 0 &&
        !jump(here.switches[next++].begun, set))
      return false;
    if (!pass_part(1, next, set)) return false;
    prepare(mode_, set);
    record_witness(set, !here.switches.empty() || here.from.mode != here.before.mode);
    return next == here.switches.size();
  }

  /// The inequality with the least ratio of value to error so far, or the inequality that failed.
  const ContactTest& nearest() const { return nearest_; }
  /// Whether pass() failed because the inequality `nearest()` was not proved. Otherwise it failed
  /// because the backlash law excludes the sequence of contacts.
  bool is_undecided() const { return is_undecided_; }
  /// An upper bound of the error of every recorded instant of contact change (s).
  double instant_error() const { return instant_error_; }

 private:
  using Guard = EnclosedGuard<Number>;
  using Series = GuardSeries<Number>;

  bool is_late() const { return delay_ > 0.0; }
  const typename Modes::Guards& guards() const { return modes_.guards(mode_, sign_); }
  /// The index of the guard that is zero just after a change of contact. In a gap it is the guard
  /// of the end at which the drive reversed.
  std::size_t own_guard() const { return mode_ == ContactMode::gap && !(sign_ > 0.0) ? 1 : 0; }
  int zeros_of(std::size_t guard) const { return guard == own_guard() ? zeros_ : 0; }
  void begin(const RecordedContact& contact, int zeros) {
    mode_ = contact.mode;
    sign_ = contact.sign;
    zeros_ = zeros;
    last_slopes_ = {};
    witness_.reset();
  }

  /// Imposes the exact constraints of a contact: Δż = 0 and Δz = g in stick, g = 0 if engaged.
  void constrain(ContactMode mode, Set& set) const {
    if (mode == ContactMode::stick) {
      set.assign(3, Modes::unit(1));
      set.assign(2, Modes::unit(0) + Modes::unit(FlowPlace::gap));
    }
    if (mode == ContactMode::engaged) set.assign(FlowPlace::gap, Number());
  }

  /// Imposes all constraints at a sample: the constraints of the contact, u_{j−1} = 0 if u_j acts
  /// at once (δ = 0), and a fixed gap position if the contact never changes.
  void prepare(ContactMode mode, Set& set) const {
    constrain(mode, set);
    if (!moves_gap_) set.spread.row(FlowPlace::gap).setZero();
    if (!is_late()) set.assign(FlowPlace::command, Number());
  }

  /// Computes the command of a sample, and sets the force and the time to those of the sample.
  void take_command(Set& set) const {
    set.assign(FlowPlace::pending, modes_.command());
    if (!is_late()) set.assign(FlowPlace::command, Modes::unit(FlowPlace::pending));
    const auto& [force, quadrature] = modes_.force(sample_);
    set.assign(FlowPlace::force, force);
    set.assign(FlowPlace::quadrature, quadrature);
    set.assign(FlowPlace::one, Number(1.0));
    set.assign(FlowPlace::time, Number());
  }

  void record_witness(const Set& set, bool has_changed) {
    if (has_changed) witness_ = set;
    if (witness_) prepare(mode_, *witness_);
  }

  /// Applies a jump of the command or the force. Only stick may end by such a jump.
  bool jump(const RecordedContact& to, Set& set) {
    if (to.mode == mode_) return true;
    if (mode_ != ContactMode::stick || to.sign != sign_) return false;
    constrain(ContactMode::stick, set);
    if (to.mode == ContactMode::engaged) {
      // Without an acceleration onwards the drive would enter the gap instead.
      const Row pushed_on = Number(sign_) * modes_.free_acceleration();
      if (!test(about(ContactSurface::free_acceleration, 0, now(set)), set.range(pushed_on)))
        return false;
      constrain(to.mode, set);
    }
    begin(to, to.mode == ContactMode::gap ? 2 : 1);
    return true;
  }

  bool pass_part(std::size_t part, std::size_t& next, Set& set) {
    if (modes_.pieces(part) == 0) return true;
    const auto& switches = path_.samples[sample_].switches;
    const Number end = part == 0 ? modes_.part(0) : modes_.part(0) + modes_.part(1);
    const bool is_first = part == 0;
    bool changed = false;
    while (next < switches.size() && switches[next].guard >= 0 &&
           (!is_first || switches[next].after < delay_)) {
      if (!pass_to_switch(switches[next++], end, set)) return false;
      changed = true;
    }
    return changed ? pass_to_clock(end, set) : pass_whole(part, set);
  }

  /// Moves the set over one part of a sampling period, δ or τ − δ, without change of contact.
  bool pass_whole(std::size_t part, Set& set) {
    const Number length = modes_.piece(part);
    for (int count = 0; count < modes_.pieces(part); ++count) {
      if (!stays_positive(set, length.upper(), guards().size())) return false;
      for (Set* one : {&set, witness_ ? &*witness_ : nullptr}) {
        if (one == nullptr) continue;
        one->centre = modes_.over_piece(mode_, part, one->centre);
        one->spread = modes_.over_piece(mode_, part, one->spread);
      }
      zeros_ = 0;
    }
    return true;
  }

  /// Moves the set over a length of time (s) that is the same for all its motions.
  bool pass_piece(const Number& length, Set& set) {
    if (!stays_positive(set, length.upper(), guards().size())) return false;
    flow(length, set);
    if (witness_) flow(length, *witness_);
    zeros_ = 0;
    return true;
  }

  bool pass_to_switch(const RecordedSwitch& recorded, const Number& end, Set& set) {
    const auto which = static_cast<std::size_t>(recorded.guard);
    if (!may_change(which, recorded.begun)) return false;
    while (recorded.after - now(set) > 0.9 * modes_.longest())
      if (!pass_piece(Number(0.5 * modes_.longest()), set)) return false;
    const Guard& guard = guards()[which];
    const int terms = modes_.terms_for(modes_.longest());
    const Series all(guard, set, terms);
    Set single = set;
    single.radius = 0.0;
    const double near = recorded.after - now(set);
    const std::optional<Number> length = all.falls_through_zero(near);
    std::optional<Number> exact = Series(guard, single, terms).falls_through_zero(near);
    // The zero of the centre must lie in the interval of first zeros of all motions.
    const bool is_that =
        length && exact && length->lower() <= exact->lower() && exact->upper() <= length->upper();
    if (exact && !is_that) exact = length;
    const ContactTest crossing = about(guard.surface, 1, recorded.after);
    const int zeros = zeros_of(which);
    if (!length || !exact || length->upper() > modes_.longest()) {
      const Number begins = all.derivative(zeros);
      return begins.is_positive() ? refuse(crossing, -all.slope(Number(std::max(near, 0.0))))
                                  : refuse(about(guard.surface, zeros, now(set)), begins);
    }
    if (!all.is_positive(length->lower(), zeros))
      return refuse(about(guard.surface, zeros, now(set)), all.derivative(zeros));
    if (!stays_positive(set, length->upper(), which)) return false;
    if (!test(crossing, -all.slope(*length))) return false;
    meet(guard.terms.front(), *exact, *length, recorded.begun.mode, set);
    const Number instant = set.range(Modes::unit(FlowPlace::time));
    instant_error_ = std::max(instant_error_, (instant - Number(recorded.after)).magnitude());
    change(recorded.begun, which, set);
    return test(about(ContactSurface::sampling_instant, 0, recorded.after), end - instant);
  }

  bool pass_to_clock(const Number& end, Set& set) {
    const Row time = Modes::unit(FlowPlace::time);
    for (;;) {
      const Number left = end - set.range(time);
      if (left.upper() <= modes_.longest()) break;
      if (!pass_piece(Number(0.5 * modes_.longest()), set)) return false;
    }
    const Number left = end - set.range(time);
    if (!left.is_positive())
      return refuse(about(ContactSurface::sampling_instant, 0, now(set)), left);
    if (!stays_positive(set, left.upper(), guards().size())) return false;
    flow(end - set.at_centre(time), set);
    set.spread = set.together();
    set.is_apart = false;
    set.assign(FlowPlace::time, end);
    zeros_ = 0;
    return true;
  }

  void flow(const Number& length, Set& set) const {
    set.centre = modes_.flowed(mode_, set.centre, length);
    set.spread = modes_.flowed(mode_, set.spread, length);
    if (set.is_apart) set.at_once = modes_.flowed(mode_, set.at_once, length);
  }

  /// Moves the set to a surface h w = 0 that all motions reach after a time s in `length`, the
  /// centre after `centre_length`. With the spread D of the set, the matrix A⁻ of the ending mode
  /// and f⁻ = A⁻w, the points reached have the y-derivative (I − f⁻ h/(h f⁻)) e^{A⁻s} D.
  void meet(const Row& surface, const Number& centre_length, const Number& length,
            ContactMode after, Set& set) {
    Set there = set;
    flow(length, there);
    const auto& rate = modes_.rate(mode_);
    typename Set::State field;
    for (Eigen::Index i = 0; i < field.size(); ++i) field[i] = there.range(rate.row(i));
    const RowVector<Number, 6> earlier =
        (surface * there.spread).eval() / there.range(surface * rate);
    flow(centre_length, set);
    typename Set::Spread together = set.together();
    if (mode_ == ContactMode::stick) {
      together.row(3) = together.row(1);
      together.row(2) = together.row(0) + together.row(FlowPlace::gap);
    }
    set.spread = there.spread - field * earlier;
    const double apart = set.deviation(Modes::unit(FlowPlace::time)).upper();
    set.at_once = carried_across(saltation(surface, after, there), after, together, apart);
    set.is_apart = true;
  }

  /// The saltation matrix S = R + (f⁺ − R f⁻) h/(h f⁻) for all motions that reach a surface, f⁻ and
  /// f⁺ being ẇ before and after, and R the matrix that sets g. Where stick begins, S conserves
  /// momentum and makes Δż vanish at any acceleration; where stick ends at a surface, f⁺ = f⁻.
  typename Modes::Rate saltation(const Row& surface, ContactMode after, const Set& there) const {
    using Rate = typename Modes::Rate;
    Rate result = Rate::Identity();
    if (after == ContactMode::stick) {
      result.row(1) = modes_.common_velocity();
      result.row(3) = modes_.common_velocity();
    } else if (mode_ != ContactMode::stick) {
      const Rate& rate = modes_.rate(mode_);
      const Row gradient = surface / there.range(surface * rate);
      for (const Eigen::Index i : {1, 3})
        result.row(i) += there.range(modes_.rate(after).row(i) - rate.row(i)) * gradient;
    }
    if (mode_ == ContactMode::engaged) result.row(FlowPlace::gap) = Modes::unit(2) - Modes::unit(0);
    return result;
  }

  /// The derivative at one instant, transported by the flow back to the instant of the centre, for
  /// motions that change their contact a time δ after the centre, |δ| ≤ apart:
  ///
  ///     e^{−A⁺δ} S e^{A⁻δ} = S + δ (S A⁻ − A⁺S)
  ///                          + δ²/2 e^{−A⁺δ'} (A⁺²S − 2 A⁺S A⁻ + S A⁻²) e^{A⁻δ'},
  ///
  /// where δ' lies between 0 and δ. The common part of S A⁻ and A⁺S cancels.
  /// @param together  derivative at the instant of the centre, before the change
  typename Set::Spread carried_across(const typename Modes::Rate& saltation, ContactMode after,
                                      const typename Set::Spread& together, double apart) const {
    using Spread = typename Set::Spread;
    const auto before = [&](const Spread& spread) { return modes_.moved(mode_, spread); };
    const auto beyond = [&](const Spread& spread) { return modes_.moved(after, spread); };
    if (apart > modes_.longest()) return Spread::Constant(Number::unknown());
    const Number later(-apart, apart);
    const Spread around = modes_.flowed(mode_, together, later);
    const Spread at_centre = saltation * together;
    const Spread first = saltation * before(together) - beyond(at_centre);
    const Spread second = beyond(beyond(saltation * around)) -
                          beyond(saltation * before(around)) * Number(2.0) +
                          saltation * before(before(around));
    return at_centre + first * later +
           modes_.flowed(after, second, later) * (square(later) * Number(0.5));
  }

  /// Changes the contact at the zero of a guard: imposes the constraints on the surface and
  /// determines which derivatives of the next guard vanish there.
  void change(const RecordedContact& to, std::size_t guard, Set& set) {
    const ContactMode left = mode_;
    if (left != ContactMode::gap) set.assign_where_met(3, Modes::unit(1));
    if (left == ContactMode::engaged)
      set.assign_where_met(FlowPlace::gap, Modes::unit(2) - Modes::unit(0));
    if (left == ContactMode::stick)
      set.assign_where_met(2, Modes::unit(0) + Modes::unit(FlowPlace::gap));
    if (to.mode == ContactMode::engaged) set.assign(FlowPlace::gap, Number());
    int zeros = 0;
    if (to.mode == ContactMode::gap) zeros = left == ContactMode::stick ? 3 : 2;
    if (to.mode == ContactMode::engaged && left == ContactMode::stick) zeros = guard == 1 ? 2 : 0;
    begin(to, zeros);
  }

  /// Whether the backlash law allows a given contact after the zero of a guard. If it allows
  /// several contacts, the guards of the new contact decide.
  bool may_change(std::size_t guard, const RecordedContact& to) const {
    if (guard >= guards().size()) return false;
    switch (mode_) {
      case ContactMode::engaged:
        return to.mode != ContactMode::engaged && to.sign == sign_;
      case ContactMode::gap:
        return to.mode == ContactMode::engaged && to.sign == (guard == 0 ? 1.0 : -1.0);
      case ContactMode::stick:
        return to.mode == (guard == 0 ? ContactMode::gap : ContactMode::engaged) &&
               to.sign == sign_;
    }
    return false;
  }

  /// Whether all guards except number `but` are proved to be positive up to the time `end` (s).
  bool stays_positive(const Set& set, double end, std::size_t but) {
    for (std::size_t g = 0; g < guards().size(); ++g) {
      if (g == but) continue;
      const ContactSurface surface = guards()[g].surface;
      const int terms = modes_.terms_for(end);
      const Series series(guards()[g], set, terms);
      const int zeros = zeros_of(g);
      if (!series.is_positive(end, zeros)) {
        if (witness_ && zeros == 0 && Series(guards()[g], *witness_, terms).is_positive(end, 0))
          continue;
        const bool begins = zeros > 0 || !series.value(Number()).is_positive();
        return refuse(about(surface, zeros, now(set) + (begins ? 0.0 : end)),
                      begins ? series.derivative(zeros) : series.value(Number(end)));
      }
      if (zeros > 0) note(about(surface, zeros, now(set)), series.derivative(zeros));
      note_minima(g, series, zeros > 0 ? end : 0.0, end, now(set));
    }
    return true;
  }

  /// Records the local minima of a positive guard, at turning points and where stick begins.
  void note_minima(std::size_t guard, const Series& series, double from, double end, double now) {
    const ContactSurface surface = guards()[guard].surface;
    const auto slope = [&](double s) { return series.slope(Number(s)).middle(); };
    double& last = last_slopes_[guard];
    const bool may_turn = last < 0.0 || (last == 0.0 && mode_ == ContactMode::stick);
    if (from < end && slope(from) > 0.0 && may_turn)
      note(about(surface, 0, now + from), series.value(Number(from)));
    if (from < end && slope(from) < 0.0 && slope(end) > 0.0) {
      double falls = from, rises = end;
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (falls + rises);
        (slope(middle) < 0.0 ? falls : rises) = middle;
      }
      note(about(surface, 0, now + falls), series.value(Number(falls)));
    }
    last = slope(end);
  }

  std::int64_t number_of_sample() const { return static_cast<std::int64_t>(sample_); }
  static double now(const Set& set) { return set.centre[FlowPlace::time].middle(); }
  ContactTest about(ContactSurface surface, int order, double instant) const {
    return {surface, order, number_of_sample(), instant};
  }
  void note(ContactTest about, const Number& value) {
    about.distance = value.middle();
    about.error = value.radius();
    if (nearest_.sample < 0 || about.decided_by() < nearest_.decided_by()) nearest_ = about;
  }
  bool refuse(ContactTest about, const Number& value) {
    nearest_.sample = -1;
    note(about, value);
    is_undecided_ = true;
    return false;
  }
  bool test(const ContactTest& about, const Number& value) {
    if (!value.is_positive()) return refuse(about, value);
    note(about, value);
    return true;
  }

  const Modes& modes_;
  const RecordedContacts& path_;
  double delay_;
  bool moves_gap_;
  std::size_t sample_ = 0;
  bool has_begun_ = false;
  ContactMode mode_ = ContactMode::engaged;
  double sign_ = 1.0;
  int zeros_ = 0;
  std::array<double, 2> last_slopes_{};  // of the guards at the end of the last part; 0: unknown
  std::optional<Set> witness_;           // second set that contains all motions
  ContactTest nearest_;
  bool is_undecided_ = false;
  double instant_error_ = 0.0;
};

}  // namespace detail
}  // namespace holdfast
