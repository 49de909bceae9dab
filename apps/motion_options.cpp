#include "motion_options.hpp"

#include <map>

namespace holdfast::program {

CLI::Option* add_duration(const Job& job, double& duration) {
  return job.add_number("--duration", duration, "Length of the motion, s", 0.0, 1e12);
}

void add_from(const Job& job, double& from) {
  job.add_number("--from", from, "First instant to be written, s", 0.0, 1e12);
}

void add_switching(const Job& job, Switching& switching) {
  static const std::map<std::string, Switching> words{{"sampled", Switching::sampled},
                                                      {"exact", Switching::exact}};
  job->add_option_function<std::string>(
         "--switching", [&switching](const std::string& word) { switching = words.at(word); },
         "When the drive enters and leaves its backlash: at samples, the paper's rule, or when it "
         "happens")
      ->check(CLI::IsMember({"sampled", "exact"}))
      ->default_str("sampled");
}

void add_largest_period(const Job& job, std::int64_t& largest_period) {
  job->add_option("--max-period", largest_period, "Longest period that is looked for, samples")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{100'000'000}))
      ->type_name("")
      ->capture_default_str();
}

}  // namespace holdfast::program
