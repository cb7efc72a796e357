// Readable colours, by the contrast ratios of WCAG 2.1.

#include "app/ui/look.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace substep {
namespace {

using ui::Theme;
using ui::to_vec4;

double linear(float channel) {
  const auto c = static_cast<double>(channel);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(const ImVec4& c) {
  return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
}

ImVec4 over(const ImVec4& top, const ImVec4& below) {
  const float a = top.w;
  return {a * top.x + (1 - a) * below.x, a * top.y + (1 - a) * below.y,
          a * top.z + (1 - a) * below.z, 1.0F};
}

double contrast(const ImVec4& a, const ImVec4& b) {
  const double light = std::max(luminance(a), luminance(b));
  const double dark = std::min(luminance(a), luminance(b));
  return (light + 0.05) / (dark + 0.05);
}

// The colours of panels over the brightest and the darkest background of the picture.
std::vector<ImVec4> seen(const Theme& t, ImU32 surface) {
  std::vector<ImVec4> all;
  for (const Color& c : {t.view.background_top, t.view.background_bottom}) {
    all.push_back(over(to_vec4(surface), {c.r, c.g, c.b, 1.0F}));
  }
  return all;
}

class Contrast : public testing::TestWithParam<bool> {
 protected:
  const Theme& t = GetParam() ? ui::dark_theme() : ui::light_theme();
  void expect(ImU32 ink, ImU32 surface, double least, const std::string& what) const {
    for (const ImVec4& ground : seen(t, surface)) {
      EXPECT_GE(contrast(over(to_vec4(ink), ground), ground), least) << what;
    }
  }
};

constexpr double kText = 4.5;     // AA, ordinary text
constexpr double kGraphic = 3.0;  // AA, lines, signs and controls

TEST_P(Contrast, TextIsReadableOnEverySurface) {
  for (const ImU32 surface : {t.panel, t.raised, t.well, t.control, t.control_hover}) {
    expect(t.text, surface, 7.0, "text");
  }
  for (const ImU32 surface : {t.panel, t.raised, t.well}) expect(t.dim, surface, kText, "dim");
  expect(t.dim, t.control, kText, "notes of a menu's entry");
  for (const ImU32 surface : {t.panel, t.raised}) {
    expect(t.accent_hover, surface, surface == t.panel ? kText : kGraphic, "what is pointed at");
  }
  expect(t.on_accent, t.accent, kText, "button");
  expect(t.on_accent, ui::fade(t.accent, 0.88F), kText, "button that is pointed at");
}

TEST_P(Contrast, TextOverThePictureIsReadable) {
  for (const Color& c : {t.view.background_top, t.view.background_bottom}) {
    const ImVec4 ground(c.r, c.g, c.b, 1.0F);
    EXPECT_GE(contrast(to_vec4(t.text), ground), 7.0);
    EXPECT_GE(contrast(to_vec4(t.dim), ground), kText);
  }
}

TEST_P(Contrast, WordsInColourAreReadableWhereTheyStand) {
  expect(t.amber, t.well, kText, "levels in plots");
  for (const ImU32 curve : {t.blue, t.orange, t.teal, t.amber, t.purple}) {
    expect(curve, t.well, kText, "the name at the end of a curve");
  }
  expect(t.text, ui::fade(t.orange, 0.5F), kText, "the time of a failure in the map");
  expect(t.orange, t.well, kText, "the cap in plots");
  for (const ImU32 surface : {t.panel, t.raised}) {
    expect(t.teal, surface, kText, "holds");
    expect(t.orange, surface, kText, "fails");
  }
}

TEST_P(Contrast, CurvesStandOutFromTheirGround) {
  for (const ImU32 curve : {t.blue, t.orange, t.teal, t.amber, t.purple, t.grey}) {
    expect(curve, t.well, kGraphic, "curve");
  }
  for (const ImU32 surface : {t.panel, t.raised, t.well}) {
    expect(t.accent_hover, surface, kGraphic, "focus ring");
  }
  for (const ImU32 surface : {t.panel, t.well}) expect(t.accent, surface, kGraphic, "what is on");
}

// Colours of compared runs as seen by people without one of the three kinds of cones (Viénot,
// Brettel and Mollon 1999, on linear RGB).
TEST_P(Contrast, ComparedRunsDifferForColourBlindEyes) {
  struct Matrix {
    double m[3][3];
  };
  const Matrix protan{{{0.11238, 0.88762, 0.0}, {0.11238, 0.88762, 0.0}, {0.00401, -0.00401, 1.0}}};
  const Matrix deutan{{{0.29275, 0.70725, 0.0}, {0.29275, 0.70725, 0.0}, {-0.02234, 0.02234, 1.0}}};
  for (const Matrix& eye : {protan, deutan}) {
    const auto look = [&](ImU32 color) {
      const ImVec4 c = to_vec4(color);
      const double rgb[3] = {linear(c.x), linear(c.y), linear(c.z)};
      std::vector<double> out;
      for (const auto& row : eye.m) {
        const double v = row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2];
        out.push_back(std::sqrt(std::max(0.0, v)));  // close to the perceived brightness
      }
      return out;
    };
    const std::vector<ImU32> runs{t.blue, t.orange, t.teal, t.purple};
    for (std::size_t i = 0; i < runs.size(); ++i) {
      for (std::size_t j = i + 1; j < runs.size(); ++j) {
        double square = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double d = look(runs[i])[k] - look(runs[j])[k];
          square += d * d;
        }
        EXPECT_GT(std::sqrt(square), 0.15) << i << " and " << j;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Themes, Contrast, testing::Bool(), [](const auto& theme) {
  return std::string(theme.param ? "Dark" : "Light");
});

}  // namespace
}  // namespace substep
