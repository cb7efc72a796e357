#include "app/imgui/complaints.hpp"

#include <cstdio>
#include <cstring>

namespace substep::imgui {
namespace {

constexpr int kMostTold = 20;  // a faulty window fails in every frame
int count = 0;

}  // namespace

void complain(const char* broken, const char* file, int line) {
  if (++count > kMostTold) return;
  const char* name = std::strrchr(file, '/');
  std::fprintf(stderr, "Dear ImGui, %s:%d: %s\n", name ? name + 1 : file, line, broken);
}

int complaints() { return count; }

}  // namespace substep::imgui
