#pragma once
// Limits of a scene file, far beyond any sensible scene: they catch typing errors and keep squares
// and quotients in range.

#include <cstddef>

#include "core/model/range.hpp"

namespace substep {

inline constexpr int kSceneVersion = 2;  // of the format; version 1 is read too
inline constexpr std::size_t kMaxBodies = 20000;
inline constexpr std::size_t kMaxJoints = 20000;
inline constexpr std::size_t kMaxForces = 1'000'000;
inline constexpr std::size_t kMaxVerdictRules = 100;
inline constexpr std::size_t kMaxNameSize = 100;  // [bytes]
inline constexpr std::size_t kMaxTitle = 200;     // [bytes]
inline constexpr std::size_t kMaxProse = 2000;    // [bytes]
inline constexpr int kMaxCollisionGroup = 1'000'000;

inline constexpr double kUnitTolerance = 1e-6;  // on the length of axes and quaternions [-]
inline constexpr Range kUnitLength{1.0 - kUnitTolerance, 1.0 + kUnitTolerance};

inline constexpr Range kSizeRange = positive(1e6, "m");
inline constexpr Range kMassRange{1e-30, 1e12, false, false, "kg"};
inline constexpr Range kInertiaRange{1e-60, 1e24, false, false, "kg m^2"};
inline constexpr Range kPositionRange = symmetric(1e6, "m");
inline constexpr Range kVelocityRange = symmetric(1e8, "m/s");
inline constexpr Range kAngularVelocityRange = symmetric(1e5, "rad/s");
inline constexpr Range kBodyForceRange = symmetric(1e18, "N");
inline constexpr Range kBodyTorqueRange = symmetric(1e21, "N m");
inline constexpr Range kFrictionRange = not_negative(100.0, "-");
inline constexpr Range kRestitutionRange = not_negative(1.0, "-");
inline constexpr Range kRestitutionSpeedRange = not_negative(1e8, "m/s");
inline constexpr Range kComplianceRange = not_negative(1e12, "m/N");
inline constexpr Range kAngularComplianceRange = not_negative(1e18, "rad/(N m)");
inline constexpr Range kAngleRange = symmetric(6.3, "rad");
inline constexpr Range kMotorTorqueRange = positive(1e21, "N m");
inline constexpr Range kMotorForceRange = positive(1e18, "N");
inline constexpr Range kDriveAngleRange = symmetric(1e6, "rad");
inline constexpr Range kDriveStiffnessRange = not_negative(1e18, "N/m");
inline constexpr Range kDriveTurningStiffnessRange = not_negative(1e21, "N m/rad");
inline constexpr Range kDriveDampingRange = not_negative(1e18, "N s/m");
inline constexpr Range kDriveTurningDampingRange = not_negative(1e21, "N m s/rad");
inline constexpr Range kRegularisationRange = not_negative(1e9, "1/kg");
inline constexpr Range kMarginRange = not_negative(1e6, "m");
inline constexpr Range kAccelerationRange = symmetric(1e30, "m/s^2, rad/s^2");
inline constexpr Range kGravityRange = symmetric(1e8, "m/s^2");
inline constexpr Range kFrameRange{1e-5, 1.0, false, false, "s"};
inline constexpr Range kDurationRange = positive(86400.0, "s");
inline constexpr Range kDistanceRange = positive(1e6, "m");
inline constexpr Range kElasticRange = symmetric(1e30, "m, rad");
inline constexpr Range kForceRange = symmetric(1e30, "N, N m");
inline constexpr Range kForceRateRange = symmetric(1e40, "N/s, N m/s");
inline constexpr Range kForceRateChangeRange = symmetric(1e50, "N/s^2, N m/s^2");
inline constexpr Range kStiffnessRange = symmetric(1e30, "N/m, N m/rad");
inline constexpr Range kStiffnessOverMassRange = not_negative(1e60, "1/s^2");
inline constexpr Range kEnergyRange = positive(1e24, "J");
inline constexpr Range kErrorRange = positive(1e24, "m, J");
inline constexpr Range kOperationsRange = positive(1e18, "-");

}  // namespace substep
