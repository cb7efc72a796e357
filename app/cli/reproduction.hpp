#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/io/json.hpp"

namespace substep::cli {

/// A figure or claim of the paper and our result.
struct Card {
  std::string title;
  std::string paper;    // the paper's statement
  std::string here;     // our result
  std::string why;      // reason for a difference
  std::string command;  // command line that reproduces it
  enum class Outcome { kAgrees, kDiffers, kFails } outcome = Outcome::kFails;
  std::vector<Json> charts;  // chart_json
};

struct Reproduction {
  int jobs = 1;
  const std::atomic<bool>* cancelled = nullptr;
  /// Called before each card with its number, from 0, the number of cards and its name.
  std::function<void(std::size_t, std::size_t, const std::string&)> on_card;
};

/// Runs Figs. 2, 3 and 4 of Giles and Andrews (MIG '24) and the paper's claims in words.
std::vector<Card> reproduce(const Reproduction& options);

}  // namespace substep::cli
