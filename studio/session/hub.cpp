#include "studio/session/hub.h"

#include <algorithm>
#include <utility>

namespace espalier::studio {

std::optional<std::string> Listener::next(std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  filled_.wait_for(lock, wait, [&] { return over_ || !frames_.empty(); });
  if (frames_.empty()) return over_ ? std::nullopt : std::optional(std::string());
  const std::shared_ptr<const std::string> frame = std::move(frames_.front());
  frames_.pop_front();
  bytes_ -= frame->size();
  return *frame;
}

void Listener::add(const std::shared_ptr<const std::string>& frame) {
  const std::lock_guard lock(mutex_);
  if (over_) return;
  bytes_ += frame->size();
  if (bytes_ > kMostBytes) {
    frames_.clear();
    bytes_ = 0;
    over_ = true;
  } else {
    frames_.push_back(frame);
  }
  filled_.notify_all();
}

void Listener::close() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  filled_.notify_all();
}

std::vector<std::shared_ptr<Listener>> Hub::living() {
  std::vector<std::shared_ptr<Listener>> all;
  std::erase_if(listeners_, [&](const std::weak_ptr<Listener>& weak) {
    if (auto listener = weak.lock()) {
      all.push_back(std::move(listener));
      return false;
    }
    return true;
  });
  return all;
}

std::shared_ptr<Listener> Hub::join() {
  const std::lock_guard lock(mutex_);
  if (over_ || living().size() >= kMostListeners) return nullptr;
  auto listener = std::make_shared<Listener>();
  listeners_.push_back(listener);
  return listener;
}

void Hub::send(std::string frame) {
  const auto shared = std::make_shared<const std::string>(std::move(frame));
  const std::lock_guard lock(mutex_);
  for (const auto& listener : living()) {
    if (listener->greeted_) listener->add(shared);
  }
}

bool Hub::anyNew() const {
  const std::lock_guard lock(mutex_);
  return std::any_of(listeners_.begin(), listeners_.end(), [](const std::weak_ptr<Listener>& weak) {
    const auto listener = weak.lock();
    return listener && !listener->greeted_;
  });
}

void Hub::greet(const std::vector<std::string>& frames) {
  const std::lock_guard lock(mutex_);
  for (const auto& listener : living()) {
    if (std::exchange(listener->greeted_, true)) continue;
    for (const std::string& frame : frames) listener->add(std::make_shared<const std::string>(frame));
  }
}

void Hub::close() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  for (const auto& listener : living()) listener->close();
}

}  // namespace espalier::studio
