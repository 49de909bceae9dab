#pragma once

#include <sys/stat.h>

#include "cli/running_program.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {

/// Sixty tiles, each of many times the work that it takes to look whether it is there.
inline const std::string tiled_sweep =
    "sweep --axis initial.z1=0:0.001:40 --axis backlash.width=0.0005:0.002:12 --duration 100"
    " --tile 8 --metric steady_peak --metric reversals_per_s --metric engaged_fraction";

/// Tells a file from another one of the same name that was written later.
struct FileStamp {
  std::uint64_t inode;
  std::int64_t seconds, nanoseconds;  // of its last change

  friend bool operator==(const FileStamp& one, const FileStamp& other) {
    return one.inode == other.inode && one.seconds == other.seconds &&
           one.nanoseconds == other.nanoseconds;
  }
};

using TileStamps = std::map<std::string, FileStamp>;

inline std::filesystem::path tile_folder_of(const std::filesystem::path& output) {
  return output.string() + ".tiles";
}

/// The tiles that are kept for an output; files may come and go meanwhile.
inline TileStamps tiles_kept_for(const std::filesystem::path& output) {
  TileStamps tiles;
  std::error_code gone;
  for (std::filesystem::directory_iterator entry(tile_folder_of(output), gone), end;
       !gone && entry != end; entry.increment(gone)) {
    const std::string name = entry->path().filename().string();
    struct stat found = {};
    if (name.rfind("tile-", 0) != 0 || stat(entry->path().c_str(), &found) != 0) continue;
    tiles[name] = {found.st_ino, found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
  }
  return tiles;
}

inline std::vector<std::string> sweep_words(const std::filesystem::path& output,
                                            const std::string& more) {
  std::vector<std::string> words = words_of(tiled_sweep + " " + more);
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
  EXPECT_FALSE(std::filesystem::exists(tile_folder_of(folder / name)));
  return result_at(folder / name);
}

/// Until so many tiles are there, or the program has ended.
inline void wait_for_tiles(const RunningProgram& program, const std::filesystem::path& output,
                           std::size_t tiles) {
  while (program.runs() && tiles_kept_for(output).size() < tiles)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// A sweep that a signal ended after some of its tiles.
class StoppedSweep {
 public:
  explicit StoppedSweep(int signal_number, const std::string& name = "sweep.csv")
      : output_(folder_ / name) {
    RunningProgram program(sweep_words(output_, ""));
    wait_for_tiles(program, output_, 8);
    program.send(signal_number);
    ending_ = program.wait();
    tiles_ = tiles_kept_for(output_);
    EXPECT_GE(tiles_.size(), 8U) << ending_.errors;
    EXPECT_FALSE(std::filesystem::exists(output_));
  }

  const TemporaryFolder& folder() const { return folder_; }
  const std::filesystem::path& output() const { return output_; }
  const Ending& ending() const { return ending_; }
  const TileStamps& tiles() const { return tiles_; }

  /// The file of a tile, counted among those that are there.
  std::filesystem::path tile(std::size_t number) const {
    return tile_folder_of(output_) / std::next(tiles_.begin(), static_cast<int>(number))->first;
  }

  /// Goes on with it, and expects the result of one that nothing disturbed.
  void expect_resumes() const {
    const Ending resumed = swept(output_, "--resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_TRUE(result_at(output_) == undisturbed_result(output_.filename().string()));
    EXPECT_FALSE(std::filesystem::exists(tile_folder_of(output_)));
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path output_;
  Ending ending_{};
  TileStamps tiles_;
};

}  // namespace holdfast::tests
