#include <algorithm>
#include <utility>

#include "app/ui/plot.hpp"

namespace substep::ui {

std::pair<double, double> TimeAxis::window(double now) const {
  const double t1 = follow ? std::max(from + span, now) : end;
  return {t1 - span, t1};
}

void TimeAxis::zoom(double factor, double fixed, double now) {
  const auto [t0, t1] = window(now);
  const double wanted = std::clamp(span * factor, kShortest, kLongest);
  if (!follow) {
    end = fixed + (t1 - fixed) * wanted / span;
    follow = end >= now && end - wanted <= from;  // everything is in view
  }
  span = wanted;
}

void TimeAxis::pan(double seconds, double now) {
  end = window(now).second + seconds;
  end = std::max(end, from + std::min(span, now - from));
  follow = end >= now;
}

void TimeAxis::show(double t0, double t1) {
  if (t0 > t1) std::swap(t0, t1);
  span = std::clamp(t1 - t0, kShortest, kLongest);
  end = std::max(t1, t0 + span);
  follow = false;
}

void TimeAxis::follow_again() {
  follow = true;
  if (span < 5.0) span = 10.0;
}

}  // namespace substep::ui
