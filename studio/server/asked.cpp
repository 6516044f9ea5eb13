#include "studio/server/asked.h"

#include <charconv>
#include <cmath>

#include "studio/session/refused.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

constexpr int kBadRequest = 400;
constexpr int kMostDepth = 16;
constexpr double kFarthest_m = 1e7;

[[noreturn]] void refuse(const char* key, const std::string& expected) {
  throw Refused(kBadRequest, std::string(key) + ": expected " + expected);
}

}  // namespace

struct AskedBody::Parsed {
  Json json;
};

AskedBody::AskedBody(const std::string& body) {
  bool deep = false;
  const auto no_deeper = [&](int depth, Json::parse_event_t, const Json&) {
    deep = deep || depth > kMostDepth;
    return depth <= kMostDepth;
  };
  Json json = Json::parse(body, no_deeper, false);
  if (json.is_discarded() || !json.is_object() || deep)
    throw Refused(kBadRequest, "the body is no JSON that is known here; expected an object");
  parsed_ = std::make_unique<const Parsed>(Parsed{std::move(json)});
}

AskedBody::~AskedBody() = default;

bool AskedBody::has(const char* key) const {
  return parsed_->json.contains(key);
}

std::string AskedBody::text(const char* key) const {
  if (!has(key) || !parsed_->json[key].is_string()) refuse(key, "a text");
  return parsed_->json[key].get<std::string>();
}

std::map<std::string, std::string> AskedBody::texts(const char* key) const {
  if (!has(key) || !parsed_->json[key].is_object()) refuse(key, "texts by the names of their files");
  std::map<std::string, std::string> texts;
  for (const auto& [name, text] : parsed_->json[key].items()) {
    if (!text.is_string()) refuse(key, "texts by the names of their files");
    texts[name] = text.get<std::string>();
  }
  return texts;
}

sim::Vec3 AskedBody::place(const char* key) const {
  const Json& json = parsed_->json;
  if (!has(key) || !json[key].is_array() || json[key].size() != 3) refuse(key, "three numbers");
  sim::Vec3 place(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Json& number = json[key][axis];
    if (!number.is_number() || !(std::abs(number.get<double>()) <= kFarthest_m)) refuse(key, "three numbers");
    place[static_cast<int>(axis)] = number.get<double>();
  }
  return place;
}

std::int64_t AskedBody::number(const char* key, std::int64_t low, std::int64_t high) const {
  const Json& json = parsed_->json;
  if (!has(key) || !json[key].is_number_integer()) refuse(key, "a whole number");
  const auto number = json[key].get<std::int64_t>();
  if (number < low || number > high) refuse(key, "a whole number that can be");
  return number;
}

double metresOf(const std::string& text) {
  double metres = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), metres);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(metres) <= kFarthest_m))
    throw Refused(kBadRequest, "expected a number of metres");
  return metres;
}

std::int64_t wholeNumber(const std::string& text, std::int64_t high) {
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0 || number > high)
    throw Refused(kBadRequest, "expected a whole number");
  return number;
}

}  // namespace espalier::studio
