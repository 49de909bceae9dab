#pragma once

#include <string>
#include <vector>

#include "report/picture/picture_panels.hpp"

namespace holdfast::program {

/// The panels of a picture as the script of the page reads them: a list of
/// {"box": [left, top, right, bottom], "x": {"name", "unit", "from", "to", "log"}, "y", "right"},
/// in which an axis without a name is left out.
std::string panels_json(const std::vector<PicturePanel>& panels);

}  // namespace holdfast::program
