#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

// Cards ten times as long and wide as playing cards, and thicker: the picture is the same.
constexpr double kCardLength = 0.88;      // [m]
constexpr double kCardThickness = 0.012;  // [m]
constexpr double kCardWidth = 0.63;       // [m]
constexpr double kCardMass = 0.25;        // [kg]
constexpr double kCardMu = 0.8;
// Cards lean 22.6 degrees: a triangle with sides 5, 12 and 13.
constexpr double kSine = 5.0 / 13.0;
constexpr double kCosine = 12.0 / 13.0;
constexpr double kCardPitch = 0.70;  // from one pair of cards to the next [m]

Body card(const Scene& scene, double length, const Vec3& position) {
  Body body =
      solid("card_" + std::to_string(scene.bodies.size() - 1),
            box(length, kCardThickness, kCardWidth), kCardMass * length / kCardLength, position);
  body.friction = kCardMu;
  body.color = kPaper;
  return body;
}

/// Two cards that lean on each other over x, standing at height y.
void add_pair(double x, double y, Scene& scene) {
  // Half the extents of a leaning card. It touches its partner with the upper corner.
  const double half_width = 0.5 * (kCardLength * kSine + kCardThickness * kCosine);
  const double half_height = 0.5 * (kCardLength * kCosine + kCardThickness * kSine);
  for (const double side : {-1.0, 1.0}) {
    Body body = card(scene, kCardLength, {x + side * half_width, y + half_height, 0.0});
    // The card's +x points up, towards its partner.
    body.orientation = turn_about_z(-side * kSine, kCosine);
    scene.bodies.push_back(body);
  }
}

}  // namespace

Scene card_house(int storeys) {
  const double storey = kCardLength * kCosine + kCardThickness * kSine;
  Scene scene = paper_scene();
  scene.name = "card_house";
  scene.title = "Card house";
  scene.group = "playground";
  scene.description = "A house of cards, " + std::to_string(storeys) +
                      " storeys high, held by friction and balance only.";
  scene.look_for = "It stands. Throw a ball at it, or pull out a card.";
  scene.effects = {.gravity = true, .contact = true, .friction = true};
  // The stiffness needs no more than one step per frame, but with such a step cards roll over their
  // edges and creep.
  scene.settings.mode = Mode::kConst;
  scene.settings.n = 8;
  add_ground(kCardMu, 0.004, scene);
  double y = 0.0;
  for (int pairs = storeys; pairs >= 1; --pairs) {
    const double first = -0.5 * (pairs - 1) * kCardPitch;
    for (int i = 0; i < pairs; ++i) add_pair(first + i * kCardPitch, y, scene);
    y += storey;
    for (int i = 0; i + 1 < pairs; ++i) {  // horizontal cards: the floor of the next storey
      scene.bodies.push_back(card(scene, kCardPitch - 0.004,
                                  {first + (i + 0.5) * kCardPitch, y + 0.5 * kCardThickness, 0.0}));
    }
    y += kCardThickness;
  }
  // The last card of the top pair.
  const int top = static_cast<int>(scene.bodies.size()) - 1;
  scene.criteria.displacement = Criteria::Displacement{top, 0.1};
  scene.criteria.track = top;
  scene.camera.eye = {2.4, 0.5 * y + 0.9, 1.1 + 1.35 * y};
  scene.camera.target = {0.0, 0.5 * y, 0.0};
  return scene;
}

}  // namespace substep::scenes
