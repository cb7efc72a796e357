#pragma once

#include <string>

#include "core/lab/fair_trade.hpp"

namespace substep {

/// "with as small a joint gap", for a constant N whose error is at most that of adaptive sub-steps.
const char* as_accurate(const FairTrade& trade);
/// The number of constant sub-steps that is as accurate: "7", "9 to 10" if the values between the
/// two that ran are unknown, "more than 24" if none that ran is enough.
std::string trade_number(const TradeRow& row, int most_n);

/// The comparison in one to three sentences: what adaptive sub-stepping takes, what the best
/// constant N takes, under this load or under all loads.
std::string trade_text(const FairTrade& trade);

}  // namespace substep
