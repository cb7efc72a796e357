#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Which of the criterion's two terms is the larger: the number of sub-steps follows it.
enum class CriterionTerm : std::uint8_t { kNone, kStiffness, kRotation };

/// What each term of the criterion requires, by Eqs. 10 and 11.
struct Criterion {
  CriterionTerm set_by = CriterionTerm::kNone;
  StiffnessLeader stiffness;   // the stiffest degree of freedom; body -1 where nothing is stiff
  double r_rotation = 0.0;     // [1/s^2]
  int rotation_body = -1;      // -1 where no body rotates, or the term is switched off
  double angular_speed = 0.0;  // of that body [rad/s]
  bool rotation_on = false;    // the setting
  bool remembered = false;     // the fastest rotation of the last seconds counts
  int n_stiffness = 1;         // N that each term alone requires
  int n_rotation = 1;

  /// The body that sets N, or -1.
  [[nodiscard]] int body() const;
};

Criterion criterion_of(const Scene& scene, const Settings& settings, const State& state,
                       const FrameReport& report);

/// "along x", "rotation about z": a degree of freedom of a body, about its principal axes.
std::string degree_of_freedom(const StiffnessLeader& who);
/// "link_3, rotation about z"; "top, spinning at 60 rad/s now"; what sets N.
std::string setter_text(const Scene& scene, const Criterion& criterion);
/// One term in words, with what it requires: "Stiffness of link_3, along y" and
/// "Rotation of top, 60 rad/s now".
std::string stiffness_text(const Scene& scene, const Criterion& criterion);
std::string rotation_text(const Scene& scene, const Criterion& criterion);
/// Explains the value of the rotation term, in words.
std::string rotation_meaning(const Scene& scene, const Criterion& criterion);
/// What both terms ask for: "stiffness alone N = 12, rotation alone N = 23".
std::string both_terms_text(const Criterion& criterion);

}  // namespace substep
