// The law of the sky's error, held against places with known surroundings: streets, courts, corners, towns of
// boxes and walls in them. The boxes are exact, so that only the directions err.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/light/sky.h"
#include "sim/world/field.h"

namespace espalier {
namespace {

using sim::Vec3;
using sim::Weighting;

constexpr std::array kWeightings{Weighting::uniform, Weighting::cosine, Weighting::cie_overcast};

struct Box {
  Vec3 low, high;
};

/// A place at the origin; what surrounds it is turned about the vertical.
struct Place {
  std::vector<Box> boxes;
  double cosine = 1.0, sine = 0.0;
  Vec3 normal{0, 1, 0};

  bool open(Vec3 d) const {
    const Vec3 turned(cosine * d.x + sine * d.z, d.y, -sine * d.x + cosine * d.z);
    for (const Box& box : boxes) {
      double enter = 0.0, leave = 1e30;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = box.low[axis] / turned[axis], b = box.high[axis] / turned[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter < leave) return false;
    }
    return true;
  }
};

/// Every second place stands along the axes, as walls in voxel worlds do; the others at any angle.
std::vector<Place> places(int count) {
  std::mt19937 random(3);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) * 0x1p-32;
  };
  constexpr double kFar = 1000.0;
  std::vector<Place> all;
  for (int i = 0; i < count; ++i) {
    Place place;
    const double x = within(0.02, 0.98), z = within(0.02, 0.98);
    const double height = std::exp(within(std::log(0.2), std::log(4.0)));
    if (i % 4 == 0) {  // a street
      place.boxes = {{{-x - 1, -1, -kFar}, {-x, height, kFar}}, {{1 - x, -1, -kFar}, {2 - x, height, kFar}}};
    } else if (i % 4 == 1) {  // a court
      place.boxes = {{{-x - 1, -1, -9}, {-x, height, 9}},
                     {{1 - x, -1, -9}, {2 - x, height, 9}},
                     {{-9, -1, -z - 1}, {9, height, -z}},
                     {{-9, -1, 1 - z}, {9, height, 2 - z}}};
    } else {  // a town; in every other one the place is on a wall
      while (place.boxes.size() < 12) {
        const Vec3 centre(within(-3, 3), 0, within(-3, 3)), half(within(0.2, 0.8), 0, within(0.2, 0.8));
        const Box box{{centre.x - half.x, -1, centre.z - half.z},
                      {centre.x + half.x, within(0.2, 4.0), centre.z + half.z}};
        if (box.low.x < 0.05 && box.high.x > -0.05 && box.low.z < 0.05 && box.high.z > -0.05) continue;
        place.boxes.push_back(box);
      }
      if (i % 4 == 3) place.boxes.push_back({{-1, -1, -2}, {-0.01, 3, 2}});
    }
    const double turn = i / 4 % 2 == 0 ? 0.0 : within(0.0, 2.0 * std::numbers::pi);
    place.cosine = std::cos(turn);
    place.sine = std::sin(turn);
    if (i % 4 == 3) place.normal = {place.cosine, 0, place.sine};
    all.push_back(place);
  }
  return all;
}

using Exposures = std::array<double, kWeightings.size()>;

/// Adds what an open direction with this share gives.
void add(Exposures& to, Vec3 unit, double share, const Place& place) {
  for (std::size_t w = 0; w < to.size(); ++w)
    to[w] += share * sim::received(kWeightings[w], unit, place.normal);
}

Exposures truth(const Place& place) {
  constexpr int kPoints = 16'000;
  Exposures sums{};
  for (int i = 0; i < kPoints; ++i) {
    const double y = (i + 0.5) / kPoints, across = std::sqrt(1.0 - y * y);
    const double turn = 2.0 * std::numbers::pi * i * std::numbers::phi;
    const Vec3 unit(across * std::cos(turn), y, across * std::sin(turn));
    if (place.open(unit)) add(sums, unit, 1.0 / kPoints, place);
  }
  return sums;
}

TEST(SkyLaw, TheErrorOfASkyIsWithinWhatItStates) {
  const auto all = places(240);
  std::vector<Exposures> truths;
  for (const Place& place : all) truths.push_back(truth(place));
  for (const int count : {64, 128, 256, 448, 1024}) {
    const auto sky = sim::makeSky({.directions = count}).directions;
    std::vector<Vec3> units;
    for (const auto& d : sky) units.push_back(glm::normalize(Vec3(d.v)));
    Exposures squares{};
    for (std::size_t p = 0; p < all.size(); ++p) {
      Exposures sums{};
      for (std::size_t i = 0; i < sky.size(); ++i) {
        if (all[p].open(units[i]))
          add(sums, units[i], sky[i].weight / double(sim::ExposureField::kWhole), all[p]);
      }
      for (std::size_t w = 0; w < sums.size(); ++w) squares[w] += std::pow(sums[w] - truths[p][w], 2);
    }
    for (std::size_t w = 0; w < squares.size(); ++w) {
      const double measured = std::sqrt(squares[w] / static_cast<double>(all.size()));
      const double stated = sim::skyError(kWeightings[w], count);
      EXPECT_LT(measured, stated) << sim::nameOf(kWeightings[w]) << ' ' << count;
      EXPECT_GT(measured, 0.6 * stated) << sim::nameOf(kWeightings[w]) << ' ' << count << ": too careful";
    }
  }
}

}  // namespace
}  // namespace espalier
