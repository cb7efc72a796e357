#pragma once

namespace substep {

// Purpose, paper and licence as shown in the window; keep consistent with core/docs/references.bib
// and LICENSE.
inline constexpr const char* kPurpose = "A laboratory for stable constrained rigid bodies";
inline constexpr const char* kPaperTitle =
    "Adaptive Sub-stepping for Constrained Rigid Body Simulations";
inline constexpr const char* kPaperAuthors = "C. Giles and S. Andrews, MIG '24";
inline constexpr const char* kPaperDoi = "10.1145/3677388.3696331";
inline constexpr const char* kLicence = "MIT licence, © 2026 The substep authors";

/// The paper's BibTeX entry.
inline constexpr const char* kPaperBibtex = R"(@inproceedings{giles2024,
  author = {Giles, Chris and Andrews, Sheldon},
  title = {Adaptive Sub-stepping for Constrained Rigid Body Simulations},
  booktitle = {The 16th ACM SIGGRAPH Conference on Motion, Interaction, and Games (MIG '24)},
  year = {2024},
  doi = {10.1145/3677388.3696331}
}
)";

}  // namespace substep
