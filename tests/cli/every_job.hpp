#pragma once

#include "cli/program.hpp"

namespace holdfast::tests {

/// A job with arguments for which it is soon done, and with those for which it is not; none where
/// there are no such.
struct JobToTry {
  std::string quick;
  std::string slow;
  bool needs_packages = false;  // SUNDIALS or Ceres Solver

  std::string name() const { return quick.substr(0, quick.find(' ')); }
  bool is_built() const { return both_packages || !needs_packages; }
};

/// A line with a damper in the wind.
inline const std::string line_with_dashpot =
    " --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020"
    " --set site.weibull_scale=5 --set device.1.kind=dashpot --set device.1.position=1.5"
    " --set device.1.damping=200";

/// Every job whose result is a table.
inline const std::vector<JobToTry> jobs_with_table = {
    {"case", ""},
    {"conductors", ""},
    {"reduce", "reduce", true},
    {"statics --elements 10 --force -0.5:0.5:3", "statics --elements 20000 --force -1:1:100000"},
    {"modes --elements 20 --count 2", "modes --elements 1000 --count 200"},
    {"decay --elements 10 --duration 0.5", "decay --elements 200 --duration 40000 --interval 40000",
     true},
    {"peaks --elements 10 --force -0.1:0.1:2", "peaks --force -0.1:0.1:100000", true},
    {"fit", "fit", true},
    {"stability --p -600:0:40 --d -20:0:40",
     "stability --yes --radius --p -1000:200:1000000 --d -40:20:1000"},
    {"boundary", ""},
    {"response --p -600:0:40 --d -20:0:40", "response --yes --p -1000:200:1000000 --d -40:20:1000"},
    {"design", "design --frequency 5:60:10000000"},
    {"margins", ""},
    {"modal-damping --no-control --set plant.model=string --set control.sampling_period=0.01", ""},
    {"sensitivity", ""},
    {"max-delay --frequency 5:6:2", "max-delay --frequency 5:60:10000000"},
    {"simulate --duration 1", "simulate --yes --duration 9e6"},
    {"spectrum --duration 2", "spectrum --duration 2000 --switching exact"},
    {"deviation --duration 1", "deviation --yes --duration 9e6"},
    {"coverage --durations 1,2 --cells 10", "coverage --durations 9e6"},
    {"verdict",
     "verdict --set excitation.frequency=9.99999 --max-period 100000000"
     " --set backlash.width=0.003"},
    {"orbit",
     "orbit --follow backlash.width=0:0.01 --set control.sampling_period=0.010003 --quiet"},
    {"basins --axis initial.z1=0:0.001:3 --axis initial.v2=0:0.1:3",
     "basins --axis initial.z1=0:0.001:3000 --axis initial.v2=0:0.1:3000 --max-period 1000"},
    {"diagram --axis backlash.width=0:0.001:3 --transient 1 --strobes 10",
     "diagram --axis backlash.width=0:0.003:100000"},
    {"section --duration 2 --from 1", "section --duration 9e6"},
    {"lyapunov --duration 1", "lyapunov --duration 9e6"},
    {"sweep --axis backlash.width=0:0.003:3 --duration 1",
     "sweep --axis backlash.width=0:0.003:3000 --axis initial.z1=0:0.001:3000"},
    {"absorption --frequency 5:20:4" + line_with_dashpot,
     "absorption --quiet --yes --frequency 3:150:100000000" + line_with_dashpot},
    {"aeolian --frequency 5:20:4" + line_with_dashpot,
     "aeolian --quiet --yes --frequency 3:150:10000000" + line_with_dashpot},
    {"fatigue" + line_with_dashpot, ""},
    {"place --quiet --for damping --frequency 5:10:3" + line_with_dashpot,
     "place --quiet --modes 1:1000" + line_with_dashpot, true},
    {"sag-tension --set conductor.name=Drake --set conductor.span=300 --set stringing.tension=28e3"
     " --set stringing.temperature=15",
     ""},
    {"answers", "answers --set excitation.frequency=10.0001"},
};

/// Those of them that this program was built with.
inline std::vector<JobToTry> tables_to_try() {
  std::vector<JobToTry> built;
  for (const JobToTry& job : jobs_with_table)
    if (job.is_built()) built.push_back(job);
  return built;
}

/// The jobs that print a text, and so have no --output.
inline const std::vector<std::string> jobs_with_text = {"completion bash", "bill-of-materials",
                                                        "manual"};

}  // namespace holdfast::tests
