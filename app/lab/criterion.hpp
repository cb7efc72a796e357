#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The larger of the criterion's two terms; it determines N.
enum class CriterionTerm : std::uint8_t { kNone, kStiffness, kRotation };

/// The requirement of each term of the criterion, by Eqs. 10 and 11.
struct Criterion {
  CriterionTerm set_by = CriterionTerm::kNone;
  StiffnessLeader stiffness;   // the stiffest degree of freedom; body -1 if nothing is stiff
  double r_rotation = 0.0;     // [1/s^2]
  int rotation_body = -1;      // -1 if no body rotates or the term is switched off
  double angular_speed = 0.0;  // of that body [rad/s]
  bool rotation_on = false;    // the setting
  bool remembered = false;     // the value is the maximum of the last seconds
  int n_stiffness = 1;         // N required by each term alone
  int n_rotation = 1;

  /// The r that sets N [1/s^2].
  [[nodiscard]] double r() const {
    return set_by == CriterionTerm::kRotation ? r_rotation : stiffness.r;
  }
  /// The body that sets N, or -1.
  [[nodiscard]] int body() const;
};

Criterion criterion_of(const Scene& scene, const Settings& settings, const State& state,
                       const FrameReport& report);

/// "along x", "rotation about z": a degree of freedom of a body, about its principal axes.
std::string degree_of_freedom(const StiffnessLeader& who);
/// "link_3, rotation about z"; "top, spinning at 60 rad/s now": the cause of N.
std::string setter_text(const Scene& scene, const Criterion& criterion);
/// One term with its requirement: "Stiffness of link_3, along y" and "Rotation of top, 60 rad/s
/// now".
std::string stiffness_text(const Scene& scene, const Criterion& criterion);
std::string rotation_text(const Scene& scene, const Criterion& criterion);
/// Explains the value of the rotation term.
std::string rotation_meaning(const Scene& scene, const Criterion& criterion);
/// The requirement of both terms: "stiffness alone N = 12, rotation alone N = 23".
std::string both_terms_text(const Criterion& criterion);

}  // namespace substep
