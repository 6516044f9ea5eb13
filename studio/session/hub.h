#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

/// A page that listens: frames that it has still to be sent. Any thread may call any of it.
class Listener {
 public:
  /// What it may leave waiting, after which it is dropped: it asks anew when it is there again.
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;

  /// The next frame; an empty one after so long without any; nothing once it is over.
  std::optional<std::string> next(std::chrono::milliseconds wait);

 private:
  friend class Hub;
  void add(const std::shared_ptr<const std::string>& frame);
  void close();

  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<std::shared_ptr<const std::string>> frames_;
  std::size_t bytes_ = 0;
  bool over_ = false;
  bool greeted_ = false;  // the Hub's
};

/// All pages that listen. Any thread may call any of it.
class Hub {
 public:
  static constexpr std::size_t kMostListeners = 4;

  /// One more, which hears nothing until it is greeted; null where there are as many as may be.
  std::shared_ptr<Listener> join();
  /// To all that were greeted.
  void send(std::string frame);
  /// Whether any waits to be greeted.
  bool anyNew() const;
  /// To those that wait, which hear what is sent from then on.
  void greet(const std::vector<std::string>& frames);
  void close();

 private:
  std::vector<std::shared_ptr<Listener>> living();

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<Listener>> listeners_;
  bool over_ = false;
};

}  // namespace espalier::studio
