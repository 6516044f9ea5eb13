// The server as a browser, and as a hostile page, meets it.
#include "studio/server/server.h"

#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "studio/server/guard.h"
#include "tests/studio/small_project.h"

namespace espalier::studio {
namespace {

using nlohmann::json;

class Served : public tests::SmallProject {
 protected:
  void SetUp() override {
    SmallProject::SetUp();
    session_ = std::make_unique<Session>(scratch_.path("scene.yaml"), 2);
    server_ = std::make_unique<Server>(*session_, 0);
    const std::string address = server_->address();
    token_ = address.substr(address.find("token=") + 6);
    host_ = "127.0.0.1:" + std::to_string(server_->port());
    page_ = {{"Host", host_},
             {"Cookie", cookieName(server_->port()) + "=" + token_},
             {"Origin", "http://" + host_},
             {"Sec-Fetch-Site", "same-origin"}};
  }
  httplib::Client client() {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_read_timeout(60);
    return client;
  }
  static httplib::Headers without(httplib::Headers headers, const std::string& name) {
    headers.erase(name);
    return headers;
  }

  std::unique_ptr<Session> session_;
  std::unique_ptr<Server> server_;
  std::string token_, host_;
  httplib::Headers page_;
};

TEST_F(Served, TheAddressWithTheTokenGivesTheCookie) {
  auto http = client();
  const auto opened = http.Get("/?token=" + token_);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->status, 303);
  EXPECT_EQ(opened->get_header_value("Location"), "/");
  const std::string cookie = opened->get_header_value("Set-Cookie");
  EXPECT_NE(cookie.find(token_), std::string::npos);
  EXPECT_NE(cookie.find("HttpOnly"), std::string::npos);
  EXPECT_NE(cookie.find("SameSite=Strict"), std::string::npos);
  EXPECT_EQ(http.Get("/?token=" + std::string(32, '0'))->status, 403);
  EXPECT_EQ(http.Get("/")->status, 403);
  EXPECT_EQ(http.Get("/api/project")->status, 403);
}

TEST_F(Served, EveryAnswerIsClosedToOthers) {
  auto http = client();
  const std::vector<std::pair<std::string, httplib::Headers>> asked{
      {"/", page_}, {"/api/project", page_}, {"/nothing", page_}, {"/api/project", {}}};
  for (const auto& [path, headers] : asked) {
    const auto answer = http.Get(path, headers);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff") << path;
    EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store") << path;
    EXPECT_NE(answer->get_header_value("Content-Security-Policy").find("default-src 'none'"),
              std::string::npos)
        << path;
    EXPECT_FALSE(answer->has_header("Access-Control-Allow-Origin")) << path;
  }
}

TEST_F(Served, AHostilePageGetsNothing) {
  auto http = client();
  const std::string edit = json{{"texts", {{"vine.yaml", "gone"}}}}.dump();
  const auto posted = [&](const std::string& name, const std::string& value) {
    httplib::Headers headers = without(page_, name);
    if (!value.empty()) headers.emplace(name, value);
    const auto answer = http.Post("/api/edit", headers, edit, "application/json");
    return answer ? answer->status : -1;
  };
  EXPECT_EQ(posted("Host", "evil.example"), 421);
  EXPECT_EQ(posted("Origin", "http://evil.example"), 403);
  EXPECT_EQ(posted("Origin", ""), 403);
  EXPECT_EQ(posted("Sec-Fetch-Site", "cross-site"), 403);
  EXPECT_EQ(posted("Cookie", ""), 403);
  EXPECT_EQ(posted("Cookie", cookieName(server_->port()) + "=" + std::string(32, '0')), 403);
  const auto preflight = http.Options("/api/edit", {{"Host", host_}, {"Origin", "http://evil.example"}});
  ASSERT_TRUE(preflight);
  EXPECT_EQ(preflight->status, 403);
  EXPECT_EQ(json::parse(session_->project())["version"], 1) << "nothing was edited";
}

TEST_F(Served, NoPathLeadsToFiles) {
  auto http = client();
  for (const char* path : {"/../scene.yaml", "/%2e%2e/scene.yaml", "/scene.yaml",
                           "/api/export/..%2fscene.yaml", "/api/export/report.json",
                           "/api/site/0000000000000000.glb", "/api/texture/..%2f.png", "/etc/passwd"}) {
    const auto answer = http.Get(path, page_);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 404) << path;
  }
}

TEST_F(Served, EditsAndQuestionsGoThrough) {
  auto http = client();
  const auto post = [&](const std::string& path, const json& body) {
    const auto answer = http.Post(path, page_, body.dump(), "application/json");
    EXPECT_TRUE(answer) << path;
    return answer ? *answer : httplib::Response();
  };
  const auto edited =
      post("/api/edit", {{"texts", {{"vine.yaml", tests::replaced(tests::kSmallRules, "up", "upp")}}}});
  EXPECT_EQ(edited.status, 200);
  EXPECT_EQ(json::parse(edited.body)["problems"][0]["fix"], "up");
  EXPECT_EQ(post("/api/place", {{"planting", "vine"}, {"seed", 0}, {"at_m", {0.1, 0.2, 0.3}}}).status, 409)
      << "of texts that are wrong";
  post("/api/edit", {{"texts", {{"vine.yaml", tests::kSmallRules}}}});
  const auto placed = post("/api/place", {{"planting", "vine"}, {"seed", 0}, {"at_m", {0.1, 0.2, 0.3}}});
  EXPECT_EQ(placed.status, 200) << placed.body;
  EXPECT_EQ(json::parse(placed.body)["edits"].size(), 3u);
  for (const char* path : {"/api/project", "/api/library", "/api/schema/rules", "/api/schema/scene"}) {
    const auto answer = http.Get(path, page_);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 200) << path;
    EXPECT_TRUE(json::accept(answer->body)) << path;
  }
}

TEST_F(Served, BodiesThatAreNoneAreRefused) {
  auto http = client();
  const std::string deep = std::string(5000, '[') + std::string(5000, ']');
  for (const std::string& body :
       {std::string(), std::string("{"), std::string("[]"), std::string("null"), std::string("{\"texts\":1}"),
        std::string("{\"texts\":{\"vine.yaml\":7}}"), std::string("{\"texts\":{\"/etc/passwd\":\"\"}}"),
        "{\"texts\":" + deep + "}", std::string("\xff\xfe{")}) {
    const auto answer = http.Post("/api/edit", page_, body, "application/json");
    ASSERT_TRUE(answer) << body;
    EXPECT_EQ(answer->status, 400) << body;
  }
  for (const char* body :
       {"{}", R"({"version":-1,"plant":0,"node":0})", R"({"version":1e30,"plant":0,"node":0})",
        R"({"version":1,"plant":0,"node":3000000000})", R"({"version":"1","plant":0,"node":0})"})
    EXPECT_EQ(http.Post("/api/why", page_, body, "application/json")->status, 400) << body;
  EXPECT_EQ(
      http.Post("/api/place", page_, R"({"planting":"vine","at_m":[1,2,1e300]})", "application/json")->status,
      400);
  for (const char* version : {"", "x", "-1", "99999999999999999999"})
    EXPECT_EQ(http.Get(std::string("/api/surfaces?version=") + version, page_)->status, 400) << version;
}

TEST_F(Served, AHundredMegabytesAreRefusedBeforeTheyAreKept) {
  auto http = client();
  const std::string large(100'000'000, 'x');
  const auto answer = http.Post("/api/edit", page_, large, "application/json");
  if (answer) {  // or it hung up on us
    EXPECT_EQ(answer->status, 413);
  }
  EXPECT_EQ(client().Get("/api/project", page_)->status, 200) << "and lives";
}

TEST_F(Served, AFloodOfRequestsIsServed) {
  std::atomic<int> good{0}, bad{0};
  std::vector<std::thread> pages;
  for (int t = 0; t < 24; ++t) {
    pages.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        auto http = client();
        const auto answer = http.Get(i % 2 ? "/api/project" : "/nothing", page_);
        ++(answer && (answer->status == 200 || answer->status == 404) ? good : bad);
      }
    });
  }
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(bad, 0);
  EXPECT_EQ(good, 480);
}

TEST_F(Served, StreamsAreFewAndEndWithTheServer) {
  std::atomic<int> streaming{0}, refused{0}, ended{0};
  std::vector<std::thread> pages;
  for (int t = 0; t < 6; ++t) {
    pages.emplace_back([&] {
      auto http = client();
      bool counted = false;
      const auto answer = http.Get("/api/stream", page_, [&](const char*, std::size_t) {
        if (!std::exchange(counted, true)) ++streaming;
        return true;
      });
      if (answer && answer->status == 429) ++refused;
      ++ended;
    });
  }
  const auto began = std::chrono::steady_clock::now();
  while ((streaming < 4 || refused < 2) &&
         std::chrono::steady_clock::now() - began < std::chrono::seconds(30))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(refused, 2);
  const auto closing = std::chrono::steady_clock::now();
  server_.reset();
  session_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - closing, std::chrono::seconds(3))
      << "ten times what is promised";
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(ended, 6);
}

/// A page that never reads: its laptop's lid is closed.
TEST_F(Served, AClosedLidHoldsNobodyUp) {
  const int lid = ::socket(AF_INET, SOCK_STREAM, 0);
  const int little = 4096;  // of what the system takes on its behalf
  ::setsockopt(lid, SOL_SOCKET, SO_RCVBUF, &little, sizeof little);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(lid, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  std::string request = "GET /api/stream HTTP/1.1\r\n";
  for (const auto& [name, value] : page_) request += name + ": " + value + "\r\n";
  request += "\r\n";
  ASSERT_EQ(::send(lid, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
  auto http = client();
  for (int i = 0; i < 150; ++i) {
    const std::string text =
        tests::replaced(tests::kSmallRules, "up: 0.1", "up: 0.1" + std::to_string(i % 7));
    const auto answer =
        http.Post("/api/edit", page_, json{{"texts", {{"vine.yaml", text}}}}.dump(), "application/json");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
    if (i % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto closing = std::chrono::steady_clock::now();
  server_.reset();
  session_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - closing, std::chrono::seconds(3))
      << "ten times what is promised";
  ::close(lid);
}

}  // namespace
}  // namespace espalier::studio
