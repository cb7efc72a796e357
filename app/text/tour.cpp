#include "app/text/tour.hpp"

#include <array>

namespace substep {

std::span<const TourStep> tour_steps() {
  static constexpr std::array<TourStep, 6> kSteps{
      {{"A heavy box on a thin chain",
        "25 links of 1 kg carry 1,000 kg, at one step per frame and with an exact solver: the "
        "chain tears at 0.35 s. Its pull, turned by any small rotation of a link, pushes back like "
        "a "
        "spring that is too stiff for so long a step.",
        "The links, and the error as it climbs. The run pauses where it fails.",
        "scene=swinging_box&mode=none&solver=bpp&integrator=euler&panel=plots"},
       {"Enough sub-steps hold it",
        "Seven sub-steps hold; with six (orange ghost) the chain tears after a few seconds. You "
        "cannot know in advance that it takes seven, and every frame pays for the worst one.",
        "The ghost leaves the chain as it passes the lowest point.",
        "scene=swinging_box&mode=const&n=7&solver=bpp&integrator=euler&compare=n:6&panel=plots"},
       {"Damping holds it too, and slows it",
        "Adaptive damping takes one step per frame and damps the rotations that are too stiff for "
        "it. After ten seconds a fifth of the energy is gone.",
        "The box falls behind the orange ghost, which swings undamped.",
        "scene=swinging_box&mode=damping&alpha=0.1&solver=bpp&integrator=euler"
        "&compare=mode:adaptive&panel=plots"},
       {"Adaptive sub-steps",
        "From the forces in the chain the paper reads how stiff it is, and from that how many "
        "sub-steps the next frame needs: 10 at the turning points, 20 at the bottom of the swing. "
        "In ten seconds 0.15 % of the energy is lost.",
        "Why this N: the link and the rotation that set it.",
        "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=euler&panel=why"},
       {"Alpha trades cost for distance",
        "Alpha says how far from the limit of stability a step keeps. N is proportional to 1/√α: "
        "the orange ghost has a quarter of the alpha, twice the sub-steps and half the loss.",
        "The two curves of N, one twice the other.",
        "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=euler"
        "&compare=alpha:0.025&panel=plots"},
       {"What does accuracy cost?",
        "Sometimes nothing: leapfrog lets gravity act over the middles of two sub-steps and keeps "
        "the energy to a millionth, at the same number of sub-steps. The orange ghost is Euler.",
        "The energy. Then run all methods in the panel Accuracy: error against cost.",
        "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=leapfrog"
        "&compare=integrator:euler&panel=accuracy"}}};
  return kSteps;
}

}  // namespace substep
