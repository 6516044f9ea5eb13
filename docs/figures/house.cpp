// The figure of docs/house.md: rooms, wings and what builds on what, as the sources have it.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "docs/figures/figures.h"
#include "docs/figures/house_plan.h"
#include "sim/base/error.h"

namespace espalier::figures {
namespace {

using glm::vec2;
using sim::Colour;

/// How a room's wings are set: each row a chain of them, each on the next one. A wing of several rows is as
/// high as they are. Rows are drawn as they stand here, and checked against the sources.
struct Setting {
  std::vector<Names> rows;
  Colour paper, line;
};

const std::map<std::string, Setting>& settings() {
  static const std::map<std::string, Setting> all = {
      {"sim",
       {{{"grow", "light", "sweep", "tile", "world", "base"},
         {"grow", "sense", "tile"},
         {"scatter", "tile"},
         {"cut", "tile"},
         {"relief", "base"}},
        {0.945f, 0.925f, 0.880f},
        {0.56f, 0.47f, 0.30f}}},
      {"rules",
       {{{"growth", "front", "language"}, {"growth", "diffusion"}},
        {0.900f, 0.935f, 0.880f},
        {0.33f, 0.50f, 0.27f}}},
      {"render",
       {{{"finish", "files", "model", "image"}, {"form", "model", "image"}, {"voxels", "image"}},
        {0.890f, 0.920f, 0.950f},
        {0.27f, 0.42f, 0.60f}}},
      {"scenes",
       {{{"gallery", "job", "read", "yaml"},
         {"job", "read", "import"},
         {"job", "accuracy", "prepare", "inspect", "import"},
         {"job", "foretell", "prepare"},
         {"job", "foretell", "show", "made", "prepare"},
         {"job", "foretell", "show", "made", "write"}},
        {0.955f, 0.905f, 0.885f},
        {0.64f, 0.36f, 0.26f}}},
      {"studio", {{{"server", "session", "wire"}}, {0.930f, 0.905f, 0.945f}, {0.47f, 0.33f, 0.56f}}},
      {"cli", {{}, {0.925f, 0.920f, 0.915f}, {0.42f, 0.42f, 0.44f}}}};
  return all;
}

constexpr float kPad = 16, kHead = 42, kGap = 26, kRowGap = 12, kLeastRow = 30, kCorner = 7;
constexpr float kName = 15, kSmall = 12.5f, kLine = 17;
constexpr float kPage = 1100, kMargin = 14, kBetween = 34;
constexpr Colour kCard(0.995f, 0.995f, 0.99f), kSoft(0.36f, 0.37f, 0.39f);

Names wrapped(const Names& names, float width) {
  Names lines;
  for (const std::string& name : names) {
    if (!lines.empty() && render::textWidth(lines.back() + "  " + name, kSmall) <= width) {
      lines.back() += "  " + name;
    } else {
      lines.push_back(name);
    }
  }
  return lines;
}

void arrow(render::Image& image, vec2 from, vec2 to, Colour colour) {
  const vec2 way = glm::normalize(to - from), side(-way.y, way.x);
  const render::Ink ink{colour};
  render::drawSegment(image, from, to, 1.6f, ink);
  for (const float turn : {-1.0f, 1.0f})
    render::drawSegment(image, to, to - 6.5f * way + turn * 4.0f * side, 1.6f, ink);
}

void card(render::Image& image, vec2 low, vec2 high, Colour fill, Colour line) {
  render::fillBox(image, low, high, {line}, kCorner);
  render::fillBox(image, low + 1.2f, high - 1.2f, {fill}, kCorner - 1);
}

/// Where a wing stands: columns count from the right, what is built on most; rows from the top.
struct Place {
  int right = 0, left = 0, top = 0, bottom = 0;
};

/// A room's wings on their places.
class RoomPlan {
 public:
  RoomPlan(const std::string& name, const Room& room, float wide)
      : name_(name), room_(room), setting_(settings().at(name)), wide_(wide) {
    requireRows();
    for (const auto& [wing, is] : room_.wings) places_[wing].right = depth(wing);
    for (auto& [wing, place] : places_) {
      place.left = place.right;
      int least = columns_;
      for (const auto& [other, is] : room_.wings) {
        if (std::find(is.builds_on.begin(), is.builds_on.end(), wing) != is.builds_on.end())
          least = std::min(least, places_.at(other).right);
      }
      if (least < columns_) place.left = least - 1;  // there is room as far as those that stand on it
      place.top = rows();
      for (int row = 0; row < rows(); ++row) {
        if (!in(row, wing)) continue;
        place.top = std::min(place.top, row);
        place.bottom = row;
      }
    }
    row_high_.assign(setting_.rows.size(), kLeastRow);
    for (const int spans :
         {1, 2, 3}) {  // what lies in one row first; what is higher than its rows widens the last
      for (const auto& [wing, place] : places_) {
        if (place.bottom - place.top + 1 != spans) continue;
        float& last = row_high_[static_cast<std::size_t>(place.bottom)];
        last += std::max(0.0f, textHigh(wing) - (bottom(place.bottom) - top(place.top)));
      }
    }
  }

  float high() const { return rows() == 0 ? kHead + 4 : bottom(rows() - 1) + kPad; }
  void stretchTo(float high) {
    const float more = (high - this->high()) / static_cast<float>(rows());
    for (float& row : row_high_) row += more;
  }

  void draw(render::Image& image, vec2 low) const {
    card(image, low, low + vec2(wide_, high()), setting_.paper, setting_.line);
    const vec2 head = low + vec2(kPad, 28);
    text(image, head, name_, 20, render::Align::left, render::Font::bold, setting_.line);
    const float after = render::textWidth(name_, 20, render::Font::bold) + 14;
    text(image, head + vec2(after, 0), room_.title, 15, render::Align::left, render::Font::regular, kInk);
    const Names& in_no_wing = room_.wings.empty() ? room_.headers : room_.flat;
    text(image, head + vec2(wide_ - 2 * kPad, 0), fmt::format("{}", fmt::join(in_no_wing, "  ")), kSmall,
         render::Align::right, render::Font::regular, kSoft);
    for (const auto& [wing, place] : places_) drawWing(image, low, wing, place);
    for (int row = 0; row < rows(); ++row) {
      const Names& chain = setting_.rows[static_cast<std::size_t>(row)];
      const float y = low.y + 0.5f * (top(row) + bottom(row));
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        arrow(image, {low.x + left(places_.at(chain[i]).right) + column(), y},
              {low.x + left(places_.at(chain[i + 1]).left) - 2, y}, setting_.line);
      }
    }
  }

 private:
  int rows() const { return static_cast<int>(setting_.rows.size()); }
  bool in(int row, const std::string& wing) const {
    const Names& chain = setting_.rows[static_cast<std::size_t>(row)];
    return std::find(chain.begin(), chain.end(), wing) != chain.end();
  }
  float column() const {
    const auto n = static_cast<float>(columns_);
    return (wide_ - 2 * kPad - (n - 1) * kGap) / n;
  }
  float left(int from_right) const {
    return kPad + static_cast<float>(columns_ - 1 - from_right) * (column() + kGap);
  }
  float bottom(int row) const { return top(row) + row_high_[static_cast<std::size_t>(row)]; }
  float top(int row) const { return row == 0 ? kHead : bottom(row - 1) + kRowGap; }
  float widthOf(const Place& place) const {
    const auto n = static_cast<float>(place.left - place.right + 1);
    return n * (column() + kGap) - kGap;
  }
  float textHigh(const std::string& wing) const {
    const Names lines = wrapped(room_.wings.at(wing).headers, widthOf(places_.at(wing)) - 18);
    return 36 + kLine * static_cast<float>(lines.size());
  }

  int depth(const std::string& wing) {
    int most = 0;
    for (const std::string& on : room_.wings.at(wing).builds_on) most = std::max(most, depth(on) + 1);
    columns_ = std::max(columns_, most + 1);
    return most;
  }

  void requireRows() const {
    std::set<std::pair<std::string, std::string>> drawn, there;
    std::set<std::string> placed;
    for (const Names& chain : setting_.rows) {
      placed.insert(chain.begin(), chain.end());
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) drawn.insert({chain[i], chain[i + 1]});
    }
    for (const auto& [wing, is] : room_.wings) {
      if (!placed.contains(wing))
        throw sim::InputError(fmt::format("docs/figures/house.cpp has no place for {}/{}", name_, wing));
      for (const std::string& on : is.builds_on) there.insert({wing, on});
    }
    if (drawn != there || placed.size() != room_.wings.size())
      throw sim::InputError(
          fmt::format("the rows of {} in docs/figures/house.cpp are not what "
                      "tests/house/wings.txt says",
                      name_));
  }

  void drawWing(render::Image& image, vec2 low, const std::string& wing, const Place& place) const {
    const vec2 a = low + vec2(left(place.left), top(place.top));
    const vec2 b = low + vec2(left(place.right) + column(), bottom(place.bottom));
    card(image, a, b, kCard, glm::mix(setting_.line, setting_.paper, 0.45f));
    text(image, a + vec2(9, 21), wing, kName, render::Align::left, render::Font::bold);
    vec2 at = a + vec2(9, 41);
    for (const std::string& line : wrapped(room_.wings.at(wing).headers, widthOf(place) - 18)) {
      text(image, at, line, kSmall, render::Align::left, render::Font::regular, kSoft);
      at.y += kLine;
    }
  }

  std::string name_;
  const Room& room_;
  const Setting& setting_;
  float wide_;
  int columns_ = 1;
  std::vector<float> row_high_;
  std::map<std::string, Place> places_;
};

}  // namespace

render::Image house() {
  const std::map<std::string, Room> rooms = readHouse();
  const std::map<std::string, Names> drawn = {{"sim", {}},
                                              {"rules", {"sim"}},
                                              {"render", {"sim"}},
                                              {"scenes", {"rules", "render"}},
                                              {"studio", {"scenes"}},
                                              {"cli", {"studio"}}};
  for (const auto& [name, room] : rooms) {
    if (!drawn.contains(name) || drawn.at(name) != room.builds_on)
      throw sim::InputError("docs/figures/house.cpp draws other rooms than tests/house/wings.txt says");
  }
  const float inside = kPage - 2 * kMargin, rules_wide = 0.42f * (inside - kBetween);
  RoomPlan cli("cli", rooms.at("cli"), inside), studio("studio", rooms.at("studio"), inside),
      scenes("scenes", rooms.at("scenes"), inside), rules("rules", rooms.at("rules"), rules_wide),
      render("render", rooms.at("render"), inside - kBetween - rules_wide),
      sim("sim", rooms.at("sim"), inside);
  rules.stretchTo(render.high());

  const float studio_y = kMargin + cli.high() + kBetween, scenes_y = studio_y + studio.high() + kBetween,
              middle_y = scenes_y + scenes.high() + kBetween, sim_y = middle_y + render.high() + kBetween;
  render::Image image(static_cast<int>(kPage), static_cast<int>(sim_y + sim.high() + kMargin), 3);
  render::fillBox(image, {0, 0}, {image.width, image.height}, {kPaper});
  const float render_x = kMargin + rules_wide + kBetween;
  cli.draw(image, {kMargin, kMargin});
  studio.draw(image, {kMargin, studio_y});
  scenes.draw(image, {kMargin, scenes_y});
  rules.draw(image, {kMargin, middle_y});
  render.draw(image, {render_x, middle_y});
  sim.draw(image, {kMargin, sim_y});
  const auto down = [&](float x, float below) {
    arrow(image, {x, below - kBetween + 1}, {x, below - 3}, kInk);
  };
  const float rules_x = kMargin + 0.5f * rules_wide, render_middle = 0.5f * (render_x + kPage - kMargin);
  down(0.5f * kPage, studio_y);
  down(0.5f * kPage, scenes_y);
  for (const float y : {middle_y, sim_y}) {
    down(rules_x, y);
    down(render_middle, y);
  }
  return image;
}

}  // namespace espalier::figures
