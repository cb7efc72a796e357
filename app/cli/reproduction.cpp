#include "app/cli/reproduction.hpp"

#include "app/cli/reproduction_cards.hpp"

namespace substep::cli {
namespace {

struct Part {
  const char* name;
  Card (*run)(const Reproduction&);
};
constexpr Part kParts[] = {{"Fig. 2", substeps_over_time},
                           {"Fig. 3", energy_over_time},
                           {"Fig. 4", heavy_stack},
                           {"explosion", explosion},
                           {"alpha", alpha_law},
                           {"Gauss-Seidel", gauss_seidel},
                           {"bridge", bridge},
                           {"taller stack", taller_stack},
                           {"cap", capped}};

}  // namespace

std::vector<Card> reproduce(const Reproduction& options) {
  std::vector<Card> cards;
  for (const Part& part : kParts) {
    if (*options.cancelled) break;
    options.on_card(cards.size(), std::size(kParts), part.name);
    cards.push_back(part.run(options));
  }
  return cards;
}

}  // namespace substep::cli
