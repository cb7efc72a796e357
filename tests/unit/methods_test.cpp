// The table of methods: every entry must exist.

#include "core/model/methods.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "core/model/names.hpp"
#include "core/model/setting_fields.hpp"
#include "core/solver/solver.hpp"

namespace substep {
namespace {

void expect_settings(const SettingNames& names) {
  for (const std::string_view name : names) {
    EXPECT_TRUE(name.empty() || find_setting(name) != nullptr) << name;
  }
}

// The tables assert this: one with a method left out, or a solver that nothing makes, does not
// compile.
TEST(Methods, ATableWithAMissingEntryDoesNotCompile) {
  constexpr auto without = [](auto table, auto change) {
    change(table);
    return is_complete(table);
  };
  static_assert(without(kModes, [](auto&) {}));
  static_assert(!without(kModes, [](auto& table) { table.back() = {}; }));
  static_assert(!without(kModes, [](auto& table) { std::swap(table[0], table[1]); }));
  static_assert(!std::is_default_constructible_v<SolverEntry>, "what makes the solver");
  static_assert(!std::is_constructible_v<decltype(SolverEntry::make), std::nullptr_t>);
  static_assert(!without(kIntegrators, [](auto& table) { table[1].name = ""; }));
}

TEST(Methods, ReadSettingsThatExist) {
  for (const SolverEntry& entry : kSolvers) expect_settings(entry.reads);
  for (const ModeEntry& entry : kModes) expect_settings(entry.reads);
}

TEST(Methods, CaptionsNameSettingsThatTheModeReads) {
  for (const ModeEntry& mode : kModes) {
    for (const char* text : {mode.caption, mode.takes}) {
      const std::string_view caption = text == nullptr ? "" : text;
      for (std::size_t open = caption.find('{'); open != std::string_view::npos;
           open = caption.find('{', open + 1)) {
        const std::string_view name = caption.substr(open + 1, caption.find('}', open) - open - 1);
        EXPECT_TRUE(reads(PaperSettings{.mode = mode.value}, name)) << caption;
      }
    }
  }
}

TEST(Methods, EverySolverOfTheTableCanBeMadeAndIsListedOnce) {
  std::set<SolverKind> listed;
  for (const SolverKind solver : listed_solvers()) listed.insert(solver);
  EXPECT_EQ(listed.size(), kSolvers.size());
  for (const SolverEntry& entry : kSolvers) {
    EXPECT_NE(make_solver(entry.value), nullptr) << entry.title;
    EXPECT_EQ(value_of<SolverKind>(entry.name), entry.value);
    EXPECT_EQ(entry.iterations > 0, reads(PaperSettings{.solver = entry.value}, "iterations"));
  }
}

}  // namespace
}  // namespace substep
