#!/usr/bin/env bash
# Takes out of the source, one at a time, what keeps hard cases stable, and expects a named test to
# fail each time: mutations.sh SOURCE BUILD. SOURCE is copied to BUILD/source and never changed.
set -euo pipefail
source=${1:?source folder}
build=${2:?build folder}
mkdir -p "$build"
build=$(cd "$build" && pwd)
copy=$build/source
tree=$copy/build/release  # as deep as the usual one: then ccache knows what is not changed
failures=0
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_SLOPPINESS=pch_defines,time_macros
fi

# A copy of what git knows or would add, with times kept, so that only what changed is built again.
copy_source() {
  mkdir -p "$copy"
  (cd "$source" && git ls-files -z --cached --others --exclude-standard -- \
    CMakeLists.txt core scenes tests/CMakeLists.txt tests/unit tests/physics tests/paper \
    tests/support tests/reference | tar --null --ignore-failed-read -cT - 2>/dev/null) |
    tar -x -C "$copy"
  cmake -S "$copy" -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUBSTEP_APP=OFF \
    -DSUBSTEP_TESTS=ON >"$build/configure.log"
}

build_tests() { cmake --build "$tree" --target "$@" >"$build/build.log" 2>&1; }

program() { find "$tree/tests" -name "$1" -type f -perm -u+x; }

# mutate NAME FILE SED-SCRIPT PROGRAM TEST
mutate() {
  local name=$1 file=$copy/$2 script=$3 tests=$4 test=$5
  cp -p "$file" "$build/original"
  sed -E -i "$script" "$file"
  if cmp -s "$file" "$build/original"; then
    echo "FAILED $name: nothing to take out in $2; mend the script"
    failures=$((failures + 1))
    return
  fi
  if ! build_tests "$tests"; then
    echo "FAILED $name: does not build"
    tail -n 20 "$build/build.log"
    failures=$((failures + 1))
  elif "$(program "$tests")" --gtest_filter="$test" >"$build/test.log" 2>&1; then
    echo "FAILED $name: $test passes without it"
    failures=$((failures + 1))
  elif grep -q '^\[  FAILED  \]' "$build/test.log"; then
    echo "ok     $name: $test fails without it"
  else
    echo "FAILED $name: $test did not run"
    failures=$((failures + 1))
  fi
  cp "$build/original" "$file"  # newer than what was built of it
}

copy_source
build_tests unit_tests physics_tests paper_tests
for pair in unit_tests:SubstepClock.NeverPassesTheCapWhateverItIs \
  physics_tests:Solves.AreAllComplementary \
  physics_tests:Invariance.TurnedWithGravitySubstepsAndMotionAreTheSame \
  paper_tests:HeavyStackStress.SixteenAndAdaptiveStandTenSeconds \
  paper_tests:HeavyStack.ContactComplianceFallsWhateverTheSteps \
  paper_tests:SwingingBoxPgs.AdaptiveHoldsWithTheSoftDriftLaw; do
  "$(program "${pair%%:*}")" --gtest_filter="${pair#*:}" >"$build/test.log" 2>&1 || {
    echo "FAILED ${pair#*:} fails as it stands"
    exit 1
  }
done

mutate "the probe" core/sim/setup.cpp 's/if \(probe_due\(\)\) probe\(report\);//' \
  paper_tests HeavyStackStress.SixteenAndAdaptiveStandTenSeconds
mutate "the cap of N" core/stepping/substep_clock.cpp \
  's/std::min\(wanted_substeps\(rest_, dt_max\), limit_ - taken_\)/wanted_substeps(rest_, dt_max)/' \
  unit_tests SubstepClock.NeverPassesTheCapWhateverItIs
mutate "outer friction passes" core/solver/bpp.cpp 's/kPasses = [0-9]+/kPasses = 1/' \
  physics_tests Solves.AreAllComplementary
mutate "compliance on redundant rows" core/sim/substep.cpp \
  's/block\.C\[row\] \* per_dt2/0.0 * per_dt2/' \
  paper_tests HeavyStack.ContactComplianceFallsWhateverTheSteps
mutate "soft drift with PGS" core/sim/substep.cpp 's/drift_law\(settings\)/Drift::kFull/' \
  paper_tests SwingingBoxPgs.AdaptiveHoldsWithTheSoftDriftLaw
mutate "the principal-frame diagonal" core/constraints/stiffness_matrix.cpp 's/(Cols<3>\(\)) \* R;/\1 * Mat3::Identity();/' \
  physics_tests Invariance.TurnedWithGravitySubstepsAndMotionAreTheSame
exit $((failures > 0))
