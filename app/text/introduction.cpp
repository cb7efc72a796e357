#include "app/text/introduction.hpp"

#include "app/text/citation.hpp"
#include "app/text/format.hpp"

namespace substep {

IntroductionWords introduction_words(const Lab& lab) {
  IntroductionWords words;
  words.claim =
      "1,000 kg on a chain of 25 links of 1 kg, simulated live, twice. Only the number of steps "
      "per "
      "frame differs.";
  words.paper = std::string("After “") + kPaperTitle + "”, " + kPaperAuthors;
  words.torn.title = "One step per frame";
  const Verdict* verdict = Introduction::torn(lab);
  const bool torn = verdict != nullptr && !verdict->holds();
  words.torn.note = torn ? "Torn at " + fixed(verdict->failed_at(), 2) + " s: the step is too long"
                         : "The step is too long for this stiff chain";
  words.held.title = "Adaptive: N sub-steps";
  const int n = lab.session.report().n_substeps;
  if (n > 0) words.held.title += ", now " + std::to_string(n);
  words.held.note = "It holds: the forces in the chain set N, frame by frame";
  words.clock = fixed(lab.session.state().time, 2) + " s";
  if (lab.session.speed() < 1.0) words.clock += ", slow motion";
  return words;
}

}  // namespace substep
