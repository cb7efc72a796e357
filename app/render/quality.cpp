#include "app/render/quality.hpp"

#include <algorithm>
#include <array>

namespace substep {
namespace {

constexpr int kWindow = 12;              // frames per judged window
constexpr double kSlowFrame = 1.0 / 30;  // a frame that took longer to draw is slow [s]
constexpr int kFewest = 4;               // frames that suffice if all are slow and
constexpr double kEnough = 0.6;          // have taken this long in total [s]
constexpr double kAsleep = 10.0;         // a background tab: not a drawing time [s]
constexpr double kMostWait = 256.0;      // limit of patience_ [s]

}  // namespace

bool is_software(std::string_view renderer) {
  constexpr std::array<std::string_view, 4> kNames{"llvmpipe", "softpipe", "SwiftShader",
                                                   "Basic Render"};
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
}

Quality finest_in_software(std::size_t bodies) {
  if (bodies > 1000) return Quality::kSketch;
  if (bodies > 400) return Quality::kCoarse;
  if (bodies > 150) return Quality::kPlain;
  return Quality::kFine;
}

void QualityGovernor::observe(double wall_dt, double own) {
  if (wall_dt > kAsleep) return;
  steady_ += wall_dt;
  ++seen_;
  if (wall_dt - own > kSlowFrame) {
    ++slow_;
    lost_ += wall_dt - own;
  }
  const bool evident = slow_ == seen_ && seen_ >= kFewest && lost_ > kEnough;
  if (seen_ < kWindow && !evident) return;
  const bool slow = 2 * slow_ > seen_;
  const bool quick = slow_ == 0;
  seen_ = slow_ = 0;
  lost_ = 0.0;
  if (slow && quality_ != Quality::kSketch) {
    // After a finer quality has failed at once, the wait is extended.
    if (tried_ && steady_ < 4.0) patience_ = std::min(2.0 * patience_, kMostWait);
    tried_ = false;
    quality_ = static_cast<Quality>(static_cast<int>(quality_) - 1);
    steady_ = 0.0;
  } else if (quick && quality_ != Quality::kFine && steady_ > patience_) {
    quality_ = static_cast<Quality>(static_cast<int>(quality_) + 1);
    tried_ = true;
    steady_ = 0.0;
  }
}

}  // namespace substep
