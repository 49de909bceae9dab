#include "report/picture/page_picture.hpp"

#include "io/file/input.hpp"
#include "report/figures/gnuplot.hpp"
#include "report/picture/compact_svg.hpp"
#include "report/picture/data_url.hpp"

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
