#pragma once
#include <string>
#include <string_view>

namespace espalier::studio {

/// Who may ask: this machine's own page, whose cookie holds the token. Plain functions of what a request says
/// of itself, so that they can be tested as such.

/// 128 bits from the system, in hexadecimal digits. Throws InputError where the system gives none.
std::string newToken();

/// Takes as long whatever differs.
bool sameSecret(std::string_view a, std::string_view b);

/// What of a request its judgment hangs on. Headers that are not there are empty.
struct Asker {
  std::string_view method, host, origin, fetch_site, cookie;
};

/// What a server knows of itself.
struct House {
  int port = 0;
  std::string token;
};

/// The status with which to refuse a request before anything else is looked at: 421 for another host than
/// this one, 403 for a page from elsewhere; 0: none.
int refusalByPlace(const Asker& asker, const House& house);
/// Whether its cookie has the token.
bool knowsToken(const Asker& asker, const House& house);

/// What the cookie is called: of each port its own, as cookies do not tell ports apart.
std::string cookieName(int port);

}  // namespace espalier::studio
