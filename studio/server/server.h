#pragma once
#include <memory>
#include <string>

#include "studio/session/session.h"

namespace espalier::studio {

/// Serves a session and its page to browsers of this machine, and to nobody else (README.md, "Protocol").
class Server {
 public:
  /// Listens on 127.0.0.1 at once; `port` 0: at one that is free. The session is borrowed. Throws InputError
  /// where the port cannot be had.
  Server(Session& session, int port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// Where the page is, with the token.
  std::string address() const;

 private:
  class Routes;
  std::unique_ptr<Routes> routes_;
};

}  // namespace espalier::studio
