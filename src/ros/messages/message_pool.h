#pragma once

#include <cstddef>
#include <vector>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

namespace sdf_ccd {

/// Messages that are published without a copy, and reused with their memory once no subscriber holds them any more.
template <class Message>
class MessagePool {
 public:
  /// A message that nobody else holds. It still has its former contents.
  boost::shared_ptr<Message> acquire() {
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      next_ = (next_ + 1) % messages_.size();
      if (messages_[next_].use_count() == 1) return messages_[next_];
    }
    // A subscriber that keeps messages has to keep its own, so that the pool does not grow forever.
    if (messages_.size() == kMax) return boost::make_shared<Message>();
    messages_.push_back(boost::make_shared<Message>());
    return messages_.back();
  }

 private:
  static constexpr std::size_t kMax = 64;

  std::vector<boost::shared_ptr<Message>> messages_;
  std::size_t next_ = 0;
};

}  // namespace sdf_ccd
