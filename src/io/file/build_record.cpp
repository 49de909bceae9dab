#include "io/file/build_record.hpp"

#include <toml++/toml.h>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "kernels/instruction_set.hpp"

#ifdef HOLDFAST_HAS_SIMD
#ifndef __EMSCRIPTEN__
#include <oneapi/tbb/version.h>
#endif
#include <xsimd/config/xsimd_config.hpp>
#endif
#ifdef HOLDFAST_HAS_SUNDIALS
#include <sundials/sundials_config.h>
#endif
#ifdef HOLDFAST_HAS_CERES
#include <ceres/version.h>
#endif
#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf_meta.h>
#endif
#ifdef HOLDFAST_HAS_ZSTD
#include <zstd.h>
#endif

#ifndef HOLDFAST_VERSION
#error "the build defines HOLDFAST_VERSION"
#endif

namespace holdfast::program {
namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

nlohmann::ordered_json component(const Dependency& dependency) {
  return {{"type", "library"},
          {"name", dependency.name},
          {"version", dependency.version},
          {"licenses", {{{"expression", dependency.licence}}}}};
}

}  // namespace

std::vector<Dependency> dependencies() {
  std::vector<Dependency> all;
#ifdef HOLDFAST_HAS_CERES
  all.push_back({"Ceres Solver", CERES_VERSION_STRING, "BSD-3-Clause"});
#endif
  all.push_back({"CLI11", dotted(CLI11_VERSION_MAJOR, CLI11_VERSION_MINOR, CLI11_VERSION_PATCH),
                 "BSD-3-Clause"});
  all.push_back(
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION), "MPL-2.0"});
#ifdef HOLDFAST_HAS_NETCDF
  all.push_back({"netCDF-C", NC_VERSION, "NetCDF"});
#endif
  all.push_back({"nlohmann-json",
                 dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                        NLOHMANN_JSON_VERSION_PATCH),
                 "MIT"});
#ifdef TBB_VERSION_MAJOR
  all.push_back(
      {"oneTBB", dotted(TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH), "Apache-2.0"});
#endif
#ifdef HOLDFAST_HAS_SUNDIALS
  all.push_back({"SUNDIALS", SUNDIALS_VERSION, "BSD-3-Clause"});
#endif
  all.push_back({"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH), "MIT"});
#ifdef HOLDFAST_HAS_SIMD
  all.push_back({"xsimd", dotted(XSIMD_VERSION_MAJOR, XSIMD_VERSION_MINOR, XSIMD_VERSION_PATCH),
                 "BSD-3-Clause"});
#endif
#ifdef HOLDFAST_HAS_ZSTD
  all.push_back({"Zstandard", ZSTD_VERSION_STRING, "BSD-3-Clause"});
#endif
  return all;
}

std::string compiler_text() {
#if defined(__clang__)
  std::string text = "Clang " + dotted(__clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  std::string text = "GCC " + dotted(__GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  std::string text = "another compiler";
#endif
#if defined(__AVX512F__)
  return text + ", AVX-512";
#elif defined(__AVX2__)
  return text + ", AVX2";
#else
  return text;
#endif
}

std::string version_text() {
  std::string text = "holdfast " HOLDFAST_VERSION "\ncompiled by " + compiler_text() +
                     "\ninstructions " + std::string(name_of(best_instruction_set())) + " (of " +
                     available_instruction_names() + ")\nwith";
  for (const Dependency& dependency : dependencies())
    text += "\n  " + dependency.name + " " + dependency.version;
  return text;
}

std::string bill_of_materials() {
  nlohmann::ordered_json components = nlohmann::ordered_json::array();
  for (const Dependency& dependency : dependencies()) components.push_back(component(dependency));
  nlohmann::ordered_json bill = {
      {"bomFormat", "CycloneDX"}, {"specVersion", "1.5"}, {"version", 1}};
  bill["metadata"]["component"] = component({"holdfast", HOLDFAST_VERSION, "BSD-3-Clause"});
  bill["metadata"]["component"]["type"] = "application";
  bill["metadata"]["properties"] = {{{"name", "compiler"}, {"value", compiler_text()}}};
  bill["components"] = components;
  return bill.dump(2) + "\n";
}

}  // namespace holdfast::program
