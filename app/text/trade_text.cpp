#include "app/text/trade_text.hpp"

#include <algorithm>

#include "app/text/format.hpp"

namespace substep {
namespace {

constexpr double kAsMany = 1.05;  // ratios between its inverse and this are "as many"

int n_of(const Result& constant) { return constant.experiment.settings.n; }

/// "3.3 times as many", "as many"; at_least: "at least 3.3 times as many".
std::string times_as_many(double ratio, bool at_least) {
  if (ratio > 1.0 / kAsMany && ratio < kAsMany) return at_least ? "at least as many" : "as many";
  return (at_least ? "at least " : "") + coarse_number(ratio) + " times as many";
}

std::string failing(const FairTrade& trade) {
  const auto failed = std::find_if(trade.rows.begin(), trade.rows.end(), [](const TradeRow& row) {
    return !row.adaptive->metrics.holds;
  });
  const std::string alpha = "With alpha = " + plain_number(trade.alpha) + " adaptive sub-stepping ";
  if (trade.rows.size() == 1) return alpha + "fails here. Choose a smaller alpha.";
  const std::string load =
      failed->load == 1.0 ? "the scene's own load" : plain_number(failed->load) + " times the load";
  return alpha + "fails under " + load + ". Choose a smaller alpha.";
}

std::string of_one_load(const FairTrade& trade) {
  const TradeRow& row = trade.rows.front();
  const std::string start = "Adaptive sub-stepping takes " + coarse_number(row.n()) +
                            " sub-steps per frame on average. The smallest constant N " +
                            as_accurate(trade) + " is ";
  const bool known = row.constant != nullptr;
  const int least = 1 + (known ? row.too_few : std::max(row.too_few, trade.most_n));
  const bool exactly = known && least == n_of(*row.constant);
  return start + trade_number(row, trade.most_n) + ": " + times_as_many(least / row.n(), !exactly) +
         ".";
}

}  // namespace

const char* as_accurate(const FairTrade& trade) {
  switch (trade.axis) {
    case ErrorAxis::kGap:
      return "with as small a joint gap";
    case ErrorAxis::kPenetration:
      return "with as small an overlap";
    case ErrorAxis::kEnergy:
      return "with as small an energy drift";
    default:
      return "that is as accurate";
  }
}

std::string trade_number(const TradeRow& row, int most_n) {
  if (row.constant == nullptr) return "more than " + std::to_string(std::max(row.too_few, most_n));
  const int n = n_of(*row.constant);
  if (row.too_few + 1 >= n) return std::to_string(n);
  return std::to_string(row.too_few + 1) + " to " + std::to_string(n);
}

std::string trade_text(const FairTrade& trade) {
  if (trade.rows.empty()) return "";
  if (!trade.holds()) return failing(trade);
  if (trade.rows.size() == 1) return of_one_load(trade);
  const double mean = trade.mean_n();
  const std::string n =
      trade.for_all ? std::to_string(*trade.for_all) : "more than " + std::to_string(trade.most_n);
  return "Adaptive sub-stepping takes " + coarse_number(mean) +
         " sub-steps per frame, averaged over these loads. A constant N " + as_accurate(trade) +
         " under all of them is " + n + ": " +
         times_as_many((trade.for_all ? *trade.for_all : trade.most_n + 1) / mean, !trade.for_all) +
         ".";
}

}  // namespace substep
