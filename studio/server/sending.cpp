#include "studio/server/sending.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "studio/wire/frame.h"

namespace espalier::studio {
namespace {

constexpr std::chrono::seconds kBetweenPings(2);

/// Sends what is taken of bytes, and knows for how long nothing was.
class Patience {
 public:
  /// How many went; nothing where it is over.
  std::optional<std::size_t> send(httplib::DataSink& sink, std::string_view bytes) {
    const auto now = std::chrono::steady_clock::now();
    if (!sink.is_writable()) return now - taken_ < kLongest ? std::optional(std::size_t{0}) : std::nullopt;
    taken_ = now;
    const std::size_t size = std::min(kPiece, bytes.size());
    return sink.write(bytes.data(), size) ? std::optional(size) : std::nullopt;
  }

 private:
  static constexpr std::size_t kPiece = 1 << 14;  // what a socket takes that takes anything
  static constexpr std::chrono::seconds kLongest{20};
  std::chrono::steady_clock::time_point taken_ = std::chrono::steady_clock::now();
};

/// What a page listens to, on its way.
class Streamed {
 public:
  explicit Streamed(std::shared_ptr<Listener> listener) : listener_(std::move(listener)) {}

  /// Sends a piece, if there is one. False: it is over.
  bool go(httplib::DataSink& sink) {
    if (at_ == frame_.size()) {
      auto next = listener_->next(kBetweenPings);
      if (!next) {
        sink.done();
        return true;
      }
      frame_ = next->empty() ? frameOf(FrameKind::nothing, "") : std::move(*next);
      at_ = 0;
    }
    const auto sent = patience_.send(sink, std::string_view(frame_).substr(at_));
    at_ += sent.value_or(0);
    return sent.has_value();
  }

 private:
  std::shared_ptr<Listener> listener_;
  std::string frame_;
  std::size_t at_ = 0;
  Patience patience_;
};

}  // namespace

void give(httplib::Response& response, Assets::Bytes bytes, const char* type) {
  const std::size_t size = bytes->size();
  response.set_content_provider(
      size, type,
      [bytes = std::move(bytes), patience = std::make_shared<Patience>()](
          std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return patience->send(sink, std::string_view(*bytes).substr(offset, length)).has_value();
      });
}
void give(httplib::Response& response, std::string bytes, const char* type) {
  give(response, std::make_shared<const std::string>(std::move(bytes)), type);
}

void stream(httplib::Response& response, std::shared_ptr<Listener> listener, const char* type) {
  response.set_chunked_content_provider(
      type, [streamed = std::make_shared<Streamed>(std::move(listener))](
                std::size_t, httplib::DataSink& sink) { return streamed->go(sink); });
}

}  // namespace espalier::studio
