#include "ros/monitor/standing_warnings.h"

namespace sdf_ccd {

void StandingWarnings::set(const std::string& kind, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (text.empty()) {
    texts_.erase(kind);
  } else {
    texts_[kind] = text;
  }
}

void StandingWarnings::copyTo(std::vector<std::string>& texts) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  texts.resize(texts_.size());
  std::size_t i = 0;
  for (const auto& [kind, text] : texts_) texts[i++] = text;
}

}  // namespace sdf_ccd
