#include "report/picture/compact_svg.hpp"

#include "report/picture/page_picture.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

/// A curve through these places and so many more that lie where the last of them does.
std::string curve_through(const std::string& places, int more) {
  std::string curve = places;
  for (int k = 0; k < more; ++k)
    curve += (k % 4 == 0 ? "\t\t " : " ") + places.substr(places.rfind('L'));
  return "<path d='" + curve + "  '/>\n";
}

TEST(CompactSvg, GoesAlongCurvesBySteps) {
  EXPECT_EQ(
      compact_svg(curve_through("M60.45,278.47 L70.20,278.47 L70.31,270.05 L69.00,270.05", 20)),
      "<path d='M60.45 278.47l9.75 0 .11-8.42-1.31 0'/>\n");
  EXPECT_EQ(compact_svg(curve_through("M1.00,2.00 L1.00,2.00 M5.00,5.00 L6.00,4.60", 20)),
            "<path d='M1 2l0 0M5 5l1-.4'/>\n");
}

TEST(CompactSvg, TakesALongCurveInTenths) {
  EXPECT_EQ(
      compact_svg(curve_through("M60.45,278.47 L70.20,278.47 L70.31,270.02 L69.00,270.02", 600)),
      "<path d='M60.5 278.5l9.7 0 .1-8.5-1.3 0'/>\n");
}

TEST(CompactSvg, DrawsACloudOfDotsAsOneCurve) {
  const auto dots = [](int count) {
    std::string lines;
    for (int k = 0; k < count; ++k)
      lines += "\t<use xlink:href='#gpPt6' transform='translate(" + std::to_string(k) +
               ".50,2.00) scale(0.88)' color='rgb(  0, 114, 178)'/>\n";
    return lines;
  };
  EXPECT_EQ(
      compact_svg("<g>\n" + dots(8) + "</g>\n"),
      "<g>\n<path fill='none' stroke='rgb(  0, 114, 178)' stroke-linecap='round' "
      "stroke-width='1.9404' d='M.5 2h0m1 0h0m1 0h0m1 0h0m1 0h0m1 0h0m1 0h0m1 0h0'/>\n</g>\n");
  const std::string few = compact_svg("<g>\n" + dots(3) + "</g>\n");
  EXPECT_NE(few.find("translate(2.50,2.00)"), std::string::npos) << few;
}

TEST(CompactSvg, KeepsShapesTextsAndWhatItDoesNotKnow) {
  const std::string shape = "<path id='gpPt13' d='M0,1.330 L1.265,0.411 z'/>\n";
  EXPECT_EQ(compact_svg(shape), shape);
  const std::string arc = "<path d='" + std::string(200, 'A') + "'/>\n";
  EXPECT_EQ(compact_svg(arc), arc);
  EXPECT_EQ(compact_svg("<?xml version=\"1.0\"?>\n<svg>\n\n\t<title>x</title><desc>of\nit</desc>\n"
                        "<g fill=\"none\">\n</g>\n\t<text>0.50 and  more</text>\n</svg>\n"),
            "<svg>\n<text>0.50 and  more</text>\n</svg>\n");
}

TEST(DataUrl, HoldsADrawingThatNothingCutsShort) {
  EXPECT_EQ(svg_url("<svg a=\"50%\">\n<use href='#b'/></svg>"),
            "data:image/svg+xml;charset=utf-8,<svg a=%2250%25%22> <use href='%23b'/></svg>");
  EXPECT_EQ(png_url("\x89PNG"), "data:image/png;base64,iVBORw==");
}

}  // namespace
}  // namespace holdfast::program
