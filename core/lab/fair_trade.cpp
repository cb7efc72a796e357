#include "core/lab/fair_trade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/lab/axes.hpp"
#include "core/lab/experiment.hpp"
#include "core/lab/sweep.hpp"

namespace substep {
namespace {

constexpr double kAsAccurate = 1.05;  // ratio of errors
constexpr std::array kAxes{ErrorAxis::kGap, ErrorAxis::kPenetration, ErrorAxis::kEnergy};

using Column = std::map<double, const Result*>;  // by the method's parameter
using Columns = std::map<double, Column>;        // by load

Columns columns_of(std::span<const Result> results, const Settings& method) {
  const std::string name = series_name(method);
  Columns columns;
  for (const Result& result : results) {
    const Experiment& e = result.experiment;
    if (series_name(e.settings) != name) continue;
    columns[e.load][series_parameter(e.settings).value] = &result;
  }
  return columns;
}

/// The parameters that ran under every load.
std::vector<double> common(const Columns& columns) {
  std::vector<double> all;
  if (columns.empty()) return all;
  for (const auto& [value, result] : columns.begin()->second) {
    const bool everywhere = std::all_of(columns.begin(), columns.end(), [v = value](const auto& c) {
      return c.second.contains(v);
    });
    if (everywhere) all.push_back(value);
  }
  return all;
}

/// The first error that any run has.
ErrorAxis axis_of(const Columns& columns) {
  for (const ErrorAxis axis : kAxes) {
    for (const auto& [load, column] : columns) {
      for (const auto& [value, result] : column) {
        if (error_of(*result, axis)) return axis;
      }
    }
  }
  return ErrorAxis::kEnergy;
}

double error(const Result& result, ErrorAxis axis) {
  return error_of(result, axis).value_or(std::numeric_limits<double>::infinity());
}

bool is_enough(const Result& constant, const Result& adaptive, ErrorAxis axis) {
  return constant.metrics.holds && error(constant, axis) <= kAsAccurate * error(adaptive, axis);
}

TradeRow row_of(double load, const Result& adaptive, const Column& constants, ErrorAxis axis) {
  TradeRow row{load, &adaptive};
  if (!adaptive.metrics.holds) return row;
  for (const auto& [n, constant] : constants) {
    if (is_enough(*constant, adaptive, axis)) {
      row.constant = constant;
      break;
    }
    row.too_few = static_cast<int>(n);
  }
  return row;
}

bool is_on_map(double alpha) {
  const std::span<const double> shown = map_alphas();
  return std::find(shown.begin(), shown.end(), alpha) != shown.end();
}

/// By their ratio.
double nearest(const std::vector<double>& alphas, double wanted) {
  const auto distance = [&](double alpha) { return std::abs(std::log(alpha / wanted)); };
  return *std::min_element(alphas.begin(), alphas.end(),
                           [&](double a, double b) { return distance(a) < distance(b); });
}

}  // namespace

double TradeRow::n() const { return cost_of(*adaptive, CostAxis::kSubsteps); }

double FairTrade::mean_n() const {
  double sum = 0.0;
  for (const TradeRow& row : rows) sum += row.n();
  return rows.empty() ? 0.0 : sum / static_cast<double>(rows.size());
}

bool FairTrade::holds() const {
  return std::all_of(rows.begin(), rows.end(),
                     [](const TradeRow& row) { return row.adaptive->metrics.holds; });
}

FairTrade fair_trade(const Scene& scene, std::span<const Result> results, Policy policy,
                     double alpha) {
  Settings method = paper_settings(scene);
  method.policy = policy;
  const Columns adaptive = columns_of(results, method);
  method.mode = Mode::kConst;
  const Columns constant = columns_of(results, method);
  FairTrade trade;
  trade.axis = axis_of(adaptive);
  trade.alphas = common(adaptive);
  std::erase_if(trade.alphas, [](double value) { return !is_on_map(value); });
  if (trade.alphas.empty()) return trade;
  trade.alpha = nearest(trade.alphas, alpha);
  for (const auto& [load, column] : adaptive) {
    const auto beside = constant.find(load);
    if (beside == constant.end()) continue;
    trade.rows.push_back(row_of(load, *column.at(trade.alpha), beside->second, trade.axis));
  }
  if (trade.rows.empty()) return trade;
  for (const double n : common(constant)) {
    trade.most_n = static_cast<int>(n);
    const auto enough_in = [&](const TradeRow& row) {
      return row.adaptive->metrics.holds &&
             is_enough(*constant.at(row.load).at(n), *row.adaptive, trade.axis);
    };
    if (!trade.for_all && std::all_of(trade.rows.begin(), trade.rows.end(), enough_in)) {
      trade.for_all = static_cast<int>(n);
    }
  }
  return trade;
}

}  // namespace substep
