#include "studio/server/server.h"

#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/problem.h"
#include "scenes/read/json_schema.h"
#include "scenes/read/rule_library.h"
#include "sim/base/error.h"
#include "studio/server/asked.h"
#include "studio/server/guard.h"
#include "studio/server/page_files.h"
#include "studio/server/sending.h"
#include "studio/session/refused.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kMostBody = std::size_t{1} << 20;
constexpr std::size_t kThreads = 12;  // each stream holds one
constexpr const char* kJson = "application/json";
constexpr const char* kBinary = "application/octet-stream";

Asker askerOf(const httplib::Request& request, std::map<std::string, std::string>& headers) {
  for (const char* name : {"Host", "Origin", "Sec-Fetch-Site", "Cookie"})
    headers[name] = request.get_header_value(name);
  return {request.method, headers["Host"], headers["Origin"], headers["Sec-Fetch-Site"], headers["Cookie"]};
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(textOf({{"error", why}}), kJson);
}

std::string libraryJson() {
  Json rules = Json::array();
  for (const scenes::LibraryRules& one : scenes::ruleLibrary())
    rules.push_back({{"name", one.name}, {"about", scenes::aboutOf(one)}, {"text", one.text}});
  return textOf({{"rules", std::move(rules)}});
}

/// No room is left for a browser to guess, keep or let others frame what it is sent.
httplib::Headers headersOfAll() {
  return {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
       "connect-src 'self' blob:; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; "
       "frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Cache-Control", "no-store"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
}

}  // namespace

class Server::Routes {
 public:
  Routes(Session& session, int port) : session_(session) {
    house_.token = newToken();
    http_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // Not the library's own choice, by which another process could listen at the same port.
    http_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http_.set_payload_max_length(kMostBody);
    http_.set_read_timeout(10);
    http_.set_write_timeout(0, 100'000);
    // The library waits out an idle connection before it stops; on one machine a new one costs nothing.
    http_.set_keep_alive_max_count(1);
    http_.set_keep_alive_timeout(1);
    http_.set_default_headers(headersOfAll());
    http_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return judge(request, response);
    });
    http_.set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, std::exception_ptr thrown) {
          try {
            std::rethrow_exception(thrown);
          } catch (const Refused& refused) {
            refuse(response, refused.status(), scenes::cleanText(refused.what()));
          } catch (const std::exception& error) {
            refuse(response, 500, scenes::cleanText(error.what()));
          }
        });
    http_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) refuse(response, response.status, "there is nothing here");
    });
    addPage();
    addReading();
    addWriting();
    addStream();
    house_.port =
        port == 0 ? http_.bind_to_any_port("127.0.0.1") : (http_.bind_to_port("127.0.0.1", port) ? port : -1);
    if (house_.port <= 0)
      throw sim::InputError("the port " + std::to_string(port) +
                            " of this machine cannot be had; expected one that is free");
    listening_ = std::thread([this] { http_.listen_after_bind(); });
  }

  ~Routes() {
    session_.end();
    http_.stop();
    listening_.join();
  }

  const House& house() const { return house_; }

 private:
  using Response = httplib::Response;
  using Request = httplib::Request;
  using Handled = httplib::Server::HandlerResponse;

  Handled judge(const Request& request, Response& response) const {
    std::map<std::string, std::string> headers;
    const Asker asker = askerOf(request, headers);
    if (const int status = refusalByPlace(asker, house_); status != 0) {
      refuse(response, status, "this address is for its own page alone");
      return Handled::Handled;
    }
    const std::string token = request.get_param_value("token");
    if (request.method == "GET" && request.path == "/" && !token.empty()) {
      if (sameSecret(token, house_.token)) {
        response.set_header("Set-Cookie", cookieName(house_.port) + "=" + house_.token +
                                              "; HttpOnly; SameSite=Strict; Path=/");
        response.set_redirect("/", 303);
        return Handled::Handled;
      }
    } else if (knowsToken(asker, house_)) {
      return Handled::Unhandled;
    }
    refuse(response, 403, "open the address that espalier studio printed, which has a token");
    return Handled::Handled;
  }

  void addPage() {
    for (const PageFile& file : pageFiles()) {
      const auto page = [&file](const Request&, Response& response) {
        give(response, std::string(file.bytes), std::string(file.type).c_str());
      };
      http_.Get("/" + literal(file.path), page);
      if (file.path == "index.html") http_.Get("/", page);
    }
    if (pageFiles().empty()) {
      http_.Get("/", [](const Request&, Response& response) {
        response.set_content(
            "This espalier was built without its page: node 18 or newer and npm were missing, "
            "or npm could not fetch what the page is made from.\n",
            "text/plain; charset=utf-8");
      });
    }
  }

  /// A path as the pattern that httplib takes.
  static std::string literal(std::string_view path) {
    std::string pattern;
    for (const char c : path) {
      if (c == '.') pattern += '\\';
      pattern += c;
    }
    return pattern;
  }

  void addReading() {
    const auto get = [this](const char* pattern, auto make) {
      http_.Get(pattern,
                [make](const Request& request, Response& response) { give(response, make(request), kJson); });
    };
    get("/api/project", [this](const Request&) { return session_.project(); });
    get("/api/library", [](const Request&) { return libraryJson(); });
    get("/api/schema/rules", [](const Request&) { return scenes::schemaFor(scenes::FileKind::rules); });
    get("/api/schema/scene", [](const Request&) { return scenes::schemaFor(scenes::FileKind::scene); });
    const auto file = [this](const char* pattern, const char* type, auto find) {
      http_.Get(pattern, [find, type](const Request& request, Response& response) {
        const Assets::Bytes bytes = find(request.matches[1].str());
        if (!bytes) throw Refused(404, "it is gone");
        give(response, bytes, type);
      });
    };
    file(R"(/api/site/([0-9a-f]{16})\.glb)", "model/gltf-binary",
         [this](const std::string& id) { return session_.assets().site(id); });
    file(R"(/api/texture/([0-9a-f]{16})\.png)", "image/png",
         [this](const std::string& id) { return session_.assets().texture(id); });
    http_.Get("/api/surfaces", [this](const Request& request, Response& response) {
      give(response, session_.surfaces(wholeOf<Version>(request.get_param_value("version"))), kBinary);
    });
    http_.Get("/api/layers", [this](const Request& request, Response& response) {
      const std::string axis = request.get_param_value("axis");
      if (axis != "x" && axis != "y" && axis != "z") throw Refused(400, "axis: expected x, y or z");
      give(response,
           session_.layers(wholeOf<Version>(request.get_param_value("version")), axis[0] - 'x',
                           metresOf(request.get_param_value("at"))),
           kBinary);
    });
    http_.Get(R"(/api/export/([A-Za-z0-9_.-]+))", [this](const Request& request, Response& response) {
      const std::string name = request.matches[1].str();
      auto bytes = session_.exported(name);
      if (!bytes) throw Refused(404, "it is gone");
      response.set_header("Content-Disposition", "attachment; filename=\"" + name + "\"");
      give(response, std::move(*bytes), kBinary);
    });
  }

  void addWriting() {
    const auto post = [this](const char* path, auto make) {
      http_.Post(path, [make](const Request& request, Response& response) {
        give(response, make(AskedBody(request.body)), kJson);
      });
    };
    post("/api/edit", [this](const AskedBody& asked) { return session_.edit(asked.texts("texts")); });
    post("/api/why", [this](const AskedBody& asked) {
      return session_.why(asked.whole<Version>("version"), asked.whole<std::uint32_t>("plant"),
                          asked.whole<std::int32_t>("node"));
    });
    post("/api/place", [this](const AskedBody& asked) {
      if (asked.has("camera"))
        return session_.setCamera(asked.text("camera"), asked.place("eye_m"), asked.place("target_m"));
      if (asked.has("seed"))
        return session_.moveSeed(asked.text("planting"), asked.whole<std::uint32_t>("seed"),
                                 asked.place("at_m"));
      return session_.addSeed(asked.text("planting"), asked.place("at_m"));
    });
    post("/api/export", [this](const AskedBody& asked) {
      return session_.makeExport(asked.text("what"), asked.has("image") ? asked.text("image") : "");
    });
    http_.Post("/api/save", [this](const Request& request, Response& response) {
      const AskedBody asked(request.body);
      const Session::Saved saved = session_.save(asked.text("file"), asked.text("text"), asked.text("saved"));
      if (saved.conflict) response.status = 409;
      give(response, saved.json, kJson);
    });
  }

  void addStream() {
    http_.Get("/api/stream", [this](const Request&, Response& response) {
      const std::shared_ptr<Listener> listener = session_.listen();
      if (!listener) throw Refused(429, "too many pages are open");
      stream(response, listener, kBinary);
    });
  }

  Session& session_;
  House house_;
  httplib::Server http_;
  std::thread listening_;
};

Server::Server(Session& session, int port) : routes_(std::make_unique<Routes>(session, port)) {}
Server::~Server() = default;

int Server::port() const {
  return routes_->house().port;
}

std::string Server::address() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/?token=" + routes_->house().token;
}

}  // namespace espalier::studio
