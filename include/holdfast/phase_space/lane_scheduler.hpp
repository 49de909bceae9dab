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

/// Assigns motions of one loop to the lanes of a SIMD pack and decides when each ends.
class LaneScheduler {
 public:
  LaneScheduler() = default;
  LaneScheduler(const LaneScheduler&) = delete;
  LaneScheduler& operator=(const LaneScheduler&) = delete;
  virtual ~LaneScheduler() = default;

  /// Gives a lane its next motion from `start` [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s). @return false
  /// where none is left
  virtual bool next(std::size_t lane, Vector<double, 4>& start) = 0;
  /// Takes the state of a lane's motion at a stroboscopic instant. @return whether it goes on
  virtual bool goes_on(std::size_t lane, const Vector<double, 4>& state, bool is_followed) = 0;
  /// Takes the mode of a lane's motion at a sample.
  virtual void took(std::size_t lane, ContactMode mode) = 0;
  /// q, samples from one stroboscopic instant to the next.
  virtual std::int64_t period() const = 0;
};

/// Moves motions of one loop with exact switching on side by side, a lane taking the next one at
/// the stroboscopic instant at which its own has ended. Samples are counted from each of those
/// instants, so that no rounding of late instants lets sampling and forcing drift apart.
/// @param loop        of which has_event_pack(), whose sampling and forcing coincide every
///                    scheduler.period() samples
/// @param scheduler  hands the motions out
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
