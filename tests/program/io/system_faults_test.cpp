// What becomes of results where the process ends, or the system fails, between any two of its calls
// that change files. The calls are those of this program: they come here before they go to the
// system, in whichever library they are made.

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "case/case_file.hpp"
#include "output/grid/grid_output.hpp"
#include "output/metadata.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "program/child_process.hpp"
#include "program/store/small_store.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "text/checksum.hpp"

namespace {

/// Called before a call of the system, with its name; not 0: its error number.
int (*before_call)(const char* name) = nullptr;

int fault_of(const char* name) { return before_call == nullptr ? 0 : before_call(name); }

template <typename... Arguments>
long call_system(const char* name, long number, Arguments... arguments) {
  const int fault = fault_of(name);
  if (fault == 0) return syscall(number, arguments...);
  errno = fault;
  return -1;
}

}  // namespace

extern "C" {

int rename(const char* from, const char* to) noexcept {
  return static_cast<int>(call_system("rename", SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0U));
}

int unlink(const char* path) noexcept {
  return static_cast<int>(call_system("unlink", SYS_unlinkat, AT_FDCWD, path, 0));
}

int fsync(int descriptor) { return static_cast<int>(call_system("fsync", SYS_fsync, descriptor)); }

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  return call_system("pwrite", SYS_pwrite64, descriptor, bytes, size, offset);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  return pwrite64(descriptor, bytes, size, offset);
}

int ftruncate64(int descriptor, off64_t size) noexcept {
  return static_cast<int>(call_system("ftruncate", SYS_ftruncate, descriptor, size));
}

int ftruncate(int descriptor, off_t size) noexcept { return ftruncate64(descriptor, size); }

}  // extern "C"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::exit_code_of_child;
using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;
using tests::write_text;

int calls_left = 0;

bool is_last_call() { return calls_left-- == 0; }

JobContext context_for(const fs::path& output) {
  JobContext context;
  context.job = "sweep";
  context.case_data = load_case(std::nullopt, {});
  context.output = output;
  return context;
}

// ---- a table and its metadata -----------------------------------------------------------------

void write_table(const fs::path& file, double value) {
  Table table(context_for(file), {{"x", "m", ""}});
  table.row(value);
  table.commit();
}

/// Whether the metadata say of the table what it is.
bool describes(const fs::path& metadata, const fs::path& table) {
  const std::string text = read_text(table);
  const auto json = nlohmann::json::parse(read_text(metadata));
  const auto& known = json["notes"][0]["holdfast"]["table"];
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx",
                static_cast<unsigned long long>(checksum(text)));  // NOLINT
  return known.is_object() && known["bytes"] == text.size() && known["crc64_xz"] == digits;
}

bool stands_beside_another(const fs::path& table) {
  const fs::path metadata = metadata_path(table);
  return fs::exists(table) && fs::exists(metadata) && !describes(metadata, table);
}

TEST(Metadata, TellsWhichTableItDescribes) {
  const TemporaryFolder folder;
  write_table(folder / "x.csv", 0.25);
  EXPECT_TRUE(describes(folder / "x.csv-metadata.json", folder / "x.csv"));
  write_text(folder / "x.csv", "x\r\n0.26\r\n");
  EXPECT_FALSE(describes(folder / "x.csv-metadata.json", folder / "x.csv"));
}

/// Writes a table over another one in a child, to which something happens before its nth call that
/// changes a name.
int write_over(const fs::path& file, int nth, int (*happens)(const char*)) {
  write_table(file, 1.0);
  return exit_code_of_child([&] {
    install_signal_handlers();
    std::thread([] { std::this_thread::sleep_for(std::chrono::hours(1)); }).detach();
    calls_left = nth;
    before_call = happens;
    write_table(file, 2.0);
    return calls_left >= 0 ? 1 : 0;  // 1: there were no more calls
  });
}

int killed(const char*) {
  if (is_last_call()) raise(SIGKILL);
  return 0;
}

/// To the process, whose other thread gets what this one holds back, and time to do so.
int interrupted_twice(const char*) {
  if (!is_last_call()) return 0;
  for (int i = 0; i < 2; ++i) {
    kill(getpid(), SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return 0;
}

TEST(Table, ThatIsKilledNeverStandsBesideMetadataOfAnother) {
  const TemporaryFolder folder;
  for (int nth = 0;; ++nth) {
    const int code = write_over(folder / "x.csv", nth, killed);
    EXPECT_FALSE(stands_beside_another(folder / "x.csv")) << nth;
    EXPECT_TRUE(fs::exists(folder / "x.csv")) << nth;
    if (code == 1) break;
    EXPECT_EQ(code, -SIGKILL) << nth;
  }
}

TEST(Table, ThatIsInterruptedIsTheOldOneOrTheNewOneWithItsMetadata) {
  const TemporaryFolder folder;
  for (int nth = 0;; ++nth) {
    const int code = write_over(folder / "x.csv", nth, interrupted_twice);
    EXPECT_TRUE(fs::exists(folder / "x.csv") && fs::exists(folder / "x.csv-metadata.json")) << nth;
    EXPECT_FALSE(stands_beside_another(folder / "x.csv")) << nth;
    EXPECT_EQ(folder.files(), 2) << nth;
    if (code == 1) break;
  }
}

// ---- chunks -----------------------------------------------------------------------------------

std::vector<std::string> calls;

TEST(StoreFolder, FinishesAChunkOnTheDiskBeforeItHasItsName) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "small.zarr", small_store());
  calls.clear();
  before_call = [](const char* name) {
    calls.emplace_back(name);
    return 0;
  };
  store.put(0, values_of_small_store(0));
  before_call = [](const char* name) { return std::string(name) == "fsync" ? EIO : 0; };
  const std::string words =
      message_of<OutputError>([&] { store.put(1, values_of_small_store(1)); });
  before_call = nullptr;
  EXPECT_EQ(calls,
            (std::vector<std::string>{"fsync", "rename", "fsync", "rename", "fsync", "rename"}));
  EXPECT_NE(words.find("Input/output error"), std::string::npos) << words;
  EXPECT_TRUE(store.has(0));
  EXPECT_FALSE(store.has(1));
}

// ---- netCDF -----------------------------------------------------------------------------------

#ifdef HOLDFAST_HAS_NETCDF

bool is_write(const char* name) {
  return std::string(name) == "pwrite" || std::string(name) == "ftruncate";
}

int fails_once(const char* name) { return is_write(name) && is_last_call() ? EIO : 0; }

int fails_from_then_on(const char* name) { return is_write(name) && calls_left-- <= 0 ? EIO : 0; }

/// 0: written; 1: refused with the reason.
int write_grid(const fs::path& file) {
  const std::string words = message_of<OutputError>([&] {
    const GridLayout layout = {
        {{{"a", "", ""}, Axis{0.0, 1.0, 300}}, {{"b", "", ""}, Axis{0.0, 1.0, 500}}},
        {{{"x", "m", ""}, {}}}};
    std::vector<double> values(150000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
    GridOutput output(context_for(file), layout);
    output.append(150000, {values.data()});
    output.commit();
  });
  if (words == "(nothing was thrown)") return 0;
  return words == "cannot write " + file.string() + ": Input/output error" ? 1 : 2;
}

TEST(Netcdf, AFaultInAnyOfItsWritesIsToldAndLeavesNothing) {
  for (int (*fails)(const char*) : {fails_once, fails_from_then_on}) {
    const TemporaryFolder folder;
    int code = 1, nth = 0;
    for (; code == 1; ++nth) {
      code = exit_code_of_child([&] {
        calls_left = nth;
        before_call = fails;
        return write_grid(folder / "x.nc");
      });
      EXPECT_EQ(folder.files(), code == 0 ? 1 : 0) << nth;
    }
    EXPECT_EQ(code, 0) << nth;
    EXPECT_GE(nth, 5);
  }
}

#endif

}  // namespace
}  // namespace holdfast::program
