#include "core/import/mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/import/xml_numbers.hpp"

namespace substep {
namespace {

constexpr std::size_t kMostMeshCoordinates = 30'000'000;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) {
    word = (word << 8U) | static_cast<unsigned char>(bytes[at + i]);
  }
  return word;
}

double number_at(std::string_view bytes, std::size_t at) {
  const std::uint32_t word = word_at(bytes, at);
  float number = 0.0F;
  std::memcpy(&number, &word, sizeof number);
  return static_cast<double>(number);
}

std::vector<Vec3> points_of_stl(std::string_view content, std::string& fault) {
  constexpr std::size_t kHead = 84;
  constexpr std::size_t kTriangle = 50;
  constexpr std::size_t kNormal = 12;
  std::vector<Vec3> points;
  if (content.size() < kHead || (content.size() - kHead) / kTriangle < word_at(content, 80)) {
    fault = "it is no binary STL";
    return points;
  }
  const std::size_t triangles = word_at(content, 80);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3 point;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t at = kHead + t * kTriangle + kNormal + 12 * corner + 4 * i;
        point[static_cast<int>(i)] = number_at(content, at);
      }
      if (!point.allFinite()) {
        fault = "a coordinate is not finite";
        return {};
      }
      points.push_back(point);
    }
  }
  return points;
}

std::vector<Vec3> points_of_obj(std::string_view content, std::string& fault) {
  std::vector<Vec3> points;
  for (std::size_t start = 0; start < content.size();) {
    const std::size_t end = std::min(content.find('\n', start), content.size());
    const std::string_view line = content.substr(start, end - start);
    start = end + 1;
    if (!line.starts_with("v ")) continue;
    const auto numbers = numbers_of(line.substr(2), 7);
    if (!numbers || numbers->size() < 3) {
      fault = "a vertex has fewer than three numbers";
      return {};
    }
    points.emplace_back(numbers->data());
  }
  return points;
}

}  // namespace

std::vector<Vec3> points_of_text(std::string_view text, std::string& fault) {
  std::vector<Vec3> points;
  const auto numbers = numbers_of(text, kMostMeshCoordinates);
  if (!numbers || numbers->empty() || numbers->size() % 3 != 0) {
    fault = "its vertices are not triples of numbers";
    return points;
  }
  for (std::size_t i = 0; i < numbers->size(); i += 3) points.emplace_back(numbers->data() + i);
  return points;
}

std::vector<Vec3> points_of_file(std::string_view name, std::string_view content,
                                 std::string& fault) {
  const auto ends_in = [&](std::string_view end) {
    return name.size() >= end.size() && name.substr(name.size() - end.size()) == end;
  };
  if (ends_in(".stl") || ends_in(".STL")) return points_of_stl(content, fault);
  if (ends_in(".obj") || ends_in(".OBJ")) return points_of_obj(content, fault);
  fault = "'" + std::string(name) + "' is neither STL nor OBJ";
  return {};
}

}  // namespace substep
