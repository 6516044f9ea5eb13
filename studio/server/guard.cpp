#include "studio/server/guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/base/error.h"

namespace espalier::studio {
namespace {

constexpr int kMisdirected = 421, kForbidden = 403;

bool isThisHost(std::string_view host, int port) {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool isThisOrigin(std::string_view origin, int port) {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && isThisHost(origin.substr(kScheme.size()), port);
}

}  // namespace

std::string newToken() {
  std::array<std::uint8_t, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw sim::InputError("the system gives no random numbers for a token");
  std::string token;
  for (const std::uint8_t byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool sameSecret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differs = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differs |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return differs == 0;
}

int refusalByPlace(const Asker& asker, const House& house) {
  if (!isThisHost(asker.host, house.port)) return kMisdirected;
  const bool plain = asker.method == "GET";
  // Pages of this one say where they come from in all that changes anything; what is typed into the address
  // line, or comes from no browser, says nothing.
  if (!asker.origin.empty() && !isThisOrigin(asker.origin, house.port)) return kForbidden;
  if (!plain && asker.origin.empty()) return kForbidden;
  const bool from_here = asker.fetch_site.empty() || asker.fetch_site == "same-origin";
  if (!plain && !from_here) return kForbidden;
  // A link elsewhere may lead to the page, and gets no further than the cookie allows: SameSite keeps it
  // away.
  return 0;
}

std::string cookieName(int port) {
  return fmt::format("espalier-studio-{}", port);
}

bool knowsToken(const Asker& asker, const House& house) {
  const std::string wanted = cookieName(house.port) + "=";
  std::string_view rest = asker.cookie;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    std::string_view one = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
    if (one.starts_with(wanted) && sameSecret(one.substr(wanted.size()), house.token)) return true;
  }
  return false;
}

}  // namespace espalier::studio
