// Who may ask: the page of this server, by its cookie, from this machine's own name.
#include "studio/server/guard.h"

#include <gtest/gtest.h>

namespace espalier::studio {
namespace {

const House kHouse{8123, "0123456789abcdef0123456789abcdef"};

TEST(Guard, OnlyThisHostIsServed) {
  for (const char* host : {"127.0.0.1:8123", "localhost:8123"})
    EXPECT_EQ(refusalByPlace({"GET", host, "", "", ""}, kHouse), 0) << host;
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:8124", "evil.example:8123", "127.0.0.1:8123.evil.example", "evil.example",
        "localhost:81230", "[::1]:8123", "LOCALHOST:8123", "0.0.0.0:8123"})
    EXPECT_EQ(refusalByPlace({"GET", host, "", "", ""}, kHouse), 421) << host;
}

TEST(Guard, WhatChangesAnythingComesFromThePageItself) {
  const auto judged = [](const char* method, const char* origin, const char* site) {
    return refusalByPlace({method, "127.0.0.1:8123", origin, site, ""}, kHouse);
  };
  EXPECT_EQ(judged("POST", "http://127.0.0.1:8123", "same-origin"), 0);
  EXPECT_EQ(judged("POST", "http://localhost:8123", "same-origin"), 0);
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "HEAD", "PATCH"}) {
    EXPECT_EQ(judged(method, "", "same-origin"), 403) << method;
    EXPECT_EQ(judged(method, "null", "same-origin"), 403) << method;
    EXPECT_EQ(judged(method, "http://evil.example", "cross-site"), 403) << method;
    EXPECT_EQ(judged(method, "http://127.0.0.1:8124", "same-site"), 403) << method;
    EXPECT_EQ(judged(method, "https://127.0.0.1:8123", "same-origin"), 403) << method;
    EXPECT_EQ(judged(method, "http://127.0.0.1:8123", "cross-site"), 403) << method;
    EXPECT_EQ(judged(method, "http://127.0.0.1:8123", "same-site"), 403) << method;
  }
  EXPECT_EQ(judged("GET", "", "none"), 0) << "typed into the address line";
  EXPECT_EQ(judged("GET", "http://evil.example", "cross-site"), 403);
}

TEST(Guard, TheCookieHasTheToken) {
  const auto knows = [](const std::string& cookie) {
    return knowsToken({"GET", "127.0.0.1:8123", "", "", cookie}, kHouse);
  };
  const std::string own = cookieName(8123) + "=" + kHouse.token;
  EXPECT_TRUE(knows(own));
  EXPECT_TRUE(knows("a=b; " + own));
  EXPECT_TRUE(knows(own + "; c=d"));
  for (const std::string& cookie :
       {std::string(), cookieName(8123), cookieName(8123) + "=", own + "0", own.substr(0, own.size() - 1),
        "x" + own, cookieName(8124) + "=" + kHouse.token, "a=" + own})
    EXPECT_FALSE(knows(cookie)) << cookie;
}

TEST(Guard, TokensAreLongAndNeverTheSame) {
  const std::string a = newToken(), b = newToken();
  EXPECT_EQ(a.size(), 32u);
  EXPECT_EQ(a.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(a, b);
  EXPECT_TRUE(sameSecret(a, a));
  EXPECT_FALSE(sameSecret(a, b));
  EXPECT_FALSE(sameSecret(a, a.substr(1)));
}

}  // namespace
}  // namespace espalier::studio
