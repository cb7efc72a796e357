#include "app/text/tour.hpp"

#include <array>

namespace substep {

std::span<const TourStep> tour_steps() {
  static constexpr std::array<TourStep, 8> kSteps{
      {{.title = "A heavy box on a thin chain",
        .text = "A box of {load} hangs on 25 links of 1 kg each. The solver is exact and takes one "
                "step per frame. The pull of the chain turns with every link and acts like a "
                "spring. At 1,000 kg this spring is too stiff for so long a step.",
        .watch = "Watch the links in slow motion, and [the joint error](error) as it grows.",
        .task = "Does a lighter box help? Set its mass to 10 kg.",
        .link = "scene=swinging_box&mode=none&solver=bpp&integrator=euler&panel=plots&plots=error"
                "&level=explore",
        .loop = {.end = 4.0, .slow_until = 0.5},
        .reply = reply_lighter_box},
       {.title = "Enough sub-steps hold it",
        .text = "Every frame takes {n}. This chain needs at least seven. The number is not "
                "known in advance, and every frame takes as many as the worst one.",
        .watch = "Watch the chain as it swings down, and [the joint error](error).",
        .task = "Make it fail: set six sub-steps.",
        .link = "scene=swinging_box&mode=const&n=7&solver=bpp&integrator=euler&panel=plots"
                "&plots=error&level=explore",
        .loop = {.end = 4.0},
        .reply = reply_break_it},
       {.title = "Damping holds it too, and slows it",
        .text = "A frame takes at most {n_cap}. Bodies that are too stiff for that are damped. The "
                "chain holds even with one sub-step, which costs a fifth of the energy in ten "
                "seconds.",
        .watch = "Watch the box fall behind the orange ghost, which swings undamped, and "
                 "[the kinetic energy](energy).",
        .task = "Lose less than a tenth: allow more sub-steps.",
        .link = "scene=swinging_box&mode=capped&n_cap=1&alpha=0.1&solver=bpp&integrator=euler"
                "&compare=mode:adaptive&panel=plots&plots=energy,drift&level=explore",
        .loop = {.end = 10.0},
        .reply = reply_lose_less},
       {.title = "Adaptive sub-steps",
        .text = "The paper computes the stiffness from the forces in the chain, and from the "
                "stiffness the number of sub-steps that the next frame needs. At alpha = 0.1, N is "
                "10 at the turning points and 20 at the bottom of the swing. In ten seconds "
                "0.15 % of the energy is lost. Here alpha = {alpha}.",
        .watch = "Watch [which link sets N](why), and [the law](law) with its numbers.",
        .task = "Keep N at ten or below: raise alpha.",
        .link = "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=euler&panel=why"
                "&plots=substeps,energy&level=explore",
        .loop = {.end = 10.0},
        .reply = reply_range_of_n},
       {.title = "Alpha trades cost for accuracy",
        .text = "Alpha sets the distance to the limit of stability, which is 1. This run has "
                "alpha = {alpha}, the orange ghost 0.1. N is proportional to 1/√α: a quarter of "
                "the alpha takes twice the sub-steps and loses half the energy.",
        .watch = "Watch [the plot of N](substeps) and [the energy drift](drift).",
        .task = "Double N: set alpha to a quarter, 0.025.",
        .link = "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=euler"
                "&compare=alpha:0.1&panel=plots&plots=substeps,drift&level=explore",
        .loop = {.end = 5.0},
        .reply = reply_double_n},
       {.title = "The load changes, and N follows",
        .text =
            "The box has a mass of {load}. At 1,000 kg seven constant sub-steps hold as well "
            "(orange ghost). A heavier box makes the chain stiffer. Seven are then too few, and "
            "adaptive sub-stepping takes more.",
        .watch = "Watch the ghost, and [the plot of N](substeps).",
        .task = "Make the box four times as heavy.",
        .link = "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=euler"
                "&n=7&compare=mode:const&panel=plots&plots=substeps,error&level=explore",
        .loop = {.end = 4.0},
        .reply = reply_heavier_box},
       {.title = "A load that changes while it runs",
        .text =
            "Balls of 10, 100 and 1,000 kg roll over a bridge of light planks, and N follows each "
            "of them. The orange ghost takes {n} in every frame. Thirteen is the "
            "smallest constant number whose largest joint gap is at most 5 % larger. That number "
            "is known only "
            "after the run, and takes more sub-steps in all.",
        .watch = "Watch [the plot of N](substeps) under each ball, and [the joint error](error).",
        .task = "Make the ghost's bridge fail: set seven sub-steps.",
        .link = "scene=convoy&mode=adaptive&policy=substep&alpha=0.25&solver=bpp&integrator=euler"
                "&n=13&compare=mode:const&panel=plots&plots=substeps,error&level=explore",
        .loop = {.end = 8.4},
        .reply = reply_changing_load},
       {.title = "What does accuracy cost?",
        .text =
            "Sometimes nothing. Adaptive steps buy safety; the order of a method buys accuracy. "
            "Leapfrog applies gravity from the middle of one sub-step to the middle of the next. "
            "At alpha = 0.1 its energy error is below a millionth, with as many sub-steps as the "
            "orange ghost, which is Euler. This run has alpha = {alpha}.",
        .watch = "Watch [the energy drift](drift). [Error against cost](accuracy) shows all "
                 "methods.",
        .task = "Save half the sub-steps: raise alpha to 0.4.",
        .link = "scene=swinging_box&mode=adaptive&alpha=0.1&solver=bpp&integrator=leapfrog"
                "&compare=integrator:euler,alpha:0.1&panel=plots&plots=substeps,drift"
                "&level=explore",
        .loop = {.end = 5.0},
        .reply = reply_half_the_substeps}}};
  return kSteps;
}

std::string_view scene_of(const TourStep& step) {
  constexpr std::string_view kSceneKey = "scene=";
  std::string_view link = step.link;
  link.remove_prefix(link.find(kSceneKey) + kSceneKey.size());
  return link.substr(0, link.find('&'));
}

std::span<const TourPlace> tour_places() {
  static constexpr std::array<TourPlace, 7> kPlaces{{{"substeps", "plots", "plot", "substeps"},
                                                     {"energy", "plots", "plot", "energy"},
                                                     {"drift", "plots", "plot", "drift"},
                                                     {"error", "plots", "plot", "error"},
                                                     {"why", "why", "why", "setter"},
                                                     {"law", "why", "why", "law"},
                                                     {"accuracy", "accuracy", "tabs", "Accuracy"}}};
  return kPlaces;
}

}  // namespace substep
