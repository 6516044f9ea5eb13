#include "sim/base/cbor_writer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "sim/base/byte_sink.h"

namespace espalier::sim {
namespace {

using nlohmann::json;

/// Heads of every length, through a sink: the bytes of another writer.
TEST(CborWriter, WritesWhatAnotherReads) {
  const std::vector<std::uint64_t> numbers = {0,     23,    24,         255,        256,
                                              65535, 65536, 0xffffffff, 1ull << 32, ~std::uint64_t{0}};
  const std::vector<std::int32_t> column(100'000, -7);
  std::string bytes;
  ByteSink sink([&](std::string_view piece) { bytes += piece; });
  std::ostream stream(&sink);
  CborWriter out(stream);
  out.map(4);
  out.text("column");
  out.packed(column);
  out.text("numbers");
  out.array(numbers.size());
  for (const std::uint64_t number : numbers) out.number(number);
  out.text("text");
  out.text(std::string(300, 'x'));
  out.text("true");
  out.boolean(true);
  stream.flush();

  const auto* const raw = reinterpret_cast<const std::uint8_t*>(column.data());
  const json wanted = {{"column", json::binary({raw, raw + column.size() * sizeof(std::int32_t)})},
                       {"numbers", numbers},
                       {"text", std::string(300, 'x')},
                       {"true", true}};
  std::string written;
  json::to_cbor(wanted, written);
  EXPECT_TRUE(bytes == written);
  EXPECT_TRUE(json::from_cbor(bytes) == wanted);
}

}  // namespace
}  // namespace espalier::sim
