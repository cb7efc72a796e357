#pragma once

#include "core/constraints/cylindrical_joint.hpp"
#include "core/constraints/prismatic_joint.hpp"

namespace substep {

/// The travel of a sliding joint as one row: phi = v . d - lower [m], like the rows of the joint,
/// with v along the axis instead of across it. For the upper bound v is reversed. The functions are
/// documented in PoseRows.
template <class Slide>
struct TravelOf {
  using Owner = Slide;

  /// The measure of tolerances [m]: the half width of body a.
  static double width(const Body& a) {
    return std::visit([](const auto& shape) { return shape.half_width(); }, a.shape);
  }

  /// @param upper whether phi is the distance from the upper bound
  static JointGeometry geometry(const Slide& slide, const TravelLimit& limit, bool upper) {
    JointGeometry geometry = TravelOf::geometry(slide);
    if (upper) geometry.v1 = -geometry.v1;
    geometry.middle = upper ? -limit.upper : limit.lower;
    return geometry;
  }

  /// phi = v . d, of a drive or a spring.
  static JointGeometry geometry(const Slide& slide, const auto& /*part*/) {
    return geometry(slide);
  }

  /// Of a row that has a speed and no position.
  static JointGeometry geometry(const Slide& slide) {
    JointGeometry geometry{slide.anchor_a, slide.anchor_b};
    geometry.v1 = slide.axis_b;
    return geometry;
  }

  static void constants(Block& block) {
    block.rows = block.position_rows = 1;
    block.has_point_rows = false;
    block.C[0] = 0.0;
    block.v2 = block.axis = block.w = Vec3::Zero();  // of the joint's other rows
  }

  static void rows(const JointGeometry& joint, const Side& a, const Side& b, Block& block) {
    const Vec3 r_a = a.R * joint.anchor_a;
    block.r_a = r_a;
    block.r_b = (a.x - b.x) + r_a;
    block.rho = b.R * joint.anchor_b;
    block.v1 = b.R * joint.v1;
    block.phi[0] = block.v1.dot(block.r_b - block.rho) - joint.middle;
    set_row(block, 0, block.v1);
  }

  static void curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
    double of_all[kMaxRows];
    PrismaticRows::curvature(block, u_a, u_b, of_all);
    curvature[0] = of_all[0];
  }

  static void stiffness(const Block& block, auto& K) {
    PrismaticRows::stiffness(with_one_force(block), K);
  }
  static void mean_stiffness(const Block& block, auto& K) {
    PrismaticRows::mean_stiffness(with_one_force(block), K);
  }

  static void move(const Block& start, const Motion& a, const Motion& b, RowRange /*rows*/,
                   Block& moved) {
    PrismaticRows::move(start, a, b, {0, 1}, moved);
  }
  static void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
    double of_all[kMaxRows];
    PrismaticRows::moved_errors(start, a, b, of_all);
    phi[0] = of_all[0];
  }

  static Vec3 force(const Block& block, const double* force) { return force[0] * block.v1; }
  static Vec3 torque(const Block& /*block*/, const double* /*force*/) { return Vec3::Zero(); }

  static void push_change(const Block& block, const Motion& a, const Motion& b, const double* force,
                          Vec6& on_a, Vec6& on_b) {
    const double of_all[kMaxRows] = {force[0]};
    PrismaticRows::push_change(block, a, b, of_all, on_a, on_b);
  }

 private:
  static Block with_one_force(const Block& block) {
    Block one = block;
    for (int row = 1; row < kMaxRows; ++row) one.lambda[row] = 0.0;
    return one;
  }
};

using SlideTravel = TravelOf<PrismaticJoint>;
using CylinderTravel = TravelOf<CylindricalJoint>;

}  // namespace substep
