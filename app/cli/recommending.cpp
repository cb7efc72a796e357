#include "app/cli/recommending.hpp"

#include <algorithm>
#include <utility>

#include "app/cli/all_methods.hpp"

namespace substep::cli {

std::optional<HoldSearch> searched(const Question& question, std::vector<Result> candidates,
                                   const Reference& reference) {
  HoldSearch search(question.scene, std::move(candidates), question.whole, reference,
                    [want = question.want](const Result& result) { return want.is_met(result); });
  return complete(search, *question.scene) ? std::optional(std::move(search)) : std::nullopt;
}

std::optional<Answer> answer_to(const Question& question, Reference reference) {
  Answer answer;
  answer.reference = std::move(reference);
  auto results = run_all_methods(question.scene, question.compared, question.jobs, answer.reference,
                                 question.defaults);
  if (!results) return std::nullopt;
  answer.results = std::move(*results);
  const Want& want = question.want;
  // Errors below the uncertainty are equal.
  const double floor = want.of_path() && !want.error_is_given ? answer.reference.uncertainty : 0.0;
  const auto points = run_points(answer.results, want.error, want.cost, floor);
  for (const RunPoint& point : want.best_first(points)) {
    answer.candidates.push_back(answer.results[point.result]);
  }
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&](const RunPoint& p, const RunPoint& q) {
        return want.error_is_given ? p.error < q.error : p.cost < q.cost;
      });
  if (nearest != points.end()) answer.nearest = answer.results[nearest->result];
  const auto search = searched(question, answer.candidates, answer.reference);
  if (!search) return std::nullopt;
  answer.failed = search->failed();
  answer.found = search->found();
  return answer;
}

std::optional<Reference> reference_for(const Question& question) {
  if (!question.want.of_path()) return no_reference();
  return find_reference(question.scene, question.compared, question.want.required());
}

}  // namespace substep::cli
