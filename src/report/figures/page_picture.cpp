#include "report/figures/page_picture.hpp"

#include "io/file/input.hpp"
#include "report/figures/compact_svg.hpp"
#include "report/figures/data_url.hpp"
#include "report/figures/gnuplot.hpp"

namespace holdfast::program {

PagePicture page_picture(const Figure& figure, const std::filesystem::path& folder) {
  constexpr std::size_t short_enough = 60000;
  const std::vector<PicturePanel> panels = draw(figure, folder);
  const std::string drawing = read_input(folder / "pictures" / (figure.name + ".svg"));
  PagePicture vector{svg_url(compact_svg(drawing)), panels};
  if (vector.url.size() <= short_enough) return vector;
  const PassingPicture dots = passing_picture(figure, folder, ".png");
  PagePicture raster{png_url(dots.bytes), dots.panels};
  return raster.url.size() < vector.url.size() ? raster : vector;
}

}  // namespace holdfast::program
