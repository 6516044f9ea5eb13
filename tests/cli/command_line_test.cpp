// Commands that grow nothing, and mistakes in the words that the program is started with.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.h"

namespace espalier {
namespace {

using nlohmann::json;

TEST(CommandLine, HelpVersionAndMistakes) {
  EXPECT_EQ(tests::espalier("--help").status, 0);
  EXPECT_NE(tests::espalier("--help").output.find("grow"), std::string::npos);
  EXPECT_EQ(tests::espalier("--version").status, 0);
  EXPECT_EQ(tests::espalier("").status, 2);
  EXPECT_EQ(tests::espalier("grow").status, 2);
  EXPECT_EQ(tests::espalier("plant x").status, 2);
  EXPECT_EQ(tests::espalier("grow no-such-scene.yaml").status, 2);
}

TEST(CommandLine, SchemasAreJson) {
  for (const char* kind : {"rules", "scene"}) {
    const auto ran = tests::espalier(std::string("schema ") + kind);
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(json::parse(ran.output)["$schema"], "https://json-schema.org/draft/2020-12/schema");
  }
  EXPECT_NE(tests::espalier("schema plants").status, 0);
}

}  // namespace
}  // namespace espalier
