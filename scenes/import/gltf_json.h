#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/error.h"

/// Members of glTF's JSON, taken strictly: who takes `-4`, `12.0` or a text for some whole number reads past
/// what is there. All throw sim::InputError, which names the member.
namespace espalier::scenes::gltf {

using Json = nlohmann::json;

/// A whole number from 0 on; nothing where there is no such member.
std::optional<std::uint64_t> wholeIn(const Json& object, const char* key);
std::uint64_t requiredWhole(const Json& object, const char* key);

/// An array; empty where there is no such member.
const Json& listIn(const Json& object, const char* key);
/// The same of objects alone.
const Json& objectsIn(const Json& object, const char* key);
/// An object that must be there.
const Json& requiredObject(const Json& object, const char* key);
/// A text that must be there.
const std::string& requiredText(const Json& object, const char* key);
/// A value for a message.
std::string shown(const Json& value);

/// The number of an entry of the document's `list`.
std::size_t indexOf(const Json& value, const char* key, const Json& document, const char* list);
/// Nothing where there is no such member.
std::optional<std::size_t> indexIn(const Json& object, const char* key, const Json& document,
                                   const char* list);
std::size_t requiredIndex(const Json& object, const char* key, const Json& document, const char* list);

/// Does `work`; an error in it then begins with the part of the file that is meant: "bufferView 3: ...".
template <class Work>
auto inPart(const char* part, std::size_t number, Work work) {
  try {
    return work();
  } catch (const sim::InputError& error) {
    throw sim::InputError(fmt::format("{} {}: {}", part, number, error.what()));
  } catch (const Json::exception&) {
    throw sim::InputError(
        fmt::format("{} {}: a member of it is of another kind than glTF has it", part, number));
  }
}

}  // namespace espalier::scenes::gltf
