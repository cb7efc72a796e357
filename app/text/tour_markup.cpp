// The markup of the tour's sentences.

#include "app/text/tour.hpp"

namespace substep {
namespace {

// The kind of markup at the start of a text: a number, a place, or neither. @param size of its
// markup [characters]
TourPart read_mark(std::string_view text, std::size_t& size) {
  size = 0;
  if (text.starts_with('{')) {
    const std::size_t end = text.find('}');
    if (end == std::string_view::npos) return {};
    size = end + 1;
    return {TourPart::Kind::kNumber, "", std::string(text.substr(1, end - 1))};
  }
  if (!text.starts_with('[')) return {};
  const std::size_t middle = text.find("](");
  const std::size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
  if (end == std::string_view::npos) return {};
  size = end + 1;
  return {TourPart::Kind::kPlace, std::string(text.substr(1, middle - 1)),
          std::string(text.substr(middle + 2, end - middle - 2))};
}

}  // namespace

std::vector<TourPart> tour_parts(std::string_view sentence) {
  std::vector<TourPart> parts;
  std::string plain;
  const auto end_plain = [&] {
    if (!plain.empty()) parts.push_back({TourPart::Kind::kText, plain, ""});
    plain.clear();
  };
  while (!sentence.empty()) {
    std::size_t size = 0;
    TourPart mark = read_mark(sentence, size);
    if (size > 0) {
      end_plain();
      parts.push_back(std::move(mark));
    } else {
      plain += sentence.front();
      size = 1;
    }
    sentence.remove_prefix(size);
  }
  end_plain();
  return parts;
}

}  // namespace substep
