#include "scenes/import/gltf_json.h"

#include "scenes/problem.h"

namespace espalier::scenes::gltf {
namespace {

std::uint64_t wholeOf(const Json& value, const char* key) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;  // sums of some such numbers cannot overflow
  if (value.is_number_unsigned() && value.get<std::uint64_t>() <= kMost) return value.get<std::uint64_t>();
  throw sim::InputError(fmt::format("{} is {}; expected a whole number from 0 on", key, shown(value)));
}

[[noreturn]] void failMissing(const char* key) {
  throw sim::InputError(fmt::format("it has no {}", key));
}

}  // namespace

std::string shown(const Json& value) {
  if (value.is_string()) return inQuotes(value.get_ref<const std::string&>());
  return value.is_primitive() ? value.dump() : std::string("an ") + value.type_name();
}

std::optional<std::uint64_t> wholeIn(const Json& object, const char* key) {
  const auto member = object.find(key);
  if (member == object.end()) return std::nullopt;
  return wholeOf(*member, key);
}

std::uint64_t requiredWhole(const Json& object, const char* key) {
  const auto whole = wholeIn(object, key);
  if (!whole) failMissing(key);
  return *whole;
}

const Json& listIn(const Json& object, const char* key) {
  static const Json kNone = Json::array();
  const auto member = object.find(key);
  if (member == object.end()) return kNone;
  if (!member->is_array())
    throw sim::InputError(fmt::format("{} is {}; expected an array", key, shown(*member)));
  return *member;
}

const Json& objectsIn(const Json& object, const char* key) {
  const Json& list = listIn(object, key);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_object())
      throw sim::InputError(fmt::format("number {} of {} is {}; expected an object", i, key, shown(list[i])));
  }
  return list;
}

const std::string& requiredText(const Json& object, const char* key) {
  const auto member = object.find(key);
  if (member == object.end()) failMissing(key);
  if (!member->is_string())
    throw sim::InputError(fmt::format("{} is {}; expected a text", key, shown(*member)));
  return member->get_ref<const std::string&>();
}

const Json& requiredObject(const Json& object, const char* key) {
  const auto member = object.find(key);
  if (member == object.end()) failMissing(key);
  if (!member->is_object())
    throw sim::InputError(fmt::format("{} is {}; expected an object", key, shown(*member)));
  return *member;
}

std::size_t indexOf(const Json& value, const char* key, const Json& document, const char* list) {
  const std::uint64_t index = wholeOf(value, key);
  const std::size_t count = listIn(document, list).size();
  if (index >= count)
    throw sim::InputError(fmt::format("{} is {}, but the file has {} {}", key, index, count, list));
  return static_cast<std::size_t>(index);
}

std::optional<std::size_t> indexIn(const Json& object, const char* key, const Json& document,
                                   const char* list) {
  const auto member = object.find(key);
  if (member == object.end()) return std::nullopt;
  return indexOf(*member, key, document, list);
}

std::size_t requiredIndex(const Json& object, const char* key, const Json& document, const char* list) {
  const auto index = indexIn(object, key, document, list);
  if (!index) failMissing(key);
  return *index;
}

}  // namespace espalier::scenes::gltf
