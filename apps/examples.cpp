#include "texts.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace holdfast::program {
namespace {

struct Example {
  std::string_view job;
  std::string_view arguments;
  std::string_view tells;
};

/// Those of the whole program bear its name.
constexpr Example known_examples[] = {
    {"holdfast", "report --output report", "everything about the built-in case on one page"},
    {"holdfast", "answers", "in words: does control help, which D, how slow, how much play?"},
    {"holdfast", "case --init my-cable.toml", "a commented case to start from"},
    {"holdfast", "stability --set control.sampling_period=0.01", "stable gains, 10 ms computer"},
    {"holdfast", "max-delay --frequency 5:50:10", "how slow may the computer be?"},
    {"holdfast", "sweep --axis backlash.width=0:0.003:31", "how much play may the belt have?"},
    {"holdfast", "simulate --duration 1 --output motion.csv", "the motion from rest"},
    {"holdfast", "verdict --set backlash.width=0.002", "is it periodic, and how sure is that?"},
    {"holdfast", "JOB --help", "examples and options of a job"},
    {"case", "--init my-cable.toml", "a commented case to start from"},
    {"case", "--check my-cable.toml", "what each value means and what follows"},
    {"case", "--set control.sampling_period=0.01", "the built-in case with another computer"},
    {"reduce", "--case my-cable.toml", "the plant of a conductor with its absorber"},
    {"statics", "--force -1:1:41", "41 forces from -1 N to 1 N"},
    {"modes", "--count 6", "the six lowest frequencies"},
    {"decay", "--force 0.2 --equal-displacement", "after 0.2 N is let go"},
    {"peaks", "--force 0.1:0.4:4", "for four forces"},
    {"fit", "--data decay.csv", "c2 from a record of time_s,displacement_m"},
    {"stability", "--set control.sampling_period=0.01", "with a 10 ms computer"},
    {"stability", "--radius --output chart.nc", "the spectral radius, as netCDF-4"},
    {"stability",
     "--axis control.sampling_period=0.001:0.02:40 --axis control.differential_gain=-60:20:81",
     "over other keys"},
    {"boundary", "--p -1000:200", "the curves of all P between these"},
    {"boundary", "--stable-interval", "which D at the case's P, which P at its D"},
    {"boundary", "--regions", "the regions that it bounds"},
    {"response", "--p -557:-557:1 --d -15:0:31", "over D at one P"},
    {"design", "--frequency 5:50:10", "the best D at each of ten frequencies"},
    {"design", "--band 9:11 --largest-radius 0.9995", "one D for a band of frequencies"},
    {"design", "--both-gains", "P and D that forget a disturbance fastest"},
    {"margins", "", "of the case"},
    {"margins", "--set control.differential_gain=-10", "with another D"},
    {"sensitivity", "", "of the case"},
    {"max-delay", "--frequency 5:50:10", "for ten frequencies"},
    {"max-delay", "--frequency 10:10:1 --criterion stable", "stability alone"},
    {"simulate", "--duration 10 --output motion.csv", "ten seconds from rest"},
    {"simulate", "--kick 9:0.001 --from 8.9", "the conductor displaced by 1 mm at 9 s"},
    {"simulate", "--switching exact", "the drive switches when it happens"},
    {"spectrum", "--set backlash.width=0.002", "with 2 mm of play"},
    {"deviation", "--offset 1e-9", "from 1 nm apart"},
    {"coverage", "--durations 10,100,1000", "after 10 s, 100 s and 1000 s"},
    {"verdict", "--set control.sampling_period=0.011 --set backlash.width=0.002",
     "what looks irregular in the paper"},
    {"verdict", "--switching exact", "with a drive that does not wait for the clock"},
    {"orbit", "--certificate", "how far it is from breaking"},
    {"orbit", "--follow backlash.width=0:0.003", "where it ends, and why"},
    {"basins", "--axis initial.z1=-0.005:0.005:101 --axis initial.z2=-0.005:0.005:101",
     "101 x 101 states"},
    {"diagram", "--axis backlash.width=0:0.003:61", "over the play, up and back"},
    {"section", "--from 50", "once it is steady"},
    {"lyapunov", "--duration 100", "with standard errors"},
    {"sweep",
     "--axis control.sampling_period=0.001:0.03:30 --axis backlash.width=0:0.003:31 --output "
     "map.csv",
     "delay against play"},
    {"sweep", "--axis backlash.width=0:0.003:31 --metric verdict", "one metric"},
    {"answers", "", "of the built-in case"},
    {"answers", "--case my-cable.toml --details", "with what they rest on"},
    {"report", "--output report", "the built-in case"},
    {"report", "--case my-cable.toml --output my-report", "a case of yours"},
    {"completion", "bash > holdfast.bash", "to be sourced by bash"},
    {"manual", "> holdfast.1", "then: man ./holdfast.1"},
    {"bill-of-materials", "> holdfast.cdx.json", "beside the package"},
};

std::string command_of(const Example& example) {
  std::string command = "holdfast";
  for (const std::string_view part :
       {example.job == "holdfast" ? std::string_view() : example.job, example.arguments})
    if (!part.empty()) command.append(" ").append(part);
  return command;
}

}  // namespace

std::string examples_of(const std::string& name) {
  constexpr std::size_t longest_with_remark = 56;
  std::vector<const Example*> chosen;
  std::size_t width = 0;
  for (const Example& example : known_examples) {
    if (example.job != name) continue;
    chosen.push_back(&example);
    const std::size_t length = command_of(example).size();
    if (length <= longest_with_remark) width = std::max(width, length);
  }
  std::string text;
  for (const Example* example : chosen) {
    std::string line = "  " + command_of(*example);
    line.resize(std::max(line.size(), width + 2), ' ');
    text += line.append("  # ").append(example->tells).append("\n");
  }
  return text;
}

std::string ExamplesFirst::make_description(const CLI::App* app) const {
  std::string text = CLI::Formatter::make_description(app);
  const std::string lines = examples_of(app->get_name());
  return lines.empty() ? text : text + "\nExamples:\n" + lines + "\n";
}

}  // namespace holdfast::program
