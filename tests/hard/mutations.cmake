# Mutation tests: each removes one feature that keeps hard cases stable, and a test that passes with it
# must fail.
#
# substep_mutation(NAME SOURCE TAKEN LEFT TESTS TEST): links the objects of the program TESTS with a
# changed SOURCE, ahead of the library with the original; its TEST must fail.
function(substep_mutation name source taken left tests test)
  set(mutant ${CMAKE_CURRENT_BINARY_DIR}/mutants/${name}.cpp)
  add_custom_command(OUTPUT ${mutant}
    COMMAND ${CMAKE_COMMAND} -D INPUT=${PROJECT_SOURCE_DIR}/${source} -D OUTPUT=${mutant}
            -D "TAKEN=${taken}" -D "LEFT=${left}" -P ${CMAKE_CURRENT_SOURCE_DIR}/mutate.cmake
    DEPENDS ${PROJECT_SOURCE_DIR}/${source} ${CMAKE_CURRENT_SOURCE_DIR}/mutate.cmake
    COMMENT "Changing ${source}" VERBATIM)
  # Not in a unity build: the other files of the unit would be linked twice.
  set_source_files_properties(${PROJECT_SOURCE_DIR}/${source} TARGET_DIRECTORY substep_core
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(without_${name} ${mutant} $<TARGET_OBJECTS:${tests}>)
  target_compile_options(without_${name} PRIVATE -w)  # functions without callers are intended
  target_link_libraries(without_${name} PRIVATE substep_core substep_scenes GTest::gtest_main)
  add_test(NAME Mutations.ATestFailsWithout_${name}
    COMMAND without_${name} --gtest_filter=${test} --gtest_color=no)
  set_tests_properties(Mutations.ATestFailsWithout_${name} PROPERTIES LABELS hard
    PASS_REGULAR_EXPRESSION "\n\\[  FAILED  \\] ${test} ")
endfunction()

substep_mutation(the_probe core/sim/frame.cpp "if \\(probe_due\\(\\)\\) probe\\(report\\);" ""
  paper_tests HeavyStackStress.SixteenAndAdaptiveStandTenSeconds)
substep_mutation(the_cap_of_N core/stepping/substep_clock.cpp
  "std::min\\((wanted_substeps\\(rest_, dt_max\\)), limit - taken_\\)" "\\1"
  unit_tests SubstepClock.NeverExceedsTheCap)
substep_mutation(outer_friction_passes core/solver/bpp.cpp "kPasses = [0-9]+" "kPasses = 1"
  physics_tests Solves.AreAllComplementary)
substep_mutation(compliance_on_redundant_rows core/sim/substep.cpp
  "block\\.C\\[row\\] \\* per_dt2" "0.0 * per_dt2"
  paper_tests HeavyStack.FallsWithContactComplianceAtAnyStep)
substep_mutation(soft_drift_with_PGS core/stepping/drift.cpp "law == Drift::kSoft && dt < tau" "false"
  paper_tests SwingingBoxPgs.AdaptiveHoldsWithTheSoftDriftLaw)
substep_mutation(the_diagonal_in_Newtons_mass core/solver/newton.cpp
  "k\\.cwiseMax\\(0\\.0\\)" "(0.0 * k)" paper_tests NewtonAtTheEnd.StandsAtOneSubstepAndDamps)
substep_mutation(the_principal_frame_diagonal core/constraints/stiffness_matrix.cpp
  "columns \\* R\\)" "columns * Mat3::Identity())"
  physics_tests Invariance.TurnedWithGravitySubstepsAndMotionAreTheSame)
