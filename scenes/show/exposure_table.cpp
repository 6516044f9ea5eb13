#include "scenes/show/exposure_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes/show/light_json.h"
#include "scenes/show/light_texts.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::ordered_json;

/// So many decimals, and not more digits in the files than mean something.
double rounded(double value, double scale) {
  return std::round(value * scale) / scale;
}
constexpr double kDecimals = 1e4;

double sixDigits(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

/// The least value at or below which lies so great a share of the area.
double quantile(const std::vector<std::pair<float, float>>& sorted, double area, double share) {
  double below = 0.0;
  for (const auto& [value, part] : sorted) {
    below += static_cast<double>(part);
    if (below >= share * area) return static_cast<double>(value);
  }
  return static_cast<double>(sorted.back().first);
}

/// Of values with their areas, in any order.
Spread spreadOf(std::vector<std::pair<float, float>> values, double range) {
  std::sort(values.begin(), values.end());
  double area = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& [value, part] : values) {
    area += static_cast<double>(part);
    sum += static_cast<double>(part) * static_cast<double>(value);
  }
  Spread spread;
  const double mean = area > 0.0 ? sum / area : 0.0;
  for (const auto& [value, part] : values) {
    const double off = static_cast<double>(value) - mean;
    squares += static_cast<double>(part) * off * off;
    const auto bin = static_cast<std::size_t>(
        std::clamp(static_cast<double>(value) / range * Spread::kBins, 0.0, Spread::kBins - 1.0));
    spread.histogram[bin] += static_cast<double>(part);
  }
  const auto tidy = [](double value) { return rounded(value, kDecimals); };
  spread.mean = tidy(mean);
  spread.deviation = tidy(area > 0.0 ? std::sqrt(squares / area) : 0.0);
  spread.least = tidy(static_cast<double>(values.front().first));
  spread.lower_quartile = tidy(quantile(values, area, 0.25));
  spread.median = tidy(quantile(values, area, 0.5));
  spread.upper_quartile = tidy(quantile(values, area, 0.75));
  spread.greatest = tidy(static_cast<double>(values.back().first));
  for (double& share : spread.histogram) share = tidy(area > 0.0 ? share / area : 0.0);
  return spread;
}

/// Text in a field of RFC 4180.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string joined(const std::vector<std::string>& fields) {
  return fmt::format("{}\r\n", fmt::join(fields, ","));
}

std::vector<std::pair<const char*, double>> numbersOf(const Spread& s) {
  return {{"mean", s.mean},       {"standard_deviation", s.deviation},
          {"minimum", s.least},   {"lower_quartile", s.lower_quartile},
          {"median", s.median},   {"upper_quartile", s.upper_quartile},
          {"maximum", s.greatest}};
}

Json rowJson(const ExposureTable& table, const ExposureRow& row) {
  Json json = Json::object();
  if (!row.faces.empty()) {
    json = {{"faces", row.faces}};
  } else if (!row.object.empty()) {
    json = {{"object", row.object}, {"region", row.region}};
  }
  json["voxels"] = row.voxels;
  json["area_m2"] = row.area_m2;
  if (table.unreached == Unreached::leave_out) json["left_out_m2"] = row.left_out_m2;
  for (std::size_t q = 0; q < table.quantities.size(); ++q) {
    Json spread = Json::object();
    for (const auto& [name, value] : numbersOf(row.spreads[q])) spread[name] = value;
    spread["histogram"] = row.spreads[q].histogram;
    json[table.quantities[q].name] = spread;
  }
  return json;
}

constexpr std::array kWays{"N", "NE", "E", "SE", "S", "SW", "W", "NW", "up", "down"};

std::size_t wayNumber(sim::Vec3f normal, double north_deg) {
  constexpr float kLevel = 0.8660254f;  // the cosine of 30 degrees
  if (std::abs(normal.y) > kLevel) return normal.y > 0.0f ? 8 : 9;
  const double compass_deg =
      std::atan2(static_cast<double>(normal.x), -static_cast<double>(normal.z)) * 180.0 / std::numbers::pi -
      north_deg;
  return static_cast<std::size_t>(((std::lround(compass_deg / 45.0) % 8) + 8) % 8);
}

double areaOf(const sim::Lighting& light, const std::vector<std::size_t>& of) {
  double area = 0.0;
  for (const std::size_t i : of) area += static_cast<double>(light.surfaces[i].surface.coverage);
  return sixDigits(area * light.about.voxel_m * light.about.voxel_m);
}

/// Numbers of surfaces: those that a table counts, and those that it leaves out.
struct Sorted {
  std::vector<std::size_t> counted, left_out;
};

/// Whether any of the sky or the sun is seen from in front of a surface, also where that lies behind the
/// surface's plane, as it does below a balcony.
bool isReached(const sim::Lighting& light, std::size_t i) {
  constexpr float kRounding = 1e-5f;  // sums over no open direction; one alone brings more
  return light.brightest[i] != sim::Vec3f(0.0f) || light.sky.values[i] > kRounding ||
         light.sun.values[i] > kRounding;
}

Sorted sorted(const sim::Lighting& light, const std::vector<std::size_t>& of, Unreached unreached) {
  if (unreached == Unreached::count) return {of, {}};
  Sorted result;
  for (const std::size_t i : of) (isReached(light, i) ? result.counted : result.left_out).push_back(i);
  return result;
}

/// What the light of some surfaces is like.
ExposureRow rowOf(const ExposureTable& table, const sim::Lighting& light,
                  const std::vector<const sim::Received*>& received, const Sorted& surfaces) {
  const std::vector<std::size_t>& of = surfaces.counted;
  ExposureRow row;
  row.voxels = of.size();
  row.area_m2 = areaOf(light, of);
  row.left_out_m2 = areaOf(light, surfaces.left_out);
  row.spreads.resize(received.size());
  sim::parallelForEach(received.size(), [&](std::size_t q) {
    std::vector<std::pair<float, float>> values;
    values.reserve(of.size());
    for (const std::size_t i : of)
      values.emplace_back(received[q]->values[i], light.surfaces[i].surface.coverage);
    row.spreads[q] = spreadOf(std::move(values), table.quantities[q].range);
  });
  return row;
}

}  // namespace

std::string wayOf(sim::Vec3f normal, double north_deg) {
  return kWays[wayNumber(normal, north_deg)];
}

ExposureTable exposureTable(const std::string& scene, const sim::World& world, const sim::Lighting& light,
                            double north_deg, Unreached unreached) {
  ExposureTable table{scene, light.about, {}, {}, unreached};
  std::vector<const sim::Received*> received = {&light.sky};
  table.quantities.push_back(
      {"sky_exposure", "1", "what a surface receives of the sky by its own normal; open ground: 1", 1.0});
  if (!light.about.sun.empty()) {
    table.quantities.push_back({"sun_exposure", "1", "weighted share of the sun's way in sight", 1.0});
    table.quantities.push_back({"sun_hours", "hours a day", "direct sun", light.about.sun_hours});
    received.insert(received.end(), {&light.sun, &light.sun_hours});
  }
  const std::size_t parts = world.parts().size();
  std::vector<std::vector<std::size_t>> of(parts + 1);  // surfaces by part; the last holds all
  for (std::size_t i = 0; i < light.surfaces.size(); ++i)
    of[static_cast<std::size_t>(light.surfaces[i].surface.part - 1)].push_back(i);
  of.back().resize(light.surfaces.size());
  std::iota(of.back().begin(), of.back().end(), std::size_t{0});
  for (std::size_t p = 0; p <= parts; ++p) {
    const auto add = [&](const std::vector<std::size_t>& those, const std::string& faces) {
      const Sorted surfaces = sorted(light, those, unreached);
      if (surfaces.counted.empty()) return;
      ExposureRow row = rowOf(table, light, received, surfaces);
      row.faces = faces;
      if (p < parts) {
        row.object = world.parts()[p].object;
        row.region = world.parts()[p].region;
      }
      table.rows.push_back(std::move(row));
    };
    add(of[p], "");
    std::array<std::vector<std::size_t>, kWays.size()> facing;
    for (const std::size_t i : of[p])
      facing[wayNumber(light.surfaces[i].surface.normal, north_deg)].push_back(i);
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      add(facing[way], kWays[way]);
    }
  }
  const std::vector<std::size_t> left_out = sorted(light, of.back(), unreached).left_out;
  table.left_out = left_out.size();
  table.left_out_m2 = areaOf(light, left_out);
  return table;
}

std::string toCsv(const ExposureTable& table) {
  std::vector<std::string> header = {"scene",  "voxel_m", "object",      "region",   "faces",
                                     "voxels", "area_m2", "left_out_m2", "quantity", "unit"};
  for (const auto& [name, value] : numbersOf({})) header.emplace_back(name);
  header.emplace_back("histogram_to");
  for (std::size_t bin = 1; bin <= Spread::kBins; ++bin) header.push_back(fmt::format("share_{}", bin));
  for (const auto& [name, text] : texts(table.about)) header.push_back(name);
  std::string csv = joined(header);
  for (const ExposureRow& row : table.rows) {
    const bool total = row.object.empty();
    for (std::size_t q = 0; q < table.quantities.size(); ++q) {
      std::vector<std::string> fields = {field(table.scene),
                                         fmt::format("{:.6g}", table.about.voxel_m),
                                         total ? "total" : field(row.object),
                                         field(row.region),
                                         row.faces.empty() ? "all" : row.faces,
                                         std::to_string(row.voxels),
                                         fmt::format("{}", row.area_m2),
                                         fmt::format("{}", row.left_out_m2),
                                         table.quantities[q].name,
                                         table.quantities[q].unit};
      for (const auto& [name, value] : numbersOf(row.spreads[q])) fields.push_back(fmt::format("{}", value));
      fields.push_back(fmt::format("{}", rounded(table.quantities[q].range, kDecimals)));
      for (const double share : row.spreads[q].histogram) fields.push_back(fmt::format("{}", share));
      for (const auto& [name, text] : texts(table.about)) fields.push_back(field(text));
      csv += joined(fields);
    }
  }
  return csv;
}

std::string toJson(const ExposureTable& table) {
  Json json;
  json["scene"] = table.scene;
  json["light"] = lightJson(table.about);
  for (const auto& quantity : table.quantities) {
    json["quantities"][quantity.name] = {{"unit", quantity.unit},
                                         {"meaning", quantity.meaning},
                                         {"histogram_to", rounded(quantity.range, kDecimals)}};
  }
  json["weighted_by"] = "area";
  if (table.unreached == Unreached::leave_out) {
    json["left_out"] = {{"voxels", table.left_out},
                        {"area_m2", table.left_out_m2},
                        {"meaning", "surfaces from which no sky and no sun is seen"}};
  }
  json["regions"] = Json::array();
  for (const ExposureRow& row : table.rows) {
    if (!row.faces.empty()) {
      Json& whole = row.object.empty() ? json["total"] : json["regions"].back();
      whole["facing"].push_back(rowJson(table, row));
    } else if (row.object.empty()) {
      json["total"] = rowJson(table, row);
    } else {
      json["regions"].push_back(rowJson(table, row));
    }
  }
  return json.dump(2) + "\n";
}

namespace {

/// The rows that a person will look at: the largest regions, in their order, the total, and that by where it
/// faces.
std::vector<const ExposureRow*> rowsToShow(const std::vector<ExposureRow>& rows) {
  constexpr std::size_t kMost = 40;
  std::vector<const ExposureRow*> shown, total;
  for (const ExposureRow& row : rows) {
    if (row.object.empty()) {
      total.push_back(&row);
    } else if (row.faces.empty()) {
      shown.push_back(&row);
    }
  }
  if (shown.size() > kMost) {
    std::stable_sort(shown.begin(), shown.end(),
                     [](const ExposureRow* a, const ExposureRow* b) { return a->area_m2 > b->area_m2; });
    shown.resize(kMost);
    std::sort(shown.begin(), shown.end());
  }
  shown.insert(shown.end(), total.begin(), total.end());
  return shown;
}

}  // namespace

std::string toText(const ExposureTable& table) {
  const bool objects = std::any_of(table.rows.begin(), table.rows.end(), [&](const ExposureRow& row) {
    return !row.object.empty() && row.object != table.rows.front().object;
  });
  const auto nameOf = [&](const ExposureRow& row) {
    if (!row.faces.empty()) return "  facing " + row.faces;
    if (row.object.empty()) return std::string("all surfaces");
    return objects ? row.object + ", " + row.region : row.region;
  };
  const std::vector<const ExposureRow*> rows = rowsToShow(table.rows);
  std::size_t width = 0;
  for (const ExposureRow* row : rows) width = std::max(width, nameOf(*row).size());
  std::string text = fmt::format("{:{}}  {:>10}", "", width, "area m2");
  for (const auto& [name, unit, meaning, range] : table.quantities)
    text += fmt::format("  {:>22}", unit == "1" ? name : name + ", " + unit);
  text += "\n";
  for (const ExposureRow* row : rows) {
    text += fmt::format("{:{}}  {:>10.2f}", nameOf(*row), width, row->area_m2);
    for (std::size_t q = 0; q < table.quantities.size(); ++q) {
      const Spread& s = row->spreads[q];
      text += fmt::format(
          "  {:>22}", fmt::format("{:.2f} ({:.2f} .. {:.2f})", s.mean, s.lower_quartile, s.upper_quartile));
    }
    text += "\n";
  }
  const auto regions = [](const auto& all, auto rowAt) {
    return std::count_if(all.begin(), all.end(), [&](const auto& row) {
      return !rowAt(row).object.empty() && rowAt(row).faces.empty();
    });
  };
  const auto left = regions(table.rows, [](const ExposureRow& row) -> const ExposureRow& { return row; }) -
                    regions(rows, [](const ExposureRow* row) -> const ExposureRow& { return *row; });
  if (left > 0) text += fmt::format("and {} smaller regions, in exposure.csv\n", left);
  if (table.unreached == Unreached::leave_out) {
    text += fmt::format("left out: {:.2f} m2 from which no sky and no sun is seen ({} voxels)\n",
                        table.left_out_m2, table.left_out);
  }
  return text + "means by area, with the quartiles\n";
}

}  // namespace espalier::scenes
