#include "scenes/generator/scenes.hpp"

namespace substep::scenes {

std::vector<Scene> shipped() {
  return {swinging_box(),
          bridge(),
          heavy_stack(),
          heavy_stack_tall(),
          heavy_stack_stress(),
          heavy_stack_stress_tall(),
          pendulum(),
          spinning_top(),
          sliding_box(),
          free_fall(),
          bouncing_balls(),
          wrecking_ball(),
          card_house(),
          ragdoll_drop(),
          wall()};
}

}  // namespace substep::scenes
