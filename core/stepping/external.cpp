#include "core/stepping/external.hpp"

namespace substep {

void add_external(const Scene& scene, const Part& part, std::span<const InertiaInverse> own,
                  std::span<const Mat3> R_WB, std::span<const double> time, std::span<Vec6> u) {
  for (const int body : part.moving) {
    const std::size_t i = index(body);
    const Body& b = scene.bodies[i];
    u[i].head<3>() += time[i] * own[i].linear * b.force;
    const Vec3 torque_B = R_WB[i].transpose() * b.torque;
    u[i].tail<3>() += time[i] * (R_WB[i] * own[i].angular.cwiseProduct(torque_B));
  }
}

}  // namespace substep
