#pragma once

#include <string>

#include "app/lab/introduction.hpp"
#include "app/lab/lab.hpp"

namespace substep {

/// What the first screen says, for the canvas and for its twin in HTML.
struct IntroductionWords {
  std::string claim;  // what the two pictures show
  std::string paper;  // whose method it is
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
