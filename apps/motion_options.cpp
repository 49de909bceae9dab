#include "motion_options.hpp"

namespace holdfast::program {

CLI::Option* add_duration(const Job& job, double& duration) {
  return job->add_option("--duration", duration, "Length of the motion, s")
      ->check(number_from(0.0, 1e12))
      ->type_name("")
      ->capture_default_str();
}

void add_from(const Job& job, double& from) {
  job->add_option("--from", from, "First instant to be written, s")
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

}  // namespace holdfast::program
