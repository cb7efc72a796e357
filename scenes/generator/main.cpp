// Writes the scene files: generate_scenes --out DIR

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/io/scene_writer.hpp"
#include "scenes/generator/scenes.hpp"

namespace {

int generate(int argc, char** argv) {
  if (argc != 3 || std::string_view(argv[1]) != "--out") {
    std::fputs(
        "usage: generate_scenes --out DIR\n"
        "Writes every shipped scene to DIR/NAME.json. Ropes and other variants:\n"
        "substep generate rope --links 100\n",
        stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[2];
  for (const substep::Scene& scene : substep::scenes::shipped()) {
    const std::filesystem::path path = folder / (scene.name + ".json");
    std::ofstream file(path, std::ios::binary);
    file << substep::write_scene(scene);
    if (!file.flush()) {
      std::fprintf(stderr, "cannot write %s\n", path.string().c_str());
      return 1;
    }
    std::printf("%s\n", path.string().c_str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return generate(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_scenes: %s\n", error.what());
    return 1;
  }
}
