#include "report/picture/panels_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace holdfast::program {
namespace {

using Json = nlohmann::ordered_json;

/// A hundred-thousandth of a picture is less than a pixel.
double of_picture(double part) { return std::round(1e5 * part) / 1e5; }

void add_axis(Json& panel, const char* which, const PanelAxis& axis) {
  if (axis.name.empty()) return;
  panel[which] = {{"name", axis.name}, {"from", axis.from}, {"to", axis.to}};
  if (!axis.unit.empty()) panel[which]["unit"] = axis.unit;
  if (axis.logarithmic) panel[which]["log"] = true;
}

}  // namespace

std::string panels_json(const std::vector<PicturePanel>& panels) {
  Json list = Json::array();
  for (const PicturePanel& panel : panels) {
    Json told;
    told["box"] = {of_picture(panel.left), of_picture(panel.top), of_picture(panel.right),
                   of_picture(panel.bottom)};
    add_axis(told, "x", panel.x);
    add_axis(told, "y", panel.y);
    add_axis(told, "right", panel.right_axis);
    list.push_back(std::move(told));
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace holdfast::program
