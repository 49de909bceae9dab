#pragma once

#include "case/case_file.hpp"
#include "store/store_folder.hpp"
#include "store/stored_grid.hpp"

namespace holdfast::program {

/// Seven times five cells in chunks of two rows, a column of each kind and one beside the table.
inline StoreDescription small_store() {
  JobContext context;
  context.job = "sweep";
  context.case_data = load_case(std::nullopt, {"control.sampling_period=0.004"});
  context.case_source.text = "";
  context.case_source.name = "my.toml";
  context.case_source.overrides = {"control.sampling_period=0.004"};
  context.options = {{"--axis", "backlash.width=0:0.003:7"}, {"--axis", "initial.z1=0:1:5"}};
  const GridLayout layout{{{{"backlash.width", "m", "r0"}, Axis{0.0, 0.003, 7}},
                           {{"initial.z1", "m", "z1 at the start"}, Axis{0.0, 1.0, 5}}},
                          {{{"steady_peak", "N.s/m", "largest |z1|"}, {}},
                           {{"period_samples", "", "0: none", "integer"}, {}},
                           {{"kind", "", "of motion", "string"}, {"periodic", "chaotic"}}}};
  StoreDescription store = store_description(context, layout, 10);
  store.table_columns = 2;
  return store;
}

inline ChunkValues values_of_small_store(std::int64_t chunk) {
  const ChunkGrid grid = small_store().grid;
  ChunkValues values(3);
  for (std::int64_t i = 0; i < grid.cells_of(chunk); ++i) {
    const auto cell = static_cast<double>(grid.first_cell(chunk) + i);
    values[0].push_back(cell / 3.0);
    values[1].push_back(1000.0 * cell - 7.0);
    values[2].push_back(static_cast<int>(cell) % 2);
  }
  return values;
}

}  // namespace holdfast::program
