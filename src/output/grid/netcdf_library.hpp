#pragma once

namespace holdfast::program {

/// Throws NoAnswer, which names the package, unless the netCDF C library can be used.
void require_netcdf();

/// The address of a function of the netCDF C library. The library is loaded at the first call:
/// with what it depends on that takes longer than many a job, and few jobs need it.
/// Throws what require_netcdf() throws.
void* netcdf_symbol(const char* name);

/// A function by its type: `netcdf_function<decltype(nc_close)>("nc_close")(id)`.
template <class Function>
Function* netcdf_function(const char* name) {
  return reinterpret_cast<Function*>(netcdf_symbol(name));
}

}  // namespace holdfast::program
