#include "case/model/conditioning.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/chaos/modal_lyapunov.hpp"
#include "job.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct LyapunovQuestion {
  double duration = 100.0;             ///< duration of the motion (s)
  double discard = 0.0;                ///< time (s) left out at the start
  std::string tangent = "consistent";  ///< "consistent" or "printed" tangents
  bool largest = false;                ///< whether only the largest exponent is computed
  bool history = false;                ///< whether exponents after every sample are written
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--duration", duration);
    job.add("--discard", discard);
    job.add("--tangent", tangent);
    job.add("--largest", largest);
    job.add("--history", history);
    job.add("--switching", switching);
  }
  void run(const JobContext& context) const;
};

/// Sampling for the tangent maps S and S*: that of the motion, or δ = τ as printed in the paper.
Sampling<double> tangent_sampling_of(const Case& the_case, const LyapunovQuestion& options) {
  Sampling<double> sampling = sampling_of(the_case);
  if (options.tangent == "printed") sampling.processing_delay = sampling.period;
  return sampling;
}

std::int64_t steps_of(const JobContext& context, const LyapunovQuestion& options) {
  const std::int64_t steps = samples_of(context.case_data, options.duration) - 1;
  if (steps < 1) throw WrongInput("--duration is below one sampling period: give a longer one");
  return steps;
}

/// Throws WrongInput for all exponents with a delay of 20 samples or more; warns of very long work.
void require_bearable_modes(const Case& the_case, const MovingLoop& moving,
                            const LyapunovQuestion& options, bool quiet) {
  if (!std::holds_alternative<BuiltPlant>(moving)) return;
  constexpr double bearable = 20.0;
  if (!options.largest &&
      the_case.control.processing_delay >= bearable * the_case.control.sampling_period)
    throw WrongInput(
        "all exponents need control.processing_delay below 20 sampling periods: give a "
        "shorter delay, or --largest for the first exponent alone");
  report_warning(dense_work_warning(the_case, options.switching), quiet);
}

/// Writes one row: a time (s), and the exponents averaged up to this time.
void write_history_row(Table& table, double time, const Vector<double, 5>& exponents) {
  table.writer().cell(time);
  for (const double exponent : exponents) table.writer().cell(exponent);
  table.writer().end_row();
}

void write_history(const SampledMasses& moving, const JobContext& context,
                   const LyapunovQuestion& options, std::int64_t steps, Table& table) {
  auto motion = motion_of(moving);
  const double period = context.case_data.control.sampling_period;
  const Case& the_case = context.case_data;
  LyapunovObserver observer(
      sampled_loop(plant_of(the_case), tangent_sampling_of(the_case, options)), gains_of(the_case));
  run_to_completion(motion, steps, {}, observer, [&](const MotionSample<double>& sample) {
    write_history_row(table, sample.time + period, observer.spectrum().exponents());
  });
}

void write_history(const SampledModes& moving, const JobContext&, const LyapunovQuestion&,
                   std::int64_t steps, Table& table) {
  auto motion = motion_of(moving);
  ModalSpectrum spectrum(moving.loop);
  run_to_completion(motion, steps, {}, spectrum, [&](const MotionSample<double>& sample) {
    const double time = static_cast<double>(sample.index + 1) * moving.loop.sampling.period;
    write_history_row(table, time, spectrum.spectrum().exponents());
  });
}

template <class Moving>
void write_history(const Moving& moving, const JobContext& context, const LyapunovQuestion&,
                   std::int64_t steps, Table& table) {
  auto motion = motion_of(moving);
  EventLyapunov lyapunov(motion);
  for (std::int64_t step = 0; step < steps; ++step) {
    look_for_interrupt(step);
    run_to_completion(lyapunov, 1, {});
    write_history_row(table, motion.time(), lyapunov.spectrum().exponents().template head<5>());
  }
  tell_of_end(context, end_of(motion));
}

/// Writes one row for each exponent: per sample, per second, standard error.
void write_exponents(const JobContext& context, const MovingLoop& moving,
                     const LyapunovQuestion& options) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = steps_of(context, options);
  const std::int64_t discard = samples_within(options.discard, period) - 1;
  if (discard >= steps) throw WrongInput("--discard must be shorter than --duration");
  Table table(context, columns_of("exponents"));
  const auto scope = options.largest ? LyapunovScope::largest : LyapunovScope::all;
  const LyapunovRun run{steps - discard, discard, scope};
  const auto [result, end] =
      exponents_of(moving, run, tangent_sampling_of(context.case_data, options));
  if (result.diverged) refuse_diverging(end.time);
  tell_of_end(context, end);
  report_warning(open_sign_warning(result), context.quiet);
  report_warning(stepped_reading_warning(context.case_data), context.quiet);
  report_warning(
      short_average_warning(context.case_data, static_cast<double>(result.samples) * period),
      context.quiet);
  table.note("averaged_from_s",
             format_number(static_cast<double>(discard + result.settling) * period));
  for (int i = 0; i < (options.largest ? 1 : 5); ++i)
    table.row(i + 1, result.exponents[i], result.exponents[i] / period, result.standard_errors[i]);
  table.commit();
}

/// Writes the exponents after every sample.
void write_exponent_history(const JobContext& context, const MovingLoop& moving,
                            const LyapunovQuestion& options) {
  const std::int64_t steps = steps_of(context, options);
  Table table(context, columns_of("exponent history"));
  std::visit([&](const auto& one) { write_history(one, context, options, steps, table); }, moving);
  table.commit();
}

void LyapunovQuestion::run(const JobContext& context) const {
  const MovingLoop moving = smooth_loop_of(context.case_data, switching);
  require_bearable_modes(context.case_data, moving, *this, context.quiet);
  history ? write_exponent_history(context, moving, *this)
          : write_exponents(context, moving, *this);
}

}  // namespace

void add_lyapunov(CLI::App& program) { add_job<LyapunovQuestion>(program, "lyapunov"); }

}  // namespace holdfast::program
