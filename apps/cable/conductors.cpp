#include "case/library/conductor_library.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

struct ConductorsQuestion {
  std::string text;

  void add_to(const Job& job) { job.add("--find", text); }

  void run(const JobContext& context) const {
    const auto found = conductors_with(text);
    if (found.empty())
      throw NoAnswer("--find " + shortened(text, 60) +
                     ": no conductor of the library has this text in its name, kind or source; "
                     "leave --find out to list all");
    Table table(context, columns_of("conductors"));
    for (const LibraryConductor* one : found)
      table.row(one->name, one->kind, one->mass_per_length, one->diameter, one->area,
                one->rated_strength, one->youngs_modulus, one->source);
    table.commit();
  }
};

}  // namespace

void add_conductors(CLI::App& program) { add_job<ConductorsQuestion>(program, "conductors"); }

}  // namespace holdfast::program
