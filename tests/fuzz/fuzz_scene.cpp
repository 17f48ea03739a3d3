// Any bytes are a scene that is refused with a place in it, or one that survives being written and read again.

#include <skein/scene/scene_file.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, const std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  skein::SceneConfig scene;
  try {
    scene = skein::read_scene_text(text, "scene.toml", {}).config;
  } catch (const skein::SceneError& error) {
    if (error.problems().empty()) std::abort();
    for (const skein::Problem& problem : error.problems())
      if (problem.where.line < 1 || problem.where.column < 1 || problem.message.empty()) std::abort();
    return 0;
  }
  const std::string written = skein::write_scene(scene);
  if (skein::write_scene(skein::read_scene_text(written, "scene.toml", {}).config) != written) std::abort();
  return 0;
}
