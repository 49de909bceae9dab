#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/batch/event_pack.hpp"
#include "holdfast/motion/batch/event_table.hpp"
#include "holdfast/motion/implemented_loop.hpp"

namespace holdfast {

/// Assigns motions of one loop to the lanes of a SIMD pack and decides when each ends. At a
/// *stroboscopic instant* sampling and forcing are in phase.
class LaneScheduler {
 public:
  LaneScheduler() = default;
  LaneScheduler(const LaneScheduler&) = delete;
  LaneScheduler& operator=(const LaneScheduler&) = delete;
  virtual ~LaneScheduler() = default;

  /// Assigns a lane its next motion and sets its `start` [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s).
  /// @return false where no motion is left
  virtual bool next(std::size_t lane, Vector<double, 4>& start) = 0;
  /// Decides at a stroboscopic instant whether a lane's motion continues. Where `is_followed` is
  /// false the motion is invalid, because contact changes accumulate (SwitchCounts::accumulates).
  virtual bool goes_on(std::size_t lane, const Vector<double, 4>& state, bool is_followed) = 0;
  /// Records the contact mode of a lane's motion at a sample.
  virtual void took(std::size_t lane, ContactMode mode) = 0;
  /// The number q of samples from one stroboscopic instant to the next.
  virtual std::int64_t period() const = 0;
};

/// Runs motions of one loop with exact switching in parallel, one per SIMD lane. A lane starts its
/// next motion at the stroboscopic instant at which the previous one ended. Samples are counted
/// from this instant, so that rounding of large times cannot shift the phase.
/// @param loop       loop for which has_event_pack() is true, with q = scheduler.period()
/// @param scheduler  assigns the motions to the lanes and receives their results
/// @throws InvalidParameter where the loop is not admissible
template <class Scalar>
void run_on_lanes(const ImplementedLoop& loop, LaneScheduler& scheduler) {
  using Pack = EventPack<Scalar>;
  constexpr std::size_t lanes = Pack::lanes;
  EventTable table(loop);
  std::array<EventStart, lanes> starts;
  starts.fill({&loop, &table, Vector<double, 4>::Zero()});
  Pack pack(starts);
  std::array<bool, lanes> taken{};
  for (bool begins = true;; begins = false) {
    pack.restart_index(0);
    bool some = false;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (taken[lane] && scheduler.goes_on(lane, pack.state(lane), !pack.accumulates(lane))) {
        some = true;
        continue;
      }
      if (!taken[lane] && !begins) continue;
      Vector<double, 4> start;
      taken[lane] = false;
      while (!taken[lane] && scheduler.next(lane, start))
        taken[lane] = scheduler.goes_on(lane, start, true);
      taken[lane] ? pack.restart(lane, start) : pack.sleep(lane);
      some = some || taken[lane];
    }
    if (!some) return;
    for (std::int64_t j = 0; j < scheduler.period(); ++j) {
      pack.sense();
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (taken[lane]) scheduler.took(lane, pack.contact(lane).word());
      pack.advance();
    }
  }
}

}  // namespace holdfast
