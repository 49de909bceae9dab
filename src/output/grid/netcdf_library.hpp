#pragma once

namespace holdfast::program {

/// Throws NoAnswer, which names the package to install, unless the netCDF C library can be used.
void require_netcdf();

/// Address of a function of the netCDF C library. The library is loaded at the first call: loading
/// takes longer than many jobs, and few jobs need it.
/// Throws the exceptions of require_netcdf().
void* netcdf_symbol(const char* name);

/// A function of the library, by its type: `netcdf_function<decltype(nc_close)>("nc_close")(id)`.
template <class Function>
Function* netcdf_function(const char* name) {
  return reinterpret_cast<Function*>(netcdf_symbol(name));
}

}  // namespace holdfast::program
