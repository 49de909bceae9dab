#include "report/page/answers.hpp"

#include <unistd.h>

#include "case/model/modal/modes_warning.hpp"
#include "job.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {
namespace {

struct AnswersQuestion {
  bool detailed = false;

  void add_to(const Job& job) { job.add("--details", detailed); }

  void run(const Job& job) const {
    const JobContext context = job.context();
    report_warning(drift_warning(context.case_data), context.quiet);
    report_warning(dense_work_warning(context.case_data, Switching::sampled), context.quiet);
    Table table(context, columns_of(detailed ? "detailed answers" : "answers"));
    answer(context, [&](const Answer& known) {
      if (detailed)
        table.row(known.question, known.answer, known.detail,
                  shell_text(known.arguments, job.case_arguments()));
      else
        table.row(known.question, known.answer);
      if (isatty(STDOUT_FILENO) == 1) table.writer().flush();  // a pipe gets them together
    });
    table.commit();
  }
};

}  // namespace

void add_answers(CLI::App& program) { add_job<AnswersQuestion>(program, "answers"); }

}  // namespace holdfast::program
