// Lyapunov exponents of the sampled loop with backlash, by blocks of contacts.
// Peer: Eigen's 5 × 5 product and Gram–Schmidt at every sample on a motion stepped
// beside it. All sides alternate in one run; the medians and their ratios are printed.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "medians.hpp"
#include "processor.hpp"

namespace {

using namespace holdfast;

constexpr std::int64_t samples = 200000;

volatile double sink = 0.0;

IdealLoop<double> loop_of(double period, double delay_fraction) {
  return {
      kollar2022_plant(), {period, delay_fraction * period}, {-557.0, -13.0}, {0.5, 10.0}, 0.002};
}

/// What a user would write.
class EveryStep {
 public:
  EveryStep(const SampledLoop<double>& loop, const PdGains<double>& gains)
      : engaged_(loop.engaged_map(gains)), backlash_(loop.backlash_map()) {}

  void push(bool engaged) {
    Matrix<double, 5> next = (engaged ? engaged_ : backlash_) * basis_;
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j < i; ++j) next.col(i) -= next.col(j).dot(next.col(i)) * next.col(j);
      const double length = next.col(i).norm();
      sums_[i] += std::log(length);
      next.col(i) /= length;
    }
    basis_ = next;
    ++steps_;
  }
  Vector<double, 5> exponents() const { return sums_ / steps_; }

 private:
  Matrix<double, 5> engaged_, backlash_;
  Matrix<double, 5> basis_ = Matrix<double, 5>::Identity();
  Vector<double, 5> sums_ = Vector<double, 5>::Zero();
  double steps_ = 0;
};

struct Sides {
  explicit Sides(const IdealLoop<double>& of)
      : loop(of),
        sampled(sampled_loop(of.plant, of.sampling)),
        blocks(std::make_shared<const ItineraryBlocks>(sampled, of.gains)),
        ratio(*forcing_ratio(of)) {
    auto motion = start();
    for (std::int64_t taken = 0; taken < samples; ++taken) {
      itinerary.push_back(motion.sense().engaged ? 1 : 0);
      motion.advance();
    }
  }

  PeriodicallyForcedMotion<double> start() const {
    return periodically_forced_motion(loop, ratio, Vector<double, 4>(Vector<double, 4>::Zero()));
  }

  Vector<double, 5> every_step() const {
    SampledMotion<double> motion(sampled, loop.gains, held_harmonic(sampled), loop.excitation,
                                 Backlash<double>(loop.backlash_width), Vector<double, 4>::Zero());
    EveryStep peer(sampled, loop.gains);
    for (std::int64_t taken = 0; taken < samples; ++taken) {
      peer.push(motion.sense().engaged);
      motion.advance();
    }
    return peer.exponents();
  }

  Vector<double, 5> every_step_on_contacts() const {
    EveryStep peer(sampled, loop.gains);
    for (const std::uint8_t contact : itinerary) peer.push(contact != 0);
    return peer.exponents();
  }

  Vector<double, 5> by_blocks(LyapunovScope scope) const {
    auto motion = start();
    LyapunovRun run{samples};
    run.scope = scope;
    return run_lyapunov(motion, blocks, run).exponents;
  }

  Vector<double, 5> by_blocks_on_contacts() const {
    BlockSpectrum<double> spectrum(blocks);
    ItineraryBlock block = empty_block;
    for (const std::uint8_t contact : itinerary) {
      block = followed_by(block, contact != 0);
      if (!is_whole(block)) continue;
      spectrum.push(block);
      block = empty_block;
    }
    return spectrum.spectrum(block).exponents();
  }

  double motion_alone() const {
    auto motion = start();
    double sum = 0;
    for (std::int64_t taken = 0; taken < samples; ++taken) {
      sum += motion.sense().control_force;
      motion.advance();
    }
    return sum;
  }

  IdealLoop<double> loop;
  SampledLoop<double> sampled;
  std::shared_ptr<const ItineraryBlocks> blocks;
  Rational ratio;
  std::vector<std::uint8_t> itinerary;
};

void measure(double period, double delay_fraction) {
  const Sides sides(loop_of(period, delay_fraction));
  const auto time = bench::medians(
      {[&] { sink = sides.every_step()[0]; }, [&] { sink = sides.every_step_on_contacts()[0]; },
       [&] { sink = sides.motion_alone(); }, [&] { sink = sides.by_blocks(LyapunovScope::all)[0]; },
       [&] { sink = sides.by_blocks_on_contacts()[0]; },
       [&] { sink = sides.by_blocks(LyapunovScope::largest)[0]; }});
  const auto per_sample = [](double seconds) { return seconds / samples * 1e9; };
  const double error = (sides.every_step_on_contacts() - sides.by_blocks_on_contacts())
                           .head<4>()
                           .cwiseAbs()
                           .maxCoeff();
  std::printf("\ntau %g ms, delay %g tau (ns per trajectory and sample, one core)\n", period * 1e3,
              delay_fraction);
  std::printf("  motion alone                     %8.1f\n", per_sample(time[2]));
  std::printf("  QR at every sample               %8.1f, tangents alone %8.1f\n",
              per_sample(time[0]), per_sample(time[1]));
  std::printf("  words                            %8.1f, tangents alone %8.1f\n",
              per_sample(time[3]), per_sample(time[4]));
  std::printf("    ratio                          %8.1f, tangents alone %8.1f\n", time[0] / time[3],
              time[1] / time[4]);
  std::printf("  words, largest exponent alone    %8.1f, ratio %8.1f\n", per_sample(time[5]),
              time[0] / time[5]);
  std::printf("  largest difference of the finite exponents %.1e\n", error);
}

}  // namespace

int main() {
  if (!holdfast::bench::processor_suffices()) return 0;
  std::printf("medians of %d alternating repetitions\n", bench::usual_repetitions);
  for (const double period : {0.001, 0.011}) {
    for (const double delay_fraction : {0.0, 0.5}) measure(period, delay_fraction);
  }
}
