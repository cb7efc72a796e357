#pragma once

#include <cstdint>
#include <span>

#include "core/collision/contact_point.hpp"
#include "core/constraints/block.hpp"
#include "core/constraints/stiffness_matrix.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Row 0: phi = gap along n, n from b to a [m].
void contact_row(const ContactPoint& point, const ContactModel& model, const Vec3& x_a,
                 const Vec3& x_b, Block& block);

/// J u of row 0: positive when the bodies separate [m/s]. @param u per body [m/s, rad/s]
double normal_speed(const Block& contact, std::span<const Vec6> u);

/// Rows 1 and 2: no sliding along t1, t2.
/// @param along t1 its component normal to n gives t1, world
void friction_rows(const ContactModel& model, double mu, const Vec3& along, Block& block);

/// Selects the terms of a contact that enter K. The paper's and the exact ones choose N. Only the
/// normal term is added to a mass: friction is not the gradient of an error, so its derivative is
/// not a spring; with it the bridge failed from 8 of 512 starts, without it from none.
enum class ContactTerms : std::uint8_t {
  kPaper,   // a ball-and-socket joint that carries l = lambda_n n + friction. It is not the
            // derivative of the contact force: it stiffens a sphere's spin
  kNormal,  // the true derivative of the normal force and its torques: lambda_n times the Hessian
            // of phi
  kExact,   // that of friction too, with tangents that rotate with body b and stay perpendicular to
            // the normal, as in move_rows()
};
void contact_stiffness(const Block& block, ContactTerms terms, StiffnessMatrix& K);

}  // namespace substep
