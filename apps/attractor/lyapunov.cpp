#include "jobs/attractor/lyapunov_tables.hpp"

#include <memory>

#include "job.hpp"
#include "motion_options.hpp"

namespace holdfast::program {
namespace {

struct LyapunovArguments {
  LyapunovOptions question;
  bool history = false;
};

}  // namespace

void add_lyapunov(CLI::App& program) {
  const Job job(program, "lyapunov", question::attractor,
                "The five Lyapunov exponents of the motion");
  const auto options = std::make_shared<LyapunovArguments>();
  LyapunovOptions& asked = options->question;
  add_duration(job, asked.duration);
  CLI::Option* discard = job->add_option("--discard", asked.discard, "Left out at the start, s")
                             ->check(number_from(0.0, 1e12))
                             ->type_name("")
                             ->capture_default_str();
  CLI::Option* error =
      job->add_option(
             "--standard-error", asked.standard_error,
             "Stop once the largest exponent per sample is known to this; 0: at --duration")
          ->check(number_from(0.0, 1e12))
          ->type_name("")
          ->capture_default_str();
  job->add_option("--tangent", asked.tangent,
                  "consistent: of the motion itself; printed: S and S* with delay tau, as the "
                  "paper's Table 2")
      ->check(CLI::IsMember({"consistent", "printed"}))
      ->capture_default_str();
  CLI::Option* largest =
      job->add_flag("--largest", asked.largest, "The largest exponent alone, at less cost");
  job->add_flag("--history", options->history, "Write the exponents after every sample")
      ->excludes(discard)
      ->excludes(error)
      ->excludes(largest);
  add_switching(job, asked.switching);
  job->final_callback([job, options] {
    options->history ? write_exponent_history(job.context(), options->question)
                     : write_exponents(job.context(), options->question);
  });
}

}  // namespace holdfast::program
