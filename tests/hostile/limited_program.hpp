#pragma once

#include "cli/running_program.hpp"

namespace holdfast::tests {

/// What a program that runs alone and for seconds may take. Where others have the processors, its
/// time is that which it computes, up to five times as much by the clock.
struct Limits {
  std::chrono::milliseconds patience{2000};    ///< until it is asked to stop
  std::chrono::milliseconds last_words{1000};  ///< from then until it is killed
  int processor_seconds = 5;
};

/// How a limited program ended.
struct LimitedEnding : Ending {
  bool asked_to_stop = false;  ///< it was not done within the patience
  bool killed = false;         ///< nor did it stop when it was asked
  double seconds = 0.0;
};

/// `holdfast WORDS` in the folder `place/work`, with `place/tmp` for temporary files, 4 GiB of
/// addresses and files of 64 MiB; one that grows larger is an error of write(), as on a full disk,
/// rather than a signal.
inline LimitedEnding limited_run(const std::vector<std::string>& words,
                                 const std::filesystem::path& place, const Limits& limits) {
  const auto start = std::chrono::steady_clock::now();
  RunningProgram program(words, "ulimit -t " + std::to_string(limits.processor_seconds) +
                                    "; ulimit -f 131072; ulimit -c 0; trap '' XFSZ\n" +
                                    (is_sanitized ? "" : "ulimit -v 4194304\n") +
                                    "export TMPDIR='" + (place / "tmp").string() + "'; cd '" +
                                    (place / "work").string() + "' || exit 127");
  LimitedEnding ending{};
  ending.asked_to_stop = !program.ends_within(limits.patience);
  if (ending.asked_to_stop) {
    program.send(SIGINT);
    ending.killed = !program.ends_within(limits.last_words);
    if (ending.killed) program.send(SIGKILL);
  }
  static_cast<Ending&>(ending) = program.wait();
  ending.output.resize(std::min<std::size_t>(ending.output.size(), 1000));
  ending.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return ending;
}

}  // namespace holdfast::tests
