#include "output/grid/netcdf_library.hpp"

#include <string>

#include "process/errors.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <dlfcn.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

[[noreturn]] void refuse_to_load() {
  const char* reason = dlerror();
  throw NoAnswer("the netCDF C library cannot be loaded (" +
                 std::string(reason != nullptr ? reason : "no reason given") +
                 "): install the package libnetcdf-dev");
}

/// Loads the library with which the program was built, or another of its name on this machine.
void* load() {
  // HDF5 locks the files that it opens, and this program locks unfinished files: each would block
  // the other. Some file systems have no locks at all.
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  const std::string path = HOLDFAST_NETCDF_LIBRARY;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    library = dlopen(path.substr(path.rfind('/') + 1).c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  if (library == nullptr) refuse_to_load();
  // HDF5, used by netCDF, cleans up when the process ends, and crashes on a file that it could not
  // finish for lack of space. Files to be finished are closed before.
  const auto forgo = reinterpret_cast<int (*)()>(dlsym(library, "H5dont_atexit"));
  if (forgo != nullptr) forgo();
  return library;
}

/// Throws std::bad_alloc if less memory is left than any call of HDF5 takes: without memory HDF5
/// crashes.
void require_room() {
  constexpr std::size_t room = std::size_t{16} << 20U;
  void* const found = mmap(nullptr, room, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) throw std::bad_alloc();
  munmap(found, room);
}

void* netcdf_library() {
  static void* const library = load();
  return library;
}

}  // namespace

void require_netcdf() { netcdf_library(); }

void* netcdf_symbol(const char* name) {
  void* symbol = dlsym(netcdf_library(), name);
  require_room();
  if (symbol == nullptr) refuse_to_load();
  return symbol;
}

#else

void require_netcdf() {
  throw NoAnswer(
      "netCDF needs the netCDF C library, which this program was built without: install the "
      "package libnetcdf-dev and build again, or give a name that ends in .csv");
}

void* netcdf_symbol(const char*) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
