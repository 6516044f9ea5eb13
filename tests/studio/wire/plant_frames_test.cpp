// What goes to the page of a plant: every number comes back, piece by piece as in one.
#include "studio/wire/plant_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/quaternion.hpp>

#include "render/model/radii.h"
#include "tests/support/small_vine.h"

namespace espalier::studio {
namespace {

using tests::kVineFrame;

/// Reads numbers as the page does.
class Reader {
 public:
  explicit Reader(std::string frame) : bytes_(std::move(frame)) {
    length = take<std::uint32_t>(1)[0];
    kind = take<std::uint32_t>(1)[0];
  }
  template <class T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> values(count);
    EXPECT_LE(at_ + count * sizeof(T), bytes_.size());
    std::memcpy(values.data(), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }
  bool atEnd() const { return at_ == bytes_.size(); }

  std::uint32_t length = 0, kind = 0;

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

TEST(PlantFrames, NodesComeBack) {
  const sim::Plant vine = tests::smallVine();
  const std::size_t total = vine.skeleton.parent.size();
  for (const std::size_t first : {std::size_t{0}, std::size_t{5}, total}) {
    Reader read(nodesFrame({7, 3, 9}, vine, kVineFrame, first));
    EXPECT_EQ(read.kind, 2u);
    const auto header = read.take<std::uint32_t>(6);
    const std::size_t count = total - first;
    EXPECT_EQ(header, (std::vector<std::uint32_t>{7, 3, static_cast<std::uint32_t>(first),
                                                  static_cast<std::uint32_t>(count),
                                                  static_cast<std::uint32_t>(total), 9}));
    const auto parents = read.take<std::int32_t>(count);
    const auto positions = read.take<float>(3 * count);
    const auto radii = read.take<float>(total);
    const auto born = read.take<std::uint16_t>(count);
    const auto orders = read.take<std::uint16_t>(count);
    const auto exposure = read.take<std::uint8_t>(count);
    EXPECT_TRUE(read.atEnd());
    const auto wanted = render::stemRadii(vine.skeleton, vine.girth);
    for (std::size_t n = 0; n < total; ++n) EXPECT_FLOAT_EQ(radii[n], 0.04f * wanted[n]);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t n = first + i;
      EXPECT_EQ(parents[i], vine.skeleton.parent[n]);
      EXPECT_EQ(born[i], vine.skeleton.born[n]);
      EXPECT_NEAR(exposure[i] / 255.0, vine.skeleton.columns.at("exposure")[n], 0.003);
      const sim::Vec3 at_m = sim::worldFromVoxel(kVineFrame, vine.skeleton.position_vx[n]);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(positions[3 * i + static_cast<std::size_t>(axis)], at_m[axis], 1e-6);
    }
  }
}

TEST(PlantFrames, ElementsStandAsTheyWerePlaced) {
  const sim::Plant vine = tests::smallVine();
  const auto whole = elementFrames({1, 0, 2}, vine, kVineFrame, 0);
  ASSERT_EQ(whole.size(), 1u);
  Reader read(whole[0]);
  EXPECT_EQ(read.kind, 3u);
  const std::size_t count = vine.elements.size();
  const auto header = read.take<std::uint32_t>(6);
  EXPECT_EQ(header, (std::vector<std::uint32_t>{1, 0, 0, 0, static_cast<std::uint32_t>(count), 2}));
  const auto positions = read.take<float>(3 * count);
  const auto scales = read.take<float>(count);
  const auto turns = read.take<std::int16_t>(4 * count);
  const auto born = read.take<std::uint16_t>(count);
  const auto exposure = read.take<std::uint8_t>(count);
  EXPECT_TRUE(read.atEnd());
  for (std::size_t e = 0; e < count; ++e) {
    const sim::PlacedElement& element = vine.elements[e];
    const double unit = 1.0 / 32767.0;
    const glm::dquat turn(turns[4 * e + 3] * unit, turns[4 * e] * unit, turns[4 * e + 1] * unit,
                          turns[4 * e + 2] * unit);
    const sim::Vec3 corner(0.3, 0.7, -0.1);
    const sim::Vec3 at_m(positions[3 * e], positions[3 * e + 1], positions[3 * e + 2]);
    const sim::Vec3 shown = at_m + static_cast<double>(scales[e]) * 0.04 * (turn * corner);
    const sim::Vec3 wanted = sim::worldFromVoxel(kVineFrame, sim::placed(element, corner));
    EXPECT_LT(glm::distance(shown, wanted), 1e-4);
    EXPECT_EQ(born[e], element.born);
    EXPECT_NEAR(exposure[e] / 255.0, element.exposure, 0.003);
  }
}

TEST(PlantFrames, OfAShapeOnlyWhatIsNewIsTold) {
  sim::Plant vine = tests::smallVine();
  vine.shapes.push_back(tests::keeledLeaf());
  for (std::size_t e = 0; e < vine.elements.size(); ++e) vine.elements[e].shape = e % 3 == 0 ? 1 : 0;
  EXPECT_EQ(elementFrames({1, 0, 2}, vine, kVineFrame, 0).size(), 2u);
  EXPECT_TRUE(elementFrames({1, 0, 2}, vine, kVineFrame, vine.elements.size()).empty());
  const std::size_t last = vine.elements.size() - 1;
  const auto one = elementFrames({1, 0, 2}, vine, kVineFrame, last);
  ASSERT_EQ(one.size(), 1u);
  Reader read(one[0]);
  const auto header = read.take<std::uint32_t>(6);
  const auto shape = static_cast<std::uint32_t>(vine.elements[last].shape);
  const auto before = static_cast<std::uint32_t>(std::count_if(
      vine.elements.begin(), vine.elements.end() - 1,
      [&](const sim::PlacedElement& e) { return e.shape == static_cast<std::int32_t>(shape); }));
  EXPECT_EQ(header, (std::vector<std::uint32_t>{1, 0, shape, before, 1, 2}));
}

}  // namespace
}  // namespace espalier::studio
