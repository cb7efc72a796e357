#pragma once

#include <string>

#include "app/lab/introduction.hpp"
#include "app/lab/lab.hpp"

namespace substep {

/// Texts of the first screen, for the canvas and for its HTML equivalent.
struct IntroductionWords {
  std::string claim;  // caption of the two pictures
  std::string paper;  // authors of the method
  struct Label {
    std::string title;
    std::string note;
  };
  Label torn;
  Label held;
  std::string clock;
};
IntroductionWords introduction_words(const Lab& lab);

}  // namespace substep
