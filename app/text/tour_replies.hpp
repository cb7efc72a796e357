#pragma once

#include "app/text/tour.hpp"

namespace substep {

// What the runs of the tour's steps answer: read from the last pass of the loop, never from a
// number that was written down.
TourReply reply_lighter_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_break_it(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_lose_less(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_range_of_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_double_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_heavier_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_half_the_substeps(const Lab& lab, const RunLoop::Outcome& outcome);

}  // namespace substep
