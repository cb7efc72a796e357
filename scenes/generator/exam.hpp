#pragma once
// The exam's cases (core/lab/exam.hpp): scenes in code and their references.

#include <vector>

#include "core/lab/exam.hpp"

namespace substep::scenes {

/// All cases in the order of the exam's table, including those that scenes cannot express.
const std::vector<ExamEntry>& exam();

// Joints: exam_pendulums.cpp, exam_linkages.cpp
ExamCase exam_simple_pendulum();
ExamCase exam_revolute();
ExamCase exam_spherical();
ExamCase exam_distance();
ExamCase exam_universal();
ExamCase exam_cylindrical();
ExamCase exam_four_bar();
ExamCase exam_bricard();
ExamCase exam_squeezer();

// Rotation: exam_rotation.cpp
ExamCase exam_heavy_top();
ExamCase exam_symmetric_body();
ExamCase exam_tumbling();

// Contact: exam_rolling.cpp, exam_spheres.cpp, exam_compliant.cpp
ExamCase exam_rolling();
ExamCase exam_rolling_oblique();
ExamCase exam_bouncing();
ExamCase exam_spheres();
ExamCase exam_elastic_spheres();
ExamCase exam_compliant_ball();
ExamCase exam_soft_clutter();
ExamCase exam_hard_clutter();

}  // namespace substep::scenes
