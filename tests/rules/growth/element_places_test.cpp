#include "rules/growth/element_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace espalier::rules {
namespace {

using sim::Vec3;

constexpr double kDegreesOfOne = 180.0 / std::numbers::pi;

Phyllotaxis spaced(double spacing_vx, double angle_deg, int whorl = 1) {
  Phyllotaxis phyllotaxis;
  phyllotaxis.spacing = {spacing_vx};
  phyllotaxis.angle_deg = angle_deg;
  phyllotaxis.whorl = whorl;
  return phyllotaxis;
}

sim::Skeleton lineOf(const std::vector<Vec3>& nodes) {
  sim::Skeleton skeleton;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    skeleton.parent.push_back(static_cast<sim::NodeId>(i) - 1);
    skeleton.position_vx.push_back(nodes[i]);
  }
  return skeleton;
}

TEST(ElementPlaces, AreSpacedAlongTheLimbAndTurnAboutIt) {
  const auto places = placesInOrder(spaced(0.5, 137.5), 1.2, 3.2);  // at 1.5, 2, 2.5 and 3
  ASSERT_EQ(places.size(), 4u);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double k = 3.0 + static_cast<double>(i);
    EXPECT_NEAR(1.2 + 2.0 * places[i].along, 0.5 * k, 1e-12);
    EXPECT_NEAR(places[i].turn_deg, std::fmod(137.5 * k, 360.0), 1e-9);
  }
}

// However a limb is cut into segments, its leaves stand in the same places.
TEST(ElementPlaces, GoOnFromSegmentToSegment) {
  const Phyllotaxis phyllotaxis = spaced(0.3, 100.0, 2);
  const auto whole = placesInOrder(phyllotaxis, 0.0, 7.0);
  std::vector<std::pair<double, double>> parts;
  double begins = 0.0;
  for (const double length : {0.1, 0.95, 2.5, 0.05, 3.4}) {
    for (const ElementPlace& place : placesInOrder(phyllotaxis, begins, begins + length))
      parts.emplace_back(begins + length * place.along, place.turn_deg);
    begins += length;
  }
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_NEAR(parts[i].first, 7.0 * whole[i].along, 1e-9);
    EXPECT_NEAR(parts[i].second, whole[i].turn_deg, 1e-9);
  }
}

TEST(ElementPlaces, OfAWhorlAreEvenlyAboutTheStem) {
  const auto places = placesInOrder(spaced(1.0, 60.0, 3), 0.0, 1.5);
  ASSERT_EQ(places.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(places[i].along, places[0].along);
    EXPECT_NEAR(places[i].turn_deg, 60.0 + 120.0 * static_cast<double>(i), 1e-9);
  }
}

TEST(ElementPlaces, AreNeverMoreThanASegmentMayHave) {
  EXPECT_EQ(placesInOrder(spaced(1e-3, 90.0), 0.0, 1e3).size(), static_cast<std::size_t>(kMostOnASegment));
}

/// A limb whose nodes know their places.
sim::Skeleton limbOf(const std::vector<Vec3>& nodes) {
  sim::Skeleton skeleton = lineOf(nodes);
  auto &turns = skeleton.columns[kLimbTurnColumn], &lengths = skeleton.columns[kLimbLengthColumn];
  turns = lengths = {0.0f};
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const Vec3 way = glm::normalize(nodes[n] - nodes[n - 1]);
    const LimbQuantities end = atEnd(limbPlace(skeleton, static_cast<sim::NodeId>(n) - 1, way), way,
                                     glm::distance(nodes[n], nodes[n - 1]));
    turns.push_back(end.turn);
    lengths.push_back(end.length_vx);
  }
  return skeleton;
}

TEST(LimbPlace, MeasuresTheWayFromTheSeed) {
  const LimbPlace place = limbPlace(limbOf({{0, 0, 0}, {0, 2, 0}, {0, 2, 3}, {4, 2, 3}}), 3, Vec3(1, 0, 0));
  EXPECT_NEAR(place.length_vx, 9.0, 1e-6);
  EXPECT_NEAR(glm::length(place.across), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(place.across, Vec3(1, 0, 0)), 0.0, 1e-12);
}

TEST(LimbPlace, DoesNotTurnAboutTheLimb) {
  const sim::Skeleton straight = limbOf({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}});
  const Vec3 way = glm::normalize(Vec3(1, 2, 3));
  for (const sim::NodeId node : {1, 2, 3})
    EXPECT_NEAR(glm::distance(limbPlace(straight, node, way).across, limbPlace(straight, 0, way).across), 0.0,
                1e-6);
  // Round a flat bend, what is square to its plane stays so, and what lies in it turns with it.
  std::vector<Vec3> bend;
  for (int i = 0; i <= 40; ++i) bend.emplace_back(10.0 * std::cos(0.1 * i), 10.0 * std::sin(0.1 * i), 0.0);
  const sim::Skeleton arc = limbOf(bend);
  const auto alongZ = [&](sim::NodeId node) {
    const auto n = static_cast<std::size_t>(node);
    return limbPlace(arc, node, glm::normalize(bend[n] - bend[n - 1])).across.z;
  };
  for (const sim::NodeId node : {1, 5, 17, 40}) EXPECT_NEAR(alongZ(node), alongZ(1), 1e-5) << node;
}

// Lengths are kept in single precision: what lies between two segments must be of one of them alone.
TEST(ElementPlaces, NoneIsLostOrDoubledBetweenSegmentsOfALongLimb) {
  const Phyllotaxis phyllotaxis = spaced(0.25, 90.0);
  const Vec3 way = glm::normalize(Vec3(0.3, 1.0, 0.2));
  LimbPlace begins{0.0, sim::perpendicular(way)};
  std::size_t seen = 0;
  for (int i = 0; i < 4000; ++i) {
    const LimbQuantities end = atEnd(begins, way, 0.1 + 0.25 * (i % 7));
    seen += placesInOrder(phyllotaxis, begins.length_vx, static_cast<double>(end.length_vx)).size();
    begins.length_vx = static_cast<double>(end.length_vx);
  }
  EXPECT_EQ(seen, static_cast<std::size_t>(std::floor(begins.length_vx / 0.25)));
}

/// What stands by phyllotaxis on a stem that goes straight up.
sim::PlacedElement standing(const Element& rule, double turn_deg, int trial = 0) {
  const Surroundings around;
  const Senses senses;
  sim::Slots slots({7, 0}, sim::Purpose::element);
  sim::PlacedElement element;
  stand(element, rule, {0.5, turn_deg, true}, Vec3(0, 1, 0), Vec3(1, 0, 0), around, senses, Vec3(0.0), trial,
        slots);
  return element;
}

TEST(Stand, LeavesTheStemByThePitchAndAtTheTurn) {
  Element rule;
  rule.phyllotaxis = spaced(1.0, 0.0);
  rule.phyllotaxis->pitch_deg = 40.0;
  rule.petiole.value = 2.5;
  rule.face = 0.0;
  for (const double turn : {0.0, 100.0, 250.0}) {
    const sim::PlacedElement e = standing(rule, turn);
    const double pitch = std::acos(e.y.y) * kDegreesOfOne;
    EXPECT_NEAR(pitch, 40.0, 4.0 + 1e-6);  // it sways a little
    // The axis square to both, about which the turn goes, is z here: from x by the turn to -z.
    const Vec3 out = Vec3(e.position_vx.x, 0.0, e.position_vx.z) / 2.5;
    EXPECT_NEAR(glm::length(out), 1.0, 1e-9) << "the petiole's length, square to the stem";
    const double seen = std::atan2(-out.z, out.x) * kDegreesOfOne;
    EXPECT_NEAR(std::remainder(seen - turn, 360.0), 0.0, 4.0 + 1e-6);
    EXPECT_NEAR(glm::dot(e.x, e.y), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(glm::cross(e.x, e.y) - e.z), 0.0, 1e-9);
    EXPECT_GT(e.z.y, 0.0) << "its face looks to the stem's tip";
  }
}

TEST(Stand, LeansAsideTheMoreTheLaterTheTrial) {
  Element rule;
  rule.phyllotaxis = spaced(1.0, 0.0);
  const Vec3 wanted = standing(rule, 0.0, 0).y;
  double farthest = 0.0;
  for (int trial = 0; trial < 14; ++trial)
    farthest = std::max(farthest, std::acos(std::min(1.0, glm::dot(standing(rule, 0.0, trial).y, wanted))));
  EXPECT_GT(farthest * kDegreesOfOne, 4.0);
  EXPECT_LT(farthest * kDegreesOfOne, 130.0);
}

}  // namespace
}  // namespace espalier::rules
