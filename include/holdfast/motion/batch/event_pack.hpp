#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/phasor_table.hpp"
#include "holdfast/math/roots/first_roots.hpp"
#include "holdfast/motion/batch/event_table.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/taylor_step.hpp"

namespace holdfast {

/// The excitation of a pack of motions, each with its own harmonics, held or exact: a lane whose
/// force is held has one harmonic that stands still.
template <class Scalar>
class LaneExcitation {
 public:
  /// @param of_lane  (lane) → const DigitalLoop&
  template <class OfLane>
  explicit LaneExcitation(const OfLane& of_lane) {
    std::size_t lines = 1;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      lines = std::max(lines, of_lane(lane).force.harmonics.size());
    for (std::size_t l = 0; l < lines; ++l) lines_.push_back(line_of_lanes(of_lane, l));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      held_[lane] = of_lane(lane).hold == ForceHold::sampled ? 1.0 : 0.0;
    any_held_ = any(held_.all() > Scalar(0.5));
    phases_.resize(lines);
  }

  /// Sample j, one after the other or from 0 again.
  void begin_sample(std::int64_t index) {
    const auto k = static_cast<std::size_t>(index) % RotatingPhasor<Scalar>::block;
    Scalar held_force(0);
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      if (k == 0) lines_[l].turning.turn_to(index);
      phases_[l] = lines_[l].turning.at(k);
      held_force = held_force + lines_[l].at_sample.cosine * phases_[l].cosine -
                   lines_[l].at_sample.sine * phases_[l].sine;
    }
    if (!any_held_) return;
    const Mask<Scalar> held = held_.all() > Scalar(0.5);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      phases_[l] = {select(held, l == 0 ? held_force : Scalar(0), phases_[l].cosine),
                    select(held, Scalar(0), phases_[l].sine)};
  }

  /// Whether the force of a lane is held over its samples.
  bool is_held(std::size_t lane) const { return held_[lane] > 0.5; }
  /// How many harmonics a lane has at the most.
  std::size_t lines() const { return lines_.size(); }
  /// F_l cos ω_l t_j and F_l sin ω_l t_j; of a held force F_j and 0.
  const ExcitationSample<Scalar>& phase(std::size_t line) const { return phases_[line]; }

  /// The harmonics with their own phases some time (s) after the sample.
  void turned(const Scalar& after, std::vector<LanePhasor<Scalar>>& phasors) const {
    using std::floor;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      const Line& line = lines_[l];
      const Scalar cycles = line.frequency * after + line.phase_cycles;
      const ExcitationSample<Scalar> turn = unit_phasor(Scalar(cycles - floor(cycles)));
      phasors[l] = {line.angular_frequency,
                    {turn.cosine * phases_[l].cosine - turn.sine * phases_[l].sine,
                     turn.cosine * phases_[l].sine + turn.sine * phases_[l].cosine}};
    }
  }

  /// F (N) of harmonics.
  static Scalar force(const std::vector<LanePhasor<Scalar>>& phasors) {
    Scalar sum(0);
    for (const LanePhasor<Scalar>& phasor : phasors) sum = sum + phasor.phase.cosine;
    return sum;
  }

 private:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;

  struct Line {
    RotatingPhasor<Scalar> turning;
    ExcitationSample<Scalar> at_sample;                 // cos φ and sin φ
    Scalar frequency, phase_cycles, angular_frequency;  // 0 where the force is held
  };

  template <class OfLane>
  static Line line_of_lanes(const OfLane& of_lane, std::size_t l) {
    const auto number = [&](const auto& part) {
      return detail::from_lanes<Scalar>([&](std::size_t lane) -> double {
        const auto& lines = of_lane(lane).force.harmonics;
        return part(l < lines.size() ? lines[l] : Harmonic{0.0, 1.0, 0.0},
                    of_lane(lane).hold == ForceHold::exact);
      });
    };
    const Scalar period =
        detail::from_lanes<Scalar>([&](std::size_t lane) { return of_lane(lane).sampling.period; });
    return {
        RotatingPhasor<Scalar>({number([](const Harmonic& line, bool) { return line.amplitude; }),
                                number([](const Harmonic& line, bool) { return line.frequency; })},
                               period),
        {number([](const Harmonic& line, bool) { return std::cos(line.phase); }),
         number([](const Harmonic& line, bool) { return std::sin(line.phase); })},
        number([](const Harmonic& line, bool exact) { return exact ? line.frequency : 0.0; }),
        number([](const Harmonic& line, bool exact) {
          return exact ? line.phase / (2.0 * pi<double>) : 0.0;
        }),
        number([](const Harmonic& line, bool exact) {
          return exact ? line.angular_frequency() : 0.0;
        })};
  }

  std::vector<Line> lines_;
  std::vector<ExcitationSample<Scalar>> phases_;
  LaneNumbers<Scalar> held_;
  bool any_held_;
};

/// One motion of an EventPack.
struct EventStart {
  const ImplementedLoop* loop;  ///< of which has_event_pack()
  EventTable* table;            ///< that serves it; as long-lived as the pack
  Vector<double, 4> state;      ///< z_0 (m, m/s, m, m/s), finite
};

/// Motions whose contact changes between the samples, side by side: those of EventMotion, each with
/// its own loop, at the same sample all of them.
///
/// The steps are those of EventMotion. Lanes in which a guard may come to zero go from one change
/// of contact to the next together, the others waiting for them; the transition itself is
/// DriveContact's, lane by lane. Each lane's arithmetic is the same whoever its neighbours are.
///
/// Work per sample without a change of contact: some 90 operations on packs; for each stretch of a
/// lane, of which a change of contact needs one or two, some 1500. Nothing is allocated.
/// @tparam Scalar  `double` or a pack
template <class Scalar>
class EventPack {
  using Lane = Lanes<Scalar>;
  using LaneMask = Mask<Scalar>;

 public:
  static constexpr std::size_t lanes = Lane::count;  ///< motions at a time

  /// What `sense` takes, of all lanes.
  struct Sample {
    std::array<Scalar, 4> state;  ///< z_j
    Scalar control_force;         ///< what the drive transmits (N)
    LaneMask engaged;             ///< it transmits the command
  };

  /// @param starts  one for each lane; lanes beyond the last motion repeat one and are to `sleep`
  explicit EventPack(const std::array<EventStart, lanes>& starts)
      : excitation_(
            [&](std::size_t lane) -> const DigitalLoop& { return starts[lane].loop->digital; }),
        phasors_(excitation_.lines()) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto& [loop, table, state] = starts[lane];
      tables_[lane] = table;
      contacts_.emplace_back(loop->plant, loop->backlash, loop->switching, state);
      const DigitalLoop& digital = loop->digital;
      period_[lane] = digital.sampling.period;
      delay_[lane] = std::min(digital.sampling.processing_delay, digital.sampling.period);
      proportional_[lane] = digital.gains.proportional;
      differential_[lane] = digital.gains.differential;
      awake_[lane] = 1.0;
      for (std::size_t i = 0; i < 4; ++i) state_[i][lane] = state[static_cast<Eigen::Index>(i)];
    }
    any_delay_ = any(delay_.all() > Scalar(0));
    any_late_ = any(delay_.all() < period_.all());
    for (auto& step : steps_) step.lines.resize(excitation_.lines());
    modes_.fill(-1);
    stepped_modes_.fill(-1);
    for (std::size_t lane = 0; lane < lanes; ++lane) enter_mode(lane);
  }

  /// Takes sample j. Call once per sample.
  Sample sense() {
    excitation_.begin_sample(index_);
    switches_.fill(0);
    const std::array<Scalar, 4> z = state();
    command_ = proportional_.all() * z[0] + differential_.all() * z[1];
    const Scalar first = select(delay_.all() > Scalar(0), previous_command_, command_);
    jump(Scalar(0), first, awake(), IgnoreFlowOfLanes());
    Sample sample{z, select(engaged_.all() > Scalar(0.5), command_, Scalar(0)),
                  engaged_.all() > Scalar(0.5)};
    if (sticking_.any()) sample.control_force = with_sticking(sample.control_force);
    return sample;
  }

  /// What `advance` does without an observer.
  struct IgnoreFlowOfLanes {
    /// The contact of a lane changed, s after the sample: the numbers of its modes, and that of the
    /// guard, −1 for a jump.
    void switched(std::size_t, int, int, int, double) const {}
  };

  /// Moves all lanes from t_j to t_{j+1} under the commands that the last `sense()` decided.
  void advance() { advance(IgnoreFlowOfLanes()); }
  /// The same past an observer as IgnoreFlowOfLanes is one.
  template <class Observer>
  void advance(Observer&& observer) {
    const Scalar delay = delay_.all(), period = period_.all(), zero(0);
    if (any_delay_) flow({0, previous_command_, zero, delay}, awake() & (delay > zero), observer);
    if (any_late_) {
      const LaneMask late = awake() & (delay < period);
      if (any_delay_) jump(delay, command_, late & (delay > zero), observer);
      flow({1, command_, delay, period}, late, observer);
    }
    previous_command_ = command_;
    ++index_;
  }

  /// j, the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// The present sample is number j from now on, at which the excitation is what it was.
  void restart_index(std::int64_t index) { index_ = index; }
  /// z_j of all lanes.
  std::array<Scalar, 4> state() const {
    return {state_[0].all(), state_[1].all(), state_[2].all(), state_[3].all()};
  }
  /// z_j of one lane.
  Vector<double, 4> state(std::size_t lane) const {
    return {state_[0][lane], state_[1][lane], state_[2][lane], state_[3][lane]};
  }
  /// The contact of a lane in its present mode.
  const DriveContact<>& contact(std::size_t lane) const { return contacts_[lane]; }
  /// Whether the changes of contact of a lane accumulate (SwitchCounts::accumulates).
  bool accumulates(std::size_t lane) const { return accumulates_[lane]; }
  /// Whether those of any lane do.
  bool some_accumulate() const { return some_accumulate_; }
  /// The lane's motion has ended: it is at rest, and no other waits for it.
  void sleep(std::size_t lane) {
    awake_[lane] = 0.0;
    for (auto& number : state_) number[lane] = 0.0;
  }

 private:
  using Numbers = LaneNumbers<Scalar>;

  /// A part of the sampling period, in every lane.
  struct Part {
    std::size_t number;
    Scalar command, begin, end;
  };

  /// SubintervalStep of the present modes, and how far a guard may come below the chord.
  struct Step {
    std::array<std::array<Numbers, 4>, 4> transition;
    std::array<Numbers, 4> command, drift;
    std::vector<std::array<std::array<Numbers, 4>, 2>> lines;  // cosine, sine
    Numbers drop_by_norm, drop_by_command, drop_constant;
  };

  /// GuardOf of all lanes.
  struct LaneGuard {
    std::array<Numbers, 4> state;
    Numbers command, force, constant, zeros;

    Scalar at(const std::array<Scalar, 4>& z, const Scalar& u) const {
      return state[0].all() * z[0] + state[1].all() * z[1] + state[2].all() * z[2] +
             state[3].all() * z[3] + (command.all() * u + constant.all());
    }
  };

  LaneMask awake() const { return awake_.all() > Scalar(0.5); }
  static std::array<std::uint8_t, lanes> flags(const LaneMask& mask) {
    std::array<std::uint8_t, lanes> result;
    Lane::store_flags(mask, result.data());
    return result;
  }

  // What a lane's contact is, spread out for the packs.

  /// After a change of contact; the steps follow when they are next asked for.
  void enter_mode(std::size_t lane) {
    const DriveContact<>& contact = contacts_[lane];
    const int mode = contact.mode();
    const EventTable& table = *tables_[lane];
    const auto& dynamics = table.motion(mode).dynamics();
    for (std::size_t mass = 0; mass < 2; ++mass)
      by_command_[mass][lane] = dynamics.command[static_cast<Eigen::Index>(2 * mass + 1)];
    if (!table.move_alike(modes_[lane], mode)) enter_dynamics(lane, dynamics);
    modes_[lane] = mode;
    rate_[lane] = table.rate(mode);
    engaged_[lane] = contact.word() == ContactMode::engaged ? 1.0 : 0.0;
    sticks_[lane] = contact.word() == ContactMode::stick ? 1.0 : 0.0;
    sticking_.set(lane, contact.word() == ContactMode::stick);
    stale_.set(lane, true);
    refresh_guards(lane);
  }

  void enter_dynamics(std::size_t lane, const AffineDynamics& dynamics) {
    for (std::size_t mass = 0; mass < 2; ++mass) {
      const auto row = static_cast<Eigen::Index>(2 * mass + 1);
      for (std::size_t i = 0; i < 4; ++i)
        acceleration_[mass][i][lane] = dynamics.state(row, static_cast<Eigen::Index>(i));
      drift_[mass][lane] = dynamics.drift[row];
      by_force_[mass][lane] = dynamics.force[row];
    }
  }

  /// The steps of the present modes.
  void refresh_steps() {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!stale_[lane]) continue;
      const int mode = modes_[lane];
      const EventTable& table = *tables_[lane];
      const bool alike = table.move_alike(stepped_modes_[lane], mode);
      stepped_modes_[lane] = mode;
      for (std::size_t part = 0; part < 2; ++part) {
        const SubintervalStep<4>& step = table.motion(mode).step(part);
        for (std::size_t i = 0; i < 4; ++i)
          steps_[part].command[i][lane] = step.command[static_cast<Eigen::Index>(i)];
        if (!alike) enter_step(lane, part, step);
        if (contacts_[lane].changes_between_samples()) enter_drop(lane, part);
      }
      if (alike) continue;
      const TwoMass<double> plant = contacts_[lane].plant(mode);
      energy_[0][lane] = plant.conductor_stiffness;
      energy_[1][lane] = plant.conductor_mass;
      energy_[2][lane] = plant.absorber_stiffness;
      energy_[3][lane] = plant.absorber_mass;
    }
    stale_.reset();
  }

  void enter_step(std::size_t lane, std::size_t part, const SubintervalStep<4>& from) {
    Step& to = steps_[part];
    const bool held = excitation_.is_held(lane);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t k = 0; k < 4; ++k)
        to.transition[i][k][lane] = from.transition(row, static_cast<Eigen::Index>(k));
      to.drift[i][lane] = from.drift[row];
      for (std::size_t l = 0; l < to.lines.size(); ++l) {
        const bool has = !held && l < from.lines.size();
        to.lines[l][0][i][lane] = has              ? from.lines[l].cosine[row]
                                  : held && l == 0 ? from.held[row]
                                                   : 0.0;
        to.lines[l][1][i][lane] = has ? from.lines[l].sine[row] : 0.0;
      }
    }
  }

  void enter_drop(std::size_t lane, std::size_t part) {
    const EventTable::Drop drop = tables_[lane]->drop(contacts_[lane], part);
    steps_[part].drop_by_norm[lane] = drop.by_norm;
    steps_[part].drop_by_command[lane] = drop.by_command;
    steps_[part].drop_constant[lane] = drop.constant;
  }

  /// A guard that a lane has not got is far above zero for good.
  void refresh_guards(std::size_t lane) {
    constexpr double far = 1e90;
    const Guards guards = accumulates_[lane] ? Guards() : contacts_[lane].guards();
    bool fresh = false;
    for (std::size_t g = 0; g < 2; ++g) {
      const bool has = static_cast<int>(g) < guards.count;
      const Guard& guard = guards.guard[g];
      LaneGuard& to = guards_[g];
      for (std::size_t i = 0; i < 4; ++i)
        to.state[i][lane] = has ? guard.state[static_cast<Eigen::Index>(i)] : 0.0;
      to.command[lane] = has ? guard.command : 0.0;
      to.force[lane] = has ? guard.force : 0.0;
      to.constant[lane] = has ? guard.constant : far;
      to.zeros[lane] = has ? guard.zeros : 0;
      fresh = fresh || (has && (guard.zeros > 0 || guard.unsigned_yet));
    }
    unsigned_.set(lane, guards.count > 0 && guards.guard[0].unsigned_yet);
    set_fresh(lane, fresh);
    two_guards_.set(lane, guards.count > 1);
    has_guard_[lane] = guards.count > 0 ? 1.0 : 0.0;
  }

  void set_fresh(std::size_t lane, bool fresh) {
    fresh_[lane] = fresh ? 1.0 : 0.0;
    fresh_lanes_.set(lane, fresh);
  }

  // Jumps of the command.

  /// F (N) some time after the sample.
  Scalar force_at(const Scalar& after) {
    excitation_.turned(after, phasors_);
    return LaneExcitation<Scalar>::force(phasors_);
  }

  /// Lanes whose contact looks at a jump: in stick, where its condition fails under the new
  /// command, and just after a change.
  template <class Observer>
  void jump(const Scalar& after, const Scalar& command, const LaneMask& which,
            Observer&& observer) {
    if (sticking_.none() && fresh_lanes_.none()) return;
    const Scalar zero(0), force = force_at(after);
    const std::array<Scalar, 4> z = state();
    LaneMask stays = zero == zero;
    for (const LaneGuard& guard : guards_)
      stays = stays & (guard.at(z, command) + guard.force.all() * force > zero);
    const LaneMask asked =
        which & ((fresh_.all() > Scalar(0.5)) | ((sticks_.all() > Scalar(0.5)) & !stays));
    if (!any(asked)) return;
    const auto lane_asked = flags(asked);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lane_asked[lane] == 0) continue;
      const int before = contacts_[lane].mode();
      contacts_[lane].jumped(
          {state(lane), detail::lane_of(command, lane), detail::lane_of(force, lane)});
      if (contacts_[lane].mode() == before) {
        refresh_guards(lane);
        continue;
      }
      count(lane);
      enter_mode(lane);
      observer.switched(lane, before, contacts_[lane].mode(), -1, detail::lane_of(after, lane));
    }
  }

  Scalar with_sticking(const Scalar& transmitted) {
    const Scalar force = force_at(Scalar(0));
    Numbers numbers;
    numbers.set(transmitted);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (sticks_[lane] > 0.5)
        numbers[lane] = contacts_[lane].transmitted(
            {state(lane), detail::lane_of(command_, lane), detail::lane_of(force, lane)});
    return numbers.all();
  }

  void count(std::size_t lane) {
    if (++switches_[lane] > EventMotion<>::most_switches)
      accumulates_[lane] = some_accumulate_ = true;
  }

  // Parts of the period.

  template <class Observer>
  void flow(const Part& part, const LaneMask& which, Observer& observer) {
    LaneMask pending = which & !flow_without_event(part, which);
    if (!any(pending)) return;
    Numbers reached;
    reached.set(part.begin);
    while (any(pending)) {
      flow_to_event(part, pending, reached, observer);
      pending = pending & (reached.all() < part.end);
    }
  }

  /// The whole part at once in the lanes where it is sure that the contact does not change in it.
  /// @return those lanes
  LaneMask flow_without_event(const Part& part, const LaneMask& which) {
    if (stale_.any()) refresh_steps();
    const std::array<Scalar, 4> before = state();
    std::array<Scalar, 4> after = stepped(steps_[part.number], before, part.command);
    if (sticking_.any()) {
      const LaneMask sticks = sticks_.all() > Scalar(0.5);
      after[2] = select(sticks, Scalar(after[0] + (before[2] - before[0])), after[2]);
      after[3] = select(sticks, after[1], after[3]);
    }
    const LaneMask through =
        which & ((has_guard_.all() < Scalar(0.5)) | no_guard_falls(part, before, after));
    // What comes next need not wait for the bound where all lanes are through.
    const bool whole = all(through);
    for (std::size_t i = 0; i < 4; ++i)
      state_[i].set(whole ? after[i] : select(through, after[i], before[i]));
    return through;
  }

  std::array<Scalar, 4> stepped(const Step& step, const std::array<Scalar, 4>& z,
                                const Scalar& command) const {
    std::array<Scalar, 4> after;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& row = step.transition[i];
      after[i] = step.drift[i].all();
      for (std::size_t l = 0; l < step.lines.size(); ++l) {
        const ExcitationSample<Scalar>& phase = excitation_.phase(l);
        after[i] = step.lines[l][1][i].all() * phase.sine +
                   (step.lines[l][0][i].all() * phase.cosine + after[i]);
      }
      // The command is known last.
      for (std::size_t k = 0; k < 4; ++k) after[i] = row[k].all() * z[k] + after[i];
      after[i] = step.command[i].all() * command + after[i];
    }
    return after;
  }

  LaneMask no_guard_falls(const Part& part, const std::array<Scalar, 4>& before,
                          const std::array<Scalar, 4>& after) {
    using std::abs;
    using std::min;
    using std::sqrt;
    Scalar force_before(0), force_after(0);
    if (sticking_.any()) {
      force_before = force_at(part.begin);
      force_after = force_at(part.end);
    }
    Scalar least(std::numeric_limits<double>::infinity());
    for (const LaneGuard& guard : guards_) {
      const Scalar by_force = guard.force.all();
      least = min(least, min(Scalar(guard.at(before, part.command) + by_force * force_before),
                             Scalar(guard.at(after, part.command) + by_force * force_after)));
    }
    const Scalar relative = before[2] - before[0];
    const Scalar norm = sqrt(Scalar(
        energy_[0].all() * before[0] * before[0] + energy_[2].all() * relative * relative +
        energy_[1].all() * before[1] * before[1] + energy_[3].all() * before[3] * before[3]));
    const Step& step = steps_[part.number];
    const Scalar drop = step.drop_by_norm.all() * norm +
                        step.drop_by_command.all() * abs(part.command) + step.drop_constant.all();
    return (least > drop) & (fresh_.all() < Scalar(0.5));
  }

  /// Goes on to the next change of contact, or to the end of the part, in some lanes.
  template <class Observer>
  void flow_to_event(const Part& part, const LaneMask& pending, Numbers& reached,
                     Observer& observer) {
    using std::min;
    const Scalar zero(0), one(1), begin = reached.all();
    const Scalar wanted = part.end - begin;
    const Scalar length = select(pending, min(wanted, Scalar(one / rate_.all())), zero);
    const int terms = terms_of(rate_.all() * length);
    excitation_.turned(begin, phasors_);
    const std::array<Scalar, 4> z = state();
    const TwoMassSeries<Scalar> series(accelerations(part.command), z, phasors_, length, terms);
    const Event event = next_event(series, part.command, terms, pending);
    for (std::size_t i = 0; i < 4; ++i)
      state_[i].set(select(pending, series.value(series.state[i], terms, event.at), z[i]));
    const Scalar came = select(event.found, Scalar(begin + event.at * length),
                               select(length == wanted, part.end, Scalar(begin + length)));
    reached.set(select(pending, came, begin));
    if (fresh_lanes_.any()) tell_flowed(pending & (event.at * length > zero));
    if (any(event.found))
      change(event, part.command, series.value(series.force, terms, event.at), reached, observer);
  }

  /// terms_for() of the lane that turns most.
  int terms_of(const Scalar& turns) const {
    Numbers of_lane;
    of_lane.set(turns);
    double most = 0.0;
    for (std::size_t lane = 0; lane < lanes; ++lane) most = std::max(most, of_lane[lane]);
    int terms = 1;
    for (const double longest : longest_) terms += most > longest ? 1 : 0;
    return std::min(terms, most_terms);
  }

  /// How long a series of 1, 2, … terms may be, in turns.
  static std::array<double, most_terms> lengths_of_series() {
    std::array<double, most_terms> longest{};
    for (int terms = 1; terms <= most_terms; ++terms) {
      double low = 0.0, high = 2.0;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (terms_for(middle) <= terms ? low : high) = middle;
      }
      longest[static_cast<std::size_t>(terms - 1)] = low;
    }
    return longest;
  }

  std::array<LaneAcceleration<Scalar>, 2> accelerations(const Scalar& command) const {
    const auto row = [&](std::size_t mass) {
      const auto& of = acceleration_[mass];
      return LaneAcceleration<Scalar>{{of[0].all(), of[1].all(), of[2].all(), of[3].all()},
                                      by_command_[mass].all() * command + drift_[mass].all(),
                                      by_force_[mass].all()};
    };
    return {row(0), row(1)};
  }

  /// The first change of contact over a stretch, in every lane.
  struct Event {
    LaneMask found;
    Scalar at;        // in lengths of the stretch; 1 where there is none
    LaneMask second;  // it is the second guard's
  };

  Event next_event(const TwoMassSeries<Scalar>& series, const Scalar& command, int terms,
                   const LaneMask& pending) {
    const LaneMask guarded = pending & (has_guard_.all() > Scalar(0.5));
    if (two_guards_.none()) {
      std::array<LaneSeries<Scalar>, 1> guards;
      guard_series(0, series, command, terms, guarded, guards[0]);
      const auto [root] = first_roots<Scalar, 1>(guards, terms, {guarded});
      return {root.found, root.at, Scalar(0) > Scalar(0)};
    }
    std::array<LaneSeries<Scalar>, 2> guards;
    for (std::size_t g = 0; g < 2; ++g) guard_series(g, series, command, terms, guarded, guards[g]);
    const auto [one, two] = first_roots<Scalar, 2>(guards, terms, {guarded, guarded});
    const LaneMask later = two.found & !(one.found & (one.at <= two.at));
    const LaneMask found = one.found | two.found;
    return {found, select(later, two.at, one.at), later};
  }

  /// A guard along a stretch; leading coefficients that are nothing but rounding are zero.
  void guard_series(std::size_t number, const TwoMassSeries<Scalar>& series, const Scalar& command,
                    int terms, const LaneMask& which, LaneSeries<Scalar>& result) {
    const LaneGuard& guard = guards_[number];
    const std::array<Scalar, 4> row{guard.state[0].all(), guard.state[1].all(),
                                    guard.state[2].all(), guard.state[3].all()};
    const Scalar by_force = guard.force.all(), zeros = guard.zeros.all(), zero(0);
    const auto count = static_cast<std::size_t>(terms);
    for (std::size_t k = 0; k < count; ++k)
      result[k] = row[0] * series.state[0][k] + row[1] * series.state[1][k] +
                  row[2] * series.state[2][k] + row[3] * series.state[3][k];
    if (sticking_.any())
      for (std::size_t k = 0; k < count; ++k) result[k] = result[k] + by_force * series.force[k];
    result[0] = result[0] + guard.command.all() * command + guard.constant.all();
    if (fresh_lanes_.any())
      for (std::size_t k = 0; k < std::min<std::size_t>(count, 4); ++k)
        result[k] = select(zeros > Scalar(static_cast<double>(k)), zero, result[k]);
    clear_rounding(guard, row, series, command, terms, which, result);
    if (number == 0 && unsigned_.any()) learn_signs(terms, which, result);
  }

  void clear_rounding(const LaneGuard& guard, const std::array<Scalar, 4>& row,
                      const TwoMassSeries<Scalar>& series, const Scalar& command, int terms,
                      const LaneMask& which, LaneSeries<Scalar>& result) const {
    using std::abs;
    const Scalar rounding(4.0 * std::numeric_limits<double>::epsilon());
    Scalar known = abs(guard.command.all() * command) + abs(guard.constant.all());
    LaneMask still = which;
    for (std::size_t k = 0; k < static_cast<std::size_t>(terms); ++k) {
      Scalar size = known + abs(guard.force.all() * series.force[k]);
      for (std::size_t i = 0; i < 4; ++i) size = size + abs(row[i] * series.state[i][k]);
      still = still & !(abs(result[k]) > rounding * size);
      if (!any(still)) return;
      result[k] = select(still, Scalar(0), result[k]);
      known = Scalar(0);
    }
  }

  /// The sign that a guard takes first where it was not known, as detail::first_sign() has it.
  void learn_signs(int terms, const LaneMask& which, LaneSeries<Scalar>& series) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!unsigned_[lane] || flags(which)[lane] == 0) continue;
      Series alone(terms);
      for (Eigen::Index k = 0; k < terms; ++k)
        alone[k] = detail::lane_of(series[static_cast<std::size_t>(k)], lane);
      const double sign = detail::first_sign(alone);
      if (sign != 0.0) alone *= sign;
      for (Eigen::Index k = 0; k < terms; ++k) {
        Numbers numbers;
        numbers.set(series[static_cast<std::size_t>(k)]);
        numbers[lane] = alone[k];
        series[static_cast<std::size_t>(k)] = numbers.all();
      }
      if (sign == 0.0) continue;
      contacts_[lane].learn_sign(0, sign);
    }
  }

  /// Some time has passed in the lanes of a mask since their last changes.
  void tell_flowed(const LaneMask& passed) {
    const auto lane_passed = flags(passed);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lane_passed[lane] == 0 || !fresh_lanes_[lane]) continue;
      contacts_[lane].flowed();
      if (unsigned_[lane]) {
        refresh_guards(lane);
        continue;
      }
      for (LaneGuard& guard : guards_) guard.zeros[lane] = 0.0;
      set_fresh(lane, false);
    }
  }

  template <class Observer>
  void change(const Event& event, const Scalar& command, const Scalar& force,
              const Numbers& reached, Observer& observer) {
    const auto found = flags(event.found), second = flags(event.second);
    Numbers commands, forces;
    commands.set(command);
    forces.set(force);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (found[lane] == 0) continue;
      DriveContact<>& contact = contacts_[lane];
      const int before = contact.mode(), guard = second[lane];
      ContactInstant now{state(lane), commands[lane], forces[lane]};
      contact.reached(guard, now);
      for (std::size_t i = 0; i < 4; ++i) state_[i][lane] = now.state[static_cast<Eigen::Index>(i)];
      count(lane);
      enter_mode(lane);
      observer.switched(lane, before, contact.mode(), guard, reached[lane]);
    }
  }

  LaneExcitation<Scalar> excitation_;
  std::vector<LanePhasor<Scalar>> phasors_;
  std::array<double, most_terms> longest_ = lengths_of_series();
  std::array<EventTable*, lanes> tables_{};
  std::vector<DriveContact<>> contacts_;
  Numbers period_, delay_, proportional_, differential_, awake_;
  bool any_delay_ = false, any_late_ = true;
  std::array<Numbers, 4> state_;
  Scalar previous_command_ = Scalar(0), command_ = Scalar(0);
  std::int64_t index_ = 0;

  // Of the modes of the contacts.
  std::array<Step, 2> steps_;
  std::array<std::array<Numbers, 4>, 2> acceleration_;
  std::array<Numbers, 2> by_command_, drift_, by_force_;
  std::array<Numbers, 4> energy_;
  std::array<LaneGuard, 2> guards_;
  Numbers rate_, engaged_, sticks_, fresh_, has_guard_;
  std::array<int, lanes> modes_{}, stepped_modes_{}, switches_{};
  std::array<bool, lanes> accumulates_{};
  bool some_accumulate_ = false;
  std::bitset<lanes> fresh_lanes_, sticking_, unsigned_, two_guards_, stale_;
};

}  // namespace holdfast
