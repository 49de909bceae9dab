#include "sweep/sweep_size.hpp"

#include "io/text/table.hpp"
#include "process/group/mpi_launch.hpp"

namespace holdfast::program {

void write_sweep_size(const JobContext& context, const SweepOptions& options) {
  const SweepPlan plan(context, options);
  if (mpi_launch().rank > 0) return;
  JobContext to_screen = plan.context();
  to_screen.output.reset();  // the file is for the result
  Table table(to_screen, {{"quantity", "", "what the row tells", "string"},
                          {"value", "", "in the unit of the row"},
                          {"unit", "", "SI; empty without dimension", "string"}});
  const auto cells = static_cast<double>(plan.cells());
  const auto numbers_of_cell = static_cast<double>(plan.metrics().size());
  table.row("axes", static_cast<double>(plan.layout().axes.size()), "");
  table.row("cells", cells, "");
  table.row("tiles", static_cast<double>(plan.tiles()), "");
  table.row("cells_of_tile", static_cast<double>(plan.cells_of(0)), "");
  table.row("samples", plan.samples(), "");
  table.row("tile_bytes", cells * numbers_of_cell * sizeof(double), "B");
  table.commit();
}

}  // namespace holdfast::program
