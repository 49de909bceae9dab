#include "report/page/answers.hpp"

#include <memory>

#include "io/text/table.hpp"
#include "job.hpp"
#include "report/page/command_line.hpp"

namespace holdfast::program {
namespace {

std::vector<Column> answer_columns(bool detailed) {
  std::vector<Column> columns = {{"question", "", "of a designer", "string"},
                                 {"answer", "", "for the case as it is", "string"}};
  if (!detailed) return columns;
  columns.push_back({"detail", "", "what was computed, and how far it reaches", "string"});
  columns.push_back({"command", "", "that shows it", "string"});
  return columns;
}

void run(const Job& job, bool detailed) {
  const JobContext context = job.context();
  Table table(context, answer_columns(detailed));
  for (const Answer& answer : answers_of(context.case_data, context.instructions)) {
    const std::string command = shell_text(command_of(answer.arguments, job.case_arguments()));
    if (detailed)
      table.row(answer.question, answer.answer, answer.detail, command);
    else
      table.row(answer.question, answer.answer);
  }
  table.commit();
}

}  // namespace

void add_answers(CLI::App& program) {
  const Job job(program, "answers", question::all,
                "Does control help, which D, how slow a computer, how much play, what motion: the "
                "first part of the report, in words");
  const auto detailed = std::make_shared<bool>(false);
  job->add_flag("--details", *detailed,
                "With what was computed for each answer, and the command that shows it");
  job.computes_on_packs();
  job->final_callback([job, detailed] { run(job, *detailed); });
}

}  // namespace holdfast::program
