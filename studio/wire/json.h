#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "sim/base/vec.h"

/// JSON of the protocol. For sources of this room alone: nlohmann's header is heavy.
namespace espalier::studio {

using Json = nlohmann::ordered_json;

template <class Vector>
Json jsonOf(const Vector& v) requires requires {
  v.x + v.y + v.z;
}
{ return Json::array({v.x, v.y, v.z}); }

/// Bytes that are no UTF-8 are replaced.
inline std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace espalier::studio
