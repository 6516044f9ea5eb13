#pragma once
#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "studio/session/hub.h"
#include "tests/support/scratch.h"

/// A wall on a floor with two vines, which grow in an instant; and somebody who listens to the studio.
namespace espalier::tests {

inline constexpr const char* kSmallMesh = R"(
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 0 0
v 1 0 0
v 1 1 0
v -1 1 0
g ground
f 1 4 3 2
g wall
f 5 6 7 8
)";

inline constexpr const char* kSmallScene = R"(espalier: scene
name: small
meshes:
  - {file: plot.obj, solid: false}
world: {voxel: 5 cm, bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.5, 1.1]}}   # coarse
plants:
  - name: vine
    rules: vine.yaml
    seeds:
      - [-0.4, 0.1, 0.1]  # left
      - {at: [0.3, 0.1, 0.1], key: right}
iterations: 14
seed: 5
image: {width: 160, height: 120}
cameras:
  main: {eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0]}
images: [vines]
)";

inline constexpr const char* kSmallRules = R"(espalier: rules
name: vine
random_tree: {length: 2.4, branch_age_range: [1, 3], branch_angle: 60}
bias: {up: 0.1}      # how far up
require:
  proximity: {max: 3}
light: {boost: 1.8}
elements:
  - name: leaf
    per_segment: 1
    size: 1.2
    colour: "#4f7a2c"
    polygons: [[[0, 0, 0], [-.3, .4, -.1], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [.3, .4, -.1]]]
)";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class SmallProject : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("plot.obj", kSmallMesh);
    scratch_.write("vine.yaml", kSmallRules);
    scratch_.write("scene.yaml", kSmallScene);
  }

  Scratch scratch_;
};

/// Frames as they come to a page.
class Heard {
 public:
  struct Frame {
    int kind = 0;
    std::string payload;
  };

  explicit Heard(std::shared_ptr<studio::Listener> listener) : listener_(std::move(listener)) {}

  /// Listens until an event of that name and version comes for which it holds. Null, and a failure, if none
  /// does within a long time.
  nlohmann::json until(
      const std::string& name, std::uint32_t version,
      const std::function<bool(const nlohmann::json&)>& holds = [](const auto&) { return true; }) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      const auto bytes = listener_->next(std::chrono::milliseconds(100));
      if (!bytes) break;
      if (bytes->empty()) continue;
      std::uint32_t words[2];
      std::memcpy(words, bytes->data(), 8);
      EXPECT_EQ(words[0], bytes->size() - 8);
      frames.push_back({static_cast<int>(words[1]), bytes->substr(8)});
      if (frames.back().kind != 1) continue;
      auto event = nlohmann::json::parse(frames.back().payload);
      if (event["event"] == name && event["version"] == version && holds(event)) return event;
    }
    ADD_FAILURE() << "no event " << name << " of version " << version;
    return nullptr;
  }

  nlohmann::json grown(std::uint32_t version) {
    return until("growth", version, [](const auto& event) { return event["done"].template get<bool>(); });
  }

  std::vector<Frame> frames;

 private:
  std::shared_ptr<studio::Listener> listener_;
};

}  // namespace espalier::tests
