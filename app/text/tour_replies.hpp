#pragma once

#include "app/text/tour.hpp"

namespace substep {

// Feedback on the tasks of the steps: computed from the last pass of the loop, without constants.
TourReply reply_lighter_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_break_it(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_lose_less(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_range_of_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_double_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_heavier_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_changing_load(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_half_the_substeps(const Lab& lab, const RunLoop::Outcome& outcome);

}  // namespace substep
