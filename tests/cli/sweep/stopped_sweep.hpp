#pragma once

#include <sys/stat.h>

#include "cli/running_program.hpp"

namespace holdfast::tests {

/// Eighty chunks, each of many times the work that it takes to look whether it is there.
inline const std::string chunked_sweep =
    "sweep --axis initial.z1=0:0.001:40 --axis backlash.width=0.0005:0.002:12 --duration 100"
    " --chunk 8 --metric steady_peak --metric reversals_per_s --metric engaged_fraction";

/// Cells with and without backlash, of unequal numbers of samples, one that diverges and some that
/// are not admissible.
inline const std::string mixed_sweep =
    "sweep --axis control.sampling_period=0.001,0.004 --axis control.differential_gain=-13,900"
    " --axis control.processing_delay=0:0.0015:3 --axis backlash.width=0:0.002:5 --duration 1.5";

/// Tells a file from another one of the same name that was written later.
struct FileStamp {
  std::uint64_t inode;
  std::int64_t seconds, nanoseconds;  // of its last change

  friend bool operator==(const FileStamp& one, const FileStamp& other) {
    return one.inode == other.inode && one.seconds == other.seconds &&
           one.nanoseconds == other.nanoseconds;
  }
};

using ChunkStamps = std::map<std::string, FileStamp>;

/// The store beside the output, or the output itself.
inline std::filesystem::path store_of(const std::filesystem::path& output) {
  return output.extension() == ".zarr" ? output : std::filesystem::path(output.string() + ".zarr");
}

/// The chunks that are done, by their files in the store; files may come and go meanwhile.
inline ChunkStamps chunks_kept_for(const std::filesystem::path& output) {
  namespace fs = std::filesystem;
  ChunkStamps chunks;
  std::error_code gone;
  const fs::path values = store_of(output) / "steady_peak";
  for (fs::directory_iterator entry(values, gone), end; !gone && entry != end;
       entry.increment(gone)) {
    struct stat found = {};
    const std::string name = entry->path().filename().string();
    if (name.rfind("c.", 0) != 0 || stat(entry->path().c_str(), &found) != 0) continue;
    chunks[name] = {found.st_ino, found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
  }
  return chunks;
}

inline std::vector<std::string> sweep_words(const std::filesystem::path& output,
                                            const std::string& more) {
  std::vector<std::string> words = words_of(chunked_sweep + " " + more);
  words.insert(words.end(), {"--output", output.string()});
  return words;
}

inline Ending swept(const std::filesystem::path& output, const std::string& more = "") {
  return RunningProgram(sweep_words(output, more)).wait();
}

/// The table of the sweep, when nothing disturbs it, and what is written beside it.
struct SweepResult {
  std::string table;
  std::string metadata;

  friend bool operator==(const SweepResult& one, const SweepResult& other) {
    return one.table == other.table && one.metadata == other.metadata;
  }
};

inline SweepResult result_at(const std::filesystem::path& output) {
  return {read_text(output), read_text(output.string() + "-metadata.json")};
}

inline SweepResult undisturbed_result(const std::string& name) {
  const TemporaryFolder folder;
  const Ending ending = swept(folder / name);
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  EXPECT_EQ(ending.errors, "");
  EXPECT_FALSE(std::filesystem::exists(store_of(folder / name)));
  return result_at(folder / name);
}

/// Until so many chunks are there, or the program has ended.
inline void wait_for_chunks(const RunningProgram& program, const std::filesystem::path& output,
                            std::size_t chunks) {
  while (program.runs() && chunks_kept_for(output).size() < chunks)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// A sweep that a signal ended after some of its chunks.
class StoppedSweep {
 public:
  explicit StoppedSweep(int signal_number, const std::string& name = "sweep.csv",
                        const std::string& more = "")
      : output_(folder_ / name) {
    RunningProgram program(sweep_words(output_, more));
    wait_for_chunks(program, output_, 8);
    program.send(signal_number);
    ending_ = program.wait();
    chunks_ = chunks_kept_for(output_);
    EXPECT_GE(chunks_.size(), 8U) << ending_.errors;
    EXPECT_FALSE(std::filesystem::exists(output_));
  }

  const TemporaryFolder& folder() const { return folder_; }
  const std::filesystem::path& output() const { return output_; }
  const Ending& ending() const { return ending_; }
  const ChunkStamps& chunks() const { return chunks_; }

  /// The file of a chunk, counted among those that are there.
  std::filesystem::path chunk(std::size_t number) const {
    return store_of(output_) / "steady_peak" /
           std::next(chunks_.begin(), static_cast<int>(number))->first;
  }

  /// Goes on with it, and expects the result of one that nothing disturbed.
  void expect_resumes() const {
    const Ending resumed = swept(output_, "--resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_TRUE(result_at(output_) == undisturbed_result(output_.filename().string()));
    EXPECT_FALSE(std::filesystem::exists(store_of(output_)));
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path output_;
  Ending ending_{};
  ChunkStamps chunks_;
};

}  // namespace holdfast::tests
