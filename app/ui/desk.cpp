#include "app/ui/desk.hpp"

namespace substep {

Desk::Desk() {
  plot(Plot::kError).logarithmic = true;
  plot(Plot::kTime).shown = false;
}

}  // namespace substep
