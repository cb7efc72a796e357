#include "scenes/generator/exam.hpp"

#include "scenes/generator/exam_contact.hpp"

namespace substep::scenes {
const std::vector<ExamEntry>& exam() {
  static const std::vector<ExamEntry> entries{
      {"simple_pendulum", "IFToMM A01, simple pendulum", exam_simple_pendulum},
      {"four_bar", "IFToMM A02, double four-bar", exam_four_bar},
      {"bricard", "IFToMM A04, Bricard's mechanism", exam_bricard},
      {"squeezer", "IFToMM A03, Andrews' squeezing mechanism", exam_squeezer},
      {"revolute", "Revolute joint, commercial code", exam_revolute},
      {"spherical", "Spherical joint, commercial code", exam_spherical},
      {"distance", "Distance joint, commercial code", exam_distance},
      {"universal", "Universal joint, commercial code", exam_universal},
      {"cylindrical", "Cylindrical joint, commercial code", exam_cylindrical},
      {"heavy_top", "Heavy top at 150 rad/s", exam_heavy_top},
      {"symmetric_body", "Free body with two equal moments", exam_symmetric_body},
      {"tumbling", "Free body about its intermediate axis (Dzhanibekov)", exam_tumbling},
      {"rolling", "SimBenchmark, rolling along an axis", exam_rolling},
      {"rolling_oblique", "SimBenchmark, rolling at 60 degrees", exam_rolling_oblique},
      {"bouncing", "SimBenchmark, bouncing", exam_bouncing},
      {"spheres_666", "SimBenchmark, 666 spheres", exam_spheres},
      {"elastic_666", "SimBenchmark, elastic 666 spheres", exam_elastic_spheres},
      {"compliant_ball", "Ball on a lossless ground", exam_compliant_ball},
      {"soft_clutter", "Soft clutter", exam_soft_clutter},
      {"hard_clutter", "Hard clutter", exam_hard_clutter},
  };
  return entries;
}

}  // namespace substep::scenes
