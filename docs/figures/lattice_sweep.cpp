// The figure of docs/lattice-sweep.md, from the program's own directions and its own sweep.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "docs/figures/figures.h"
#include "sim/sweep/sweep.h"
#include "sim/world/field.h"

namespace espalier::figures {
namespace {

using glm::vec2;
using render::Ink;
using sim::Colour;
using sim::Voxel;

constexpr Colour kOccupied(0.25f, 0.27f, 0.31f), kBlocked(0.55f, 0.68f, 0.83f), kOpen(0.99f, 0.97f, 0.86f),
    kUnknown(0.925f, 0.92f, 0.91f), kNow(0.90f, 0.62f, 0.10f), kRay(0.76f, 0.22f, 0.17f),
    kCrossed(0.96f, 0.79f, 0.66f), kAgain(0.985f, 0.91f, 0.85f);

/// Voxels x and y of a picture's part; `low` is the lower left corner of voxel (0, 0).
class Grid {
 public:
  Grid(render::Image& image, vec2 low, float cell) : image_(image), low_(low), cell_(cell) {}

  vec2 corner(float x, float y) const { return low_ + vec2(x * cell_, -y * cell_); }
  vec2 centre(int x, int y) const {
    return corner(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  }
  void fill(int x, int y, Colour colour) {
    const vec2 a = corner(static_cast<float>(x), static_cast<float>(y) + 1.0f);
    render::fillBox(image_, a + 0.5f, a + cell_ - 0.5f, {colour});
  }
  void outline(int x, int y, int wide, int high, Colour colour, float width) {
    const vec2 a = corner(static_cast<float>(x), static_cast<float>(y)),
               b = corner(static_cast<float>(x + wide), static_cast<float>(y + high));
    const Ink ink{colour};
    render::drawSegment(image_, a, {b.x, a.y}, width, ink);
    render::drawSegment(image_, {b.x, a.y}, b, width, ink);
    render::drawSegment(image_, b, {a.x, b.y}, width, ink);
    render::drawSegment(image_, {a.x, b.y}, a, width, ink);
  }
  void dot(int x, int y, Colour colour) {
    const float r = std::min(4.0f, 0.22f * cell_);
    render::fillBox(image_, centre(x, y) - r, centre(x, y) + r, {colour}, r);
  }
  void line(vec2 a, vec2 b, Colour colour, float width) {
    render::drawSegment(image_, a, b, width, {colour});
  }

 private:
  render::Image& image_;
  vec2 low_;
  float cell_;
};

void heading(render::Image& image, vec2 at, const std::string& letter, const std::string& words) {
  text(image, at, letter, 19, render::Align::left, render::Font::bold);
  text(image, at + vec2(24, 0), words, 17);
}

constexpr Voxel kPeriod(5, 3, 0);

/// The voxels that one period crosses, and the same again.
void drawPeriod(render::Image& image, vec2 low) {
  constexpr int kWide = 16, kHigh = 10;
  Grid grid(image, low, 26);
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) grid.fill(x, y, kUnknown);
  }
  const auto crossed = sim::crossedVoxels(kPeriod);
  for (int period = 0; period < 3; ++period) {
    const Voxel start = period * kPeriod;
    for (const Voxel o : crossed) grid.fill(start.x + o.x, start.y + o.y, period == 0 ? kCrossed : kAgain);
  }
  grid.fill(0, 0, kOpen);
  grid.line(grid.centre(0, 0), grid.centre(3 * kPeriod.x, 3 * kPeriod.y), kRay, 2);
  for (int period = 0; period <= 3; ++period) grid.dot(period * kPeriod.x, period * kPeriod.y, kRay);
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    const vec2 at = grid.corner(static_cast<float>(crossed[i].x), static_cast<float>(crossed[i].y));
    text(image, at + vec2(4, -4), fmt::format("{}", i + 1), 11);
  }
  text(image, grid.centre(0, 0) + vec2(-6, -9), "p", 14, render::Align::left, render::Font::bold);
  text(image, grid.centre(kPeriod.x, kPeriod.y) + vec2(-10, -10), "p + v", 14, render::Align::right,
       render::Font::bold);
  text(image, grid.centre(2 * kPeriod.x, 2 * kPeriod.y) + vec2(-10, -10), "p + 2v", 14, render::Align::right,
       render::Font::bold);
}

/// A wall, a roof and a floor in a world of one voxel's depth.
sim::BitVolume littleWorld() {
  sim::BitVolume world({26, 13, 1});
  for (int x = 0; x < 26; ++x) world.set({x, 0, 0});
  for (int y = 1; y < 9; ++y) {
    world.set({19, y, 0});
    world.set({20, y, 0});
  }
  for (int x = 5; x < 10; ++x) world.set({x, 9, 0});
  return world;
}

/// The little world as seen along one direction.
struct Swept {
  sim::BitVolume occupied = littleWorld();
  sim::LatticeDirection direction;
  sim::ExposureField open;
  int now = 5;  ///< the slice at hand

  explicit Swept(Voxel v)
      : direction(sim::directionSet({v}, {1.0}, sim::ExposureField::kWhole)[0]),
        open(sim::sweepExposure(occupied, {direction})) {}
  bool blocked(Voxel v) const { return open.at(v) == 0.0f; }
};

/// The sweep half way down.
void drawSweep(render::Image& image, vec2 low, const Swept& swept) {
  const Voxel size = swept.occupied.size(), p(14, swept.now, 0);
  Grid grid(image, low, 19);
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      const bool known = y >= swept.now;
      const Colour colour = swept.occupied.at({x, y, 0}) ? kOccupied
                            : !known                     ? kUnknown
                            : swept.blocked({x, y, 0})   ? kBlocked
                                                         : kOpen;
      grid.fill(x, y, colour);
    }
  }
  for (const Voxel o : swept.direction.crossed) grid.outline(p.x + o.x, p.y + o.y, 1, 1, kRay, 1.6f);
  const Voxel end = p + swept.direction.v;
  grid.line(grid.centre(p.x, p.y), grid.centre(end.x, end.y), kRay, 2);
  grid.dot(p.x, p.y, kRay);
  grid.dot(end.x, end.y, kRay);
  grid.outline(0, swept.now, size.x, 1, kNow, 3);
  text(image, grid.centre(p.x, p.y) + vec2(-9, 5), "p", 14, render::Align::right, render::Font::bold);
  text(image, grid.centre(end.x, end.y) + vec2(-2, -13), "p + v", 14, render::Align::right,
       render::Font::bold);
}

/// One row of bits, and what it is.
void drawBits(render::Image& image, vec2 low, const std::string& name, Colour set,
              const std::function<bool(int)>& bit, int bits) {
  Grid grid(image, low, 19);
  for (int x = 0; x < bits; ++x) {
    grid.fill(x, 0, bit(x) ? set : kUnknown);
    text(image, grid.centre(x, 0) + vec2(0, 4), bit(x) ? "1" : "0", 10, render::Align::centre,
         render::Font::regular, bit(x) && set == kOccupied ? kPaper : kInk);
  }
  text(image, low + vec2(-14, -5), name, 14, render::Align::right);
}

/// Rows of bits, one below the other.
class BitRows {
 public:
  BitRows(render::Image& image, vec2 low, int bits) : image_(image), low_(low), bits_(bits) {}
  void add(const std::string& name, Colour set, const std::function<bool(int)>& bit) {
    drawBits(image_, low_, name, set, bit, bits_);
    low_.y += 23.0f;
  }
  void addFramed(const std::string& name, Colour set, const std::function<bool(int)>& bit) {
    low_.y += 6.0f;
    Grid grid(image_, low_, 19);
    add(name, set, bit);
    grid.outline(0, 0, bits_, 1, kNow, 3);
  }

 private:
  render::Image& image_;
  vec2 low_;
  int bits_;
};

std::string rowAt(int up) {
  return up == 0 ? "row y" : fmt::format("row y + {}", up);
}

/// The slice at hand as words: shifted rows, united.
void drawWords(render::Image& image, vec2 low, const Swept& swept) {
  BitRows rows(image, low, swept.occupied.size().x);
  const int y = swept.now;
  for (const Voxel o : swept.direction.crossed) {
    rows.add(fmt::format("occupied {}, moved by {}", rowAt(o.y), o.x), kOccupied, [&](int x) {
      return swept.occupied.at({x + o.x, y + o.y, 0});
    });
  }
  const Voxel v = swept.direction.v;
  rows.add(fmt::format("blocked {}, moved by {}", rowAt(v.y), v.x), kBlocked, [&](int x) {
    const Voxel end(x + v.x, y + v.y, 0);
    return sim::contains(swept.occupied.size(), end) && swept.blocked(end);
  });
  rows.addFramed("or: blocked row y", kBlocked, [&](int x) { return swept.blocked({x, y, 0}); });
}

/// Three directions' bits made into a number of two bits by a carry-save adder.
void drawCounting(render::Image& image, vec2 low, const std::array<Swept, 3>& three) {
  BitRows rows(image, low, three[0].occupied.size().x);
  const auto blocked = [&](std::size_t i, int x) { return three[i].blocked({x, three[i].now, 0}); };
  for (std::size_t i = 0; i < three.size(); ++i) {
    const Voxel v = three[i].direction.v;
    rows.add(fmt::format("blocked along ({}, {})", v.x, v.y), kBlocked, [&](int x) { return blocked(i, x); });
  }
  const auto count = [&](int x) {
    return static_cast<int>(blocked(0, x)) + static_cast<int>(blocked(1, x)) +
           static_cast<int>(blocked(2, x));
  };
  rows.addFramed("xor: ones", kCrossed, [&](int x) { return (count(x) & 1) != 0; });
  rows.addFramed("majority: twos", kCrossed, [&](int x) { return (count(x) & 2) != 0; });
}

void swatch(render::Image& image, vec2 at, Colour colour, const std::string& name) {
  render::fillBox(image, at - 1.0f, at + 15.0f, {kInk, 0.25f});
  render::fillBox(image, at, at + 14.0f, {colour});
  text(image, at + vec2(21, 12), name, 14);
}

}  // namespace

render::Image latticeSweep() {
  constexpr int kWide = 1040, kHigh = 830;
  render::Image image(kWide, kHigh, 3);
  render::fillBox(image, {0, 0}, {kWide, kHigh}, {kPaper});
  const std::array<Swept, 3> three = {Swept({3, 2, 0}), Swept({-2, 3, 0}), Swept({1, 1, 0})};
  heading(image, {30, 38}, "A", fmt::format("Along v = ({}, {}) a ray crosses", kPeriod.x, kPeriod.y));
  text(image, {54, 60},
       fmt::format("voxels 1 to {}, and again after each v", sim::crossedVoxels(kPeriod).size()), 17);
  drawPeriod(image, {30, 340});
  heading(image, {516, 38}, "B", "Half way down along v = (3, 2): the framed row");
  text(image, {540, 60}, "asks the rows above it, which are done", 17);
  drawSweep(image, {516, 325}, three[0]);
  const float key = 346;
  swatch(image, {516, key}, kOccupied, "occupied");
  swatch(image, {616, key}, kBlocked, "blocked");
  swatch(image, {706, key}, kOpen, "sees the edge");
  swatch(image, {836, key}, kUnknown, "not yet known");
  heading(image, {30, 414}, "C", "The framed row, all of its voxels at once: shifted words, united");
  drawWords(image, {516, 454}, three[0]);
  heading(image, {30, 646}, "D",
          "Counting: a carry-save adder makes numbers of two bits out of three directions");
  drawCounting(image, {516, 686}, three);
  return image;
}

}  // namespace espalier::figures
