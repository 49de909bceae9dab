#include "cli/program.hpp"
#include "cli/sweep/stopped_sweep.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
  return files;
}

void expect_done(const Ending& ending) { EXPECT_EQ(ending.exit_code, 0) << ending.errors; }

Files undisturbed_store() {
  const TemporaryFolder folder;
  expect_done(swept(folder / "map.zarr", "--threads 1"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map.zarr"});
  return files_in(folder / "map.zarr");
}

TEST(SweepStore, IsTheSameForAnyThreadsAndForTwoProcessesThatShareIt) {
  const Files expected = undisturbed_store();
  const TemporaryFolder folder;
  expect_done(swept(folder / "three.zarr", "--threads 3"));
  EXPECT_TRUE(files_in(folder / "three.zarr") == expected);
  RunningProgram other(sweep_words(folder / "two.zarr", "--threads 1"));
  expect_done(swept(folder / "two.zarr", "--threads 1"));
  expect_done(other.wait());
  EXPECT_TRUE(files_in(folder / "two.zarr") == expected);
}

TEST(SweepStore, KilledTwentyTimesAndDamagedItBecomesTheSame) {
  const Files expected = undisturbed_store();
  std::mt19937 random(3);
  const TemporaryFolder folder;
  const fs::path store = folder / "map.zarr";
  for (int kill = 0; kill < 20; ++kill) {
    RunningProgram program(sweep_words(store, "--threads 2"));
    wait_for_chunks(program, store, chunks_kept_for(store).size() + 1 + random() % 3);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 2000));
    program.send(SIGKILL);
    program.wait();
  }
  ASSERT_GE(chunks_kept_for(store).size(), 2U);
  write_text(store / "steady_peak" / chunks_kept_for(store).begin()->first, "damaged");
  const Ending ending = swept(store, "--resume");
  expect_done(ending);
  expect_holds(ending.errors, {"is damaged; this chunk is computed anew"});
  EXPECT_TRUE(files_in(store) == expected);
}

TEST(SweepStore, ItsPartsMakeTheWhole) {
  const TemporaryFolder folder;
  for (const char* part : {"3/3", "1/3", "2/3"})
    expect_done(swept(folder / "map.zarr", std::string("--part ") + part));
  EXPECT_TRUE(files_in(folder / "map.zarr") == undisturbed_store());
  for (const char* part : {"0/3", "4/3", "1", "1/0", "x/2", "1.5/2", "1/1000000"})
    EXPECT_EQ(swept(folder / "map.zarr", std::string("--part ") + part).exit_code, 2) << part;
  EXPECT_EQ(swept(folder / "map.csv", "--part 1/2").exit_code, 2);
}

TEST(SweepStore, DamageThatNobodyLooksForIsToldInTheEnd) {
  const TemporaryFolder folder;
  const fs::path store = folder / "map.zarr";
  expect_done(swept(store));
  write_text(store / "outcome/c.3.0", "damaged");
  const Ending ending = swept(store);
  EXPECT_EQ(ending.exit_code, 1);
  expect_holds(ending.errors, {"damaged"});
  expect_done(swept(store, "--resume"));
  expect_done(swept(store));
}

TEST(SweepStore, AnotherSweepIsRefusedWithWhatDiffers) {
  const TemporaryFolder folder;
  expect_done(swept(folder / "map.zarr"));
  const Files before = files_in(folder / "map.zarr");
  const Ending ending = swept(folder / "map.zarr", "--max-period 50");
  EXPECT_EQ(ending.exit_code, 2);
  expect_holds(ending.errors, {"--max-period was 1000000, is 50"});
  EXPECT_TRUE(files_in(folder / "map.zarr") == before);
}

std::string without_name(std::string metadata, const std::string& name) {
  const std::size_t at = metadata.find(name);
  return at == std::string::npos ? metadata : metadata.erase(at, name.size());
}

void expect_converts(const std::string& job, const std::string& ending) {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& name) { return (folder / name).string(); };
  EXPECT_EQ(printed_by(job + " --output '" + at("a.zarr") + "'"), "");
  EXPECT_EQ(printed_by(job + " --output '" + at("direct" + ending) + "'"), "");
  EXPECT_EQ(printed_by("convert '" + at("a.zarr") + "' '" + at("converted" + ending) + "'"), "");
  EXPECT_TRUE(read_text(at("converted" + ending)) == read_text(at("direct" + ending))) << job;
  if (ending != ".csv") return;
  EXPECT_EQ(without_name(read_text(at("converted.csv-metadata.json")), "converted.csv"),
            without_name(read_text(at("direct.csv-metadata.json")), "direct.csv"));
}

const std::vector<std::string> jobs_with_cells = {
    chunked_sweep + " --set control.sampling_period=0.002",
    "stability --radius --p -600:0:70 --d -20:0:31",
    "stability --continuous --p -600:0:7 --d -20:0:3",
    "stability --set plant.model=string --set plant.modes=6 --radius --p -600:0:9 --d -20:0:5",
    "response --p -600:0:40 --d -20:0:31"};

TEST(SweepStore, BecomesTheTableThatTheJobWrites) {
  for (const std::string& job : jobs_with_cells) expect_converts(job, ".csv");
  expect_converts("basins --axis initial.z1=0:0.001:9 --axis initial.v2=0:0.1:7", ".csv");
}

#ifdef HOLDFAST_HAS_NETCDF

TEST(SweepStore, BecomesTheNetcdfFileThatTheJobWrites) {
  for (const std::string& job : jobs_with_cells) expect_converts(job, ".nc");
}

#endif

TEST(SweepStore, ConversionRefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& name) { return (folder / name).string(); };
  expect_refused("convert " + at("absent.zarr") + " " + at("x.csv"), {"absent.zarr"});
  expect_refused("convert " + at("absent.zarr"), {"OUT"});
  expect_done(swept(at("a.zarr")));
  expect_refused("convert " + at("a.zarr") + " " + at("x.txt"), {".txt"});
  expect_refused("convert " + at("a.zarr") + " " + at("a.zarr"), {".csv or .nc"});
  fs::remove(fs::path(at("a.zarr")) / "steady_peak/c.4.0");
  expect_refused("convert " + at("a.zarr") + " " + at("x.csv"), {"steady_peak/c.4.0"}, 1);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.zarr"});
}

TEST(SweepStore, OtherJobsRefuseToWriteOne) {
  expect_refused("simulate --duration 1 --output x.zarr", {"x.zarr", "Zarr"});
}

}  // namespace
}  // namespace holdfast::tests
