#include <holdfast/holdfast.hpp>

#ifdef WITH_simd
#include <holdfast/simd/pack.hpp>
#include <holdfast/simd/parallel_rows.hpp>
#endif
#ifdef WITH_sundials
#include <holdfast/sundials/load_removal.hpp>
#endif
#ifdef WITH_ceres
#include <holdfast/ceres/decay_fit.hpp>
#endif

#include <iostream>

/// Calls what each adapter links: a missing library shows at once.
bool adapters_work() {
  bool fine = true;
#ifdef WITH_simd
  int rows = 0;
  holdfast::simd::parallel_rows(
      2, 1, 1, rows, [&rows](int&, std::int64_t, std::int64_t count) { rows += int(count); });
  fine = fine && rows == 2 && holdfast::Lanes<holdfast::simd::Pack<double>>::count >= 2;
#endif
#ifdef WITH_sundials
  fine = fine && holdfast::cvode::name_of_flag(0) == "CV_SUCCESS";
#endif
#ifdef WITH_ceres
  using namespace holdfast;
  DecayRecord record;
  for (int k = 0; k < 50; ++k) record.times.push_back(0.02 * k);
  record.displacements = free_decay(kollar2022_plant(), 1e-3, record.times);
  fine = fine && fit::fit_decay(record, kollar2022_plant()).outcome == fit::FitOutcome::converged;
#endif
  return fine;
}

int main() {
  if (!adapters_work()) return 1;
  std::cout << holdfast::version_string << '\n';
}
