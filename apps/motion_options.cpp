#include "motion_options.hpp"

#include "errors.hpp"
#include "text.hpp"

namespace holdfast::program {

void add_duration(const Job& job, double& duration) {
  job->add_option("--duration", duration, "Length of the motion, s")
      ->check(number_from(0.0, 1e12))
      ->type_name("")
      ->capture_default_str();
}

void add_switching(const Job& job, std::string& switching) {
  job->add_option("--switching", switching,
                  "When the drive enters and leaves its backlash: sampled, the paper's rule")
      ->check(CLI::IsMember({"sampled"}))
      ->capture_default_str();
}

void add_largest_period(const Job& job, std::int64_t& largest_period) {
  job->add_option("--max-period", largest_period, "Longest period that is looked for, samples")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{100'000'000}))
      ->type_name("")
      ->capture_default_str();
}

void require_completed(TrajectoryOutcome outcome, double time) {
  if (outcome == TrajectoryOutcome::completed) return;
  throw NoAnswer("the motion diverges: it leaves the range of numbers at t = " +
                 format_number(time) + " s; a shorter --duration shows how it grows");
}

}  // namespace holdfast::program
