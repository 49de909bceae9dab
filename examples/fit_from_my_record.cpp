// How much does my absorber damp? A record of its decay tells.
//     example_fit_from_my_record [RECORD.csv]     with columns time (s) and displacement (m)
#include <cstdio>
#include <fstream>
#include <string>

#include "holdfast/ceres/decay_fit.hpp"
#include "holdfast/plant/two_mass.hpp"

using namespace holdfast;

DecayRecord read_record(const char* path) {
  DecayRecord record;
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  double time, displacement;
  char comma;
  while (file >> time >> comma >> displacement) {
    record.times.push_back(time);
    record.displacements.push_back(displacement);
  }
  return record;
}

int main(int argc, char** argv) {
  const DecayRecord record = read_record(argc > 1 ? argv[1] : "data/kollar2022-decay.csv");
  const DecayMeasures measures = decay_measures(record);
  std::printf("first peak %.2f mm after %.3f s, period %.3f s\n", 1e3 * measures.first_peak,
              measures.first_peak_time, measures.period);

  // As it stands the question is for the absorber's damping, by the whole time history.
  fit::DecayFitOptions options;
  for (const bool whole : {true, false}) {
    if (!whole) options.target = fit::DecayTarget::first_peak_and_period;
    std::printf("by the %s:\n", whole ? "time history" : "first peak and period");
    const fit::DecayFit fit = fit::fit_decay(record, kollar2022_plant(), options);
    for (const fit::DecayMinimum& minimum : fit.minima)
      std::printf("  c2 = %.1f +- %.1f N s/m, found from %d of %d starts\n",
                  minimum.plant.absorber_damping, minimum.standard_errors.front(),
                  minimum.found_from, fit.starts);
  }
}
