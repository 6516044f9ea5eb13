#include "sim/light/sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/light/exposure.h"
#include "sim/world/field.h"
#include "tests/support/bit_worlds.h"
#include "tests/support/messages.h"

namespace espalier {
namespace {

using namespace std::chrono_literals;
using sim::RealSun;
using sim::Vec3;
using std::chrono::year_month_day;

constexpr double kDegrees = 180.0 / std::numbers::pi;

double altitude(Vec3 d) {
  return std::asin(d.y) * kDegrees;
}
/// Clockwise from -z.
double azimuth(Vec3 d) {
  return std::fmod(std::atan2(d.x, -d.z) * kDegrees + 360.0, 360.0);
}
int totalWeight(const sim::DirectionSet& set) {
  return std::accumulate(set.begin(), set.end(), 0, [](int sum, const auto& d) { return sum + d.weight; });
}

RealSun zurich(year_month_day first, year_month_day last) {
  RealSun sun{first, last};
  sun.latitude_deg = 47.37;
  sun.longitude_deg = 8.54;
  sun.utc_offset_h = 1.0;
  return sun;
}

TEST(SunArc, RisesInTheEastAndLeansTheWayItIsTold) {
  const sim::SunArc south{20.0, 180.0, 48};
  const Vec3 rise = sim::sunDirection(south, 6.0), noon = sim::sunDirection(south, 12.0);
  EXPECT_NEAR(rise.x, 1.0, 1e-6);
  EXPECT_NEAR(noon.y, std::cos(20.0 / kDegrees), 1e-6);
  EXPECT_GT(noon.z, 0.3);
  for (const auto& d : sim::makeSun(south).directions) EXPECT_GE(d.v.z, 0);
  EXPECT_GT(sim::sunDirection(sim::SunArc{20.0, 90.0, 1}, 12.0).x, 0.3);
}

TEST(SunArc, KeepsItsAngleHoursAndWeights) {
  for (const int samples : {1, 2, 12, 48, 500}) {
    for (const double toward : {0.0, 90.0, 155.0, 180.0}) {
      const auto sun = sim::makeSun(sim::SunArc{20.0, toward, samples});
      EXPECT_NEAR(sun.totalHours(), 12.0, 1e-9);
      EXPECT_EQ(totalWeight(sun.directions), sim::ExposureField::kWhole);
      EXPECT_LE(sun.worst_angle_deg, 0.5 + 1e-6);
      EXPECT_EQ(sun.hours.size(), sun.directions.size());
      // The pole of the half circle: no direction lies farther from its plane than from its place.
      const Vec3 pole = glm::normalize(glm::cross(sim::sunDirection(sim::SunArc{20.0, toward, 1}, 6.0),
                                                  sim::sunDirection(sim::SunArc{20.0, toward, 1}, 12.0)));
      for (const auto& d : sun.directions)
        EXPECT_LE(std::abs(altitude(Vec3(0, glm::dot(glm::normalize(Vec3(d.v)), pole), 0))),
                  sun.worst_angle_deg + 1e-6);
    }
  }
}

// Published by the Ladybug tools after NOAA, with refraction. Where no year is given it is 2017.
TEST(RealSun, StandsWhereNoaaSaysThatItDoes) {
  struct Known {
    double latitude, longitude, utc_offset;
    year_month_day date;
    double hour, altitude, azimuth;
  };
  for (const Known& k : {Known{40.72, -74.02, -5, 2017y / 9 / 15, 11.0, 50.35, 159.72},
                         Known{-33.87, 151.22, 10, 2017y / 11 / 15, 11.0, 72.26, 32.37},
                         Known{-33.87, 151.22, 10, 2019y / 6 / 21, 9.0, 18.99, 42.54},
                         Known{40.72, -74.02, -5, 2017y / 3 / 21, 9.5, 36.90, 129.23}}) {
    RealSun sun{k.date, k.date};
    sun.latitude_deg = k.latitude;
    sun.longitude_deg = k.longitude;
    sun.utc_offset_h = k.utc_offset;
    const Vec3 d = sim::sunDirection(sun, k.date, k.hour);
    EXPECT_NEAR(glm::length(d), 1.0, 1e-6);
    EXPECT_NEAR(altitude(d), k.altitude, 0.03);
    EXPECT_NEAR(azimuth(d), k.azimuth, 0.05);
  }
}

TEST(RealSun, RisesAndSetsByTheAirsLift) {
  // Geometric altitude 0 at the poles' equinox would be the horizon; the air lifts it by about 0.48 degrees.
  RealSun sun = zurich(2026y / 3 / 20, 2026y / 3 / 20);
  double risen = 0.0;
  for (double hour = 6.0; hour < 7.0 && risen == 0.0; hour += 1.0 / 240.0) {
    if (sim::sunDirection(sun, sun.first, hour).y > 0.0) risen = hour;
  }
  // The almanac's sunrise, 6:29, is that of the upper rim: the centre follows about 90 s later.
  EXPECT_NEAR(risen, 6.0 + 30.5 / 60.0, 2.0 / 60.0);
}

TEST(RealSun, NorthTurnsItWithTheModel) {
  RealSun sun = zurich(2026y / 6 / 21, 2026y / 6 / 21);
  const double straight = azimuth(sim::sunDirection(sun, sun.first, 9.0));
  sun.north_deg = 30.0;
  EXPECT_NEAR(azimuth(sim::sunDirection(sun, sun.first, 9.0)), straight + 30.0, 1e-4);
}

TEST(RealSun, IsOfTheDayAndItsHours) {
  const auto midsummer = sim::makeSun(zurich(2026y / 6 / 21, 2026y / 6 / 21));
  EXPECT_NEAR(midsummer.totalHours(), 15.9, 0.2);  // by the sun's centre
  EXPECT_EQ(totalWeight(midsummer.directions), sim::ExposureField::kWhole);
  auto morning = zurich(2026y / 6 / 21, 2026y / 6 / 21);
  morning.from_h = 9.0;
  morning.to_h = 12.25;
  EXPECT_NEAR(sim::makeSun(morning).totalHours(), 3.25, 1e-9);
  for (const auto& d : sim::makeSun(morning).directions) EXPECT_GT(d.v.x, -10);
  // Half of each day has sun, over a year.
  auto year = zurich(2026y / 1 / 1, 2026y / 12 / 31);
  year.step_min = 30.0;
  EXPECT_NEAR(sim::makeSun(year).totalHours(), 12.1, 0.15);
}

TEST(RealSun, WeighsBySineOfElevation) {
  auto sun = zurich(2026y / 6 / 21, 2026y / 6 / 21);
  sun.weighting = sim::SunWeighting::sine;
  const auto weighted = sim::makeSun(sun);
  EXPECT_EQ(totalWeight(weighted.directions), sim::ExposureField::kWhole);
  double scale = 0.0;
  for (std::size_t i = 0; i < weighted.directions.size(); ++i) {
    const auto& d = weighted.directions[i];
    const double ratio = d.weight / (weighted.hours[i] * glm::normalize(Vec3(d.v)).y);
    if (d.v.y * 3 < sim::crossedCount(d.v)) continue;  // low ones: half a degree is much of their elevation
    if (scale == 0.0) scale = ratio;
    EXPECT_NEAR(ratio / scale, 1.0, 0.06);
  }
}

TEST(RealSun, KeepsItsAngleOverTheYearEverywhere) {
  for (const double latitude : {-90.0, -66.0, -35.0, 0.0, 23.44, 47.0, 69.0}) {
    RealSun sun{2026y / 1 / 1, 2026y / 12 / 31};
    sun.latitude_deg = latitude;
    sun.step_min = 60.0;
    const auto year = sim::makeSun(sun);
    EXPECT_LE(year.worst_angle_deg, 0.5 + 1e-6);
    EXPECT_GT(year.worst_angle_deg, 0.4);
    EXPECT_EQ(totalWeight(year.directions), sim::ExposureField::kWhole);
    for (std::size_t i = 1; i < year.directions.size(); ++i)
      EXPECT_NE(year.directions[i].v, year.directions[i - 1].v);
  }
}

TEST(RealSun, RefusesWhatMakesNoSun) {
  const auto message = [](auto change) {
    auto sun = zurich(2026y / 6 / 21, 2026y / 6 / 21);
    change(sun);
    return tests::messageOf([&] { sim::makeSun(sun); });
  };
  EXPECT_EQ(message([](RealSun& s) { s.first = 2026y / 2 / 30; }),
            "a sun on a day that does not exist; expected a date such as 2026-06-21");
  EXPECT_EQ(message([](RealSun& s) { s.first = 2026y / 6 / 22; }),
            "a sun from 2026-06-22 to 2026-06-21; expected the second date not to be before the first");
  EXPECT_EQ(message([](RealSun& s) { s.first = 2024y / 6 / 22; }),
            "a sun of 730 days; expected at most 366: a year");
  EXPECT_EQ(message([](RealSun& s) { s.latitude_deg = 91.0; }),
            "a latitude of 91 degrees; expected -90 to 90");
  EXPECT_EQ(message([](RealSun& s) { s.to_h = 0.0; }),
            "a sun from 0 to 0 h; expected hours from 0 to 24, the first before the second");
  EXPECT_EQ(message([](RealSun& s) { s.step_min = 0.0; }), "a sun in steps of 0 minutes; expected 1 to 1440");
  EXPECT_EQ(
      message([](RealSun& s) { s.to_h = 3.0; }),
      "sun at 47.37 N 8.54 E, 2026-06-21, 0 to 3 h: the sun is never up; expected a day or hours with sun");
  EXPECT_EQ(message([](RealSun& s) { s.within_deg = 0.0; }),
            "the sun's directions within 0 degrees; expected more than 0, at most 10");
  const auto polar = message([](RealSun& s) {
    s.latitude_deg = 80.0;
    s.first = s.last = 2026y / 12 / 21;
  });
  EXPECT_NE(polar.find("the sun is never up"), polar.npos) << polar;
  const auto fine = message([](RealSun& s) { s.within_deg = 0.01; });
  EXPECT_NE(fine.find("no direction lies within 0.01 degrees of the sun"), fine.npos) << fine;
  EXPECT_NE(fine.find("expected at least 0."), fine.npos) << fine;
}

TEST(RealSun, SaysAnAccuracyThatServes) {
  for (const double latitude_deg : {-60.0, 0.0, 33.0, 47.37, 71.0}) {
    RealSun sun = zurich(2026y / 1 / 1, 2026y / 12 / 31);
    sun.latitude_deg = latitude_deg;
    sun.step_min = 60.0;
    sun.within_deg = 0.05;
    std::string message;
    try {
      sim::makeSun(sun);
    } catch (const sim::InputError& error) {
      message = error.what();
    }
    const std::string expected = "expected at least ";
    const std::size_t at = message.find(expected);
    ASSERT_NE(at, message.npos) << message;
    sun.within_deg = std::stod(message.substr(at + expected.size()));
    EXPECT_NO_THROW(sim::makeSun(sun)) << message;
    sun.within_deg -= 0.011;
    EXPECT_THROW(sim::makeSun(sun), sim::InputError) << message;
  }
}

TEST(RealSun, SaysWhatItIs) {
  const auto about = sim::describe(sim::makeSun(zurich(2026y / 6 / 21, 2026y / 6 / 21)));
  EXPECT_EQ(about.substr(0, 33), "sun at 47.37 N 8.54 E, 2026-06-21") << about;
  EXPECT_NE(about.find(" h a day, "), about.npos) << about;
  EXPECT_NE(about.find("within 0.5 degrees"), about.npos) << about;
}

// Closed forms of a point sun without air.
TEST(SunOfDeclination, GivesTheDaysLength) {
  EXPECT_NEAR(sim::sunOfDeclination(30.0, 23.44, 2.0).totalHours(), 13.9329, 0.04);
  EXPECT_NEAR(sim::sunOfDeclination(30.0, -23.44, 2.0).totalHours(), 10.0671, 0.04);
  EXPECT_NEAR(sim::sunOfDeclination(45.0, 23.44, 2.0).totalHours(), 15.4259, 0.04);
  EXPECT_NEAR(sim::sunOfDeclination(45.0, -23.44, 2.0).totalHours(), 8.5741, 0.04);
}

double hoursAt(const sim::BitVolume& world, sim::Voxel p, const sim::Sun& sun) {
  double hours = 0.0;
  for (std::size_t i = 0; i < sun.directions.size(); ++i) {
    if (sim::reachesEdge(world, p, sun.directions[i])) hours += sun.hours[i];
  }
  return hours;
}

// On the floor's middle of an endless street from north to south: (2/15) atan(cos(latitude) / 2h) hours. The
// sensor stands half a voxel above the floor, so the walls are as much lower.
TEST(SunOfDeclination, ShinesIntoAStreetFromNorthToSouth) {
  const auto sun = sim::sunOfDeclination(45.0, 0.0, 2.0);
  constexpr int kWidth = 81;
  for (const double h : {0.5, 1.0, 2.0}) {
    const int height = static_cast<int>(std::lround(h * kWidth));
    sim::BitVolume street({kWidth + 2, height + 1, 1201});
    tests::addBox(street, {0, 0, 0}, {kWidth + 1, 0, 1200});
    tests::addBox(street, {0, 1, 0}, {0, height, 1200});
    tests::addBox(street, {kWidth + 1, 1, 0}, {kWidth + 1, height, 1200});
    const double effective = (height - 0.5) / kWidth;
    const double truth = 2.0 / 15.0 * std::atan(std::cos(45.0 / kDegrees) / (2.0 * effective)) * kDegrees;
    EXPECT_NEAR(hoursAt(street, {(kWidth + 1) / 2, 1, 600}, sun), truth, 0.1) << h;
  }
}

// In a street from east to west the shadow of the south wall ends at H tan(latitude) all day.
TEST(SunOfDeclination, LeavesTheShadowOfASouthWallInPlaceAllDay) {
  constexpr int kHeight = 60, kLong = 4001;
  for (const double latitude : {30.0, 45.0, 60.0}) {
    const auto sun = sim::sunOfDeclination(latitude, 0.0, 10.0, 0.5);
    sim::BitVolume street({kLong, kHeight + 1, 140});
    tests::addBox(street, {0, 0, 0}, {kLong - 1, 0, 139});
    tests::addBox(street, {0, 1, 139}, {kLong - 1, kHeight, 139});
    const double shadow = kHeight * std::tan(latitude / kDegrees);
    const auto at = [&](double distance) {
      return hoursAt(street, {kLong / 2, 1, 139 - static_cast<int>(std::lround(distance))}, sun);
    };
    EXPECT_LT(at(0.8 * shadow), 1.5) << latitude;  // near the horizon half a degree is a long way
    EXPECT_GT(at(1.2 * shadow), 10.5) << latitude;
  }
}

}  // namespace
}  // namespace espalier
