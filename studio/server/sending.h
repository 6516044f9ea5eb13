#pragma once
// Internal to the wing.
#include <httplib.h>

#include <memory>
#include <string>

#include "studio/session/assets.h"
#include "studio/session/hub.h"

/// Answers that are sent piece by piece, as they are taken: a page that takes nothing, as one of a laptop
/// whose lid is closed, is given up after a while, and until then keeps nobody from ending.
namespace espalier::studio {

/// An answer of bytes.
void give(httplib::Response& response, Assets::Bytes bytes, const char* type);
void give(httplib::Response& response, std::string bytes, const char* type);

/// An answer that goes on for as long as there is something to listen to.
void stream(httplib::Response& response, std::shared_ptr<Listener> listener, const char* type);

}  // namespace espalier::studio
